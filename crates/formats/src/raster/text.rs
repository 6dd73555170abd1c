//! Numbers out of words, with the line they stand on: what readers of grids in text share.

use std::borrow::Cow;
use std::iter::Enumerate;
use std::str::{Lines, SplitWhitespace};

/// What a file of text says; bytes that are no UTF-8 stand for one character each.
#[must_use]
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    String::from_utf8_lossy(bytes)
}

/// A finite number or not; `None` when it is no number.
#[must_use]
pub fn parse_number(word: &str) -> Option<f64> {
    word.trim().parse().ok()
}

/// The words of a text, one after the other.
#[derive(Debug)]
pub struct Tokens<'a> {
    lines: Enumerate<Lines<'a>>,
    words: SplitWhitespace<'a>,
    line: usize,
}

impl<'a> Tokens<'a> {
    /// All words of a text.
    #[must_use]
    pub fn new(text: &'a str) -> Self {
        Self {
            lines: text.lines().enumerate(),
            words: "".split_whitespace(),
            line: 0,
        }
    }

    /// The next word.
    pub fn next_token(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            let (index, line) = self.lines.next()?;
            self.line = index + 1;
            self.words = line.split_whitespace();
        }
    }

    /// The next word as a number; `what` it is goes into the error.
    ///
    /// # Errors
    /// The line, and what stands there instead.
    pub fn number(&mut self, what: &str) -> Result<f64, String> {
        let word = self
            .next_token()
            .ok_or_else(|| format!("the file ends at line {} before {what}", self.line))?;
        parse_number(word)
            .ok_or_else(|| format!("line {}: {what} is `{word}`, no number", self.line))
    }

    /// The next word as a count.
    ///
    /// # Errors
    /// As [`Tokens::number`].
    pub fn count(&mut self, what: &str) -> Result<u32, String> {
        let value = self.number(what)?;
        if value.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&value) {
            return Err(format!("line {}: {what} is {value}, no count", self.line));
        }
        Ok(value as u32)
    }

    /// As many values as a field of that size has, the undefined ones NaN.
    ///
    /// A value takes two bytes at least, itself and what parts it from the next: no more memory than twice the text's length is asked for.
    ///
    /// # Errors
    /// As [`Tokens::number`], and where there are more or fewer.
    pub fn grid(
        &mut self,
        columns: u32,
        rows: u32,
        length: usize,
        is_undefined: impl Fn(f64) -> bool,
    ) -> Result<Vec<f64>, String> {
        let nodes = node_count(columns, rows, length / 2 + 1)?;
        let mut values = Vec::with_capacity(nodes);
        for index in 0..nodes {
            let what = || format!("value {index} of {nodes}");
            let word = self
                .next_token()
                .ok_or_else(|| format!("the file ends at line {} before {}", self.line, what()))?;
            let value = parse_number(word)
                .ok_or_else(|| format!("line {}: {} is `{word}`, no number", self.line, what()))?;
            values.push(if is_undefined(value) { f64::NAN } else { value });
        }
        match self.next_token() {
            None => Ok(values),
            Some(word) => Err(format!(
                "line {}: `{word}` follows after all {columns} x {rows} values",
                self.line
            )),
        }
    }
}

/// How many nodes, if a file can hold that many.
///
/// # Errors
/// What it declares, and what it can hold.
pub fn node_count(columns: u32, rows: u32, most: usize) -> Result<usize, String> {
    let nodes = u64::from(columns) * u64::from(rows);
    if columns < 2 || rows < 2 {
        return Err(format!(
            "it declares {columns} x {rows} nodes; a surface has at least 2 x 2"
        ));
    }
    match usize::try_from(nodes) {
        Ok(nodes) if nodes <= most => Ok(nodes),
        _ => Err(format!(
            "it declares {columns} x {rows} nodes, but is long enough for {most} at most; it is truncated or damaged"
        )),
    }
}
