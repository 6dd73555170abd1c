//! The bytes of a file and of what it refers to: `data:` URIs and files in its own folder or below, nothing else.

use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::{Image, ImageKey, Sampler, Scene};
use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Where a file's references are looked for.
pub(super) struct Files<'a> {
    base: Option<&'a Path>,
}

/// Standard base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// All bytes of a file that was opened, if they are `largest` at most.
///
/// # Errors
/// What the system says; for what is no regular file, for one that is too large, and where memory does not suffice.
pub fn read_whole_file(file: File, largest: u64) -> std::io::Result<Vec<u8>> {
    let metadata = file.metadata()?;
    if !metadata.is_file() {
        return Err(std::io::Error::other(
            "it is no regular file, so that its length is not known",
        ));
    }
    let mut bytes = Vec::new();
    if metadata.len() <= largest {
        let wanted = usize::try_from(metadata.len()).unwrap_or(usize::MAX);
        bytes
            .try_reserve_exact(wanted)
            .map_err(std::io::Error::other)?;
        // It may have grown meanwhile.
        file.take(largest + 1).read_to_end(&mut bytes)?;
    }
    if metadata.len().max(bytes.len() as u64) > largest {
        let problem = format!("larger than {largest} bytes; cut it into parts");
        return Err(std::io::Error::other(problem));
    }
    Ok(bytes)
}

/// A whole file, if it is no larger than what is left.
pub(super) fn read(path: &Path, budget: &mut Budget) -> Result<Vec<u8>, LoadProblem> {
    let refused = |source| LoadProblem::Io {
        file: path.display().to_string(),
        source,
    };
    let file = File::open(path).map_err(refused)?;
    let metadata = file.metadata().map_err(refused)?;
    if metadata.is_dir() {
        return Err(refused(std::io::ErrorKind::IsADirectory.into()));
    }
    let left = budget.bytes_left();
    if metadata.len() > left {
        budget.bytes(metadata.len())?;
    }
    let mut bytes = Vec::new();
    // A device or a growing file may hold more than it says.
    (file.take(left.saturating_add(1)).read_to_end(&mut bytes)).map_err(refused)?;
    budget.bytes(bytes.len() as u64)?;
    Ok(bytes)
}

impl<'a> Files<'a> {
    pub(super) fn new(base: Option<&'a Path>) -> Self {
        Self { base }
    }

    /// The bytes that `place` refers to with `uri`.
    pub(super) fn fetch(
        &self,
        place: &str,
        uri: &str,
        budget: &mut Budget,
    ) -> Result<Vec<u8>, LoadProblem> {
        let bad = |problem| LoadProblem::BadUri {
            place: place.to_owned(),
            uri: shorten(uri),
            problem,
        };
        if let Some(data) = uri.strip_prefix("data:") {
            let (kind, data) = data
                .split_once(',')
                .ok_or_else(|| bad("a data URI without a comma"))?;
            if !kind.ends_with(";base64") {
                return Err(bad("a data URI that is not base64"));
            }
            let bytes = BASE64.decode(data);
            return bytes.map_err(|_| bad("a data URI whose base64 is broken"));
        }
        let name =
            percent_decoded(uri).ok_or_else(|| bad("its percent signs do not decode to UTF-8"))?;
        read(&self.resolve(&name).map_err(bad)?, budget)
    }

    /// Where a relative name leads, if it leads to somewhere in the folder.
    pub(super) fn resolve(&self, name: &str) -> Result<PathBuf, &'static str> {
        const OUTSIDE: &str = "only files in the scene file's own folder or below are opened; copy it there and refer to it by its relative name";
        let name = name.replace('\\', "/");
        let has_scheme = name.split_once(':').is_some();
        let relative = Path::new(&name);
        let inside = |c: Component<'_>| matches!(c, Component::Normal(_) | Component::CurDir);
        if has_scheme || name.is_empty() || !relative.components().all(inside) {
            return Err(OUTSIDE);
        }
        let base = self.base.ok_or(
            "the scene was read from memory, without a folder to look in; load it from a file",
        )?;
        let base = if base.as_os_str().is_empty() {
            Path::new(".")
        } else {
            base
        };
        let path = base.join(relative);
        // A link may lead elsewhere.
        match (base.canonicalize(), path.canonicalize()) {
            (Ok(base), Ok(path)) if !path.starts_with(&base) => Err(OUTSIDE),
            _ => Ok(path),
        }
    }
}

/// Decodes a PNG or JPEG and adds it to the scene.
pub(super) fn add_image(
    scene: &mut Scene,
    place: &str,
    name: String,
    bytes: &[u8],
    sampler: Sampler,
    budget: &mut Budget,
) -> Result<ImageKey, LoadProblem> {
    let bad = |problem: String| LoadProblem::BadImage {
        image: place.to_owned(),
        problem,
    };
    let open = || {
        let cursor = std::io::Cursor::new(bytes);
        image::ImageReader::new(cursor).with_guessed_format()
    };
    let size = open().map_err(|e| bad(e.to_string()))?.into_dimensions();
    let (width, height) = size.map_err(|e| bad(e.to_string()))?;
    let pixels = u64::from(width) * u64::from(height);
    budget.pixels(pixels)?;
    let mut reader = open().map_err(|e| bad(e.to_string()))?;
    let mut limits = image::Limits::default();
    // Sixteen bits a channel and the decoder's own copy.
    limits.max_alloc = Some(pixels.saturating_mul(16).saturating_add(1 << 24));
    reader.limits(limits);
    let decoded = reader.decode().map_err(|e| bad(e.to_string()))?;
    let rgba = decoded.into_rgba8();
    let image = Image {
        name,
        width: rgba.width(),
        height: rgba.height(),
        rgba: rgba.into_raw(),
        sampler,
    };
    Ok(scene.add_image(image)?)
}

fn shorten(uri: &str) -> String {
    match uri.char_indices().nth(60) {
        Some((end, _)) => format!("{}...", uri.get(..end).unwrap_or_default()),
        None => uri.to_owned(),
    }
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let digit = |b: u8| (b as char).to_digit(16);
            let (high, low) = (digit(rest.next()?)?, digit(rest.next()?)?);
            bytes.push((high * 16 + low) as u8);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok()
}
