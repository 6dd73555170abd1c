//! An allocator that fails past twice the budget, so that a file which becomes huge is found as a crash, and not only one that panics.

use cap::Cap;
use std::alloc::System;

/// What a load may take.
pub const MEMORY: u64 = 64 << 20;

/// The budget, and as much again for what is taken in one step.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, 2 * MEMORY as usize);
