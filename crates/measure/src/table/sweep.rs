//! The table of a sweep: the time and the errors of each setting, and which are on the efficient edge.

use super::{COLUMNS, Column, Definition, Table, TableCell};
use crate::report::Report;

/// The columns of a comparison that a sweep shows, by title and unit.
const SHOWN: [(&str, &str); 10] = [
    ("strategy", ""),
    ("frame", "ms"),
    ("speed vs", "frustum"),
    ("speed vs", "ideal"),
    ("wrong px", "mean %"),
    ("wrong px", "max %"),
    ("of owned", "mean %"),
    ("of owned", "max %"),
    ("false", "culls"),
    ("lost", "for good"),
];

const EDGE: Column = Column {
    title: "efficient",
    unit: "edge",
    right: false,
};

impl Table {
    /// The settings of a sweep in a few columns, with a mark on those of the efficient edge; `None` for a report without a sweep. [`Table::new`]
    /// has all columns.
    pub fn sweep(report: &Report) -> Option<Self> {
        report.sweep.as_ref()?;
        let shown = |d: &&Definition| SHOWN.contains(&(d.column.title, d.column.unit));
        Some(Self::of(report, COLUMNS.iter().filter(shown)).with_edge(report))
    }

    /// The table with a column that marks the efficient edge, if the report has a sweep.
    pub(super) fn with_edge(mut self, report: &Report) -> Self {
        let Some(sweep) = &report.sweep else {
            return self;
        };
        self.columns.push(EDGE);
        for (row, strategy) in self.rows.iter_mut().zip(&report.strategies) {
            let marked = !row.yardstick && sweep.edge.iter().any(|on| on == strategy.title());
            row.cells.push(TableCell {
                text: if marked { "*" } else { "" }.to_owned(),
                best: false,
            });
        }
        self
    }
}
