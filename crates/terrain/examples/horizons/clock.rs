//! Time by the wall and time of all processors, which other programs do not add to.

use std::time::Instant;

/// When something began.
pub struct Clock {
    wall: Instant,
    work: f64,
}

impl Clock {
    pub fn start() -> Self {
        Self {
            wall: Instant::now(),
            work: work(),
        }
    }

    /// Seconds by the wall.
    pub fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }

    /// Seconds of processors; those by the wall where the system does not tell.
    pub fn work(&self) -> f64 {
        let spent = work() - self.work;
        if spent > 0.0 { spent } else { self.wall() }
    }
}

/// Seconds of processors this process has used, in hundredths.
fn work() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split(' ');
    let ticks = fields
        .skip(12)
        .take(2)
        .filter_map(|word| word.parse::<f64>().ok());
    ticks.sum::<f64>() / 100.0
}
