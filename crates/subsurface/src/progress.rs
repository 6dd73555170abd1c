//! Progress of long work.

/// Called with the number of parts that are done, and the number of all parts.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64);
