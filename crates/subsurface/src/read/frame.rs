//! Surfaces from the units of their file to metres: the rule of rasters ([`antumbra_formats::raster::Frame`]) for triangles.

use antumbra_formats::Units;
use antumbra_formats::raster::{Extent, Frame, Known};
use glam::{DVec2, DVec3, Vec3};

use super::options::ReadOptions;
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

/// Takes surfaces to metres. `said` is what their file says of its units.
pub(super) fn in_metres(
    surfaces: &mut [Surface],
    said: Units,
    options: &ReadOptions,
) -> Result<Frame, String> {
    let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let points = surfaces.iter().flat_map(|surface| {
        let positions = surface.geometry.positions.iter();
        positions.map(|position| surface.origin + Vec3::from(*position).as_dvec3())
    });
    let [low, high] = points.fold(empty, |[low, high], point| {
        [low.min(point), high.max(point)]
    });
    let frame = frame([low, high], said, options)?;
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
