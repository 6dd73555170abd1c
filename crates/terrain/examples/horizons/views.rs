//! What groups hide from a valley, a slope and a peak, against what is hidden there, and how long it takes to tell.

use std::error::Error;
use std::time::Instant;

use antumbra_terrain::{
    Arc, Eye, Field, GroupOptions, Groups, Horizons, Method, Scope, Sectors, Sights,
};
use glam::DVec3;
use rayon::prelude::*;

use crate::tables::{self, REACHES};

/// Metres that somebody's eyes are above the ground.
const EYES: f64 = 2.0;

/// Somebody in a deep place, half-way up, and on the highest peak, none of them at the border.
pub fn places(field: &Field) -> [(&'static str, DVec3); 3] {
    let [low, high] = field.plan_bounds();
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let inner = |point: &&DVec3| ((point.truncate() - middle) / half).abs().max_element() < 0.6;
    let mut inside: Vec<DVec3> = field.points().iter().filter(inner).copied().collect();
    inside.sort_by(|a, b| a.z.total_cmp(&b.z));
    let at = |share: f64| {
        let place = inside.get((share * (inside.len() - 1) as f64) as usize);
        place.copied().unwrap_or_default() + DVec3::Z * EYES
    };
    [("valley", at(0.02)), ("slope", at(0.5)), ("peak", at(1.0))]
}

/// Which triangles are drawn for somebody who looks around.
pub fn drawn(groups: &Groups, eye: DVec3) -> Vec<bool> {
    let mut drawn = vec![false; groups.order().len()];
    let mut draw = |range: std::ops::Range<u32>| {
        let row = groups.order().get(range.start as usize..range.end as usize);
        row.unwrap_or_default()
            .iter()
            .for_each(|triangle| drawn[*triangle as usize] = true);
    };
    draw(groups.always());
    Eye::new(groups, eye, Arc::ALL)
        .each_seen(|group| draw(groups.groups()[group as usize].triangles.clone()));
    drawn
}

/// Which triangles are seen: of any of their corners, middles of sides and their own middle.
pub fn seen(field: &Field, eye: DVec3) -> Vec<bool> {
    let sights = Sights::new(field);
    (0..field.triangles().len() as u32)
        .into_par_iter()
        .map(|triangle| {
            let [a, b, c] = field.corners(triangle);
            let places = [
                a,
                b,
                c,
                (a + b) / 2.0,
                (b + c) / 2.0,
                (c + a) / 2.0,
                (a + b + c) / 3.0,
            ];
            // Turned away, nothing of it is seen.
            let faces = (b - a).cross(c - a).dot(eye - a) > 0.0;
            faces
                && places
                    .into_iter()
                    .any(|place| !sights.is_blocked(eye, place))
        })
        .collect()
}

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    let views: Vec<_> = places(field)
        .into_iter()
        .map(|(name, eye)| (name, eye, seen(field, eye)))
        .collect();
    println!(
        "| sectors / sub-sectors | reaches | seeds | groups | triangles a group, median | over 130 | always drawn | hidden of valley, slope, peak | of those culled | seen and culled | µs a frame |\n|---|---|---|---|---|---|---|---|---|---|---|"
    );
    let thesis = tables::groups(field);
    let own = GroupOptions::for_triangles(field.triangles().len());
    for [count, parts, reaches] in [[16, 4, 1], [16, 4, REACHES], [32, 4, 1], [32, 4, REACHES]] {
        let horizons = Horizons::find(
            field,
            Sectors::new(count, parts)?.with_reaches(reaches)?,
            Method::Sound,
            Scope::Surface,
            &|| (),
        );
        for options in [
            thesis,
            GroupOptions {
                smallest: 130,
                ..thesis
            },
            own,
            GroupOptions::of_seeds(own.seeds * 4),
            GroupOptions {
                smallest: 8,
                ..GroupOptions::of_seeds(own.seeds * 16)
            },
        ] {
            let groups = Groups::make(field, &horizons, &options)?;
            let mut sizes: Vec<usize> = groups
                .groups()
                .iter()
                .filter(|group| group.is_leaf())
                .map(|group| group.triangles.len())
                .collect();
            sizes.sort_unstable();
            let large = sizes.iter().filter(|size| **size > 130).count();
            let mut cells = [String::new(), String::new(), String::new()];
            let mut times = String::new();
            for (_, eye, seen) in &views {
                let drawn = drawn(&groups, *eye);
                let all = seen.len() as f64;
                let hidden = seen.iter().filter(|seen| !**seen).count();
                let culled = drawn
                    .iter()
                    .zip(seen)
                    .filter(|(drawn, seen)| !**drawn && !**seen)
                    .count();
                let wrong = drawn
                    .iter()
                    .zip(seen)
                    .filter(|(drawn, seen)| !**drawn && **seen)
                    .count();
                cells[0] += &format!("{:.0} % ", 100.0 * hidden as f64 / all);
                cells[1] += &format!("{:.0} % ", 100.0 * culled as f64 / hidden as f64);
                cells[2] += &format!("{wrong} ");
                let (start, runs) = (Instant::now(), 200);
                let mut last = 0;
                for _ in 0..runs {
                    Eye::new(&groups, *eye, Arc::ALL).each_seen(|group| last = group);
                }
                std::hint::black_box(last);
                times += &format!(
                    "{:.0} ",
                    start.elapsed().as_secs_f64() / f64::from(runs) * 1e6
                );
            }
            println!(
                "| {count} / {parts} | {reaches} | {} | {} | {} | {:.0} % | {:.1} % | {}| {}| {}| {times}|",
                options.seeds,
                sizes.len(),
                sizes.get(sizes.len() / 2).copied().unwrap_or_default(),
                100.0 * large as f64 / sizes.len().max(1) as f64,
                100.0 * groups.always().len() as f64 / field.triangles().len() as f64,
                cells[0],
                cells[1],
                cells[2],
            );
        }
    }
    println!();
    Ok(())
}
