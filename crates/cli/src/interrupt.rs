//! Ends the program where its work may stop: at the next frame after SIGINT or SIGTERM, with no half-written file.
//!
//! Frames stop by themselves ([`Stoppable`]). Other work, such as loading, is not waited for, nor is a frame that takes more than
//! [`PATIENCE`], nor anything after a second signal: unfinished files are removed, and the program ends.

use std::fmt;
use std::sync::{Mutex, PoisonError};

use antumbra::files::finished;
use antumbra::measure::compare::{CompareProgress, Script};
use antumbra::scene::{Camera, Scene};

#[cfg(unix)]
pub use listen::listen;

/// What the program is doing, and the signal that it got.
static STATE: Mutex<State> = Mutex::new(State {
    signal: None,
    frames: None,
});

struct State {
    signal: Option<Signal>,
    /// How far the frames are, while frames are drawn.
    frames: Option<CompareProgress>,
}

/// A signal that asks the program to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Signal(i32);

/// The end that a signal asked for.
#[derive(Debug)]
pub struct Interruption {
    signal: Signal,
    frames: Option<CompareProgress>,
}

impl Interruption {
    /// The exit status that shells give a program which a signal ended.
    pub fn status(&self) -> u8 {
        u8::try_from(128 + self.signal.0).unwrap_or(u8::MAX)
    }
}

impl fmt::Display for Interruption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.signal.0 {
            2 => "SIGINT",
            15 => "SIGTERM",
            _ => "a signal",
        };
        write!(f, "ended by {name}")?;
        if let Some(CompareProgress { phase, done, total }) = self.frames {
            write!(f, " after {done} of {total} frames of the phase '{phase}'")?;
        }
        match finished() {
            0 => write!(f, "; no file was written"),
            files => write!(f, "; {files} files were written whole before"),
        }
    }
}

fn with<T>(change: impl FnOnce(&mut State) -> T) -> T {
    change(&mut STATE.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Notes how far the frames are.
pub fn note(progress: CompareProgress) {
    with(|state| state.frames = Some(progress));
}

/// The end that a signal has asked for.
pub fn asked() -> Option<Interruption> {
    with(|state| {
        state.signal.map(|signal| Interruption {
            signal,
            frames: state.frames,
        })
    })
}

/// A script that stops a comparison at the next frame once a signal has asked for the end.
pub struct Stoppable<'a>(pub &'a mut dyn Script);

impl Script for Stoppable<'_> {
    fn set(&mut self, scene: &mut Scene, pose: usize, camera: &Camera) -> Result<(), String> {
        match asked() {
            Some(interruption) => Err(interruption.to_string()),
            None => self.0.set(scene, pose, camera),
        }
    }
}

/// Elsewhere Ctrl-C ends a program at once; a later run sweeps what it left.
#[cfg(not(unix))]
pub fn listen() {}

#[cfg(unix)]
mod listen {
    use std::thread;
    use std::time::Duration;

    use antumbra::files::discard_all;
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    use super::{Signal, asked, with};
    use crate::print::warn;

    /// How long a frame may still take.
    const PATIENCE: Duration = Duration::from_secs(10);

    /// Begins to listen to signals. Where the system does not allow it, they end the program at once.
    pub fn listen() {
        let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else {
            return;
        };
        thread::spawn(move || {
            for signal in signals.forever() {
                let first = with(|state| {
                    state.signal.replace(Signal(signal)).is_none() && state.frames.is_some()
                });
                if first {
                    thread::spawn(|| {
                        thread::sleep(PATIENCE);
                        end();
                    });
                } else {
                    end();
                }
            }
        });
    }

    /// Ends the program here and now, without half-written files.
    fn end() {
        discard_all();
        if let Some(interruption) = asked() {
            warn(&interruption);
            // Not by way of destructors: drivers may be at work in other threads.
            signal_hook::low_level::exit(i32::from(interruption.status()));
        }
    }
}
