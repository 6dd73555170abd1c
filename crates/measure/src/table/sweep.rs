//! The table of a sweep: what each setting costs, what it gets wrong, and which are worth having.

use super::{COLUMNS, Column, Definition, Table, TableCell};
use crate::report::Report;

/// Of a comparison's columns those in which a trade is read.
const READ: [(&str, &str); 7] = [
    ("strategy", ""),
    ("frame", "ms"),
    ("speed vs", "frustum"),
    ("speed vs", "ideal"),
    ("wrong px", "mean %"),
    ("wrong px", "max %"),
    ("false", "culls"),
];

const EDGE: Column = Column {
    title: "efficient",
    unit: "edge",
    right: false,
};

impl Table {
    /// The trade of a sweep in a few columns, with a mark on the settings of the efficient edge;
    /// `None` for a report that is no sweep. [`Table::new`] has all columns.
    pub fn sweep(report: &Report) -> Option<Self> {
        report.sweep.as_ref()?;
        let read = |d: &&Definition| READ.contains(&(d.0.title, d.0.unit));
        Some(Self::of(report, COLUMNS.iter().filter(read)).with_edge(report))
    }

    /// The same with a column that marks the efficient edge, where there is a sweep.
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
