//! The geometries of a part: its polygons cut into triangles, its lines, its points. Corners that agree in everything are one vertex.

use super::source::{Corner, Elements, Part, Source};
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use crate::local_origin::{LocalPositions, localise};
use crate::polygon::{MAX_CORNERS, Triangulator};
use antumbra_scene::{Geometry, Topology};
use glam::{DAffine3, DVec3};
use std::collections::HashMap;

/// A geometry and the transform to the file's coordinates.
pub(super) struct Placed {
    pub(super) geometry: Geometry,
    pub(super) transform: DAffine3,
}

/// The geometries of a part, each with vertices of its own.
pub(super) struct MeshBuilder<'a> {
    pub(super) source: &'a Source,
    pub(super) triangulator: Triangulator,
}

/// Corners with at most this many in a polygon are cut in no time that counts.
const FEW_CORNERS: usize = 64;

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
        let mut list = CornerList {
            source: self.source,
            known: HashMap::new(),
            corners: Vec::new(),
            indices: Vec::new(),
        };
        for element in elements.each() {
            if !self.is_placed(element)? {
                let (part, reason) = match topology {
                    Topology::Points => (LostPart::Point, "not finite"),
                    _ => (LostPart::Face, "a corner is not finite"),
                };
                budget.left_out.add(part, reason, &list.named(element));
                continue;
            }
            match topology {
                Topology::Triangles => self.polygon(element, &mut list, budget)?,
                Topology::Lines => {
                    for line in element.windows(2) {
                        line.iter().for_each(|corner| list.push(*corner));
                    }
                }
                Topology::Points => element.iter().for_each(|corner| list.push(*corner)),
            }
        }
        if list.indices.is_empty() {
            return Ok(None);
        }
        budget.vertices(list.corners.len() as u64)?;
        let smooth = part.is_smooth && topology == Topology::Triangles;
        Ok(Some(list.into_placed(topology, elements, smooth, budget)))
    }

    /// Whether all corners have finite positions.
    fn is_placed(&self, element: &[Corner]) -> Result<bool, LoadProblem> {
        let mut is_placed = true;
        for corner in element {
            let position = self.source.positions.get(corner.position as usize);
            let position = position.ok_or_else(|| LoadProblem::Syntax {
                format: "OBJ",
                place: "a face".into(),
                problem: format!(
                    "its corner {} is out of bounds: there are {} vertices",
                    u64::from(corner.position) + 1,
                    self.source.positions.len()
                ),
            })?;
            // What f32 cannot hold is as far away as infinity.
            is_placed &= position.as_vec3().is_finite();
        }
        Ok(is_placed)
    }

    fn polygon(
        &mut self,
        element: &[Corner],
        list: &mut CornerList<'_>,
        budget: &mut Budget,
    ) -> Result<(), LoadProblem> {
        if element.len() > MAX_CORNERS {
            let reason = "too many corners";
            let left_out = &mut budget.left_out;
            left_out.add(LostPart::Face, reason, &list.named(element));
            return Ok(());
        }
        if element.len() > FEW_CORNERS {
            let corners = element.len() as u64;
            budget.work(corners * corners / FEW_CORNERS as u64)?;
        }
        let source = self.source;
        let position = |corner: &Corner| source.positions.get(corner.position as usize);
        let corners = element.iter().filter_map(position).copied();
        for triangle in self.triangulator.polygon(corners) {
            for corner in triangle {
                if let Some(corner) = element.get(*corner as usize) {
                    list.push(*corner);
                }
            }
        }
        Ok(())
    }
}

/// Corners and indices that are being collected.
struct CornerList<'a> {
    source: &'a Source,
    known: HashMap<Corner, u32>,
    corners: Vec<Corner>,
    indices: Vec<u32>,
}

impl CornerList<'_> {
    fn push(&mut self, corner: Corner) {
        let next = self.corners.len() as u32;
        let index = *self.known.entry(corner).or_insert(next);
        if index == next {
            self.corners.push(corner);
        }
        self.indices.push(index);
    }

    /// The element's name in messages.
    fn named(&self, element: &[Corner]) -> String {
        let first = element.first().map_or(0, |corner| corner.position);
        format!("the one from vertex {}", u64::from(first) + 1)
    }

    fn into_placed(
        self,
        topology: Topology,
        elements: &Elements,
        smooth: bool,
        budget: &mut Budget,
    ) -> Placed {
        let source = self.source;
        let corners = self.corners.iter();
        let position = |corner: &Corner| -> DVec3 {
            let position = source.positions.get(corner.position as usize);
            position.copied().unwrap_or_default()
        };
        let local = localise(corners.clone().map(position));
        let transform = local.transform();
        let LocalPositions { positions, .. } = local;
        let byte = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        let has_colours = !source.colours.is_empty();
        let colour = |corner: &Corner| {
            let colour = source.colours.get(corner.position as usize);
            let [r, g, b] = colour.copied().unwrap_or([1.0; 3]);
            [byte(r), byte(g), byte(b), 255]
        };
        let mut attribute = |indices: &dyn Fn(&Corner) -> Option<u32>, count: usize| {
            let all = elements.corners.iter();
            let wrong = all.filter(|corner| indices(corner).is_some_and(|i| i as usize >= count));
            let wrong = wrong.count() as u64;
            budget.left_out.add_many(
                LostPart::Attribute,
                "it does not exist",
                wrong,
                "a face's corner",
            );
            (self.corners.iter())
                .all(|corner| indices(corner).is_some_and(|index| (index as usize) < count))
        };
        let has_uvs = attribute(&|corner| corner.uv, source.uvs.len());
        let has_normals = attribute(&|corner| corner.normal, source.normals.len());
        let uv = |corner: &Corner| {
            let uv = corner.uv.and_then(|uv| source.uvs.get(uv as usize));
            // OBJ counts v from the bottom.
            uv.map_or([0.0; 2], |[u, v]| [*u, 1.0 - v])
        };
        let normal = |corner: &Corner| {
            let normal = corner
                .normal
                .and_then(|normal| source.normals.get(normal as usize));
            normal.copied().unwrap_or_default()
        };
        let geometry = Geometry {
            topology,
            positions,
            uvs: if has_uvs {
                corners.clone().map(uv).collect()
            } else {
                Vec::new()
            },
            normals: if has_normals {
                corners.clone().map(normal).collect()
            } else {
                Vec::new()
            },
            colours: if has_colours {
                corners.map(colour).collect()
            } else {
                Vec::new()
            },
            indices: self.indices,
        };
        Placed {
            geometry: match smooth {
                true => geometry.with_computed_normals(),
                false => geometry,
            },
            transform,
        }
    }
}
