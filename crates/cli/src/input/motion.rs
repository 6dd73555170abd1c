//! The animation that the command line names, of those that the scene has.

use antumbra::measure::compare::{Playback, Timing};
use antumbra::scene::animation::{Animation, Clip};
use antumbra::scene::{Aabb, Scene};

use crate::args::MotionArgs;
use crate::failure::Failure;

/// The times of a clip, its beginning and its end among them, at which the scene is measured, so that a camera sees all of it.
const LOOKS: usize = 24;

/// The names that a message lists.
const NAMED: usize = 16;

/// What plays; `None` where nothing is asked for.
///
/// # Errors
/// [`Failure::Usage`] for a scene without animations, and for one that it does not have.
pub fn playback(
    args: &MotionArgs,
    animation: Option<Animation>,
) -> Result<Option<Playback>, Failure> {
    if !args.requested() {
        return Ok(None);
    }
    let Some(animation) = animation else {
        return Err(Failure::Usage(
            "--time, --animate and --animation: the scene has no animation that can be played"
                .to_owned(),
        ));
    };
    let clip = match &args.animation {
        None => 0,
        Some(name) => chosen(name, &animation)?,
    };
    let timing = Timing {
        start: args.time.unwrap_or(0.0),
        frames_per_second: args.animate.map(|rate| rate.unwrap_or(MotionArgs::RATE)),
    };
    Ok(Some(Playback::new(animation, clip, timing)?))
}

/// A clip by its name or its number.
fn chosen(name: &str, animation: &Animation) -> Result<usize, Failure> {
    let number = name.parse().ok();
    let number = number.filter(|number| *number < animation.clips().len());
    animation.clip_named(name).or(number).ok_or_else(|| {
        let titled = |(number, clip): (usize, &Clip)| match clip.name.as_str() {
            "" => number.to_string(),
            name => format!("{number} \"{name}\""),
        };
        let clips = animation.clips();
        let known = clips.iter().enumerate().take(NAMED).map(titled);
        let mut known: Vec<String> = known.collect();
        if clips.len() > NAMED {
            known.push("...".to_owned());
        }
        Failure::Usage(format!(
            "--animation {name}: the scene has no such animation; it has: {}",
            known.join(", ")
        ))
    })
}

/// The box around all places that the scene takes in a clip, as far as some looks at it tell. The scene is left at the first pose.
///
/// # Errors
/// What the scene refuses.
pub fn bounds(playback: &Playback, scene: &mut Scene) -> Result<Option<Aabb>, Failure> {
    let mut all: Option<Aabb> = None;
    for look in 0..LOOKS {
        playback.show_part(scene, look as f64 / (LOOKS - 1) as f64)?;
        scene.update();
        all = match (all, scene.bounds()) {
            (Some(all), Some(now)) => Some(all.union(&now)),
            (all, now) => all.or(now),
        };
    }
    playback.show(scene, 0)?;
    scene.update();
    Ok(all)
}
