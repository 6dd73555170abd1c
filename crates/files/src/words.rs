//! Words out of files, fit for a terminal and for a message.

/// The text with control characters and direction overrides replaced by `?`. They could change a terminal's contents or reverse a line.
#[must_use]
pub fn clean(text: &str) -> String {
    text.chars()
        .map(|c| if is_hostile(c) { '?' } else { c })
        .collect()
}

/// As [`clean`], with line breaks and tabs kept: for a text of ours that has names in it.
#[must_use]
pub fn clean_lines(text: &str) -> String {
    text.chars()
        .map(|c| {
            if !matches!(c, '\n' | '\t') && is_hostile(c) {
                '?'
            } else {
                c
            }
        })
        .collect()
}

fn is_hostile(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200e}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The beginning of a text, at most `most` characters of it. A cut is shown by an ellipsis.
#[must_use]
pub fn shorten(text: &str, most: usize) -> String {
    if text.chars().nth(most).is_none() {
        return text.to_owned();
    }
    let kept = text.chars().take(most.saturating_sub(1));
    kept.chain(['\u{2026}']).collect()
}

/// The beginning of a text out of a file, for a message: clean, and at most `most` characters.
#[must_use]
pub fn short(text: &str, most: usize) -> String {
    // Cut first: the text may be as long as its file.
    clean(&shorten(text, most))
}

/// A name out of a file for a message: clean, and at most 60 characters.
#[must_use]
pub fn name(text: &str) -> String {
    short(text, 60)
}
