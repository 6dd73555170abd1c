//! Texts of files: bytes as text, and the lines of a text with their numbers.

use crate::budget::Budget;
use crate::error::LoadProblem;
use std::borrow::Cow;

/// A line and its number, from 1.
#[derive(Clone, Copy)]
pub(crate) struct Line<'a> {
    pub(crate) number: usize,
    pub(crate) text: &'a str,
}

/// The lines of a text, the empty ones too. They end with `\n`, `\r\n` or, of old, `\r`.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let mut rest = Some(text);
    let mut number = 0;
    std::iter::from_fn(move || {
        let text = rest?;
        number += 1;
        let Some((line, after)) = text.split_once(['\n', '\r']) else {
            rest = None;
            return Some(Line { number, text });
        };
        let ends_with_return = text.as_bytes().get(line.len()) == Some(&b'\r');
        rest = Some(match after.strip_prefix('\n') {
            Some(after) if ends_with_return => after,
            _ => after,
        });
        Some(Line { number, text: line })
    })
}

/// Bytes as text, without a byte order mark. In names of other encodings than UTF-8 each illegible byte is replaced, which takes a copy.
///
/// # Errors
/// A copy that exceeds the budget.
pub(crate) fn legible<'a>(
    bytes: &'a [u8],
    budget: &mut Budget,
) -> Result<Cow<'a, str>, LoadProblem> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if let Ok(text) = std::str::from_utf8(bytes) {
        return Ok(Cow::Borrowed(text));
    }
    // A byte becomes three at most, and a text that grows takes twice its length.
    budget.memory((bytes.len() as u64).saturating_mul(6))?;
    Ok(Cow::Owned(String::from_utf8_lossy(bytes).into_owned()))
}
