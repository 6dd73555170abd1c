//! A number that may change between frames without a new plan.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// A number that a strategy shares with its nodes. A clone is a separate dial of the same value.
#[derive(Debug, Default)]
pub struct Dial(Arc<AtomicU32>);

impl Dial {
    /// A dial with this value.
    pub fn new(at: f32) -> Self {
        Self(Arc::new(AtomicU32::new(at.to_bits())))
    }

    /// The same dial once more, for a node's body.
    #[must_use]
    pub fn shared(&self) -> Self {
        Self(Arc::clone(&self.0))
    }

    /// The present value.
    pub fn get(&self) -> f32 {
        f32::from_bits(self.0.load(Ordering::Relaxed))
    }

    /// Sets the value, from the next frame on.
    pub fn turn(&self, to: f32) {
        self.0.store(to.to_bits(), Ordering::Relaxed);
    }
}

impl Clone for Dial {
    fn clone(&self) -> Self {
        Self::new(self.get())
    }
}

impl PartialEq for Dial {
    fn eq(&self, other: &Self) -> bool {
        self.get() == other.get()
    }
}
