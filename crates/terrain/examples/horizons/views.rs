//! What is culled from a valley, a slope and a peak, compared with what is hidden there, and how long a traversal takes.

use std::error::Error;
use std::time::Instant;

use antumbra_terrain::{
    AzimuthRange, Field, GroupHierarchy, GroupOptions, Horizons, LineOfSight, Method, Observer,
    Scope, Sectors,
};
use glam::DVec3;
use rayon::prelude::*;

use crate::tables::{self, REACHES};

/// The height of viewpoints above the ground, metres.
const EYES: f64 = 2.0;

/// Three viewpoints, none of them near the boundary.
pub struct Viewpoints {
    /// In a valley.
    pub valley: DVec3,
    /// Half-way up.
    pub slope: DVec3,
    /// On the highest peak.
    pub peak: DVec3,
}

/// Chooses the viewpoints of a field, 2 metres above the ground.
pub fn viewpoints(field: &Field) -> Viewpoints {
    let [low, high] = field.plan_bounds();
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let inner = |point: &&DVec3| ((point.truncate() - middle) / half).abs().max_element() < 0.6;
    let mut inside: Vec<DVec3> = field.points().iter().filter(inner).copied().collect();
    inside.sort_by(|a, b| a.z.total_cmp(&b.z));
    let at = |share: f64| {
        let point = inside.get((share * (inside.len() - 1) as f64) as usize);
        point.copied().unwrap_or_default() + DVec3::Z * EYES
    };
    Viewpoints {
        valley: at(0.02),
        slope: at(0.5),
        peak: at(1.0),
    }
}

/// Which triangles are drawn for an observer that sees in all directions.
pub fn drawn(groups: &GroupHierarchy, eye: DVec3) -> Vec<bool> {
    let mut drawn = vec![false; groups.order().len()];
    let mut draw = |range: std::ops::Range<u32>| {
        let row = groups.order().get(range.start as usize..range.end as usize);
        row.unwrap_or_default()
            .iter()
            .for_each(|triangle| drawn[*triangle as usize] = true);
    };
    draw(groups.ungrouped());
    Observer::new(groups, eye, AzimuthRange::ALL)
        .each_visible(|group| draw(groups.groups()[group as usize].triangles.clone()));
    drawn
}

/// Which triangles are visible: at a corner, at the middle of a side, or at the centroid.
pub fn seen(field: &Field, eye: DVec3) -> Vec<bool> {
    let line_of_sight = LineOfSight::new(field);
    (0..field.triangles().len() as u32)
        .into_par_iter()
        .map(|triangle| {
            let [a, b, c] = field.corners(triangle);
            let points = [
                a,
                b,
                c,
                (a + b) / 2.0,
                (b + c) / 2.0,
                (c + a) / 2.0,
                (a + b + c) / 3.0,
            ];
            // A triangle that faces away is not visible.
            let faces = (b - a).cross(c - a).dot(eye - a) > 0.0;
            faces
                && points
                    .into_iter()
                    .any(|point| !line_of_sight.is_blocked(eye, point))
        })
        .collect()
}

pub fn print(field: &Field) -> Result<(), Box<dyn Error>> {
    let Viewpoints {
        valley,
        slope,
        peak,
    } = viewpoints(field);
    let views = [valley, slope, peak].map(|eye| (eye, seen(field, eye)));
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
                min_triangles: 130,
                ..thesis
            },
            own,
            GroupOptions::of_seeds(own.seeds * 4),
            GroupOptions {
                min_triangles: 8,
                ..GroupOptions::of_seeds(own.seeds * 16)
            },
        ] {
            let groups = GroupHierarchy::build(field, &horizons, &options)?;
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
            for (eye, seen) in &views {
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
                    Observer::new(&groups, *eye, AzimuthRange::ALL)
                        .each_visible(|group| last = group);
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
                100.0 * groups.ungrouped().len() as f64 / field.triangles().len() as f64,
                cells[0],
                cells[1],
                cells[2],
            );
        }
    }
    println!();
    Ok(())
}
