//! The header of a PLY and its body, with the line ends that the crate `ply-rs-bw` expects. Headers of old Macintosh programs end their lines
//! with a carriage return alone, and some writers leave blank lines.

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
pub(super) fn split(bytes: &[u8]) -> Option<Parts<'_>> {
    let start = bytes.get(..bytes.len().min(LONGEST))?;
    let first_end = start
        .iter()
        .position(|byte| matches!(byte, b'\r' | b'\n'))?;
    // The first line tells how all of them end. What follows the last one may be binary.
    let end: &[u8] = match start.get(first_end..first_end + 2) {
        Some(b"\r\n") => b"\r\n",
        _ => start.get(first_end..=first_end)?,
    };
    let mut header = String::new();
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
        header.push_str(text);
        header.push('\n');
        if text == "end_header" {
            break;
        }
        length?;
    }
    let body = bytes.get(at..).unwrap_or_default();
    Some(Parts {
        header,
        body: match is_ascii {
            true => Cow::Owned(plain(body)),
            false => Cow::Borrowed(body),
        },
    })
}

/// An ASCII body without blank lines, and with numbers that the crate knows.
fn plain(body: &[u8]) -> Vec<u8> {
    let mut kept = Vec::with_capacity(body.len() + 1);
    for line in body.split(|byte| matches!(byte, b'\r' | b'\n')) {
        let line = line.trim_ascii();
        if line.is_empty() {
            continue;
        }
        let is_odd = |byte: &u8| byte.is_ascii_alphabetic() && !matches!(byte, b'e' | b'E');
        if line.iter().any(|byte| is_odd(byte) || *byte == b'#') {
            for word in line.split(u8::is_ascii_whitespace) {
                kept.extend_from_slice(if is_not_finite(word) { b"1e999" } else { word });
                kept.push(b' ');
            }
        } else {
            kept.extend_from_slice(line);
        }
        kept.push(b'\n');
    }
    kept
}

/// Whether a word is one of the spellings of infinity and of no number, such as `-nan(ind)` and `1.#INF`. All are read as infinity: their
/// vertices are left out either way.
fn is_not_finite(word: &[u8]) -> bool {
    let word = word.to_ascii_lowercase();
    let has = |part: &[u8]| word.windows(part.len()).any(|bytes| bytes == part);
    has(b"nan") || has(b"inf") || has(b".#")
}
