//! Progress of long work.

/// A callback that receives the number of finished parts and the number of all parts.
pub type ProgressFn<'a> = &'a mut dyn FnMut(u64, u64);
