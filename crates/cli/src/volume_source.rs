//! The volume that a file holds: a bricked one, or a SEG-Y file.

use std::path::Path;
use std::sync::Arc;

use antumbra::subsurface::segy::{SegyFile, SegyOptions};
use antumbra::subsurface::{BrickSource, VolumeFile};

use crate::failure::Failure;
use crate::{notes, progress};

/// Opens a volume.
///
/// # Errors
/// What is wrong with the file.
pub fn open(
    file: &Path,
    options: &SegyOptions,
    quiet: bool,
) -> Result<Arc<dyn BrickSource>, Failure> {
    match SegyFile::is_named(file) {
        true => Ok(Arc::new(segy(file, options, quiet)?)),
        false => Ok(Arc::new(VolumeFile::open(file)?)),
    }
}

/// Opens a SEG-Y file, with progress, and says what was found.
///
/// # Errors
/// What is wrong with the file.
pub fn segy(file: &Path, options: &SegyOptions, quiet: bool) -> Result<SegyFile, Failure> {
    let bar = progress::work("reading traces", quiet);
    let opened = SegyFile::open(file, options, &mut progress::count(&bar));
    bar.finish_and_clear();
    let opened = opened?;
    notes::say(file, opened.notes(), quiet);
    Ok(opened)
}
