//! STL, ASCII and binary. The count is checked against the bytes first. Binary files are distinguished from ASCII ones by their length, since
//! many binary files begin with "solid" as well.
//!
//! Each solid becomes an entity. The corners of its triangles are welded by position. A triangle's normal is that of its plane: the stored one,
//! which the format requires to be the same, is often zero or wrong. The crate `stl_io` is not used, since it reads the first solid alone, and
//! that only in lower case.

mod ascii;
mod solid;

use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::local_origin::localise;
use crate::text::legible;
use antumbra_scene::{Geometry, Scene};
use glam::DVec3;
use solid::{Solid, TRIANGLE_MEMORY};

const HEADER: usize = 80;
const TRIANGLE: u64 = 50;

/// Reads the solids.
pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Scene, LoadProblem> {
    let mut scene = Scene::new();
    let mut solids = match kind(bytes) {
        Kind::Text => ascii::read(&legible(bytes, budget)?, budget)?,
        Kind::Binary => vec![binary(bytes, budget)?],
    };
    if solids.len() > 1 {
        solids.retain(|solid| !solid.indices.is_empty());
    }
    for solid in solids {
        budget.entities(1)?;
        budget.vertices(solid.corners.len() as u64)?;
        let local = localise(solid.corners.iter().copied());
        let transform = local.transform();
        let geometry = Geometry {
            positions: local.positions,
            indices: solid.indices,
            ..Geometry::default()
        };
        crate::single::spawn(&mut scene, &solid.name, geometry, transform)?;
    }
    Ok(scene)
}

fn binary(bytes: &[u8], budget: &mut Budget) -> Result<Solid, LoadProblem> {
    let BinaryBody { body, count } = binary_body(bytes).ok_or_else(|| LoadProblem::Truncated {
        what: "a binary STL's header".into(),
        needed: HEADER as u64 + 4,
        available: bytes.len() as u64,
    })?;
    let needed = u64::from(count) * TRIANGLE;
    if needed > body.len() as u64 {
        return Err(LoadProblem::Truncated {
            what: format!("{count} triangles"),
            needed,
            available: body.len() as u64,
        });
    }
    budget.triangles(u64::from(count))?;
    budget.mesh("stl")?;
    budget.memory(u64::from(count) * TRIANGLE_MEMORY)?;
    let mut solid = Solid::named("");
    let triangles = body.as_chunks::<{ TRIANGLE as usize }>().0;
    for triangle in triangles.iter().take(count as usize) {
        // The normal's three numbers, then those of the corners.
        let numbers = triangle.as_chunks::<4>().0;
        let mut numbers = numbers
            .iter()
            .skip(3)
            .map(|b| f64::from(f32::from_le_bytes(*b)));
        let mut next = || numbers.next().unwrap_or_default();
        let corners = [(); 3].map(|()| DVec3::new(next(), next(), next()));
        solid.add(corners, budget);
    }
    Ok(solid)
}

/// The body of a binary file.
struct BinaryBody<'a> {
    /// What follows the count.
    body: &'a [u8],
    /// The number of triangles.
    count: u32,
}

/// The body of a binary file; `None` if it is too short.
fn binary_body(bytes: &[u8]) -> Option<BinaryBody<'_>> {
    let (count, body) = bytes.get(HEADER..)?.split_first_chunk::<4>()?;
    Some(BinaryBody {
        body,
        count: u32::from_le_bytes(*count),
    })
}

/// How a file is written.
enum Kind {
    /// In ASCII.
    Text,
    /// In binary.
    Binary,
}

fn kind(bytes: &[u8]) -> Kind {
    let exact = binary_body(bytes)
        .is_some_and(|body| body.body.len() as u64 == u64::from(body.count) * TRIANGLE);
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let word = start.trim_ascii_start().get(..5).unwrap_or_default();
    let is_text = word.eq_ignore_ascii_case(b"solid") || word.eq_ignore_ascii_case(b"facet");
    match is_text && !exact {
        true => Kind::Text,
        false => Kind::Binary,
    }
}
