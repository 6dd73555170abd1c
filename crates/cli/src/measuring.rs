//! Runs a comparison for the commands that need one, with its progress on the terminal.

use antumbra::cull::Gpu;
use antumbra::measure::compare::{
    CompareOptions, Comparison, Contender, Playback, compare_scripted,
};
use antumbra::measure::report::MissingParts;

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::input::{EachPose, Input};
use crate::interrupt::{self, Stoppable};
use crate::progress::Bars;
use crate::watch::{Watch, Watched};

/// Compares the contenders on the input, its animation played and its lenses rotated to face each pose. The report has the command line and the seeds.
///
/// # Errors
/// What stopped it; nothing was written.
pub fn measure(
    gpu: &Gpu,
    mut input: Input,
    contenders: &[Contender],
    view: &ViewArgs,
    in_flight: u32,
) -> Result<Comparison, Failure> {
    let options = CompareOptions {
        size: input.size,
        samples: input.samples,
        in_flight,
        stereo: input.stereo,
        command: command_line(),
        scene_name: input.name,
        motion: input.playback.as_ref().map(Playback::facts),
        ..CompareOptions::default()
    };
    let mut bars = Bars::new(view.quiet);
    let mut each_pose = EachPose {
        playback: input.playback.as_mut(),
        sections: input.sections.as_mut(),
    };
    let mut watched = Watched {
        script: &mut Stoppable(&mut each_pose),
        watch: Watch::start(view.patience),
    };
    let comparison = compare_scripted(
        gpu,
        &mut input.scene,
        &mut watched,
        &input.path,
        contenders,
        &options,
        &mut |progress| {
            interrupt::note(progress);
            bars.show(progress);
        },
    );
    bars.finish();
    if comparison.is_err()
        && let Some(interruption) = interrupt::asked()
    {
        return Err(Failure::Interrupted(interruption));
    }
    let mut comparison = comparison?;
    let losses = input.left_out.losses().iter();
    comparison.report.scene.left_out = losses
        .map(|loss| MissingParts {
            part: loss.part.name(loss.count).to_owned(),
            count: loss.count,
            reason: loss.reason.clone(),
        })
        .collect();
    let seeds = &mut comparison.report.seeds;
    seeds.insert("path".to_owned(), view.seed);
    if let Some(seed) = input.scene_seed {
        seeds.insert("scene".to_owned(), seed);
    }
    Ok(comparison)
}

/// What was typed, from the program's name on, quoted for a shell. Bytes that are no text are replaced.
fn command_line() -> String {
    let words = std::env::args_os().skip(1);
    let words = words.map(|word| quoted(&word.to_string_lossy()));
    let words: Vec<String> = std::iter::once("antumbra".to_owned())
        .chain(words)
        .collect();
    words.join(" ")
}

fn quoted(word: &str) -> String {
    // What settings and paths are usually made of means nothing to a shell.
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    // A word without zero bytes can always be quoted, and no argument has any.
    shlex::try_quote(word).map_or_else(|_| String::new(), |quoted| quoted.into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recorded_commands_are_quoted_for_a_shell() {
        for word in [
            "a b",
            "it's",
            "$HOME",
            "a;rm -rf b",
            "`id`",
            "a\nb",
            "",
            "*.glb",
        ] {
            let line = format!("antumbra {}", quoted(word));
            let read = shlex::split(&line).unwrap();
            assert_eq!(read, ["antumbra", word], "{line}");
        }
        assert_eq!(quoted("three-pass:threshold=5"), "three-pass:threshold=5");
    }
}
