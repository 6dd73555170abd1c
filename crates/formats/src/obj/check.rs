//! A check of OBJ and MTL texts before `tobj` reads them: only the needed lines are kept, and every index is checked
//! against the preceding lines. The crate itself overflows on large indices and panics on colours with fewer than
//! three numbers.

use crate::budget::Budget;
use crate::error::LoadProblem;
use std::borrow::Cow;

/// Bytes that the crate keeps of a face and of each of its corners, and of a group, while it reads.
const FACE: u64 = 96;
const CORNER: u64 = 64;
const GROUP: u64 = 256;

/// The text without lines, points and nameless materials. The corners of its faces exist or are at least numbers in a
/// valid range. Triangles are counted against the budget.
pub(super) fn shapes(text: &str, budget: &mut Budget) -> Result<String, LoadProblem> {
    budget.enter("the text");
    budget.memory(text.len() as u64)?;
    let mut kept = String::with_capacity(text.len());
    // The numbers of positions, texture coordinates and normals so far, in the order of a corner's three numbers.
    let mut counts = [0_i64; 3];
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => counts[0] += 1,
            Some("vt") => counts[1] += 1,
            Some("vn") => counts[2] += 1,
            Some("f") => {
                let mut corners = 0_u64;
                for corner in words {
                    corners += 1;
                    if !is_sane(corner, counts) {
                        return Err(LoadProblem::Syntax {
                            format: "OBJ",
                            place: format!("line {}", i + 1),
                            problem: format!(
                                "the corner \"{}\" does not refer to one of the {} vertices, {} texture coordinates and {} normals before it",
                                corner.chars().take(40).collect::<String>(),
                                counts[0],
                                counts[1],
                                counts[2]
                            ),
                        });
                    }
                }
                if corners < 3 {
                    continue;
                }
                budget.triangles(corners - 2)?;
                budget.memory(FACE + corners * CORNER)?;
            }
            Some("usemtl" | "mtllib") if words.clone().next().is_none() => continue,
            Some("o" | "g" | "usemtl") => budget.memory(GROUP)?,
            Some("mtllib") => {}
            _ => continue,
        }
        kept.push_str(line);
        kept.push('\n');
    }
    Ok(kept)
}

/// Whether a corner "v/vt/vn" has numbers from 1 to 2^31, or negative numbers that refer to existing elements.
/// Whether the element of a positive number exists is checked later, by the crate.
fn is_sane(corner: &str, counts: [i64; 3]) -> bool {
    let mut numbers = corner.split('/');
    let sane = counts
        .into_iter()
        .zip(numbers.by_ref())
        .all(|(count, number)| {
            number.is_empty()
                || number
                    .parse::<i64>()
                    .is_ok_and(|n| (1..=1 << 31).contains(&n) || (n < 0 && -count <= n))
        });
    let starts = corner.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+');
    sane && starts && numbers.next().is_none()
}

/// The lines of a material library with a colour, an opacity or an image. A colour with one number is grey.
pub(super) fn materials(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    for line in text.lines() {
        let line = line.trim();
        let mut words = line.split_whitespace();
        let keep = match (words.next(), words.next()) {
            (Some("newmtl" | "d" | "map_Kd"), Some(_)) => Cow::Borrowed(line),
            (Some("Kd"), Some(red)) => match words.nth(1) {
                Some(_) => Cow::Borrowed(line),
                None => Cow::Owned(format!("Kd {red} {red} {red}")),
            },
            _ => continue,
        };
        kept.push_str(&keep);
        kept.push('\n');
    }
    kept
}
