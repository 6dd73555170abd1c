//! Scene files, loaded as the command line says. What was left out of one is told.

use std::path::Path;

use antumbra::formats::{LeftOut, LoadError, LoadOptions, LoadedScene, load_with_attachments};

use crate::args::LoadArgs;
use crate::failure::Failure;
use crate::print::warn;

/// Loads a scene with something to draw, and says what was left out of it.
///
/// # Errors
/// What is wrong with the file.
pub fn load(
    file: &Path,
    attachments: &[&str],
    args: &LoadArgs,
    quiet: bool,
) -> Result<LoadedScene, Failure> {
    let loaded = load_with_attachments(file, &options(args), attachments)?;
    let loaded = loaded.drawable().map_err(|problem| LoadError {
        file: Some(file.to_owned()),
        problem: Box::new(problem),
    })?;
    if !quiet {
        tell(file, &loaded.left_out, args.verbose);
    }
    Ok(loaded)
}

/// Refuses what is said of scene files where none is loaded.
///
/// # Errors
/// [`Failure::Usage`] for such an argument.
pub fn none(args: &LoadArgs) -> Result<(), Failure> {
    if args.strict || args.no_images || args.verbose {
        return Err(Failure::Usage(
            "--strict, --no-images and --verbose are for scene files: what is read here is none"
                .to_owned(),
        ));
    }
    Ok(())
}

/// As [`load`], where nothing plays: the scene is at rest for good, and that is said where it has animations.
///
/// # Errors
/// What is wrong with the file.
pub fn load_at_rest(
    file: &Path,
    attachments: &[&str],
    args: &LoadArgs,
    quiet: bool,
) -> Result<LoadedScene, Failure> {
    let loaded = load(file, attachments, args, quiet)?;
    if let Some(animation) = &loaded.animation
        && !quiet
    {
        let count = match animation.clips().len() {
            1 => "an animation".to_owned(),
            many => format!("{many} animations"),
        };
        warn(format!("{}: shown at rest; it has {count}", file.display()));
    }
    Ok(loaded.at_rest())
}

/// The limits of a load, with what the command line says.
pub fn options(args: &LoadArgs) -> LoadOptions {
    let usual = LoadOptions::default();
    LoadOptions {
        max_memory: args.memory.unwrap_or(usual.max_memory),
        skip_images: args.no_images,
        strict: args.strict,
        ..usual
    }
}

/// A line for all that was left out; with the names, a line for each kind and reason.
fn tell(file: &Path, left_out: &LeftOut, verbose: bool) {
    if left_out.is_empty() {
        return;
    }
    let file = file.display();
    if !verbose {
        warn(format!("{file}: left out: {left_out}; see --verbose"));
        return;
    }
    for loss in left_out.losses() {
        let named = loss.examples.join("; ");
        let more = match loss.count > loss.examples.len() as u64 {
            true => "; ...",
            false => "",
        };
        warn(format!("{file}: left out: {loss}: {named}{more}"));
    }
}
