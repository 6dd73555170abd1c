//! The binary form of grids and results: keywords with typed values in Fortran records, each between two copies of its length. Numbers are
//! big-endian, or little-endian throughout. The values of a keyword are in blocks of a record each.

use super::super::budget::ReadBudget;
use super::super::byte_reader::ByteReader;
use super::{CORNERS, Parts, UNIT_WORDS, cells, coordinates, no_property};

/// The most properties that are listed.
const LISTED: usize = 64;

/// What the record of a keyword takes: a name, a count and a type.
const KEYWORD: usize = 16;

/// Bytes of a record's place in memory, with the room that a list of them keeps free.
const BLOCK: u64 = 32;

/// The keywords of a file.
struct Keywords<'a> {
    file: ByteReader<'a>,
    is_big: bool,
}

/// A keyword with its values.
struct Keyword<'a> {
    name: String,
    kind: Kind,
    count: usize,
    /// The values of each record.
    blocks: Vec<&'a [u8]>,
    is_big: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Int,
    Real,
    Double,
    Logical,
    /// Texts of so many letters.
    Text(usize),
    Nothing,
}

impl Kind {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "INTE" => Self::Int,
            "REAL" => Self::Real,
            "DOUB" => Self::Double,
            "LOGI" => Self::Logical,
            "CHAR" => Self::Text(8),
            "MESS" => Self::Nothing,
            word => Self::Text(word.strip_prefix('C')?.parse().ok()?),
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::Int | Self::Real | Self::Logical => 4,
            Self::Double => 8,
            Self::Text(letters) => letters,
            Self::Nothing => 0,
        }
    }
}

impl<'a> Keywords<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self, String> {
        let is_big = match bytes.first_chunk::<4>() {
            Some([0, 0, 0, 16]) => true,
            Some([16, 0, 0, 0]) => false,
            _ => return Err("it does not begin with a record of 16 bytes".into()),
        };
        Ok(Self {
            file: ByteReader::new(bytes),
            is_big,
        })
    }

    fn i32(&mut self, what: &str) -> Result<i32, String> {
        let bytes = self.file.take(4, what)?.try_into().unwrap_or_default();
        Ok(match self.is_big {
            true => i32::from_be_bytes(bytes),
            false => i32::from_le_bytes(bytes),
        })
    }

    /// The bytes of a record.
    fn record(&mut self, what: &str) -> Result<&'a [u8], String> {
        let at = self.file.at();
        let length = self.i32(what)?;
        let bytes = self
            .file
            .take(usize::try_from(length).unwrap_or(usize::MAX), what)?;
        let after = self.i32(what)?;
        match after == length {
            true => Ok(bytes),
            false => Err(format!(
                "{what} at byte {at} is {length} bytes long before its end and {after} after it"
            )),
        }
    }

    /// The next keyword; `None` at the end. What is kept of its records is paid for, since they may be as short as a value.
    fn next(&mut self, budget: &mut ReadBudget) -> Result<Option<Keyword<'a>>, String> {
        if self.file.is_at_end() {
            return Ok(None);
        }
        let at = self.file.at();
        let record = self.record("a keyword")?;
        let (Some((name, rest)), KEYWORD) = (record.split_first_chunk::<8>(), record.len()) else {
            return Err(format!(
                "the keyword at byte {at} is {} bytes long, and should be {KEYWORD}",
                record.len()
            ));
        };
        let (count, kind) = rest.split_first_chunk::<4>().unwrap_or((&[0; 4], &[]));
        let count = match self.is_big {
            true => i32::from_be_bytes(*count),
            false => i32::from_le_bytes(*count),
        };
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
        let name = text(name);
        let kind = Kind::of(&text(kind)).ok_or_else(|| {
            format!(
                "the keyword at byte {at} has values of type `{}`",
                text(kind)
            )
        })?;
        let count = usize::try_from(count)
            .map_err(|_| format!("the keyword at byte {at} has {count} values"))?;
        // A text without letters has no records either.
        let total = count.saturating_mul(kind.bytes());
        let mut blocks = Vec::new();
        let mut held = 0;
        while held < total {
            let block = self.record(&name)?;
            // No value lies in two records.
            let is_whole = block.len().is_multiple_of(kind.bytes());
            if block.is_empty() || !is_whole || block.len() > total - held {
                return Err(format!(
                    "{name} at byte {at} has {count} values, which its records do not fit"
                ));
            }
            held += block.len();
            budget.take(BLOCK, || format!("the records of {name}"))?;
            blocks.push(block);
        }
        Ok(Some(Keyword {
            name,
            kind,
            count,
            blocks,
            is_big: self.is_big,
        }))
    }
}

impl Keyword<'_> {
    /// Calls `found` with the value of each element.
    fn each<const N: usize>(&self, mut found: impl FnMut([u8; N])) {
        for element in self
            .blocks
            .iter()
            .flat_map(|block| block.as_chunks::<N>().0)
        {
            let mut element = *element;
            if !self.is_big {
                element.reverse();
            }
            found(element);
        }
    }

    /// The values as numbers.
    fn numbers(&self, budget: &mut ReadBudget) -> Result<Vec<f32>, String> {
        budget.take(self.count as u64 * 4, || {
            format!("its {} values of {}", self.count, self.name)
        })?;
        let mut values = Vec::with_capacity(self.count);
        match self.kind {
            Kind::Int => self.each(|bytes| values.push(i32::from_be_bytes(bytes) as f32)),
            Kind::Logical => {
                self.each(|bytes| values.push((u32::from_be_bytes(bytes) != 0).into()))
            }
            Kind::Real => self.each(|bytes| values.push(f32::from_be_bytes(bytes))),
            Kind::Double => self.each(|bytes| values.push(f64::from_be_bytes(bytes) as f32)),
            Kind::Text(_) | Kind::Nothing => {}
        }
        Ok(values)
    }

    fn expect(&self, count: usize) -> Result<(), String> {
        match self.count == count {
            true => Ok(()),
            false => Err(format!(
                "{} has {} values, and should have {count}",
                self.name, self.count
            )),
        }
    }

    /// The texts, which have eight letters each in grids.
    fn texts(&self) -> Vec<String> {
        let letters = self.kind.bytes().max(1);
        let all = self.blocks.iter().flat_map(|block| block.chunks(letters));
        let few = all.take(UNIT_WORDS);
        few.map(|text| String::from_utf8_lossy(text).trim().to_owned())
            .collect()
    }
}

pub(super) fn grid(bytes: &[u8], budget: &mut ReadBudget) -> Result<Parts, String> {
    let mut keywords = Keywords::new(bytes)?;
    let mut parts = Parts::default();
    while let Some(keyword) = keywords.next(budget)? {
        let known = || {
            parts
                .size
                .ok_or("no GRIDHEAD or SPECGRID precedes its values")
        };
        match keyword.name.as_str() {
            "GRIDHEAD" | "SPECGRID" => {
                let values = keyword.numbers(budget)?;
                let (kind, size) = match (keyword.name.as_str(), values.as_slice()) {
                    ("GRIDHEAD", [kind, i, j, k, ..]) => (*kind, [i, j, k]),
                    ("SPECGRID", [i, j, k, ..]) => (1.0, [i, j, k]),
                    _ => return Err(format!("{} is too short", keyword.name)),
                };
                if kind != 1.0 {
                    return Err(format!(
                        "its grid is of type {kind}; corner-point grids are of type 1"
                    ));
                }
                let size = size.map(|side| *side as u32);
                cells(size)?;
                budget.nodes(size)?;
                parts.size = Some(size);
            }
            "COORD" => {
                keyword.expect(coordinates(known()?))?;
                parts.coord = keyword.numbers(budget)?;
            }
            "ZCORN" => {
                keyword.expect(cells(known()?)? * CORNERS)?;
                parts.zcorn = keyword.numbers(budget)?;
            }
            "ACTNUM" => {
                keyword.expect(cells(known()?)?)?;
                let values = keyword.numbers(budget)?;
                parts.active = Some(values.into_iter().map(|value| value != 0.0).collect());
            }
            "MAPAXES" => {
                let values = keyword.numbers(budget)?;
                parts.map_axes = (values.first_chunk::<6>()).map(|axes| axes.map(f64::from));
            }
            "MAPUNITS" => {
                parts.take_map_unit(keyword.texts().iter().map(String::as_str));
            }
            "GRIDUNIT" => {
                parts.take_grid_unit(keyword.texts().iter().map(String::as_str));
            }
            // Refined parts of the grid follow.
            "ENDGRID" | "LGR" => break,
            _ => {}
        }
    }
    Ok(parts)
}

/// A property's name and its values, of which there is one for each active cell or for each cell. In a file of several times the last one counts.
pub(super) fn property(
    bytes: &[u8],
    wanted: Option<&str>,
    counts: [usize; 2],
    budget: &mut ReadBudget,
) -> Result<(String, Vec<f32>), String> {
    let mut keywords = Keywords::new(bytes)?;
    let (mut found, mut listed) = (None, Vec::<String>::new());
    while let Some(keyword) = keywords.next(budget)? {
        let is_number = matches!(keyword.kind, Kind::Int | Kind::Real | Kind::Double);
        let of_grid = ["COORD", "ZCORN", "ACTNUM"].contains(&keyword.name.as_str());
        if !is_number || of_grid || !counts.contains(&keyword.count) {
            continue;
        }
        if !listed.contains(&keyword.name) && listed.len() < LISTED {
            listed.push(keyword.name.clone());
        }
        if wanted.is_none_or(|wanted| wanted.eq_ignore_ascii_case(&keyword.name)) {
            found = Some(keyword);
        }
    }
    match found {
        Some(keyword) if wanted.is_some() || listed.len() == 1 => {
            let values = keyword.numbers(budget)?;
            Ok((keyword.name, values))
        }
        _ => Err(no_property(wanted, &listed)),
    }
}
