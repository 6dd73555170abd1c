//! Writing of volume files in bounded memory. [`file_format`](super::file_format) describes their bytes.

use std::io::Write;
use std::path::Path;

use antumbra_files::WholeFile;
use rayon::prelude::*;

use super::file_format;
use super::source::BrickSource;
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;

/// The number of bytes of bricks that are made at a time, at least one brick.
const BATCH: usize = 32 << 20;

/// Writes all bricks of a volume to a temporary file beside `path`, and renames it to `path` when it is complete.
/// Bricks are made in parallel, some 32 MiB at a time. `progress` receives the number of written bricks and of all
/// bricks.
///
/// # Errors
/// [`SubsurfaceError::BadLayout`] for an invalid layout and for a name above 1024 bytes; [`SubsurfaceError::File`]
/// for an error of the system; the errors of the source. After an error the temporary file is removed, and a previous
/// file at `path` is unchanged.
pub fn write_volume(
    path: &Path,
    name: &str,
    source: &dyn BrickSource,
    progress: ProgressFn<'_>,
) -> Result<(), SubsurfaceError> {
    let layout = source.layout();
    layout.validate()?;
    let header = file_format::encode(layout, name)
        .map_err(|problem| SubsurfaceError::BadLayout { problem })?;
    let failed = |action| {
        move |source| SubsurfaceError::File {
            action,
            path: path.into(),
            source,
        }
    };
    let mut whole = WholeFile::create(path).map_err(failed("create"))?;
    let file = whole.file();
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
    whole.finish().map_err(failed("finish"))
}
