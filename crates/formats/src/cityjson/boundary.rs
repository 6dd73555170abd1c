//! The nested lists of a geometry's boundaries and semantics, whatever its type, as solids of shells of surfaces of rings.

use super::document::{Geometry, Semantics, reason};
use serde::Deserialize;
use serde_json::value::RawValue;

/// A vertex a corner, not closed: the first is not said again.
pub(super) type Ring = Vec<u32>;
/// The outer ring, and the holes in it.
pub(super) type Surface = Vec<Ring>;
type Shell = Vec<Surface>;
type Solid = Vec<Shell>;
/// For each surface which entry of the semantics says what it is. Anything may be `null`.
type Kinds = Option<Vec<Option<Vec<Option<usize>>>>>;

/// How deep a geometry's lists are.
#[derive(Clone, Copy, PartialEq)]
enum Depth {
    Surfaces,
    Solid,
    Solids,
}

/// Whether a geometry has surfaces at all, and may be read.
pub(super) fn is_solid(geometry: &Geometry<'_>) -> Option<bool> {
    depth(geometry).map(|depth| depth != Depth::Surfaces)
}

fn depth(geometry: &Geometry<'_>) -> Option<Depth> {
    match &*geometry.kind {
        "MultiSurface" | "CompositeSurface" => Some(Depth::Surfaces),
        "Solid" => Some(Depth::Solid),
        "MultiSolid" | "CompositeSolid" => Some(Depth::Solids),
        _ => None,
    }
}

/// All surfaces of a geometry, each with its entry in the semantics where there is one.
///
/// # Errors
/// What is wrong, when the lists are not as deep as the type says or hold something else than indices.
pub(super) fn surfaces(
    geometry: &Geometry<'_>,
) -> Result<impl Iterator<Item = (Surface, Option<usize>)> + use<>, String> {
    let (depth, text) = (depth(geometry), geometry.boundaries);
    let (Some(depth), Some(text)) = (depth, text) else {
        return Err(format!(
            "a geometry of the type \"{}\" without \"boundaries\"",
            super::shorten(&geometry.kind)
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

/// What cannot be read of it is left out: it is colour alone.
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
