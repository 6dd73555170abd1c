//! The header of a PLY and its body, with the line ends that the crate `ply-rs-bw` expects. Headers of old Macintosh programs end their lines
//! with a carriage return alone, and some writers leave blank lines.

use crate::budget::Budget;
use crate::error::LoadProblem;
use std::borrow::Cow;

/// A file in its two parts.
pub(super) struct Parts<'a> {
    /// The header's lines, each with a line feed.
    pub(super) header: String,
    pub(super) body: Cow<'a, [u8]>,
}

/// The most bytes of a header.
const LONGEST: usize = 1 << 20;

/// Divides a file; `None` if its header has no end.
///
/// # Errors
/// An ASCII body whose copy exceeds the budget.
pub(super) fn split<'a>(
    bytes: &'a [u8],
    budget: &mut Budget,
) -> Result<Option<Parts<'a>>, LoadProblem> {
    let Some(Header {
        text,
        length,
        is_ascii,
    }) = header(bytes)
    else {
        return Ok(None);
    };
    let body = bytes.get(length..).unwrap_or_default();
    let body = match is_ascii {
        true => Cow::Owned(plain(body, budget)?),
        false => Cow::Borrowed(body),
    };
    Ok(Some(Parts { header: text, body }))
}

/// A header.
struct Header {
    /// Its lines, each with a line feed.
    text: String,
    /// Its length in the file, in bytes.
    length: usize,
    is_ascii: bool,
}

fn header(bytes: &[u8]) -> Option<Header> {
    let start = bytes.get(..bytes.len().min(LONGEST))?;
    let first_end = start
        .iter()
        .position(|byte| matches!(byte, b'\r' | b'\n'))?;
    // The first line tells how all of them end. What follows the last one may be binary.
    let end: &[u8] = match start.get(first_end..first_end + 2) {
        Some(b"\r\n") => b"\r\n",
        _ => start.get(first_end..=first_end)?,
    };
    let mut lines = String::new();
    let mut at = 0;
    let mut is_ascii = false;
    loop {
        let rest = start.get(at..)?;
        let length = rest.windows(end.len()).position(|bytes| bytes == end);
        // A file without a body may lack the last line's end.
        let line = rest.get(..length.unwrap_or(rest.len()))?;
        at += line.len() + end.len();
        let text = String::from_utf8_lossy(line);
        let text = text.trim();
        if text.is_empty() {
            length?;
            continue;
        }
        is_ascii |= text.starts_with("format ascii");
        lines.push_str(text);
        lines.push('\n');
        if text == "end_header" {
            break;
        }
        length?;
    }
    Some(Header {
        text: lines,
        length: at,
        is_ascii,
    })
}

/// An ASCII body without blank lines, and with numbers that the crate knows.
///
/// # Errors
/// A body that exceeds the budget.
fn plain(body: &[u8], budget: &mut Budget) -> Result<Vec<u8>, LoadProblem> {
    let mut length = 0;
    each_plain(body, &mut |bytes| length += bytes.len());
    budget.memory(length as u64)?;
    let mut kept = Vec::with_capacity(length);
    each_plain(body, &mut |bytes| kept.extend_from_slice(bytes));
    Ok(kept)
}

/// Gives a plain body, piece by piece.
fn each_plain(body: &[u8], keep: &mut impl FnMut(&[u8])) {
    for line in body.split(|byte| matches!(byte, b'\r' | b'\n')) {
        let line = line.trim_ascii();
        if line.is_empty() {
            continue;
        }
        let is_odd = |byte: &u8| byte.is_ascii_alphabetic() && !matches!(byte, b'e' | b'E');
        if line.iter().any(|byte| is_odd(byte) || *byte == b'#') {
            for word in line.split(u8::is_ascii_whitespace) {
                keep(if is_not_finite(word) { b"1e999" } else { word });
                keep(b" ");
            }
        } else {
            keep(line);
        }
        keep(b"\n");
    }
}

/// Whether a word is one of the spellings of infinity and of no number, such as `-nan(ind)` and `1.#INF`. All are read as infinity: their
/// vertices are left out either way.
fn is_not_finite(word: &[u8]) -> bool {
    let word = word.to_ascii_lowercase();
    let has = |part: &[u8]| word.windows(part.len()).any(|bytes| bytes == part);
    has(b"nan") || has(b"inf") || has(b".#")
}
