//! The amounts that a file has used of its limits, and what was left out of it.

use crate::error::LoadProblem;
use crate::left_out::LeftOut;
use crate::options::LoadOptions;
use antumbra_files::MemoryBudget;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Bytes of memory that a part becomes: as it is loaded, on the GPU (whose memory is the host's with software adapters), and while its proxy
/// is made.
mod cost {
    /// Loaded 36, on the GPU 28, in maps while it is welded 40, in the simplifier some 90 for a while.
    pub(super) const VERTEX: u64 = 128;
    /// Loaded 12, on the GPU 12, in the simplifier some 90 for a while.
    pub(super) const PRIMITIVE: u64 = 64;
    /// In the scene 500, the rest in tables of slots and on the GPU.
    pub(super) const ENTITY: u64 = 1024;
    /// The mesh's own fields, its ranges, and its box as a geometry.
    pub(super) const MESH: u64 = 2048;
    /// A material, in the scene and on the GPU.
    pub(super) const MATERIAL: u64 = 512;
    /// Loaded 4, with its smaller versions on the GPU 6, on the way there 4.
    pub(super) const PIXEL: u64 = 14;
    /// An object of a JSON text while the text is read.
    pub(super) const JSON_OBJECT: u64 = 700;
}

/// Counts against [`LoadOptions`], checked before memory is allocated.
pub(super) struct Budget {
    pub(super) options: LoadOptions,
    /// What the reader left out so far.
    pub(super) left_out: LeftOut,
    bytes: u64,
    vertices: u64,
    triangles: u64,
    entities: u64,
    pixels: u64,
    files: BTreeSet<PathBuf>,
    memory: MemoryBudget,
    work: u64,
    /// The part of the file that is being read, for messages.
    part: String,
}

impl Budget {
    pub(super) fn new(options: &LoadOptions) -> Self {
        Self {
            options: options.clone(),
            left_out: LeftOut::default(),
            bytes: 0,
            vertices: 0,
            triangles: 0,
            entities: 0,
            pixels: 0,
            files: BTreeSet::new(),
            memory: MemoryBudget::new(options.max_memory),
            work: 0,
            part: "the file".to_owned(),
        }
    }

    /// Begins a part of the file, which messages name.
    pub(super) fn enter(&mut self, part: impl Into<String>) {
        self.part = part.into();
    }

    /// Takes memory for the present part.
    pub(super) fn memory(&mut self, bytes: u64) -> Result<(), LoadProblem> {
        Ok(self.memory.take(bytes, || &self.part)?)
    }

    /// The bytes of memory that are left.
    #[cfg(feature = "draco")]
    pub(super) fn memory_left(&self) -> u64 {
        self.memory.left()
    }

    /// Takes memory for a mesh or a name of this length.
    pub(super) fn mesh(&mut self, name: &str) -> Result<(), LoadProblem> {
        self.memory(cost::MESH + name.len() as u64)
    }

    /// Takes memory for a material.
    pub(super) fn material(&mut self, name: &str) -> Result<(), LoadProblem> {
        self.memory(cost::MATERIAL + name.len() as u64)
    }

    /// Takes memory for a name that an entity keeps.
    pub(super) fn name(&mut self, name: &str) -> Result<(), LoadProblem> {
        self.memory(name.len() as u64)
    }

    /// Takes steps of work, more than reading the bytes once.
    pub(super) fn work(&mut self, steps: u64) -> Result<(), LoadProblem> {
        self.work = self.work.saturating_add(steps);
        let limit = self.options.max_work;
        match self.work > limit {
            false => Ok(()),
            true => Err(LoadProblem::TooMuchWork {
                part: self.part.clone(),
                steps: self.work,
                limit,
            }),
        }
    }

    /// Records a file that is read.
    pub(super) fn file(&mut self, path: &Path) {
        self.files.insert(path.to_owned());
    }

    /// The files that were read, each once, in the order of their paths.
    pub(super) fn take_files(&mut self) -> Vec<PathBuf> {
        std::mem::take(&mut self.files).into_iter().collect()
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
        )?;
        self.memory(amount)
    }

    pub(super) fn vertices(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_vertices;
        take(
            &mut self.vertices,
            amount,
            limit,
            "vertices",
            "max_vertices",
        )?;
        self.memory(amount.saturating_mul(cost::VERTEX))
    }

    pub(super) fn triangles(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_triangles;
        take(
            &mut self.triangles,
            amount,
            limit,
            "triangles",
            "max_triangles",
        )?;
        self.memory(amount.saturating_mul(cost::PRIMITIVE))
    }

    pub(super) fn entities(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_entities;
        take(
            &mut self.entities,
            amount,
            limit,
            "entities",
            "max_entities",
        )?;
        self.memory(amount.saturating_mul(cost::ENTITY))
    }

    pub(super) fn pixels(&mut self, amount: u64) -> Result<(), LoadProblem> {
        let limit = self.options.max_image_pixels;
        take(
            &mut self.pixels,
            amount,
            limit,
            "pixels of images",
            "max_image_pixels",
        )?;
        self.memory(amount.saturating_mul(cost::PIXEL))
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
        // The text is parsed, and given back, before the next part is read.
        let bytes = amount.saturating_mul(cost::JSON_OBJECT);
        Ok(self.memory.allow(bytes, || "the JSON")?)
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
