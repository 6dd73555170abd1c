//! Reading of files, and of what a scene file refers to: `data:` URIs, and files in its own folder or below. Nothing
//! else is opened.

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// The folder in which the references of a file are resolved.
pub(super) struct FileResolver<'a> {
    base: Option<&'a Path>,
}

/// Standard base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The contents of a file, if the budget allows it.
pub(super) fn read(path: &Path, budget: &mut Budget) -> Result<Vec<u8>, LoadProblem> {
    let refused = |source| LoadProblem::Io {
        file: path.display().to_string(),
        source,
    };
    let file = antumbra_files::open(path).map_err(refused)?;
    let metadata = file.metadata().map_err(refused)?;
    let left = budget.bytes_left();
    if metadata.len() > left {
        budget.bytes(metadata.len())?;
    }
    let mut bytes = Vec::new();
    // A growing file may have more bytes than its length.
    (file.take(left.saturating_add(1)).read_to_end(&mut bytes)).map_err(refused)?;
    budget.bytes(bytes.len() as u64)?;
    budget.file(path);
    Ok(bytes)
}

impl<'a> FileResolver<'a> {
    pub(super) fn new(base: Option<&'a Path>) -> Self {
        Self { base }
    }

    /// The bytes of the reference `uri` at `place`.
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
            // Three bytes for four letters.
            budget.memory(data.len() as u64 / 4 * 3)?;
            let bytes = BASE64.decode(data);
            return bytes.map_err(|_| bad("a data URI whose base64 is broken"));
        }
        let name =
            percent_decoded(uri).ok_or_else(|| bad("its percent signs do not decode to UTF-8"))?;
        read(&self.resolve(&name).map_err(bad)?, budget)
    }

    /// The path of a relative name, if it is in the folder or below.
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
        // A symbolic link may lead elsewhere.
        match (base.canonicalize(), path.canonicalize()) {
            (Ok(base), Ok(path)) if !path.starts_with(&base) => Err(OUTSIDE),
            _ => Ok(path),
        }
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
