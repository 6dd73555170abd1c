//! Wall-clock time, and the processor time of this process, which other programs do not add to.

use std::time::Instant;

/// The start of a measurement.
pub struct Clock {
    wall: Instant,
    processor: f64,
}

impl Clock {
    pub fn start() -> Self {
        Self {
            wall: Instant::now(),
            processor: processor_seconds(),
        }
    }

    /// Seconds of wall-clock time.
    pub fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }

    /// Seconds of processor time; of wall-clock time where the system does not report it.
    pub fn processor(&self) -> f64 {
        let spent = processor_seconds() - self.processor;
        if spent > 0.0 { spent } else { self.wall() }
    }
}

/// The processor time that this process has used, seconds, in steps of a hundredth.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split(' ');
    let ticks = fields
        .skip(12)
        .take(2)
        .filter_map(|word| word.parse::<f64>().ok());
    ticks.sum::<f64>() / 100.0
}
