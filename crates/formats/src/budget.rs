//! The amounts that a file has used of its limits.

use crate::error::LoadProblem;
use crate::options::LoadOptions;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Counts against [`LoadOptions`], checked before memory is allocated.
pub(super) struct Budget {
    pub(super) options: LoadOptions,
    bytes: u64,
    vertices: u64,
    triangles: u64,
    entities: u64,
    pixels: u64,
    files: BTreeSet<PathBuf>,
}

impl Budget {
    pub(super) fn new(options: &LoadOptions) -> Self {
        Self {
            options: options.clone(),
            bytes: 0,
            vertices: 0,
            triangles: 0,
            entities: 0,
            pixels: 0,
            files: BTreeSet::new(),
        }
    }

    /// Records a file that is read.
    pub(super) fn file(&mut self, path: &Path) {
        self.files.insert(path.to_owned());
    }

    /// The files that were read, each once, in the order of their paths.
    pub(super) fn into_files(self) -> Vec<PathBuf> {
        self.files.into_iter().collect()
    }

    /// The number of bytes that may still be read from files.
    pub(super) fn bytes_left(&self) -> u64 {
        self.options.max_file_bytes.saturating_sub(self.bytes)
    }

    pub(super) fn bytes(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_file_bytes;
        take(
            &mut self.bytes,
            amount,
            limit,
            "bytes of files",
            "max_file_bytes",
        )
    }

    pub(super) fn vertices(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_vertices;
        take(
            &mut self.vertices,
            amount,
            limit,
            "vertices",
            "max_vertices",
        )
    }

    pub(super) fn triangles(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_triangles;
        take(
            &mut self.triangles,
            amount,
            limit,
            "triangles",
            "max_triangles",
        )
    }

    pub(super) fn entities(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_entities;
        take(
            &mut self.entities,
            amount,
            limit,
            "entities",
            "max_entities",
        )
    }

    pub(super) fn pixels(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_image_pixels;
        take(
            &mut self.pixels,
            amount,
            limit,
            "pixels of images",
            "max_image_pixels",
        )
    }

    /// Checks the number of objects in a JSON text. A few bytes of JSON become hundreds in memory, so they are
    /// counted before the text is parsed.
    pub(super) fn json(&self, text: &[u8]) -> Result<(), LoadProblem> {
        let (mut objects, mut commas) = (0_u64, 0_u64);
        for byte in text {
            objects += u64::from(matches!(byte, b'{' | b'['));
            commas += u64::from(*byte == b',');
        }
        let amount = objects + commas / 16;
        let limit = self.options.max_json_objects;
        if amount > limit {
            return Err(LoadProblem::TooLarge {
                what: "objects in the JSON",
                amount,
                limit,
                option: "max_json_objects",
            });
        }
        Ok(())
    }
}

fn take(
    used: &mut u64,
    amount: u64,
    limit: u64,
    what: &'static str,
    option: &'static str,
) -> Result<(), LoadProblem> {
    let total = used.saturating_add(amount);
    if total > limit {
        return Err(LoadProblem::TooLarge {
            what,
            amount: total,
            limit,
            option,
        });
    }
    *used = total;
    Ok(())
}
