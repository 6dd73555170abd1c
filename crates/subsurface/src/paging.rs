//! The result of paging.

/// The result of a call to `page`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PagingReport {
    /// Images that were filled.
    pub updated: usize,
    /// Images that are out of date and were not filled, since they are hidden.
    pub skipped: usize,
    /// Bricks that were read from the source; others were in memory.
    pub bricks_read: u64,
}
