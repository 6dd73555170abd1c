//! Imports: `//!import name` lines at the start of a file include `shared/name.wgsl`, each file at most once. Imported text comes after the
//! file's own text, which WGSL's free order of declarations allows. So the file's lines keep their numbers, and its `enable` directives stay
//! first.

use std::borrow::Cow;

use crate::{error::ShaderError, job::SourcePart};

/// A text that jobs may import.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SharedSource<'a> {
    /// Its name in `//!import`.
    pub name: &'a str,
    /// Its WGSL text.
    pub text: &'a str,
}

/// A job's text with its imports.
#[derive(Clone, Debug)]
pub(crate) struct Joined {
    /// The whole text.
    pub text: String,
    /// The files of its lines.
    pub parts: Vec<SourcePart>,
}

const IMPORT: &str = "//!import ";

/// Joins `text`, named `file` in messages, with its direct and indirect imports.
pub(crate) fn join(
    file: &str,
    text: &str,
    shared: &[SharedSource<'_>],
) -> Result<Joined, ShaderError> {
    let mut joining = Joining {
        shared,
        joined: Joined {
            text: String::new(),
            parts: Vec::new(),
        },
        done: Vec::new(),
        open: Vec::new(),
    };
    joining.append(file, text);
    joining.follow(file, text)?;
    Ok(joining.joined)
}

struct Joining<'a> {
    shared: &'a [SharedSource<'a>],
    joined: Joined,
    done: Vec<&'a str>,
    open: Vec<&'a str>,
}

impl Joining<'_> {
    fn append(&mut self, file: &str, text: &str) {
        let first_line = self.joined.parts.iter().map(|part| part.lines).sum::<u32>() + 1;
        self.joined.text.push_str(text);
        if !text.ends_with('\n') {
            self.joined.text.push('\n');
        }
        self.joined.parts.push(SourcePart {
            file: Cow::Owned(file.to_owned()),
            first_line,
            lines: number(text.lines().count().max(1)),
        });
    }

    fn follow(&mut self, file: &str, text: &str) -> Result<(), ShaderError> {
        for (line, name) in imports(file, text)? {
            if self.open.contains(&name) {
                let from = self.open.iter().position(|open| *open == name).unwrap_or(0);
                let open = self.open.iter().skip(from).copied();
                let chain: Vec<&str> = open.chain([name]).collect();
                return Err(ShaderError::ImportCycle {
                    file: file.to_owned(),
                    line,
                    chain: chain.join(" -> "),
                });
            }
            if self.done.contains(&name) {
                continue;
            }
            let Some(found) = self.shared.iter().find(|source| source.name == name) else {
                let known: Vec<&str> = self.shared.iter().map(|source| source.name).collect();
                return Err(ShaderError::UnknownImport {
                    file: file.to_owned(),
                    line,
                    name: name.to_owned(),
                    known: if known.is_empty() {
                        "none".to_owned()
                    } else {
                        known.join(", ")
                    },
                });
            };
            let path = shared_path(name);
            self.append(&path, found.text);
            self.open.push(found.name);
            self.follow(&path, found.text)?;
            self.open.pop();
            self.done.push(found.name);
        }
        Ok(())
    }
}

/// The file name of a shared text, for messages.
fn shared_path(name: &str) -> String {
    format!("wgsl/shared/{name}.wgsl")
}

/// The import lines of a file with their line numbers.
fn imports<'t>(file: &str, text: &'t str) -> Result<Vec<(u32, &'t str)>, ShaderError> {
    let mut found = Vec::new();
    let mut in_head = true;
    for (index, line) in text.lines().enumerate() {
        let number = number(index + 1);
        let line = line.trim_end();
        if !line.starts_with("//!") {
            in_head = false;
            continue;
        }
        let name = line.strip_prefix(IMPORT).map(str::trim);
        match name {
            Some(name) if !name.is_empty() && !name.contains(char::is_whitespace) => {
                if !in_head {
                    return Err(ShaderError::LateImport {
                        file: file.to_owned(),
                        line: number,
                    });
                }
                found.push((number, name));
            }
            _ => {
                return Err(ShaderError::Directive {
                    file: file.to_owned(),
                    line: number,
                    directive: line.to_owned(),
                });
            }
        }
    }
    Ok(found)
}

/// A line number. It fits, since a WGSL text cannot have 4 G lines.
fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
