//! The statements of OBJ and MTL texts: lines without comments, joined where a backslash continues them.

use std::borrow::Cow;

/// A statement and the number of its first line, from 1.
pub(super) struct Statement<'a> {
    pub(super) line: usize,
    pub(super) text: Cow<'a, str>,
}

/// The statements of a text that are not empty. A comment begins with `#` at the start of a line or after a space, since names may contain one.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    // Lines end with \n, \r\n or, of old, \r.
    let mut lines = (text.split(['\n', '\r']).enumerate()).filter(|(_, line)| !line.is_empty());
    std::iter::from_fn(move || {
        loop {
            let (number, line) = lines.next()?;
            let mut whole = Cow::Borrowed(without_comment(line));
            while let Some(start) = whole.strip_suffix('\\') {
                let mut joined = start.to_owned();
                joined.push(' ');
                let next = lines.next().map_or("", |(_, line)| line);
                joined.push_str(without_comment(next));
                whole = Cow::Owned(joined);
            }
            if !whole.is_empty() {
                return Some(Statement {
                    line: number + 1,
                    text: whole,
                });
            }
        }
    })
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
