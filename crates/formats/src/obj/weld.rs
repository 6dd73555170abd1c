//! Vertices of a part: corners that agree in position, texture coordinates and normal are one. Where a corner has no normal of its own, they
//! also agree in the smoothing group; a face in no group has corners of its own, which make it flat.

use super::source::{Corner, Element, Elements, Source};
use std::collections::HashMap;

/// Where a part's normals come from.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shading {
    /// There are none, and none are needed: lines, points, and faces that are all flat, which the renderer shades by their planes.
    Plain,
    /// From the file, for some corners at least. The others get that of their smoothing group or their face.
    Given,
    /// From the triangles of smoothing groups, and of faces that are in none.
    Smooth,
}

impl Shading {
    /// That of a part's faces.
    pub(super) fn of(faces: &Elements, source: &Source) -> Self {
        let mut corners = faces.corners.iter();
        if corners.any(|corner| source.normal(corner).is_some()) {
            return Self::Given;
        }
        match faces.each().any(|face| face.group > 0) {
            true => Self::Smooth,
            false => Self::Plain,
        }
    }
}

/// Vertices and indices that are being collected.
pub(super) struct VertexList<'a> {
    source: &'a Source,
    pub(super) shading: Shading,
    known: HashMap<(Corner, Weld), u32>,
    /// A corner for each vertex.
    pub(super) corners: Vec<Corner>,
    pub(super) indices: Vec<u32>,
}

/// What a corner without a normal of its own is welded with.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Weld {
    /// Any that is equal.
    Any,
    /// Those of this smoothing group.
    Group(u32),
    /// Those of the face of this line.
    Face(u32),
}

impl<'a> VertexList<'a> {
    pub(super) fn new(source: &'a Source, shading: Shading) -> Self {
        Self {
            source,
            shading,
            known: HashMap::new(),
            corners: Vec::new(),
            indices: Vec::new(),
        }
    }

    /// Adds a corner of an element.
    pub(super) fn push(&mut self, corner: Corner, element: Element<'_>) {
        let next = self.corners.len() as u32;
        let weld = match element.group {
            _ if self.shading == Shading::Plain => Weld::Any,
            _ if self.source.normal(&corner).is_some() => Weld::Any,
            0 => Weld::Face(element.line as u32),
            group => Weld::Group(group),
        };
        let index = *self.known.entry((corner, weld)).or_insert(next);
        if index == next {
            self.corners.push(corner);
        }
        self.indices.push(index);
    }
}
