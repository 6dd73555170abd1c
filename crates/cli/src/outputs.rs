//! What a command writes never destroys what it reads.
//!
//! Before any work, the real path of each output, links followed, is held against those of all inputs and of all other outputs. An output
//! that exists and is no regular file, such as a device, a FIFO or a folder, is refused as well: a finished file is renamed to its name, and
//! would take its place. What cannot be written is found then too, and not when the work is done.

use std::ffi::OsStr;
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};

use antumbra::files::{OutFolder, kind, probe, real_path};
use antumbra::measure::compare::is_report_file;

use crate::args::{PathArg, ViewArgs};
use crate::failure::Failure;

/// The files that a command reads and writes.
#[derive(Debug, Default)]
pub struct Outputs {
    inputs: Vec<Named>,
    outputs: Vec<Named>,
    folders: Vec<Named>,
}

/// A path, and what it is on the command line.
#[derive(Debug, Clone)]
struct Named {
    role: &'static str,
    path: PathBuf,
}

impl std::fmt::Display for Named {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} '{}'", self.role, self.path.display())
    }
}

impl Outputs {
    /// Of a command that draws this view: the files that the view is read from, and no output yet.
    pub fn for_view(view: &ViewArgs) -> Self {
        let mut outputs = Self::default();
        if let Some(scene) = &view.scene {
            outputs.reads("the scene", scene);
        }
        if let Some(PathArg::Named(path)) = &view.path {
            outputs.reads("--path", path);
        }
        if let Some(volume) = &view.volume.file {
            outputs.reads("--volume", volume);
        }
        outputs
    }

    /// Adds a file that is read.
    pub fn reads(&mut self, role: &'static str, path: impl AsRef<Path>) {
        self.inputs.push(named(role, path.as_ref()));
    }

    /// Adds a file that is written.
    pub fn writes(&mut self, role: &'static str, path: impl AsRef<Path>) {
        self.outputs.push(named(role, path.as_ref()));
    }

    /// Adds the folder that a report is written into.
    pub fn reports_into(&mut self, role: &'static str, folder: impl AsRef<Path>) {
        self.folders.push(named(role, folder.as_ref()));
    }

    /// Refuses outputs that would replace an input, another output, or what is no regular file.
    ///
    /// # Errors
    /// [`Failure::Usage`], which names both.
    pub fn check(&self) -> Result<(), Failure> {
        let inputs: Vec<Placed<'_>> = self.inputs.iter().map(Placed::of).collect();
        let mut written: Vec<Placed<'_>> = Vec::new();
        for output in self.outputs.iter().map(Placed::of) {
            output.check_free(&inputs)?;
            if let Some(other) = output.same_file(&written) {
                return Err(Failure::Usage(format!(
                    "{other} and {} are one file: name two",
                    output.named
                )));
            }
            written.push(output);
        }
        for folder in &self.folders {
            for output in &report_files(folder)? {
                Placed::of(output).check_free(&inputs)?;
            }
        }
        Ok(())
    }

    /// Tries whether every output can be written, and sweeps away what killed runs left beside them. After [`check`](Self::check).
    ///
    /// # Errors
    /// [`Failure::Output`], with the first that cannot.
    pub fn probe(&self) -> Result<(), Failure> {
        self.outputs.iter().try_for_each(|output| {
            probe(&output.path).map_err(|error| Failure::Output {
                path: output.path.clone(),
                error,
            })
        })
    }
}

/// Opens the folder of a report, until whose end no other run writes into it.
///
/// # Errors
/// [`Failure::Output`], for a folder that another run writes into, or that cannot be written.
pub fn open_folder(path: &Path) -> Result<OutFolder, Failure> {
    OutFolder::open(path).map_err(|error| Failure::Output {
        path: path.to_owned(),
        error,
    })
}

fn named(role: &'static str, path: &Path) -> Named {
    Named {
        role,
        path: path.to_owned(),
    }
}

/// A path on the command line, and where it leads.
struct Placed<'a> {
    named: &'a Named,
    place: Place,
}

impl<'a> Placed<'a> {
    fn of(named: &'a Named) -> Self {
        Self {
            named,
            place: Place::of(&named.path),
        }
    }

    /// The first of the others that is the same file.
    fn same_file<'b>(&self, others: &[Placed<'b>]) -> Option<&'b Named> {
        let mut others = others.iter();
        let other = others.find(|other| self.place.is(&other.place));
        other.map(|other| other.named)
    }

    /// Checks that an output is no input, and that it is absent or a regular file.
    fn check_free(&self, inputs: &[Placed<'_>]) -> Result<(), Failure> {
        let output = self.named;
        if let Some(input) = self.same_file(inputs) {
            return Err(Failure::Usage(format!(
                "{output} would overwrite {input}: name another file"
            )));
        }
        match &self.place.found {
            Some(found) if !found.is_file() => Err(Failure::Usage(format!(
                "{output} is {}: name a file",
                kind(found.file_type())
            ))),
            _ => Ok(()),
        }
    }
}

/// The files in a folder that a report would replace.
fn report_files(folder: &Named) -> Result<Vec<Named>, Failure> {
    let place = Place::of(&folder.path);
    match &place.found {
        None => return Ok(Vec::new()),
        Some(found) if !found.is_dir() => {
            return Err(Failure::Usage(format!(
                "{folder} is {}: name a folder",
                kind(found.file_type())
            )));
        }
        Some(_) => {}
    }
    // A folder that cannot be listed is found out when the report is written.
    let Ok(entries) = fs::read_dir(&place.path) else {
        return Ok(Vec::new());
    };
    let is_report = |name: &OsStr| name.to_str().is_some_and(is_report_file);
    let entries = entries.flatten().map(|entry| entry.file_name());
    let files = entries.filter(|name| is_report(name));
    Ok(files
        .map(|name| named(folder.role, &folder.path.join(name)))
        .collect())
}

/// Where a path leads.
struct Place {
    /// Absolute, without links.
    path: PathBuf,
    /// What is there.
    found: Option<Metadata>,
}

impl Place {
    fn of(path: &Path) -> Self {
        let path = real_path(path);
        Self {
            found: fs::metadata(&path).ok(),
            path,
        }
    }

    /// Whether both are one file: by path, or, where names differ (hard links, case), by what the file system says.
    fn is(&self, other: &Self) -> bool {
        let both = self.found.as_ref().zip(other.found.as_ref());
        self.path == other.path || both.is_some_and(|(one, other)| is_same_file(one, other))
    }
}

#[cfg(unix)]
fn is_same_file(one: &Metadata, other: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

/// Paths tell files apart: canonical ones have the case that the file system keeps.
#[cfg(not(unix))]
fn is_same_file(_: &Metadata, _: &Metadata) -> bool {
    false
}
