//! The geometries of a part: its polygons cut into triangles, its lines, its points. Corners that agree in everything are one vertex.

use super::source::{Corner, Element, Elements, Part, Source, broken};
use super::weld::{Shading, VertexList};
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use crate::local_origin::{LocalPositions, Placed, localise};
use crate::normals;
use crate::polygon::Triangulator;
use antumbra_scene::{Geometry, Topology};
use glam::DVec3;

/// The geometries of a part, each with vertices of its own.
pub(super) struct MeshBuilder<'a> {
    pub(super) source: &'a Source,
    pub(super) triangulator: Triangulator,
}

impl MeshBuilder<'_> {
    /// The part's geometry of this kind; `None` if it has no such elements that can be drawn.
    ///
    /// # Errors
    /// A corner without a position; what exceeds the budget.
    pub(super) fn geometry(
        &mut self,
        part: &Part,
        topology: Topology,
        budget: &mut Budget,
    ) -> Result<Option<Placed>, LoadProblem> {
        let elements = match topology {
            Topology::Triangles => &part.faces,
            Topology::Lines => &part.lines,
            Topology::Points => &part.points,
        };
        let shading = match topology {
            Topology::Triangles => Shading::of(elements, self.source),
            Topology::Lines | Topology::Points => Shading::Plain,
        };
        let mut list = VertexList::new(self.source, shading);
        for element in elements.each() {
            if !self.is_placed(element)? {
                let (part, reason) = match topology {
                    Topology::Points => (LostPart::Point, "not finite"),
                    _ => (LostPart::Face, "a corner is not finite"),
                };
                let place = format!("line {}", element.line);
                budget.left_out.add(part, reason, &place);
                continue;
            }
            match topology {
                Topology::Triangles => self.polygon(element, &mut list, budget)?,
                Topology::Lines => {
                    for line in element.corners.windows(2) {
                        line.iter().for_each(|corner| list.push(*corner, element));
                    }
                }
                Topology::Points => {
                    let corners = element.corners.iter();
                    corners.for_each(|corner| list.push(*corner, element));
                }
            }
        }
        if list.indices.is_empty() {
            return Ok(None);
        }
        budget.vertices(list.corners.len() as u64)?;
        Ok(Some(self.placed(list, topology, elements, budget)))
    }

    /// Whether all corners have finite positions.
    fn is_placed(&self, element: Element<'_>) -> Result<bool, LoadProblem> {
        let mut is_placed = true;
        for corner in element.corners {
            let position = self.source.positions.get(corner.position as usize);
            let position = position.ok_or_else(|| {
                let problem = format!(
                    "its corner {} is out of bounds: there are {} vertices",
                    u64::from(corner.position) + 1,
                    self.source.positions.len()
                );
                broken(element.line, problem)
            })?;
            // What f32 cannot hold is as far away as infinity.
            is_placed &= position.as_vec3().is_finite();
        }
        Ok(is_placed)
    }

    fn polygon(
        &mut self,
        element: Element<'_>,
        list: &mut VertexList<'_>,
        budget: &mut Budget,
    ) -> Result<(), LoadProblem> {
        let source = self.source;
        let position = |corner: &Corner| source.positions.get(corner.position as usize);
        let corners = element.corners.iter().filter_map(position).copied();
        let Some(triangles) = self.triangulator.polygon(corners, budget)? else {
            let place = format!("line {}", element.line);
            (budget.left_out).add(LostPart::Face, "too many corners", &place);
            return Ok(());
        };
        for corner in triangles.as_flattened() {
            if let Some(corner) = element.corners.get(*corner as usize) {
                list.push(*corner, element);
            }
        }
        Ok(())
    }

    fn placed(
        &self,
        list: VertexList<'_>,
        topology: Topology,
        elements: &Elements,
        budget: &mut Budget,
    ) -> Placed {
        let source = self.source;
        let corners = list.corners.iter();
        let position = |corner: &Corner| -> DVec3 {
            let position = source.positions.get(corner.position as usize);
            position.copied().unwrap_or_default()
        };
        let local = localise(corners.clone().map(position));
        let transform = local.transform();
        let LocalPositions { positions, .. } = local;
        let byte = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        let colour = |corner: &Corner| {
            let colour = source.colours.get(corner.position as usize);
            let [r, g, b] = colour.copied().unwrap_or([1.0; 3]);
            [byte(r), byte(g), byte(b), 255]
        };
        note_attributes(source, elements, budget);
        // OBJ counts v from the bottom.
        let uv = |corner: &Corner| source.uv(corner).map_or([0.0; 2], |[u, v]| [u, 1.0 - v]);
        let normal = |corner: &Corner| source.normal(corner).unwrap_or_default();
        let has_uvs = corners.clone().any(|corner| source.uv(corner).is_some());
        let has_normals = (corners.clone()).any(|corner| source.normal(corner).is_some());
        let mut geometry = Geometry {
            topology,
            positions,
            indices: list.indices,
            ..Geometry::default()
        };
        if has_uvs {
            geometry.uvs = corners.clone().map(uv).collect();
        }
        if !source.colours.is_empty() {
            geometry.colours = corners.clone().map(colour).collect();
        }
        if has_normals {
            geometry.normals = corners.map(normal).collect();
            // Corners without a normal get that of their smoothing group, or of their face.
            normals::mend(&mut geometry, "the normals of a part", budget);
        }
        if list.shading == Shading::Smooth {
            geometry = geometry.with_computed_normals();
        }
        Placed {
            geometry,
            transform,
        }
    }
}

/// Notes the corners whose texture coordinates or normals do not exist, and those without texture coordinates where others have them.
fn note_attributes(source: &Source, elements: &Elements, budget: &mut Budget) {
    let beyond = |index: Option<u32>, count: usize| {
        let is_beyond = index.is_some_and(|index| index as usize >= count);
        u64::from(is_beyond)
    };
    let wrong = |corner: &Corner| {
        beyond(corner.uv, source.uvs.len()) + beyond(corner.normal, source.normals.len())
    };
    note(elements, "it does not exist", &wrong, budget);
    if elements.corners.iter().any(|corner| corner.uv.is_some()) {
        let reason = "texture coordinates that other corners of the part have";
        let without = |corner: &Corner| u64::from(corner.uv.is_none());
        note(elements, reason, &without, budget);
    }
}

/// Notes attributes that are left out for a reason, so many of each corner, with the line of the first.
fn note(
    elements: &Elements,
    reason: &str,
    of_corner: &dyn Fn(&Corner) -> u64,
    budget: &mut Budget,
) {
    let of_element = |element: Element<'_>| {
        let count: u64 = element.corners.iter().map(of_corner).sum();
        (element.line, count)
    };
    let mut each = elements.each().map(of_element);
    let Some((line, first)) = each.find(|(_, count)| *count > 0) else {
        return;
    };
    let count = first + each.map(|(_, count)| count).sum::<u64>();
    let place = format!("line {line}");
    (budget.left_out).add_many(LostPart::Attribute, reason, count, &place);
}
