//! Errors of CityJSON files.

use crate::error::LoadProblem;

/// An error in the text of a file.
pub(super) fn syntax_error(place: String, problem: String) -> LoadProblem {
    LoadProblem::Syntax {
        format: "CityJSON",
        place,
        problem,
    }
}
