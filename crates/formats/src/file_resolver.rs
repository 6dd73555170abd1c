//! Reading of files, and of what a scene file refers to: `data:` URIs, and files in its own folder or below. Nothing
//! else is opened.
//!
//! Names are resolved as people's exporters write them: with backslashes, or in another case than the file has.

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::HashMap;
use std::ffi::OsString;
use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// The folder in which the references of a file are resolved.
pub(super) struct FileResolver<'a> {
    base: Option<&'a Path>,
    /// The folders in which a name was looked for in another case. Each is listed once.
    folders: RefCell<HashMap<PathBuf, Names>>,
}

/// The names of a folder, by their lower case.
type Names = HashMap<String, OsString>;

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

/// The most names of a folder that are listed, to find those of another case.
const MOST_NAMES: usize = 1 << 16;

/// Steps of work of a question to the operating system, and of a name that is listed.
const LOOK_UP: u64 = 1024;
const NAME: u64 = 64;

/// Bytes of memory of a listed name besides its letters.
const LISTED: u64 = 128;

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
        Self {
            base,
            folders: RefCell::default(),
        }
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
        let path = self.resolve(&name, budget)?.map_err(bad)?;
        read(&path, budget)
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
        match self.resolve(&own, budget)? {
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

    /// The path of a relative name, or why there is none: it must be in the folder or below.
    ///
    /// # Errors
    /// Work that exceeds the budget.
    fn resolve(
        &self,
        name: &str,
        budget: &mut Budget,
    ) -> Result<Result<PathBuf, &'static str>, LoadProblem> {
        let name = name.replace('\\', "/");
        let has_scheme = name.split_once(':').is_some();
        let relative = Path::new(&name);
        let inside = |c: Component<'_>| matches!(c, Component::Normal(_) | Component::CurDir);
        if has_scheme || name.is_empty() || !relative.components().all(inside) {
            return Ok(Err(OUTSIDE));
        }
        let Some(base) = self.base else {
            let reason =
                "the scene was read from memory, without a folder to look in; load it from a file";
            return Ok(Err(reason));
        };
        let base = if base.as_os_str().is_empty() {
            Path::new(".")
        } else {
            base
        };
        let path = self.existing(base, relative, budget)?;
        // A symbolic link may lead elsewhere.
        Ok(match (base.canonicalize(), path.canonicalize()) {
            (Ok(base), Ok(path)) if !path.starts_with(&base) => Err(OUTSIDE),
            _ => Ok(path),
        })
    }

    /// The path below `base`; where a part of it is not there, the file that differs in case alone.
    ///
    /// # Errors
    /// Work or memory that exceeds the budget.
    fn existing(
        &self,
        base: &Path,
        relative: &Path,
        budget: &mut Budget,
    ) -> Result<PathBuf, LoadProblem> {
        budget.work(LOOK_UP)?;
        let exact = base.join(relative);
        if exact.exists() {
            return Ok(exact);
        }
        let mut path = base.to_owned();
        for part in relative.components() {
            budget.work(LOOK_UP)?;
            let own = path.join(part);
            if own.exists() {
                path = own;
                continue;
            }
            match self.in_any_case(&path, &part.as_os_str().to_string_lossy(), budget)? {
                Some(name) => path.push(name),
                None => return Ok(exact),
            }
        }
        Ok(path)
    }

    /// The name in a folder that differs from this one in case alone.
    ///
    /// # Errors
    /// Work or memory that exceeds the budget.
    fn in_any_case(
        &self,
        folder: &Path,
        name: &str,
        budget: &mut Budget,
    ) -> Result<Option<OsString>, LoadProblem> {
        let wanted = name.to_lowercase();
        let mut folders = self.folders.borrow_mut();
        if let Some(names) = folders.get(folder) {
            return Ok(names.get(&wanted).cloned());
        }
        let names = names_of(folder, budget)?;
        let found = names.get(&wanted).cloned();
        folders.insert(folder.to_owned(), names);
        Ok(found)
    }
}

/// The names of a folder, as many as are listed. Of names that differ in case alone it has the first in order.
///
/// # Errors
/// Work or memory that exceeds the budget.
fn names_of(folder: &Path, budget: &mut Budget) -> Result<Names, LoadProblem> {
    let mut names = Names::new();
    for entry in folder.read_dir().into_iter().flatten().take(MOST_NAMES) {
        budget.work(NAME)?;
        let Ok(name) = entry.map(|entry| entry.file_name()) else {
            continue;
        };
        budget.memory(LISTED + 2 * name.len() as u64)?;
        let lower = name.to_string_lossy().to_lowercase();
        // The order of a folder's entries is not determined.
        let known = names.entry(lower).or_insert_with(|| name.clone());
        if name < *known {
            *known = name;
        }
    }
    Ok(names)
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
pub(super) fn data_of(uri: &str) -> Option<&str> {
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
