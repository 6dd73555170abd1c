//! The binary chunk: the arrays of the scene that it consists of, and their offsets. Nothing is copied until it is
//! written.

use super::json::{Accessor, BufferView};
use antumbra_scene::Geometry;
use std::io::{self, Write};

/// The alignment of every array in bytes.
const ALIGNMENT: u64 = 4;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

/// The chunk's parts in order, with their buffer views and accessors.
#[derive(Default)]
pub(super) struct Binary<'a> {
    parts: Vec<Part<'a>>,
    length: u64,
    pub(super) views: Vec<BufferView>,
    pub(super) accessors: Vec<Accessor>,
}

enum Part<'a> {
    Numbers(&'a [f32]),
    Indices(&'a [u32], Width),
    Borrowed(&'a [u8]),
    Owned(Vec<u8>),
}

/// The number of bytes per index.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Width {
    One,
    Two,
    Four,
}

impl Width {
    /// The least width for these indices. The greatest number of each width is reserved for strip restarts.
    fn of(indices: &[u32]) -> Self {
        match indices.iter().copied().max().unwrap_or(0) {
            0..0xff => Self::One,
            0xff..0xffff => Self::Two,
            _ => Self::Four,
        }
    }

    fn bytes(self) -> u64 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Four => 4,
        }
    }

    fn component(self) -> u32 {
        match self {
            Self::One => U8,
            Self::Two => U16,
            Self::Four => U32,
        }
    }
}

impl<'a> Binary<'a> {
    /// The number of bytes of the chunk.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// Adds the bytes of a file. Returns their buffer view.
    pub(super) fn file(&mut self, bytes: Vec<u8>) -> u32 {
        self.add(Part::Owned(bytes), None)
    }

    /// Adds borrowed bytes. Returns their buffer view.
    pub(super) fn bytes(&mut self, bytes: &'a [u8]) -> u32 {
        self.add(Part::Borrowed(bytes), None)
    }

    /// Adds positions. Returns their accessor.
    pub(super) fn positions(&mut self, geometry: &'a Geometry) -> u32 {
        let positions = &geometry.positions;
        let fold = |or: f32, pick: fn(f32, f32) -> f32| {
            positions.iter().fold([or; 3], |[x, y, z], [px, py, pz]| {
                [pick(x, *px), pick(y, *py), pick(z, *pz)]
            })
        };
        let [min, max] = [
            fold(f32::INFINITY, f32::min),
            fold(f32::NEG_INFINITY, f32::max),
        ];
        let accessor = self.floats(positions, "VEC3");
        if let Some(accessor) = self.accessors.get_mut(accessor as usize) {
            accessor.min = Some(min);
            accessor.max = Some(max);
        }
        accessor
    }

    /// Adds an attribute of floats. Returns its accessor.
    pub(super) fn floats<const N: usize>(
        &mut self,
        values: &'a [[f32; N]],
        shape: &'static str,
    ) -> u32 {
        let part = Part::Numbers(values.as_flattened());
        self.attribute(part, ARRAY_BUFFER, F32, values.len(), shape)
    }

    /// Adds colours. Returns their accessor.
    pub(super) fn colours(&mut self, colours: &'a [[u8; 4]]) -> u32 {
        let part = Part::Borrowed(colours.as_flattened());
        let accessor = self.attribute(part, ARRAY_BUFFER, U8, colours.len(), "VEC4");
        if let Some(accessor) = self.accessors.get_mut(accessor as usize) {
            accessor.normalized = true;
        }
        accessor
    }

    /// Adds indices with the least width. Returns their accessor.
    pub(super) fn indices(&mut self, indices: &'a [u32]) -> u32 {
        let width = Width::of(indices);
        let part = Part::Indices(indices, width);
        self.attribute(
            part,
            ELEMENT_ARRAY_BUFFER,
            width.component(),
            indices.len(),
            "SCALAR",
        )
    }

    fn attribute(
        &mut self,
        part: Part<'a>,
        target: u32,
        component_type: u32,
        count: usize,
        shape: &'static str,
    ) -> u32 {
        let buffer_view = self.add(part, Some(target));
        self.accessors.push(Accessor {
            buffer_view,
            component_type,
            count: count as u64,
            shape,
            normalized: false,
            min: None,
            max: None,
        });
        self.accessors.len() as u32 - 1
    }

    fn add(&mut self, part: Part<'a>, target: Option<u32>) -> u32 {
        let byte_length = part.length();
        self.views.push(BufferView {
            buffer: 0,
            byte_offset: self.length,
            byte_length,
            target,
        });
        self.length += byte_length.next_multiple_of(ALIGNMENT);
        self.parts.push(part);
        self.views.len() as u32 - 1
    }

    /// Writes the chunk's contents.
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for part in &self.parts {
            part.write(out)?;
            for _ in part.length()..part.length().next_multiple_of(ALIGNMENT) {
                out.write_all(&[0])?;
            }
        }
        Ok(())
    }
}

impl Part<'_> {
    fn length(&self) -> u64 {
        match self {
            Self::Numbers(numbers) => numbers.len() as u64 * 4,
            Self::Indices(indices, width) => indices.len() as u64 * width.bytes(),
            Self::Borrowed(bytes) => bytes.len() as u64,
            Self::Owned(bytes) => bytes.len() as u64,
        }
    }

    /// Writes the part in little-endian order.
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Numbers(numbers) => each(out, numbers, |number| number.to_le_bytes()),
            // No index exceeds its width.
            Self::Indices(indices, Width::One) => each(out, indices, |index| [index as u8]),
            Self::Indices(indices, Width::Two) => {
                each(out, indices, |index| (index as u16).to_le_bytes())
            }
            Self::Indices(indices, Width::Four) => each(out, indices, |index| index.to_le_bytes()),
            Self::Borrowed(bytes) => out.write_all(bytes),
            Self::Owned(bytes) => out.write_all(bytes),
        }
    }
}

fn each<T: Copy, const N: usize>(
    out: &mut impl Write,
    values: &[T],
    bytes: impl Fn(T) -> [u8; N],
) -> io::Result<()> {
    values
        .iter()
        .try_for_each(|value| out.write_all(&bytes(*value)))
}
