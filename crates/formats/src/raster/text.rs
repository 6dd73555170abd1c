//! Tokens and numbers of text files, with line numbers for errors. Readers of grids in text share them.

use std::borrow::Cow;
use std::iter::Enumerate;
use std::str::{Lines, SplitWhitespace};

use antumbra_files::words::name;

/// The text of a file. Each invalid UTF-8 sequence becomes one replacement character.
#[must_use]
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    String::from_utf8_lossy(bytes)
}

/// Parses a number, which may be infinite or NaN; `None` for any other text.
#[must_use]
pub fn parse_number(word: &str) -> Option<f64> {
    word.trim().parse().ok()
}

/// A number as a count; `None` for one that is not whole or does not fit.
#[must_use]
pub fn whole_number(value: f64) -> Option<u32> {
    let is_whole = value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value);
    is_whole.then_some(value as u32)
}

/// The tokens of a text, separated by white space.
#[derive(Debug)]
pub struct Tokens<'a> {
    lines: Enumerate<Lines<'a>>,
    words: SplitWhitespace<'a>,
    line: usize,
}

impl<'a> Tokens<'a> {
    /// The tokens of a text.
    #[must_use]
    pub fn new(text: &'a str) -> Self {
        Self {
            lines: text.lines().enumerate(),
            words: "".split_whitespace(),
            line: 0,
        }
    }

    /// The next token; `None` at the end.
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

    /// The next token as a number. `what` names it in the error.
    ///
    /// # Errors
    /// The line and the token, if it is no number.
    pub fn number(&mut self, what: &str) -> Result<f64, String> {
        let word = self
            .next_token()
            .ok_or_else(|| format!("the file ends at line {} before {what}", self.line))?;
        parse_number(word)
            .ok_or_else(|| format!("line {}: {what} is `{}`, no number", self.line, name(word)))
    }

    /// The next token as a whole number.
    ///
    /// # Errors
    /// As for [`Tokens::number`].
    pub fn count(&mut self, what: &str) -> Result<u32, String> {
        let value = self.number(what)?;
        whole_number(value)
            .ok_or_else(|| format!("line {}: {what} is {value}, no count", self.line))
    }

    /// The remaining tokens as `columns * rows` values. Undefined values become NaN.
    ///
    /// A value takes at least two bytes, including its separator, so no more memory than twice `length`, the text's
    /// length, is allocated.
    ///
    /// # Errors
    /// As for [`Tokens::number`], and for more or fewer values.
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
            let value = parse_number(word).ok_or_else(|| {
                format!(
                    "line {}: {} is `{}`, no number",
                    self.line,
                    what(),
                    name(word)
                )
            })?;
            values.push(if is_undefined(value) { f64::NAN } else { value });
        }
        match self.next_token() {
            None => Ok(values),
            Some(word) => Err(format!(
                "line {}: `{}` follows after all {columns} x {rows} values",
                self.line,
                name(word)
            )),
        }
    }
}

/// The number of nodes of a grid, if it is at most `most`, the number that the file can contain.
///
/// # Errors
/// The declared size, and the greatest possible number.
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
