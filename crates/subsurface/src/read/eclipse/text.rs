//! The text form of grids: keywords, each with values up to a `/`. `3*0.25` stands for three values, `--` begins a remark.

use antumbra_files::words::name;
use antumbra_formats::raster::text::{decode, parse_number};

use super::super::budget::ReadBudget;
use super::{CORNERS, Parts, UNIT_WORDS, cells, coordinates, no_property};

/// The most properties that are listed.
const LISTED: usize = 64;

/// The words of a text.
struct Words<'a> {
    rest: &'a str,
    next: Option<Word<'a>>,
}

/// A word.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Word<'a> {
    /// Anything but what follows.
    Plain(&'a str),
    /// A text in quotes.
    Quoted(&'a str),
    /// The end of a keyword's values.
    End,
}

impl<'a> Words<'a> {
    fn new(text: &'a str) -> Self {
        Self {
            rest: text,
            next: None,
        }
    }

    fn peek(&mut self) -> Option<Word<'a>> {
        if self.next.is_none() {
            self.next = self.read();
        }
        self.next
    }

    fn next(&mut self) -> Option<Word<'a>> {
        self.next.take().or_else(|| self.read())
    }

    fn read(&mut self) -> Option<Word<'a>> {
        loop {
            self.rest = self.rest.trim_start();
            if !self.rest.starts_with("--") {
                break;
            }
            self.skip_line();
        }
        let first = self.rest.chars().next()?;
        if first == '/' {
            // What follows on the line is a remark.
            self.skip_line();
            return Some(Word::End);
        }
        if first == '\'' || first == '"' {
            let inside = self.rest.get(1..).unwrap_or_default();
            let line = inside.find(['\n', first]).unwrap_or(inside.len());
            let (text, after) = inside.split_at(line);
            self.rest = after.get(1..).unwrap_or_default();
            return Some(Word::Quoted(text));
        }
        let end = self
            .rest
            .find(|c: char| c.is_whitespace() || c == '/' || c == '\'');
        let (word, after) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = after;
        Some(Word::Plain(word))
    }

    fn skip_line(&mut self) {
        self.rest = self.rest.split_once('\n').map_or("", |(_, after)| after);
    }

    /// The next keyword. Stray values are left out.
    fn keyword(&mut self) -> Option<&'a str> {
        loop {
            if let Word::Plain(word) = self.next()?
                && word.starts_with(|c: char| c.is_ascii_alphabetic())
            {
                return Some(word);
            }
        }
    }

    /// Skips the values of a keyword, if it has any: another keyword ends them too.
    fn skip(&mut self) {
        while let Some(word) = self.peek() {
            match word {
                Word::End => {
                    self.next = None;
                    return;
                }
                Word::Plain(word) if word.starts_with(|c: char| c.is_ascii_alphabetic()) => return,
                _ => self.next = None,
            }
        }
    }

    /// Calls `found` with each value of `keyword`, and how often it stands there.
    fn values(
        &mut self,
        keyword: &str,
        mut found: impl FnMut(f64, usize) -> Result<(), String>,
    ) -> Result<(), String> {
        loop {
            match self.next() {
                None | Some(Word::End) => return Ok(()),
                Some(Word::Quoted(word)) => {
                    return Err(format!("{keyword}: '{}' is no number", name(word)));
                }
                Some(Word::Plain(word)) => {
                    let (value, times) = repeated(word)
                        .ok_or_else(|| format!("{keyword}: `{}` is no number", name(word)))?;
                    found(value, times)?;
                }
            }
        }
    }

    /// The number of a keyword's values up to their end; `None` where one is no number, which is not passed.
    fn count(&mut self) -> Option<usize> {
        let mut count = 0_usize;
        loop {
            match self.peek() {
                None => return Some(count),
                Some(Word::End) => {
                    self.next = None;
                    return Some(count);
                }
                Some(Word::Quoted(_)) => return None,
                Some(Word::Plain(word)) => {
                    let (_, times) = repeated(word)?;
                    count = count.saturating_add(times);
                    self.next = None;
                }
            }
        }
    }

    /// The first words of a keyword, which is read to its end.
    fn texts(&mut self) -> Vec<&'a str> {
        let mut texts = Vec::new();
        while let Some(Word::Plain(word) | Word::Quoted(word)) = self.next() {
            if texts.len() < UNIT_WORDS {
                texts.push(word);
            }
        }
        texts
    }

    /// The values of `keyword`, of which there are `expected`.
    fn exactly(
        &mut self,
        keyword: &str,
        expected: usize,
        budget: &mut ReadBudget,
    ) -> Result<Vec<f32>, String> {
        budget.take(expected as u64 * 4, || {
            format!("its {expected} values of {keyword}")
        })?;
        let mut values = Vec::new();
        let room = values.try_reserve_exact(expected);
        room.map_err(|error| format!("{keyword}: {error}"))?;
        self.values(keyword, |value, times| {
            if times > expected - values.len() {
                return Err(format!("{keyword} has more than its {expected} values"));
            }
            values.resize(values.len() + times, value as f32);
            Ok(())
        })?;
        match values.len() == expected {
            true => Ok(values),
            false => Err(format!(
                "{keyword} has {} values, and should have {expected}",
                values.len()
            )),
        }
    }

    /// The first `N` values of `keyword`.
    fn first<const N: usize>(&mut self, keyword: &str) -> Result<[f64; N], String> {
        let mut values = [0.0; N];
        for value in &mut values {
            let Some(Word::Plain(word)) = self.next() else {
                return Err(format!("{keyword} has fewer than {N} values"));
            };
            let number = parse_number(word);
            *value = number.ok_or_else(|| format!("{keyword}: `{}` is no number", name(word)))?;
        }
        Ok(values)
    }

    /// The counts of cells along the axes.
    fn size(&mut self, keyword: &str) -> Result<[u32; 3], String> {
        let sides = self.first::<3>(keyword)?;
        let is_side = |side: &f64| side.fract() == 0.0 && (1.0..=1e9).contains(side);
        if !sides.iter().all(is_side) {
            return Err(format!("{keyword}: {sides:?} are no counts of cells"));
        }
        // What may follow: the number of reservoirs, the kind of coordinates.
        while !matches!(self.next(), None | Some(Word::End)) {}
        Ok(sides.map(|side| side as u32))
    }
}

pub(super) fn grid(bytes: &[u8], budget: &mut ReadBudget) -> Result<Parts, String> {
    let text = decode(bytes);
    let mut words = Words::new(&text);
    let mut parts = Parts::default();
    while let Some(keyword) = words.keyword() {
        let upper = keyword.to_ascii_uppercase();
        match upper.as_str() {
            "SPECGRID" | "DIMENS" => {
                let size = words.size(&upper)?;
                // Every value takes at least a letter, but for repeated ones.
                cells(size)?;
                budget.nodes(size)?;
                parts.size = Some(size);
            }
            "COORD" => parts.coord = words.exactly(&upper, coordinates(known(&parts)?), budget)?,
            "ZCORN" => {
                let corners = cells(known(&parts)?)? * CORNERS;
                parts.zcorn = words.exactly(&upper, corners, budget)?;
            }
            "ACTNUM" => {
                let values = words.exactly(&upper, cells(known(&parts)?)?, budget)?;
                parts.active = Some(values.into_iter().map(|value| value != 0.0).collect());
            }
            "MAPAXES" => {
                parts.map_axes = Some(words.first(&upper)?);
                words.skip();
            }
            "MAPUNITS" => parts.take_map_unit(words.texts()),
            "GRIDUNIT" => parts.take_grid_unit(words.texts()),
            "INCLUDE" => {
                if let Some(Word::Quoted(file) | Word::Plain(file)) = words.next() {
                    parts.note(format!(
                        "it includes '{}', which is not read: put both into one file",
                        name(file)
                    ));
                }
                words.skip();
            }
            "GDORIENT" => while !matches!(words.next(), None | Some(Word::End)) {},
            _ => words.skip(),
        }
    }
    Ok(parts)
}

fn known(parts: &Parts) -> Result<[u32; 3], String> {
    let size = parts
        .size
        .ok_or("no SPECGRID or DIMENS precedes its values");
    size.map_err(str::to_owned)
}

/// A property's name and its values.
pub(super) fn property(
    bytes: &[u8],
    wanted: Option<&str>,
    cells: usize,
    budget: &mut ReadBudget,
) -> Result<(String, Vec<f32>), String> {
    let text = decode(bytes);
    let mut words = Words::new(&text);
    let mut listed: Vec<String> = Vec::new();
    // Those with a value for each cell are found by counting, so that no more than the wanted one is kept.
    while let Some(keyword) = words.keyword() {
        if wanted.is_some_and(|wanted| wanted.eq_ignore_ascii_case(keyword)) {
            return Ok((keyword.to_owned(), words.exactly(keyword, cells, budget)?));
        }
        let is_grid = ["SPECGRID", "DIMENS", "COORD", "ZCORN", "MAPAXES", "ACTNUM"]
            .iter()
            .any(|of_grid| of_grid.eq_ignore_ascii_case(keyword));
        match words.count() {
            Some(count) if count == cells && !is_grid && listed.len() < LISTED => {
                listed.push(keyword.to_owned());
            }
            Some(_) => {}
            // Words among its values, as of PINCH or COORDSYS: no property.
            None => words.skip(),
        }
    }
    match (wanted, listed.as_slice()) {
        (None, [only]) => {
            let only = only.clone();
            property(bytes, Some(&only), cells, budget)
        }
        _ => Err(no_property(wanted, &listed)),
    }
}

/// A value, and how often it stands there.
fn repeated(word: &str) -> Option<(f64, usize)> {
    let (times, value) = match word.split_once('*') {
        Some((times, value)) => (times.parse().ok()?, value),
        None => (1, word),
    };
    Some((parse_number(value)?, times))
}
