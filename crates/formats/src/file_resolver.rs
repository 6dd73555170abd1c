//! Reading of files, and of what a scene file refers to: `data:` URIs, and files in its own folder or below. Nothing
//! else is opened.
//!
//! Names are resolved as people's exporters write them: with backslashes, or in another case than the file has.

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;
use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// The folder in which the references of a file are resolved.
pub(super) struct FileResolver<'a> {
    base: Option<&'a Path>,
}

/// What a reference that costs no shape led to.
pub(super) enum Found {
    /// The bytes.
    Bytes(Vec<u8>),
    /// Why there are none, in a word or two.
    Missing(&'static str),
}

/// Standard base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The most names of a folder that are compared with one that has another case.
const MOST_NAMES: usize = 1 << 16;

const OUTSIDE: &str = "only files in the scene file's own folder or below are opened; copy it there and refer to it by its relative name";

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
        if let Some(data) = data_of(uri) {
            let (kind, data) = data
                .split_once(',')
                .ok_or_else(|| bad("a data URI without a comma"))?;
            let decoded = || {
                percent_decoded(data)
                    .ok_or_else(|| bad("a data URI whose percent signs are broken"))
            };
            // As text, and then three bytes for four letters.
            budget.memory(data.len() as u64 * 2)?;
            if !kind.to_ascii_lowercase().ends_with(";base64") {
                return decoded();
            }
            let mut letters = match data.contains('%') {
                true => decoded()?,
                false => data.as_bytes().to_vec(),
            };
            letters.retain(|letter| !letter.is_ascii_whitespace());
            let bytes = BASE64.decode(letters);
            return bytes.map_err(|_| bad("a data URI whose base64 is broken"));
        }
        let name = percent_decoded(uri).and_then(|name| String::from_utf8(name).ok());
        let name = name.ok_or_else(|| bad("its percent signs do not decode to UTF-8"))?;
        read(&self.resolve(&name).map_err(bad)?, budget)
    }

    /// The bytes of a plain name at `place` of something that costs no shape. A name of another machine's, such as `C:\maps\red.png`, is
    /// looked for in the file's own folder.
    ///
    /// # Errors
    /// What exceeds the budget.
    pub(super) fn cosmetic(
        &self,
        place: &str,
        name: &str,
        budget: &mut Budget,
    ) -> Result<Found, LoadProblem> {
        budget.enter(place);
        let own = own_name(name);
        match self.resolve(&own) {
            Ok(path) => found(read(&path, budget)),
            Err(_) if self.base.is_none() => Ok(Found::Missing("no folder to look in")),
            Err(_) => Ok(Found::Missing("outside the file's folder")),
        }
    }

    /// As [`fetch`](Self::fetch), for what costs no shape.
    ///
    /// # Errors
    /// What exceeds the budget.
    pub(super) fn fetch_cosmetic(
        &self,
        place: &str,
        uri: &str,
        budget: &mut Budget,
    ) -> Result<Found, LoadProblem> {
        found(self.fetch(place, uri, budget))
    }

    /// The path of a relative name, if it is in the folder or below.
    fn resolve(&self, name: &str) -> Result<PathBuf, &'static str> {
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
        let path = existing(base, relative);
        // A symbolic link may lead elsewhere.
        match (base.canonicalize(), path.canonicalize()) {
            (Ok(base), Ok(path)) if !path.starts_with(&base) => Err(OUTSIDE),
            _ => Ok(path),
        }
    }
}

/// The path below `base`; where a part of it is not there, the file that differs in case alone.
fn existing(base: &Path, relative: &Path) -> PathBuf {
    let exact = base.join(relative);
    if exact.exists() {
        return exact;
    }
    let mut path = base.to_owned();
    for part in relative.components() {
        let own = path.join(part);
        if own.exists() {
            path = own;
            continue;
        }
        let wanted = part.as_os_str().to_string_lossy().to_lowercase();
        let listed = path.read_dir().into_iter().flatten().take(MOST_NAMES);
        let names = listed.filter_map(|entry| Some(entry.ok()?.file_name()));
        let mut same: Vec<_> = names
            .filter(|name| name.to_string_lossy().to_lowercase() == wanted)
            .collect();
        // The order of a folder's entries is not determined.
        same.sort();
        match same.first() {
            Some(name) => path.push(name),
            None => return exact,
        }
    }
    path
}

/// The last part of an absolute path of any system; any other name as it is.
fn own_name(name: &str) -> Cow<'_, str> {
    let slashed = name.replace('\\', "/");
    let has_drive = slashed.get(1..3) == Some(":/");
    match slashed.rsplit('/').next() {
        Some(last) if has_drive || slashed.starts_with('/') => Cow::Owned(last.to_owned()),
        _ => Cow::Borrowed(name),
    }
}

fn found(read: Result<Vec<u8>, LoadProblem>) -> Result<Found, LoadProblem> {
    match read {
        Ok(bytes) => Ok(Found::Bytes(bytes)),
        Err(LoadProblem::Io { source, .. }) if source.kind() == ErrorKind::NotFound => {
            Ok(Found::Missing("missing"))
        }
        Err(LoadProblem::Io { .. }) => Ok(Found::Missing("unreadable")),
        Err(LoadProblem::BadUri { problem, .. }) if problem == OUTSIDE => {
            Ok(Found::Missing("outside the file's folder"))
        }
        Err(LoadProblem::BadUri { .. }) => Ok(Found::Missing("a broken reference")),
        Err(limit) => Err(limit),
    }
}

/// What follows `data:`, in upper or lower case.
fn data_of(uri: &str) -> Option<&str> {
    let (scheme, data) = uri.split_at_checked(5)?;
    scheme.eq_ignore_ascii_case("data:").then_some(data)
}

fn percent_decoded(uri: &str) -> Option<Vec<u8>> {
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
    Some(bytes)
}
