//! Writes what a comparison found: the report, its pictures, its page and its plot appear together, or not at all.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use antumbra_files::{FileContents, OutFolder};

use super::{Comparison, is_report_file};
use crate::html::{Pictures, page_with};
use crate::image_error::encode_png;
use crate::report::Report;
use crate::{MeasureError, plots};

const REPORT: &str = "report.json";
const PAGE: &str = "report.html";
const PLOT: &str = "trade.svg";

impl Comparison {
    /// Writes `report.json`, its pictures and `report.html` into a folder, which is created if needed. For a sweep, also writes `trade.svg`,
    /// its plot of speed against error. [`save_into`](Self::save_into) says more.
    ///
    /// # Errors
    /// [`MeasureError`] where another run writes into the folder, or a file fails. [`OutFolder::replace`] says what is left then.
    pub fn save(&self, dir: &Path) -> Result<(), MeasureError> {
        let folder = OutFolder::open(dir).map_err(|source| MeasureError::File {
            action: "write into",
            path: dir.to_owned(),
            source,
        })?;
        self.save_into(&folder)
    }

    /// As [`save`](Self::save), into a folder that was opened before the comparison, so that no result is lost to a folder that cannot be
    /// written.
    ///
    /// Either all files are written or none: [`OutFolder::replace`] says how. The page has the pictures of this comparison, whatever is in the folder. The pictures and the
    /// plot that an earlier report in the folder names are removed.
    ///
    /// # Errors
    /// As for [`save`](Self::save).
    pub fn save_into(&self, folder: &OutFolder) -> Result<(), MeasureError> {
        let mut pictures = BTreeMap::new();
        for (name, picture) in &self.pictures {
            pictures.insert(name.clone(), encode_png(picture, Path::new(name))?);
        }
        let page = page_with(&self.report, Pictures::Memory(&pictures))?;
        let plot = match self.report.sweep {
            Some(_) => plots::speed_against_error(&self.report)?,
            None => None,
        };
        let report = self.report.to_file()?;
        let mut files: Vec<FileContents> = (pictures.into_iter())
            .map(|(name, bytes)| contents(&name, bytes))
            .collect();
        files.extend(plot.map(|svg| contents(PLOT, plots::on_paper(&svg).into_bytes())));
        files.push(contents(PAGE, page.into_bytes()));
        // Last: a report that is there is complete.
        files.push(contents(REPORT, report.into_bytes()));
        let written = folder.replace(files, &files_of_earlier(folder.path()));
        written.map_err(|failed| MeasureError::File {
            action: "write",
            path: failed.path,
            source: failed.source,
        })
    }
}

fn contents(name: &str, bytes: Vec<u8>) -> FileContents {
    FileContents {
        path: PathBuf::from(name),
        bytes,
    }
}

/// The pictures and the plot of the report that is in the folder. Without a readable report, nothing is known to be ours.
fn files_of_earlier(folder: &Path) -> Vec<String> {
    let Ok(earlier) = Report::load(folder.join(REPORT)) else {
        return Vec::new();
    };
    let worst = earlier
        .strategies
        .into_iter()
        .filter_map(|entry| entry.worst);
    let pictures = worst.flat_map(|worst| {
        let images = worst.images;
        [images.reference, images.strategy, images.marked]
    });
    let plot = earlier.sweep.map(|_| PLOT.to_owned());
    pictures
        .filter(|name| is_report_file(name))
        .chain(plot)
        .collect()
}
