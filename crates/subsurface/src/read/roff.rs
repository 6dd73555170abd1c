//! ROFF, the format of Roxar's reservoir grids: tags of typed keys, in binary or in ASCII.
//!
//! A value is kept as the file's bytes (in ASCII, as its words). Declared lengths are thus checked against the file
//! before memory is allocated.

use antumbra_formats::raster::text::{decode, parse_number};

use super::byte_reader::ByteReader;

/// The greatest number of keys in all tags. Real files have a few dozen.
const MAX_KEYS: usize = 1 << 16;

/// A file's tags, in its order.
pub(super) struct Roff<'a> {
    tags: Vec<Tag<'a>>,
}

struct Tag<'a> {
    name: String,
    keys: Vec<(String, Value<'a>)>,
}

/// The values of a key, one or many.
pub(super) enum Value<'a> {
    Binary {
        kind: Kind,
        is_big: bool,
        bytes: &'a [u8],
    },
    Ascii {
        kind: Kind,
        values: Vec<f32>,
    },
    Text(String),
    /// Several texts, such as names of codes. They are not used.
    Texts,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Byte,
    Bool,
    Int,
    Float,
    Double,
    Char,
}

impl Kind {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "byte" => Self::Byte,
            "bool" => Self::Bool,
            "int" => Self::Int,
            "float" => Self::Float,
            "double" => Self::Double,
            "char" => Self::Char,
            _ => return None,
        })
    }

    fn width(self) -> usize {
        match self {
            Self::Byte | Self::Bool | Self::Char => 1,
            Self::Int | Self::Float => 4,
            Self::Double => 8,
        }
    }
}

impl Value<'_> {
    /// The number of values.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Binary { kind, bytes, .. } => bytes.len() / kind.width(),
            Self::Ascii { values, .. } => values.len(),
            Self::Text(_) | Self::Texts => 0,
        }
    }

    /// All values as numbers. The format's grids are written in f32, which is exact for codes.
    pub(super) fn numbers(&self) -> Vec<f32> {
        let Self::Binary {
            kind,
            is_big,
            bytes,
        } = self
        else {
            return match self {
                Self::Ascii { values, .. } => values.clone(),
                _ => Vec::new(),
            };
        };
        let words = bytes.as_chunks::<4>().0.iter().map(|&word| match is_big {
            true => u32::from_be_bytes(word),
            false => u32::from_le_bytes(word),
        });
        let doubles = bytes.as_chunks::<8>().0.iter().map(|&word| match is_big {
            true => f64::from_be_bytes(word),
            false => f64::from_le_bytes(word),
        });
        match kind {
            Kind::Byte | Kind::Bool | Kind::Char => bytes.iter().map(|&b| f32::from(b)).collect(),
            Kind::Int => words.map(|word| word.cast_signed() as f32).collect(),
            Kind::Float => words.map(f32::from_bits).collect(),
            Kind::Double => doubles.map(|value| value as f32).collect(),
        }
    }

    pub(super) fn is_of_bytes(&self) -> bool {
        matches!(self, Self::Binary { kind, .. } | Self::Ascii { kind, .. } if *kind == Kind::Byte)
    }
}

impl<'a> Roff<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, String> {
        if bytes.starts_with(b"roff-bin\0") {
            return binary(bytes);
        }
        if bytes.trim_ascii_start().starts_with(b"roff-asc") {
            return ascii(&decode(bytes));
        }
        Err("it begins neither with `roff-bin` nor with `roff-asc`".into())
    }

    /// The value of a key in the tag of this kind whose key `name` is `name`.
    pub(super) fn named(&self, tag: &str, name: &str, key: &str) -> Option<&Value<'a>> {
        let value = |tag: &'_ Tag<'a>, key: &str| tag.keys.iter().position(|(of, _)| of == key);
        let mut tags = self.tags.iter().filter(|found| found.name == tag);
        let tag = tags.find(|tag| {
            let at = value(tag, "name").and_then(|at| tag.keys.get(at));
            matches!(at, Some((_, Value::Text(text))) if text.eq_ignore_ascii_case(name))
        })?;
        tag.keys.get(value(tag, key)?).map(|(_, value)| value)
    }

    /// The texts of a key in all tags of this name.
    pub(super) fn texts(&self, tag: &str, key: &str) -> Vec<&str> {
        let tags = self.tags.iter().filter(|found| found.name == tag);
        let keys = tags
            .flat_map(|tag| &tag.keys)
            .filter(|(name, _)| name == key);
        let texts = keys.filter_map(|(_, value)| match value {
            Value::Text(text) => Some(text.as_str()),
            _ => None,
        });
        texts.collect()
    }

    /// The value of a key in the first tag of this name that has the key.
    pub(super) fn find(&self, tag: &str, key: &str) -> Option<&Value<'a>> {
        let tags = self.tags.iter().filter(|found| found.name == tag);
        let mut keys = tags.flat_map(|tag| &tag.keys);
        keys.find(|(name, _)| name == key).map(|(_, value)| value)
    }

    pub(super) fn get(&self, tag: &str, key: &str) -> Result<&Value<'a>, String> {
        let found = self.find(tag, key);
        found.ok_or_else(|| format!("tag `{tag}` with key `{key}` is missing"))
    }

    /// A single number; `None` if there is none.
    pub(super) fn number(&self, tag: &str, key: &str) -> Option<f64> {
        let value = self.find(tag, key)?.numbers();
        value.first().map(|&value| f64::from(value))
    }

    pub(super) fn text(&self, tag: &str, key: &str) -> Option<String> {
        match self.find(tag, key)? {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    fn key(&mut self, name: String, value: Value<'a>, count: usize) -> Result<(), String> {
        if count >= MAX_KEYS {
            return Err(format!("it has more than {MAX_KEYS} keys"));
        }
        if let Some(tag) = self.tags.last_mut() {
            tag.keys.push((name, value));
        }
        Ok(())
    }

    fn tag(&mut self, name: String) -> Result<(), String> {
        if self.tags.len() >= MAX_KEYS {
            return Err(format!("it has more than {MAX_KEYS} tags"));
        }
        let keys = Vec::new();
        self.tags.push(Tag { name, keys });
        Ok(())
    }
}

fn binary(bytes: &[u8]) -> Result<Roff<'_>, String> {
    let mut file = ByteReader::new(bytes);
    let mut roff = Roff { tags: Vec::new() };
    let (mut is_big, mut keys) = (false, 0);
    file.until_zero("the format's name")?;
    loop {
        let at = file.at();
        let word = word(&mut file, "a tag")?;
        if word.starts_with('#') {
            continue;
        }
        if word != "tag" {
            return Err(format!("byte {at}: `{word}` where a tag should begin"));
        }
        let name = self::word(&mut file, "a tag's name")?;
        if name == "eof" {
            return Ok(roff);
        }
        roff.tag(name)?;
        loop {
            let at = file.at();
            let mut kind = self::word(&mut file, "a key")?;
            if kind == "endtag" {
                break;
            }
            let is_array = kind == "array";
            if is_array {
                kind = self::word(&mut file, "an array's type")?;
            }
            let kind = Kind::of(&kind)
                .ok_or_else(|| format!("byte {at}: `{kind}` where a key or `endtag` should be"))?;
            let name = self::word(&mut file, "a key's name")?;
            let count = if is_array {
                let count = file.take(4, "an array's length")?;
                let read = if is_big {
                    i32::from_be_bytes
                } else {
                    i32::from_le_bytes
                };
                let count = read(count.try_into().unwrap_or_default());
                usize::try_from(count)
                    .map_err(|_| format!("byte {at}: `{name}` has a length of {count}"))?
            } else {
                1
            };
            let value = if kind == Kind::Char {
                let mut last = "";
                for _ in 0..count {
                    let held = file.until_zero(&name)?;
                    last = std::str::from_utf8(held).unwrap_or_default();
                }
                match is_array {
                    true => Value::Texts,
                    false => Value::Text(last.into()),
                }
            } else {
                let length = count.saturating_mul(kind.width());
                let bytes = file.take(length, &format!("`{name}`"))?;
                if name == "byteswaptest" {
                    is_big = match bytes {
                        [1, 0, 0, 0] => false,
                        [0, 0, 0, 1] => true,
                        _ => return Err(format!("byte {at}: byteswaptest is not 1")),
                    };
                }
                Value::Binary {
                    kind,
                    is_big,
                    bytes,
                }
            };
            roff.key(name, value, keys)?;
            keys += 1;
        }
    }
}

fn word(file: &mut ByteReader<'_>, what: &str) -> Result<String, String> {
    let word = file.until_zero(what)?;
    // Names are short. In a damaged file the rest of the file may be one name.
    let short = word.get(..256).unwrap_or(word);
    Ok(String::from_utf8_lossy(short).into_owned())
}

fn ascii(text: &str) -> Result<Roff<'static>, String> {
    let mut words = AsciiWords { rest: text };
    let mut roff = Roff { tags: Vec::new() };
    let mut keys = 0;
    words.next("the format's name")?;
    loop {
        let word = words.next("a tag")?;
        if word != "tag" {
            return Err(format!("`{word}` where a tag should begin"));
        }
        let tag = words.next("a tag's name")?;
        if tag == "eof" {
            return Ok(roff);
        }
        roff.tag(tag.into())?;
        loop {
            let mut kind = words.next("a key")?;
            if kind == "endtag" {
                break;
            }
            let is_array = kind == "array";
            if is_array {
                kind = words.next("an array's type")?;
            }
            let kind = Kind::of(kind)
                .ok_or_else(|| format!("tag {tag}: `{kind}` where a key or `endtag` should be"))?;
            let name = words.next("a key's name")?;
            let mut count = 1;
            if is_array {
                let word = words.next("an array's length")?;
                count = word
                    .parse()
                    .map_err(|_| format!("tag {tag}: `{name}` has a length of `{word}`"))?;
            }
            let value = if kind == Kind::Char {
                let mut last = "";
                for _ in 0..count {
                    last = words.next(name)?;
                }
                match is_array {
                    true => Value::Texts,
                    false => Value::Text(last.into()),
                }
            } else {
                if count > words.rest.len() {
                    return Err(format!(
                        "tag {tag}: `{name}` has {count} values, but the file only {} bytes more",
                        words.rest.len()
                    ));
                }
                let value = |_| {
                    let word = words.next(name)?;
                    let value = parse_number(word).map(|value| value as f32);
                    value.ok_or_else(|| format!("tag {tag}: `{name}` has `{word}`, no number"))
                };
                let values = (0..count).map(value).collect::<Result<_, String>>()?;
                Value::Ascii { kind, values }
            };
            roff.key(name.into(), value, keys)?;
            keys += 1;
        }
    }
}

/// Words separated by spaces, strings in quotes, comments between two `#`.
struct AsciiWords<'a> {
    rest: &'a str,
}

impl<'a> AsciiWords<'a> {
    fn next(&mut self, what: &str) -> Result<&'a str, String> {
        let short = || format!("the file ends where {what} should be");
        loop {
            self.rest = self.rest.trim_ascii_start();
            let Some(comment) = self.rest.strip_prefix('#') else {
                break;
            };
            self.rest = comment.split_once('#').ok_or_else(short)?.1;
        }
        if let Some(quoted) = self.rest.strip_prefix('"') {
            let (word, rest) = quoted.split_once('"').ok_or_else(short)?;
            self.rest = rest;
            return Ok(word);
        }
        let end = self.rest.find(|c: char| c.is_ascii_whitespace());
        let (word, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest;
        if word.is_empty() {
            return Err(short());
        }
        Ok(word)
    }
}
