//! An allocator that fails past the budget, so that a file which becomes huge is found as a crash, and not only one that panics.

use cap::Cap;
use std::alloc::System;

/// What a load may take.
#[allow(dead_code, reason = "not every target has a budget to set")]
pub const MEMORY: u64 = 64 << 20;

/// The budget, and as much again for what is taken in one step.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, 256 << 20);
