//! Whether what was recorded has been submitted: an encoder that a host drops takes what it would have written with it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Knows of the encoders that something was recorded into.
#[derive(Debug, Default)]
pub(super) struct Submitted {
    lost: Arc<AtomicBool>,
}

/// Owned by an encoder's commands.
struct Ticket {
    lost: Arc<AtomicBool>,
    done: bool,
}

impl Drop for Ticket {
    fn drop(&mut self) {
        if !self.done {
            self.lost.store(true, Ordering::Release);
        }
    }
}

impl Ticket {
    /// The commands have run.
    fn finish(mut self) {
        self.done = true;
    }
}

impl Submitted {
    /// Notes that something is recorded into an encoder.
    pub fn note(&self, encoder: &wgpu::CommandEncoder) {
        let ticket = Ticket {
            lost: Arc::clone(&self.lost),
            done: false,
        };
        encoder.on_submitted_work_done(move || ticket.finish());
    }

    /// Whether an encoder was dropped since the last call.
    pub fn take_lost(&self) -> bool {
        self.lost.swap(false, Ordering::AcqRel)
    }
}
