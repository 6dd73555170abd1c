//! What plays while a scene is measured, in words.

use crate::format;
use crate::report::MotionFacts;

/// What plays, and at which times: an addition to the line about the scene.
pub(super) fn words(motion: &MotionFacts) -> String {
    let named = match format::clean(&motion.name) {
        none if none.is_empty() => format!("animation {}", motion.clip),
        name => format!("animation {name}"),
    };
    let start = format::trimmed(motion.start);
    match motion.frames_per_second {
        None => format!("; {named} at {start} s"),
        Some(rate) => {
            let (rate, seconds) = (format::trimmed(rate), format::trimmed(motion.seconds));
            format!(
                "; {named} from {start} s on, {rate} frames a second of it, again after {seconds} s"
            )
        }
    }
}
