//! The statements of OBJ and MTL texts: lines without comments, joined where a backslash continues them.

use crate::text::lines;
use std::borrow::Cow;

/// A statement and the number of its first line, from 1.
pub(super) struct Statement<'a> {
    pub(super) line: usize,
    pub(super) text: Cow<'a, str>,
}

/// The statements of a text that are not empty. A comment begins with `#` at the start of a line or after a space, since names may contain one.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = lines(text);
    std::iter::from_fn(move || {
        loop {
            let first = lines.next()?;
            let text = without_comment(first.text);
            let text = match text.strip_suffix('\\') {
                None => Cow::Borrowed(text),
                Some(start) => {
                    let others = lines.by_ref().map(|line| without_comment(line.text));
                    Cow::Owned(joined(start, others))
                }
            };
            if !text.is_empty() {
                return Some(Statement {
                    line: first.number,
                    text,
                });
            }
        }
    })
}

/// A statement that goes on in other lines, up to the first without a backslash, which may be empty.
fn joined<'a>(start: &str, others: impl Iterator<Item = &'a str>) -> String {
    let mut whole = start.to_owned();
    for line in others {
        whole.push(' ');
        match line.strip_suffix('\\') {
            Some(part) => whole.push_str(part),
            None => {
                whole.push_str(line);
                break;
            }
        }
    }
    whole
}

fn without_comment(line: &str) -> &str {
    let comment = line.match_indices('#').map(|(at, _)| at).find(|at| {
        let before = line.get(..*at).unwrap_or_default();
        before.is_empty() || before.ends_with(char::is_whitespace)
    });
    line.get(..comment.unwrap_or(line.len()))
        .unwrap_or_default()
        .trim()
}

/// A statement's first word, and the rest.
pub(super) fn keyword(statement: &str) -> (&str, &str) {
    match statement.split_once(char::is_whitespace) {
        Some((word, rest)) => (word, rest.trim_start()),
        None => (statement, ""),
    }
}
