//! Writes a volume file in bounded memory. [`format`](super::format) describes its bytes.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use rayon::prelude::*;

use super::{BrickSource, format};
use crate::error::SubsurfaceError;

/// How many bytes of bricks are made at a time; a brick at least.
const BATCH: usize = 32 << 20;

/// Writes all bricks of a volume to a file: to a new one beside it first, which takes its place when it is complete. Bricks are made in parallel,
/// some 32 MiB at a time. `progress` hears of bricks written and of all there are.
///
/// # Errors
/// [`SubsurfaceError::BadLayout`] for a layout that cannot be and a name above 1024 bytes; [`SubsurfaceError::File`] when the system
/// refuses; what the source says. Nothing of the file is left then, and what stood there before still does.
pub fn write_volume(
    path: &Path,
    name: &str,
    source: &dyn BrickSource,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(), SubsurfaceError> {
    let layout = source.layout();
    layout.validate()?;
    let header =
        format::encode(layout, name).map_err(|problem| SubsurfaceError::BadLayout { problem })?;
    let failed = |action| {
        move |source| SubsurfaceError::File {
            action,
            path: path.into(),
            source,
        }
    };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut beside = beside(folder).map_err(failed("create"))?;
    let file: &mut File = beside.as_file_mut();
    file.write_all(&header).map_err(failed("write"))?;

    let bytes = layout.brick_bytes();
    let total = (layout.bricks().map(u64::from)).iter().product::<u64>();
    let batch = (BATCH / bytes).max(1) as u64;
    let mut samples = vec![0; batch.min(total) as usize * bytes];
    let mut done = 0;
    progress(done, total);
    while done < total {
        let count = batch.min(total - done);
        let made = &mut samples[..count as usize * bytes];
        (made.par_chunks_exact_mut(bytes).enumerate())
            .try_for_each(|(i, samples)| source.read(layout.brick_at(done + i as u64), samples))?;
        file.write_all(made).map_err(failed("write"))?;
        done += count;
        progress(done, total);
    }
    beside
        .persist(path)
        .map_err(|error| failed("create")(error.error))?;
    Ok(())
}

/// A new file that goes away unless it is renamed, with the rights of any other new file.
fn beside(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".volume-").suffix(".partial");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
