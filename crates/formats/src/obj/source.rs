//! An OBJ text as its vertices and the elements that use them, in the file's order. The elements are held in parts: one for each run of
//! elements with the same object, group and material.

use super::lines::{Statement, keyword, statements};
use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::left_out::LostPart;
use glam::DVec3;
use std::collections::HashMap;

/// The vertices and elements of a file.
#[derive(Default)]
pub(super) struct Source {
    pub(super) positions: Vec<DVec3>,
    /// Linear RGB of the first positions; the others are white.
    pub(super) colours: Vec<[f32; 3]>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) parts: Vec<Part>,
    /// The names of materials that parts use.
    pub(super) materials: Vec<String>,
    /// The rest of each line that names material libraries.
    pub(super) libraries: Vec<String>,
}

/// A run of elements.
#[derive(Default)]
pub(super) struct Part {
    pub(super) name: String,
    /// The number of its material in [`Source::materials`].
    pub(super) material: Option<usize>,
    pub(super) faces: Elements,
    pub(super) lines: Elements,
    pub(super) points: Elements,
}

/// Elements of one kind.
#[derive(Default)]
pub(super) struct Elements {
    /// The corners of all, one after another.
    pub(super) corners: Vec<Corner>,
    /// What each is besides.
    pub(super) heads: Vec<Head>,
}

/// An element without its corners.
#[derive(Clone, Copy)]
pub(super) struct Head {
    /// The number of its corners.
    length: u32,
    /// Its smoothing group; 0 if it is in none.
    group: u32,
    /// The number of its line.
    line: u32,
}

/// An element.
#[derive(Clone, Copy)]
pub(super) struct Element<'a> {
    pub(super) corners: &'a [Corner],
    /// Its smoothing group; 0 if it is in none.
    pub(super) group: u32,
    /// The number of its line.
    pub(super) line: usize,
}

/// A corner: the indices of its position, texture coordinates and normal, from 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) uv: Option<u32>,
    pub(super) normal: Option<u32>,
}

/// Bytes of memory of a position with its colour, of another attribute, of a corner, of the rest of an element, and of a part.
const POSITION: u64 = 36;
const ATTRIBUTE: u64 = 12;
const CORNER: u64 = 40;
const HEAD: u64 = 24;
const PART: u64 = 512;

/// The smoothing group of a name that is not a number, such as `on`.
const NAMED_GROUP: u32 = 1;

/// The name of elements before any object or group.
const UNNAMED: &str = "unnamed_object";

impl Elements {
    /// Each element.
    pub(super) fn each(&self) -> impl Iterator<Item = Element<'_>> {
        let mut rest = self.corners.as_slice();
        self.heads.iter().map(move |head| {
            let (corners, after) = rest
                .split_at_checked(head.length as usize)
                .unwrap_or((rest, &[]));
            rest = after;
            Element {
                corners,
                group: head.group,
                line: head.line as usize,
            }
        })
    }
}

impl Source {
    /// A corner's texture coordinates; `None` if it has none that exist.
    pub(super) fn uv(&self, corner: &Corner) -> Option<[f32; 2]> {
        self.uvs.get(corner.uv? as usize).copied()
    }

    /// A corner's normal; `None` if it has none that exists.
    pub(super) fn normal(&self, corner: &Corner) -> Option<[f32; 3]> {
        self.normals.get(corner.normal? as usize).copied()
    }

    /// Reads a text.
    ///
    /// # Errors
    /// A number or a corner that cannot be read, with its line; what exceeds the budget.
    pub(super) fn read(text: &str, budget: &mut Budget) -> Result<Self, LoadProblem> {
        budget.enter("the text");
        let mut reader = Reader {
            source: Self::default(),
            part: Part::new(UNNAMED, None),
            known: HashMap::new(),
            group: 0,
            budget,
        };
        for statement in statements(text) {
            reader.statement(&statement)?;
        }
        reader.end_part();
        Ok(reader.source)
    }
}

impl Part {
    fn new(name: &str, material: Option<usize>) -> Self {
        Self {
            name: name.to_owned(),
            material,
            ..Self::default()
        }
    }

    fn is_empty(&self) -> bool {
        let all = [&self.faces, &self.lines, &self.points];
        all.iter().all(|elements| elements.heads.is_empty())
    }
}

struct Reader<'a> {
    source: Source,
    /// The present part, which is not yet among the source's.
    part: Part,
    /// The numbers of the materials' names.
    known: HashMap<String, usize>,
    /// The present smoothing group; 0 for none.
    group: u32,
    budget: &'a mut Budget,
}

impl Reader<'_> {
    fn statement(&mut self, statement: &Statement<'_>) -> Result<(), LoadProblem> {
        let (word, rest) = keyword(&statement.text);
        let line = statement.line;
        match word {
            "v" => self.position(line, rest),
            "vt" => {
                self.budget.memory(ATTRIBUTE)?;
                let uv = self.attribute(line, rest)?;
                self.source.uvs.push(uv);
                Ok(())
            }
            "vn" => {
                self.budget.memory(ATTRIBUTE)?;
                let normal = self.attribute(line, rest)?;
                self.source.normals.push(normal);
                Ok(())
            }
            "f" | "fo" => {
                let length = self.corners(line, rest, |part| &mut part.faces, 3)?;
                self.budget.triangles(length.saturating_sub(2))
            }
            "l" => {
                let length = self.corners(line, rest, |part| &mut part.lines, 2)?;
                self.budget.triangles(length.saturating_sub(1))
            }
            "p" => {
                let length = self.corners(line, rest, |part| &mut part.points, 1)?;
                self.budget.triangles(length)
            }
            "s" => {
                self.group = match rest {
                    "" | "off" => 0,
                    number => number.parse().unwrap_or(NAMED_GROUP),
                };
                Ok(())
            }
            "o" | "g" => {
                let material = self.part.material;
                let name = if rest.is_empty() { UNNAMED } else { rest };
                self.start_part(name, material)
            }
            "usemtl" if !rest.is_empty() => self.material(rest),
            "mtllib" if !rest.is_empty() => {
                self.budget.memory(rest.len() as u64)?;
                self.source.libraries.push(rest.to_owned());
                Ok(())
            }
            "curv" | "curv2" | "surf" => {
                let example = format!("line {line}");
                let reason = "free-form curves and surfaces are not read";
                let left_out = &mut self.budget.left_out;
                left_out.add(LostPart::Geometry, reason, &example);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn position(&mut self, line: usize, rest: &str) -> Result<(), LoadProblem> {
        self.budget.memory(POSITION)?;
        let mut numbers = [0.0; 7];
        let mut count = 0;
        for (number, word) in numbers.iter_mut().zip(rest.split_whitespace()) {
            *number = word.parse().map_err(|_| {
                let word = shorten(word);
                broken(line, format!("the position has \"{word}\" for a number"))
            })?;
            count += 1;
        }
        if count < 3 {
            let problem = format!("the position has {count} numbers; three are needed");
            return Err(broken(line, problem));
        }
        let [x, y, z, a, b, c, d] = numbers;
        // Six numbers end with a colour; so do seven, after a weight.
        let colour = match count {
            6 => Some([a, b, c]),
            7 => Some([b, c, d]),
            _ => None,
        };
        if let Some(colour) = colour {
            let white = [1.0; 3];
            let before = self.source.positions.len();
            self.source.colours.resize(before, white);
            let finite = |c: f64| if c.is_finite() { c as f32 } else { 1.0 };
            self.source.colours.push(colour.map(finite));
        }
        self.source.positions.push(DVec3::new(x, y, z));
        Ok(())
    }

    /// The numbers of a texture coordinate or a normal; 0 for those that are missing or cannot be read.
    fn attribute<const N: usize>(
        &mut self,
        line: usize,
        rest: &str,
    ) -> Result<[f32; N], LoadProblem> {
        let mut numbers = [0.0; N];
        for (number, word) in numbers.iter_mut().zip(rest.split_whitespace()) {
            match word.parse::<f32>() {
                Ok(read) if read.is_finite() => *number = read,
                _ => {
                    let left_out = &mut self.budget.left_out;
                    left_out.add(
                        LostPart::Attribute,
                        "no finite number",
                        &format!("line {line}"),
                    );
                    return Ok([0.0; N]);
                }
            }
        }
        Ok(numbers)
    }

    /// Adds an element to the present part; the number of its corners, 0 for one with too few.
    fn corners(
        &mut self,
        line: usize,
        rest: &str,
        elements: impl Fn(&mut Part) -> &mut Elements,
        least: u64,
    ) -> Result<u64, LoadProblem> {
        let counts = [
            self.source.positions.len(),
            self.source.uvs.len(),
            self.source.normals.len(),
        ];
        let elements = elements(&mut self.part);
        let start = elements.corners.len();
        for word in rest.split_whitespace() {
            self.budget.memory(CORNER)?;
            elements.corners.push(corner(word, counts).ok_or_else(|| {
                let [positions, uvs, normals] = counts;
                let word = word.chars().take(40).collect::<String>();
                broken(line, format!(
                    "the corner \"{word}\" does not refer to one of the {positions} vertices, {uvs} texture coordinates and {normals} normals before it"
                ))
            })?);
        }
        let length = (elements.corners.len() - start) as u64;
        if length < least {
            elements.corners.truncate(start);
            let reason = "too few corners";
            let left_out = &mut self.budget.left_out;
            left_out.add(LostPart::Face, reason, &format!("line {line}"));
            return Ok(0);
        }
        self.budget.memory(HEAD)?;
        elements.heads.push(Head {
            length: length as u32,
            group: self.group,
            line: line as u32,
        });
        Ok(length)
    }

    fn material(&mut self, name: &str) -> Result<(), LoadProblem> {
        let number = match self.known.get(name) {
            Some(number) => *number,
            None => {
                self.budget.memory(PART + 2 * name.len() as u64)?;
                let next = self.source.materials.len();
                self.source.materials.push(name.to_owned());
                self.known.insert(name.to_owned(), next);
                next
            }
        };
        if self.part.material == Some(number) {
            return Ok(());
        }
        let part = self.part.name.clone();
        self.start_part(&part, Some(number))
    }

    fn start_part(&mut self, name: &str, material: Option<usize>) -> Result<(), LoadProblem> {
        self.budget.memory(PART + name.len() as u64)?;
        self.end_part();
        self.part = Part::new(name, material);
        Ok(())
    }

    fn end_part(&mut self) {
        let part = std::mem::take(&mut self.part);
        if !part.is_empty() {
            self.source.parts.push(part);
        }
    }
}

/// A corner "v/vt/vn". Negative numbers count back from the last element before it. Whether a positive position exists is checked when all are
/// known.
fn corner(word: &str, counts: [usize; 3]) -> Option<Corner> {
    let mut numbers = [None; 3];
    let mut words = word.split('/');
    for ((number, count), word) in numbers.iter_mut().zip(counts).zip(&mut words) {
        if word.is_empty() {
            continue;
        }
        let read: i64 = word.parse().ok()?;
        let index = match read {
            1.. => read - 1,
            ..0 => (count as i64)
                .checked_add(read)
                .filter(|index| *index >= 0)?,
            0 => return None,
        };
        *number = Some(u32::try_from(index).ok()?);
    }
    let [position, uv, normal] = numbers;
    if words.next().is_some() {
        return None;
    }
    Some(Corner {
        position: position?,
        uv,
        normal,
    })
}

pub(super) fn broken(line: usize, problem: String) -> LoadProblem {
    LoadProblem::Syntax {
        format: "OBJ",
        place: format!("line {line}"),
        problem,
    }
}
