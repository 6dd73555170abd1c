//! Pictures like figures 16, 17, 19, 20 and 21 of Edmondson's thesis.

use std::error::Error;
use std::path::Path;

use antumbra_terrain::{Crystals, Field, GroupHierarchy, Horizons, Method, NONE, Scope, Sectors};
use glam::DVec3;
use image::RgbImage;

use crate::canvas::{self, View};
use crate::views::Viewpoints;
use crate::{tables, views};

const GROUND: [u8; 3] = [150, 160, 140];
const SEEN: [u8; 3] = [250, 215, 60];
const DRAWN: [u8; 3] = [235, 130, 40];
const WRONG: [u8; 3] = [220, 0, 0];
const PALE: [u8; 3] = [225, 232, 240];

pub fn draw(field: &Field, folder: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    let Viewpoints {
        valley,
        slope,
        peak,
    } = views::viewpoints(field);
    let seen = |eye| views::seen(field, eye);
    let slope_seen = seen(slope);
    for (name, settings) in [
        ("sectors", [[8, 8], [16, 4], [32, 2], [64, 1]]),
        ("parts", [[8, 1], [8, 2], [8, 4], [8, 8]]),
    ] {
        let mut rows = Vec::new();
        for method in [Method::Thesis, Method::Sound] {
            let mut row = Vec::new();
            for [count, parts] in settings {
                let horizons = Horizons::find(
                    field,
                    Sectors::new(count, parts)?,
                    method,
                    Scope::Surface,
                    &|| (),
                );
                row.push(viewshed(field, &horizons, slope, &slope_seen));
            }
            rows.push(row);
        }
        canvas::tile(&rows).save(folder.join(format!("viewsheds-by-{name}.png")))?;
    }
    let options = tables::groups(field);
    let mut row = Vec::new();
    for [count, parts] in [[8, 8], [16, 4], [32, 2], [64, 1]] {
        let horizons = Horizons::find(
            field,
            Sectors::new(count, parts)?,
            Method::Sound,
            Scope::Surface,
            &|| (),
        );
        let crystals = Crystals::grow(field, &horizons, &options)?;
        row.push(canvas::draw(field, View::Plan, 360, |triangle| {
            of_group(crystals.group_of[triangle as usize])
        }));
        if [count, parts] == [16, 4] {
            canvas::draw(field, View::Oblique, 1200, |triangle| {
                of_group(crystals.group_of[triangle as usize])
            })
            .save(folder.join("groups-aslant.png"))?;
        }
    }
    canvas::tile(&[row]).save(folder.join("groups.png"))?;
    let horizons = Horizons::find(
        field,
        Sectors::new(64, 2)?,
        Method::Sound,
        Scope::Surface,
        &|| (),
    );
    let small = antumbra_terrain::GroupOptions::of_seeds(field.triangles().len() as u32 / 50);
    let groups = GroupHierarchy::build(field, &horizons, &small)?;
    let mut row = Vec::new();
    for eye in [valley, slope, peak] {
        let (drawn, seen) = (views::drawn(&groups, eye), seen(eye));
        let colour = |triangle: u32| match (drawn[triangle as usize], seen[triangle as usize]) {
            (true, true) => SEEN,
            (true, false) => GROUND,
            (false, false) => PALE,
            (false, true) => WRONG,
        };
        row.push(marked(
            field,
            eye,
            canvas::draw(field, View::Plan, 480, colour),
        ));
    }
    canvas::tile(&[row]).save(folder.join("culled.png"))?;
    Ok(())
}

/// The triangles that are visible, that are drawn but not visible, and that are visible but not drawn, with each triangle tested by itself.
fn viewshed(field: &Field, horizons: &Horizons, eye: DVec3, seen: &[bool]) -> RgbImage {
    let colour = |triangle: u32| {
        let corners = field.triangles()[triangle as usize];
        let hidden = corners
            .into_iter()
            .all(|corner| horizons.hides_vertex(field, corner, eye));
        match (hidden, seen[triangle as usize]) {
            (false, true) => SEEN,
            (false, false) => DRAWN,
            (true, false) => GROUND,
            (true, true) => WRONG,
        }
    };
    marked(field, eye, canvas::draw(field, View::Plan, 360, colour))
}

fn marked(field: &Field, eye: DVec3, mut picture: RgbImage) -> RgbImage {
    let at = canvas::plan(field, picture.width(), eye.truncate());
    canvas::mark(&mut picture, at);
    picture
}

/// A colour for a group's number; black for no group.
fn of_group(group: u32) -> [u8; 3] {
    if group == NONE {
        return [0; 3];
    }
    let mixed = (group + 1).wrapping_mul(0x9E37_79B1);
    [mixed >> 24, mixed >> 16, mixed >> 8].map(|part| 70 + ((part & 0xFF) * 180 / 255) as u8)
}
