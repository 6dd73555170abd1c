//! Reads and writes `report.json`: with a size limit, checked, and written atomically. Numbers that are NaN or infinite are refused.

use std::path::{Component, Path};

use serde_json::Value;

use super::Report;
use crate::MeasureError;
use crate::files::{read_limited, write_whole};

/// The most bytes of a `report.json` that is read: far above a hundred strategies at ten thousand poses.
pub const MAX_REPORT_BYTES: u64 = 64 << 20;

impl Report {
    /// Reads and checks a `report.json`. Unknown fields are skipped.
    ///
    /// # Errors
    /// [`MeasureError`] where the file cannot be read, is larger than [`MAX_REPORT_BYTES`], is no report, or contradicts itself (see
    /// [`Report::check`]).
    pub fn load(path: impl AsRef<Path>) -> Result<Self, MeasureError> {
        let path = path.as_ref();
        let bytes = read_limited(path, "report.json", MAX_REPORT_BYTES)?;
        let report: Self = serde_json::from_slice(&bytes).map_err(|e| MeasureError::Malformed {
            path: path.to_owned(),
            kind: "report.json",
            reason: e.to_string(),
        })?;
        report.check()?;
        Ok(report)
    }

    /// Writes the report atomically: readers see the old file or the new one.
    ///
    /// # Errors
    /// [`MeasureError`] where a number is NaN or infinite (the field is named), the report contradicts itself, or the file cannot be
    /// written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), MeasureError> {
        write_whole(path.as_ref(), self.to_file()?.as_bytes())
    }

    /// The text of a `report.json`.
    pub(crate) fn to_file(&self) -> Result<String, MeasureError> {
        Ok(self.to_json()? + "\n")
    }

    /// The report as indented JSON text.
    ///
    /// # Errors
    /// As for [`Report::save`], except for those of the file.
    pub fn to_json(&self) -> Result<String, MeasureError> {
        self.check()?;
        let value = self.to_value()?;
        Ok(format!("{value:#}"))
    }

    /// Checks that all numbers are finite, the view has pixels, all images are inside of the report's folder, and every setting that a sweep
    /// names is among the strategies.
    ///
    /// # Errors
    /// [`MeasureError`] with the name of the first field that fails.
    pub fn check(&self) -> Result<(), MeasureError> {
        refuse_null(&self.to_value()?, "")?;
        if self.scene.samples == 0 {
            return Err(problem("scene.samples".to_owned(), "is 0"));
        }
        if self.scene.size.contains(&0) {
            return Err(problem("scene.size".to_owned(), "has no pixels"));
        }
        for (i, strategy) in self.strategies.iter().enumerate() {
            let Some(worst) = &strategy.worst else {
                continue;
            };
            let images = &worst.images;
            for (key, file) in [
                ("reference", &images.reference),
                ("strategy", &images.strategy),
                ("marked", &images.marked),
            ] {
                if !stays_inside(file) {
                    let field = format!("strategies[{i}].worst.images.{key}");
                    return Err(problem(
                        field,
                        "must name a file inside the report's folder",
                    ));
                }
            }
        }
        self.check_sweep()
    }

    /// Checks that the settings that a sweep names are among the strategies.
    fn check_sweep(&self) -> Result<(), MeasureError> {
        let Some(sweep) = &self.sweep else {
            return Ok(());
        };
        let known = |title: &str| self.strategies.iter().any(|s| s.title() == title);
        let edge = sweep.edge.iter().zip(0..);
        let edge = edge.map(|(title, i)| (title, format!("sweep.edge[{i}]")));
        let choices = sweep.budgets.iter().zip(0..).flat_map(|(budget, i)| {
            let choices = budget.choices.iter().zip(0..);
            choices.flat_map(move |(choice, j)| {
                let at = format!("sweep.budgets[{i}].choices[{j}]");
                let next = choice.next.iter().map(|next| &next.setting);
                [&choice.setting]
                    .into_iter()
                    .chain(&choice.fastest)
                    .chain(&choice.alike)
                    .chain(next)
                    .map(move |title| (title, at.clone()))
            })
        });
        match edge.chain(choices).find(|(title, _)| !known(title)) {
            Some((title, field)) => Err(MeasureError::Report {
                field,
                problem: format!("names '{title}', which is none of the strategies"),
            }),
            None => Ok(()),
        }
    }

    fn to_value(&self) -> Result<Value, MeasureError> {
        serde_json::to_value(self).map_err(|e| problem("(root)".to_owned(), &e.to_string()))
    }
}

/// Refuses NaN and infinities. JSON has no NaN, so serde_json writes null. Absent values are skipped by their fields, so every null outside of
/// the free-form settings was such a number.
fn refuse_null(value: &Value, at: &str) -> Result<(), MeasureError> {
    match value {
        Value::Null => Err(MeasureError::NotFinite {
            field: at.to_owned(),
        }),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .try_for_each(|(i, item)| refuse_null(item, &format!("{at}[{i}]"))),
        Value::Object(fields) => fields
            .iter()
            .filter(|(key, _)| *key != "settings")
            .try_for_each(|(key, field)| {
                let dot = if at.is_empty() { "" } else { "." };
                refuse_null(field, &format!("{at}{dot}{key}"))
            }),
        _ => Ok(()),
    }
}

/// Whether a file is inside of the report's folder. The page embeds the images that a report names, so a report must not name other files.
fn stays_inside(file: &str) -> bool {
    let path = Path::new(file);
    // Backslashes and drive letters have a meaning on Windows.
    !file.contains(['\\', ':'])
        && path.components().next().is_some()
        && path
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
}

fn problem(field: String, problem: &str) -> MeasureError {
    MeasureError::Report {
        field,
        problem: problem.to_owned(),
    }
}
