//! What plays: which animation of a scene file, and at which times.

use clap::Args as ClapArgs;

/// The arguments of what moves in a scene.
#[derive(Debug, Clone, Default, ClapArgs)]
pub struct MotionArgs {
    /// Show the scene as its animation has it after so many seconds. An animation begins again at its end. Without --time and --animate the scene is at rest
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = seconds)]
    pub time: Option<f64>,
    /// Play the animation along the path: so many poses are a second of it, 30 by default
    #[arg(long, value_name = "RATE", num_args = 0..=1, require_equals = true, value_parser = rate)]
    pub animate: Option<Option<f64>>,
    /// The animation to show, by its name or, from 0, by its number; the first by default
    #[arg(long, value_name = "NAME|NUMBER")]
    pub animation: Option<String>,
}

impl MotionArgs {
    /// Poses a second where no number is given.
    pub const RATE: f64 = 30.0;

    /// Whether anything of an animation is to be shown.
    pub fn requested(&self) -> bool {
        self.time.is_some() || self.animate.is_some() || self.animation.is_some()
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.0..=1e9).contains(&seconds) => Ok(seconds),
        _ => Err("it takes seconds from 0 to 1000000000: 1.5".to_owned()),
    }
}

fn rate(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(rate) if (0.001..=1e6).contains(&rate) => Ok(rate),
        _ => Err("it takes poses a second from 0.001 to 1000000: 30".to_owned()),
    }
}
