//! The nested lists of a geometry's boundaries and semantics. For any type of geometry they become solids of shells
//! of surfaces of rings.

use super::document::{Geometry, Semantics, reason};
use crate::error::shorten;
use serde::Deserialize;
use serde_json::value::RawValue;

/// One vertex index per corner. The first corner is not repeated at the end.
pub(super) type Ring = Vec<u32>;
/// The outer ring, and the rings of its holes.
pub(super) type Surface = Vec<Ring>;
type Shell = Vec<Surface>;
type Solid = Vec<Shell>;
/// For each surface the index of its entry in the semantics. Any list may be `null`.
type Kinds = Option<Vec<Option<Vec<Option<usize>>>>>;

/// The nesting depth of a geometry's lists.
#[derive(Clone, Copy, PartialEq)]
enum Depth {
    Surfaces,
    Solid,
    Solids,
}

/// What the surfaces of a geometry form.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum GeometryKind {
    /// Surfaces, visible from both sides.
    Surfaces,
    /// Solids, whose surfaces are visible from outside.
    Solids,
}

/// The kind of a geometry; `None` for one without surfaces.
pub(super) fn kind(geometry: &Geometry<'_>) -> Option<GeometryKind> {
    depth(geometry).map(|depth| match depth {
        Depth::Surfaces => GeometryKind::Surfaces,
        Depth::Solid | Depth::Solids => GeometryKind::Solids,
    })
}

fn depth(geometry: &Geometry<'_>) -> Option<Depth> {
    match &*geometry.kind {
        "MultiSurface" | "CompositeSurface" => Some(Depth::Surfaces),
        "Solid" => Some(Depth::Solid),
        "MultiSolid" | "CompositeSolid" => Some(Depth::Solids),
        _ => None,
    }
}

/// The lines of a geometry; points are lines of one vertex. `None` for one of another kind.
///
/// # Errors
/// The lists are not as deep as the type specifies, or contain something other than indices.
pub(super) fn lines(geometry: &Geometry<'_>) -> Result<Option<Vec<Ring>>, String> {
    let Some(text) = geometry.boundaries else {
        return Ok(None);
    };
    match &*geometry.kind {
        "MultiLineString" => nested(text).map(Some),
        "MultiPoint" => {
            let points: Ring = nested(text)?;
            Ok(Some(points.into_iter().map(|point| vec![point]).collect()))
        }
        _ => Ok(None),
    }
}

/// The vertex at which an instance of a template is placed; `None` if it has none.
pub(super) fn anchor(geometry: &Geometry<'_>) -> Option<u32> {
    let vertices: Ring = nested(geometry.boundaries?).ok()?;
    vertices.first().copied()
}

/// All surfaces of a geometry, each with the index of its entry in the semantics, if it has one.
///
/// # Errors
/// The lists are not as deep as the type specifies, or contain something other than indices.
pub(super) fn surfaces(
    geometry: &Geometry<'_>,
) -> Result<impl Iterator<Item = (Surface, Option<usize>)> + use<>, String> {
    let (depth, text) = (depth(geometry), geometry.boundaries);
    let (Some(depth), Some(text)) = (depth, text) else {
        return Err(format!(
            "a geometry of the type \"{}\" without \"boundaries\"",
            shorten(&geometry.kind)
        ));
    };
    let solids: Vec<Solid> = match depth {
        Depth::Surfaces => nested::<Shell>(text).map(|shell| vec![vec![shell]]),
        Depth::Solid => nested::<Solid>(text).map(|solid| vec![solid]),
        Depth::Solids => nested(text),
    }?;
    let kinds = geometry.semantics.as_ref();
    let mut kinds = kinds.map_or(Vec::new(), |semantics| kinds_of(semantics, depth));
    kinds.resize(solids.len(), None);
    let solids = solids.into_iter().zip(kinds);
    let shells = solids.flat_map(|(solid, kinds)| {
        let mut kinds = kinds.unwrap_or_default();
        kinds.resize(solid.len(), None);
        solid.into_iter().zip(kinds)
    });
    Ok(shells.flat_map(|(shell, kinds)| {
        let mut kinds = kinds.unwrap_or_default();
        kinds.resize(shell.len(), None);
        shell.into_iter().zip(kinds)
    }))
}

/// Invalid semantics are ignored, since they only affect colours.
fn kinds_of(semantics: &Semantics<'_>, depth: Depth) -> Vec<Kinds> {
    let Some(text) = semantics.values else {
        return Vec::new();
    };
    let kinds = match depth {
        Depth::Surfaces => nested(text).map(|surfaces| vec![Some(vec![surfaces])]),
        Depth::Solid => nested(text).map(|solid| vec![solid]),
        Depth::Solids => nested(text),
    };
    kinds.unwrap_or_default()
}

fn nested<'a, T: Deserialize<'a>>(text: &'a RawValue) -> Result<T, String> {
    serde_json::from_str(text.get()).map_err(|error| {
        let at = error.column();
        format!(
            "its lists are not what its type says, {} (column {at} of them)",
            reason(&error)
        )
    })
}
