//! A watch over work on the GPU: a driver that never answers ends the program with words, instead of keeping it for ever.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use antumbra::files::discard_all;
use antumbra::measure::compare::Script;
use antumbra::scene::{Camera, Scene};

use crate::print::warn;

/// How long an adapter may take where the command line does not say it.
pub const USUAL_PATIENCE: Duration = Duration::from_secs(600);

/// Ends the program where no frame is finished for long. It watches until it is dropped.
pub struct Watch {
    signs: Sender<()>,
}

impl Watch {
    /// Begins to watch.
    pub fn start(patience: Duration) -> Self {
        Self::with(patience, move || {
            let seconds = patience.as_secs();
            warn(format_args!(
                "the graphics adapter has not finished a frame for {seconds} seconds, so the run ends; no file was written. Try another adapter with --adapter, a smaller --size, or wait longer with --patience"
            ));
            discard_all();
            end();
        })
    }

    /// A watch that calls `silence` once where no sign of life arrives in time.
    fn with(patience: Duration, silence: impl FnOnce() + Send + 'static) -> Self {
        let (signs, received) = channel();
        thread::spawn(move || {
            loop {
                match received.recv_timeout(patience) {
                    Ok(()) => {}
                    Err(RecvTimeoutError::Timeout) => return silence(),
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        });
        Self { signs }
    }

    /// Tells that a frame is finished.
    pub fn sign(&self) {
        // The thread has ended if it has called `silence`.
        let _ = self.signs.send(());
    }
}

/// Ends the program without destructors: they would wait for the driver.
fn end() {
    #[cfg(unix)]
    signal_hook::low_level::exit(1);
    #[cfg(not(unix))]
    std::process::exit(1);
}

/// A script, each of whose poses is a sign that the frame before is finished.
pub struct Watched<'a> {
    /// The script.
    pub script: &'a mut dyn Script,
    /// The watch.
    pub watch: Watch,
}

impl Script for Watched<'_> {
    fn set(&mut self, scene: &mut Scene, pose: usize, camera: &Camera) -> Result<(), String> {
        self.watch.sign();
        self.script.set(scene, pose, camera)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_that_never_answers_is_not_waited_for_forever() {
        let (silence, heard) = channel();
        let watch = Watch::with(Duration::from_millis(20), move || silence.send(()).unwrap());
        watch.sign();
        heard.recv().unwrap();
        watch.sign();
    }

    #[test]
    fn a_watch_ends_with_the_work() {
        let (silence, heard) = channel::<()>();
        drop(Watch::with(Duration::MAX, move || {
            silence.send(()).unwrap()
        }));
        // The watch has let go of its end without a word.
        heard.recv().unwrap_err();
    }
}
