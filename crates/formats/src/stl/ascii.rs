//! ASCII STL: any number of solids. Words are read in any case and with any white space between them.

use super::solid::{Solid, TRIANGLE_MEMORY};
use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::text::{Line, lines};
use glam::DVec3;

/// The solids of a text, with their triangles.
///
/// # Errors
/// A word that does not belong there, with its line; what exceeds the budget.
pub(super) fn read(text: &str, budget: &mut Budget) -> Result<Vec<Solid>, LoadProblem> {
    let mut solids: Vec<Solid> = Vec::new();
    let mut corners: Vec<DVec3> = Vec::new();
    // Whether a facet has begun that has not ended.
    let mut is_open = false;
    for Line { number, text: line } in lines(text) {
        let mut words = line.split_whitespace();
        let Some(mut first) = words.next() else {
            continue;
        };
        // Some write "end solid".
        let joined;
        if first.eq_ignore_ascii_case("end") {
            joined = format!("end{}", words.next().unwrap_or_default());
            first = &joined;
        }
        let broken = |problem: String| LoadProblem::Syntax {
            format: "STL",
            place: format!("line {number}"),
            problem,
        };
        let is = |word: &str| first.eq_ignore_ascii_case(word);
        if is("solid") {
            let name = line.trim().get(first.len()..).unwrap_or_default().trim();
            budget.mesh(name)?;
            budget.name(name)?;
            solids.push(Solid::named(name));
        } else if is("vertex") {
            if !is_open {
                return Err(broken("a vertex outside of a facet".into()));
            }
            let mut position = [0.0; 3];
            for number in &mut position {
                let word = words.next().unwrap_or_default();
                *number = word.parse().map_err(|_| {
                    broken(format!("a vertex has \"{}\" for a number", shorten(word)))
                })?;
            }
            corners.push(DVec3::from(position));
        } else if is("facet") {
            if is_open {
                return Err(broken(
                    "a facet begins before the last one has ended".into(),
                ));
            }
            // The normal follows from the corners.
            is_open = true;
            corners.clear();
        } else if is("endfacet") {
            if !is_open {
                return Err(broken("a facet ends that has not begun".into()));
            }
            let [a, b, c] = *corners.as_slice() else {
                let triangle = solids.last().map_or(0, Solid::triangle_count);
                let count = corners.len();
                return Err(broken(format!("triangle {triangle} has {count} corners")));
            };
            is_open = false;
            if solids.is_empty() {
                solids.push(Solid::named(""));
            }
            if let Some(solid) = solids.last_mut() {
                budget.triangles(1)?;
                budget.memory(TRIANGLE_MEMORY)?;
                solid.add([a, b, c], budget);
            }
        } else if !["outer", "endloop", "endsolid", "color"]
            .iter()
            .any(|word| is(word))
        {
            let triangle = solids.last().map_or(0, Solid::triangle_count);
            let word = shorten(first);
            return Err(broken(format!(
                "\"{word}\" is no word of an STL, after triangle {triangle}"
            )));
        }
    }
    if is_open {
        let triangle = solids.last().map_or(0, Solid::triangle_count);
        return Err(LoadProblem::Truncated {
            what: format!("triangle {triangle} of an ASCII STL"),
            needed: text.len() as u64 + 1,
            available: text.len() as u64,
        });
    }
    Ok(solids)
}
