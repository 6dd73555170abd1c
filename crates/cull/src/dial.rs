//! A knob that may be turned while frames run, without declaring anything anew.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// A number that a strategy and its nodes share. A clone is a dial of its own that stands alike.
#[derive(Debug, Default)]
pub struct Dial(Arc<AtomicU32>);

impl Dial {
    /// A dial that stands at a number.
    pub fn new(at: f32) -> Self {
        Self(Arc::new(AtomicU32::new(at.to_bits())))
    }

    /// The same dial once more, for a node's body.
    #[must_use]
    pub fn shared(&self) -> Self {
        Self(Arc::clone(&self.0))
    }

    /// Where it stands.
    pub fn get(&self) -> f32 {
        f32::from_bits(self.0.load(Ordering::Relaxed))
    }

    /// Turns it: from the next frame on.
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
