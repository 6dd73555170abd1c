//! Surfaces from the units of their file to metres: the rule of rasters ([`antumbra_formats::raster::Frame`]) for triangles.

use antumbra_formats::Units;
use antumbra_formats::raster::{Extent, Frame, Known};
use glam::{DVec2, DVec3, Vec3};

use super::delaunay::PointSet;
use super::options::ReadOptions;
use crate::assemble;
use crate::corner_point::CornerPointGrid;
use crate::surface::Surface;

/// Surfaces wider than this, in degrees, are not taken for degrees without a word of the file.
const WIDEST: f64 = 5.0;
/// Nor are those less steep than this: a small model of metres is.
const STEEPEST: f64 = 20.0;

/// Takes a grid to metres, with what was assumed.
pub(super) fn grid_in_metres(
    grid: CornerPointGrid,
    options: &ReadOptions,
) -> Result<(CornerPointGrid, Vec<String>), String> {
    let frame = frame(grid.pillar_box(), Units::default(), options)?;
    Ok((grid.scaled(scale(&frame)), frame.notes))
}

/// Metres of the file's units along the world's axes.
fn scale(frame: &Frame) -> DVec3 {
    DVec3::new(frame.plan.x, frame.height, frame.plan.y)
}

/// Whether places of which the file says nothing can only be degrees.
pub(crate) fn looks_like_degrees(extent: &Extent) -> bool {
    (extent.high - extent.low).max_element() <= WIDEST && extent.looks_like_degrees(STEEPEST)
}

/// The frame of what lies in a box of the world.
fn frame([low, high]: [DVec3; 2], said: Units, options: &ReadOptions) -> Result<Frame, String> {
    let extent = Extent {
        low: DVec2::new(low.x, -high.z),
        high: DVec2::new(high.x, -low.z),
        relief: high.y - low.y,
    };
    Frame::of(
        &extent,
        &Known {
            named: options.units,
            said,
            looks_like_degrees: looks_like_degrees(&extent),
            latitude: options.latitude,
        },
    )
}

/// Takes sets of points, of which their file says nothing, to metres.
pub(super) fn points_in_metres(
    sets: &mut [PointSet],
    options: &ReadOptions,
) -> Result<Frame, String> {
    let points = sets.iter().flat_map(|set| set.points.iter().copied());
    let frame = frame(box_of(points), Units::default(), options)?;
    let scale = scale(&frame);
    for point in sets.iter_mut().flat_map(|set| &mut set.points) {
        *point *= scale;
        if !assemble::is_place(*point) {
            return Err(format!(
                "its point at {point}, in metres, is no place on Earth"
            ));
        }
    }
    Ok(frame)
}

/// The box of points; an empty one without any.
fn box_of(points: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    points.fold(empty, |[low, high], point| {
        [low.min(point), high.max(point)]
    })
}

/// Takes surfaces to metres. `said` is what their file says of its units.
pub(super) fn in_metres(
    surfaces: &mut [Surface],
    said: Units,
    options: &ReadOptions,
) -> Result<Frame, String> {
    let points = surfaces.iter().flat_map(|surface| {
        let positions = surface.geometry.positions.iter();
        positions.map(|position| surface.origin + Vec3::from(*position).as_dvec3())
    });
    let frame = frame(box_of(points), said, options)?;
    let scale = scale(&frame);
    if scale != DVec3::ONE {
        for surface in surfaces {
            surface.origin *= scale;
            for position in &mut surface.geometry.positions {
                let scaled = Vec3::from(*position).as_dvec3() * scale;
                *position = scaled.as_vec3().to_array();
            }
            surface.geometry.normals.clear();
            let geometry = std::mem::take(&mut surface.geometry);
            surface.geometry = geometry.with_computed_normals();
        }
    }
    Ok(frame)
}
