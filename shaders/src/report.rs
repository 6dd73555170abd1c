//! Parses and validates with naga, and renders its messages with the original files and lines.

use std::{error::Error, ops::Range};

use codespan_reporting::{
    diagnostic::{Diagnostic, Label},
    files::SimpleFiles,
    term,
};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::{error::ShaderError, source::Joined};

/// Parses a joined text and validates it with all capabilities of native wgpu devices.
pub(crate) fn check(joined: &Joined) -> Result<(naga::Module, ModuleInfo), ShaderError> {
    let module = naga::front::wgsl::parse_str(&joined.text).map_err(|error| {
        let labels = error
            .labels()
            .map(|(span, text)| (span.to_range(), text.to_owned()))
            .collect();
        let notes = error.notes().map(str::to_owned).collect();
        report(joined, error.message(), labels, notes)
    })?;
    let info = validate(&module, every_capability()).map_err(|error| {
        let labels = error
            .spans()
            .map(|(span, text)| (span.to_range(), text.clone()))
            .collect();
        let mut notes = Vec::new();
        let mut source = error.as_inner().source();
        while let Some(cause) = source {
            notes.push(cause.to_string());
            source = cause.source();
        }
        report(joined, &error.as_inner().to_string(), labels, notes)
    })?;
    Ok((module, info))
}

/// Validates as wgpu does on a device with these capabilities.
pub(crate) fn validate(
    module: &naga::Module,
    capabilities: Capabilities,
) -> Result<ModuleInfo, Box<naga::WithSpan<naga::valid::ValidationError>>> {
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(module)
        .map_err(Box::new)
}

fn every_capability() -> Capabilities {
    wgpu_naga_bridge::features_to_naga_capabilities(
        wgpu::Features::all(),
        wgpu::DownlevelFlags::all(),
    )
}

fn report(
    joined: &Joined,
    message: &str,
    labels: Vec<(Option<Range<usize>>, String)>,
    notes: Vec<String>,
) -> ShaderError {
    let mut files = SimpleFiles::new();
    let mut starts = Vec::new();
    let mut rest = joined.text.as_str();
    for part in joined.parts.iter() {
        let (text, after) = split_lines(rest, part.lines);
        starts.push(joined.text.len() - rest.len());
        files.add(part.file.as_ref(), text);
        rest = after;
    }
    let mut place = None;
    let mut shown = Vec::new();
    for (range, text) in labels {
        let Some(range) = range else { continue };
        let part = starts
            .partition_point(|start| *start <= range.start)
            .saturating_sub(1);
        let start = starts.get(part).copied().unwrap_or(0);
        let local = range.start - start..range.end.saturating_sub(start).max(range.start - start);
        if place.is_none()
            && let Some(found) = joined.parts.get(part)
        {
            let before = joined.text.as_bytes().get(start..range.start);
            let before = before.unwrap_or_default();
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            place = Some((found.file.to_string(), u32::try_from(line).ok()));
        }
        shown.push(Label::primary(part, local).with_message(text));
    }
    let file = joined.parts.first().map(|part| part.file.as_ref());
    let mut notes = notes;
    if shown.is_empty()
        && let Some(file) = file
    {
        notes.push(format!("in {file}; naga names no line for this one"));
    }
    let diagnostic = Diagnostic::error()
        .with_message(message)
        .with_labels(shown)
        .with_notes(notes);
    let mut report = String::new();
    if term::emit_to_string(&mut report, &term::Config::default(), &files, &diagnostic).is_err() {
        report = format!("error: {message}\n");
    }
    let (file, line) = match place {
        Some((file, line)) => (Some(file), line),
        None => (file.map(str::to_owned), None),
    };
    ShaderError::Invalid { report, file, line }
}

fn split_lines(text: &str, lines: u32) -> (&str, &str) {
    let mut end = 0;
    for line in text
        .split_inclusive('\n')
        .take(usize::try_from(lines).unwrap_or(usize::MAX))
    {
        end += line.len();
    }
    text.split_at(end)
}
