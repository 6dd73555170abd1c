//! What reading files assumed, left out or changed, said on standard error: a line each, with the files that it is true of.

use std::path::{Path, PathBuf};

use crate::print::warn;

/// The most files that a line names.
const NAMED: usize = 3;

/// Notes about files, in the order in which they were first made.
#[derive(Default)]
pub struct Notes {
    list: Vec<(String, Vec<PathBuf>)>,
}

impl Notes {
    /// Adds the notes about a file.
    pub fn add(&mut self, file: &Path, notes: &[String]) {
        for note in notes {
            let known = self.list.iter_mut().find(|(known, _)| known == note);
            match known {
                Some((_, files)) => files.push(file.to_owned()),
                None => self.list.push((note.clone(), vec![file.to_owned()])),
            }
        }
    }

    /// Says the notes, unless `quiet`.
    pub fn say(self, quiet: bool) {
        if quiet {
            return;
        }
        for (note, files) in self.list {
            let named: Vec<String> = files
                .iter()
                .take(NAMED)
                .map(|file| file.display().to_string())
                .collect();
            let more = match files.len().saturating_sub(NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            warn(format!("{}{more}: {note}", named.join(", ")));
        }
    }
}

/// Says the notes about one file, unless `quiet`.
pub fn say(file: &Path, notes: &[String], quiet: bool) {
    let mut all = Notes::default();
    all.add(file, notes);
    all.say(quiet);
}
