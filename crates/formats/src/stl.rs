//! STL, read by the crate `stl_io`. The count is checked against the bytes first. Binary files are distinguished from
//! ASCII ones by their length, since many binary files begin with "solid" as well.

use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::Geometry;
use std::collections::HashMap;
use std::io::Cursor;

const HEADER: usize = 80;
const TRIANGLE: u64 = 50;
/// Bytes of memory of a triangle's corners while they are welded.
const TRIANGLE_MEMORY: u64 = 128;

/// Reads the triangles and welds their corners by position. The stored normals are ignored, since they are often
/// zero.
pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Geometry, LoadProblem> {
    let body = binary_body(bytes);
    if !is_ascii(bytes) {
        let BinaryBody { available, count } = body.ok_or_else(|| LoadProblem::Truncated {
            what: "a binary STL's header".into(),
            needed: HEADER as u64 + 4,
            available: bytes.len() as u64,
        })?;
        let needed = u64::from(count) * TRIANGLE;
        if needed > available {
            return Err(LoadProblem::Truncated {
                what: format!("{count} triangles"),
                needed,
                available,
            });
        }
        budget.triangles(u64::from(count))?;
        // The crate would read a header with "solid" as ASCII.
        let disguised = bytes.starts_with(b"solid").then(|| {
            let mut copy = bytes.to_vec();
            copy.iter_mut().take(5).for_each(|byte| *byte = 0);
            copy
        });
        return collect(disguised.as_deref().unwrap_or(bytes), budget);
    }
    // The crate requires a space even without a name.
    let spaced = (!bytes.starts_with(b"solid ")).then(|| {
        let rest = bytes.get(5..).unwrap_or_default();
        [b"solid ", rest].concat()
    });
    collect(spaced.as_deref().unwrap_or(bytes), budget)
}

fn collect(bytes: &[u8], budget: &mut Budget) -> Result<Geometry, LoadProblem> {
    let broken = |place: String, problem: std::io::Error| LoadProblem::Syntax {
        format: "STL",
        place,
        problem: problem.to_string(),
    };
    let mut cursor = Cursor::new(bytes);
    let triangles =
        stl_io::create_stl_reader(&mut cursor).map_err(|e| broken("the header".into(), e))?;
    let mut geometry = Geometry::default();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    for (i, triangle) in triangles.enumerate() {
        let triangle = triangle.map_err(|e| broken(format!("triangle {i}"), e))?;
        // Three corners, each with an entry in the map.
        budget.memory(TRIANGLE_MEMORY)?;
        for corner in triangle.vertices {
            let position: [f32; 3] = corner.into();
            let next = known.len() as u32;
            let index = *known.entry(position.map(f32::to_bits)).or_insert(next);
            if index == next {
                geometry.positions.push(position);
            }
            geometry.indices.push(index);
        }
    }
    budget.vertices(geometry.positions.len() as u64)?;
    Ok(geometry)
}

/// The body of a binary file.
struct BinaryBody {
    /// Bytes after the count.
    available: u64,
    /// The number of triangles.
    count: u32,
}

/// The body of a binary file; `None` if it is too short.
fn binary_body(bytes: &[u8]) -> Option<BinaryBody> {
    let count = bytes.get(HEADER..)?.first_chunk::<4>()?;
    let available = bytes.len() - HEADER - 4;
    Some(BinaryBody {
        available: available as u64,
        count: u32::from_le_bytes(*count),
    })
}

fn is_ascii(bytes: &[u8]) -> bool {
    let exact =
        binary_body(bytes).is_some_and(|body| body.available == u64::from(body.count) * TRIANGLE);
    bytes.starts_with(b"solid") && !exact
}
