//! The mesh of a PLY's elements: polygons and strips cut into triangles, or points where there are neither.

use super::elements::{Face, Strips, Vertex};
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use crate::local_origin::{Placed, localise};
use crate::normals;
use crate::polygon::Triangulator;
use antumbra_scene::{Geometry, Topology};
use ply_rs_bw::ply::ElementDef;

/// The elements of a file.
#[derive(Default)]
pub(super) struct Elements {
    pub(super) vertices: Vec<Vertex>,
    /// Which attributes vertices have.
    pub(super) attributes: Attributes,
    pub(super) faces: Vec<Face>,
    pub(super) strips: Vec<Strips>,
}

/// Which attributes vertices have, besides their positions.
#[derive(Clone, Copy, Default)]
pub(super) struct Attributes {
    normals: bool,
    uvs: bool,
    colours: bool,
    alpha: bool,
}

impl Attributes {
    /// Those that the header declares.
    pub(super) fn of(element: &ElementDef) -> Self {
        let has = |names: &[&str]| {
            names
                .iter()
                .any(|name| element.properties.contains_key(*name))
        };
        Self {
            normals: has(&["nx"]),
            uvs: has(&["u", "s", "texture_u"]),
            colours: has(&["red", "r", "diffuse_red"]),
            alpha: has(&["alpha", "a"]),
        }
    }
}

impl Elements {
    /// The geometry.
    ///
    /// # Errors
    /// A corner without a vertex; what exceeds the budget.
    pub(super) fn into_placed(self, budget: &mut Budget) -> Result<Placed, LoadProblem> {
        let is_mesh = !self.faces.is_empty() || !self.strips.is_empty();
        let mut indices = Vec::new();
        let mut triangulator = Triangulator::new();
        let most = self
            .faces
            .iter()
            .map(|face| face.corners.len().saturating_sub(2));
        // A triangle for each face has been paid for.
        let most = most.sum::<usize>();
        budget.triangles(most.saturating_sub(self.faces.len()) as u64)?;
        for (number, face) in self.faces.iter().enumerate() {
            let place = || format!("face {number}");
            self.polygon(
                &face.corners,
                &place,
                &mut triangulator,
                budget,
                &mut indices,
            )?;
        }
        for (number, strips) in self.strips.iter().enumerate() {
            budget.triangles(strips.corners.len() as u64)?;
            for strip in strips.corners.split(|corner| *corner < 0) {
                for (i, corners) in strip.windows(3).enumerate() {
                    let corner =
                        |i: usize| corners.get(i).map_or(u32::MAX, |corner| *corner as u32);
                    // Every other triangle of a strip has the opposite winding.
                    let triangle = [corner(0), corner(1 + i % 2), corner(2 - i % 2)];
                    let place = || format!("strip {number}");
                    self.polygon(&triangle, &place, &mut triangulator, budget, &mut indices)?;
                }
            }
        }
        if !is_mesh {
            let points = self.vertices.iter().enumerate();
            let finite = |vertex: &Vertex| vertex.position.as_vec3().is_finite();
            let points = points.filter(|(_, vertex)| finite(vertex));
            indices.extend(points.map(|(number, _)| number as u32));
        }
        Ok(self.placed(indices, is_mesh, budget))
    }

    fn polygon(
        &self,
        corners: &[u32],
        place: &dyn Fn() -> String,
        triangulator: &mut Triangulator,
        budget: &mut Budget,
        indices: &mut Vec<u32>,
    ) -> Result<(), LoadProblem> {
        let mut is_finite = true;
        for corner in corners {
            let vertex = self.vertices.get(*corner as usize);
            let vertex = vertex.ok_or_else(|| LoadProblem::MissingReference {
                place: place(),
                what: "vertex",
                index: u64::from(*corner),
                count: self.vertices.len(),
            })?;
            is_finite &= vertex.position.as_vec3().is_finite();
        }
        let reason = match corners.len() {
            _ if !is_finite => "a corner is not finite",
            0..3 => "too few corners",
            _ => "",
        };
        if !reason.is_empty() {
            budget.left_out.add(LostPart::Face, reason, &place());
            return Ok(());
        }
        if let [a, b, c] = *corners {
            indices.extend([a, b, c]);
            return Ok(());
        }
        let positions = corners.iter().filter_map(|corner| {
            let vertex = self.vertices.get(*corner as usize)?;
            Some(vertex.position)
        });
        let Some(triangles) = triangulator.polygon(positions, budget)? else {
            let reason = "too many corners";
            budget.left_out.add(LostPart::Face, reason, &place());
            return Ok(());
        };
        for triangle in triangles {
            let corner = |corner: &u32| corners.get(*corner as usize).copied();
            indices.extend(triangle.iter().filter_map(corner));
        }
        Ok(())
    }

    fn placed(self, mut indices: Vec<u32>, is_mesh: bool, budget: &mut Budget) -> Placed {
        let Self {
            mut vertices,
            attributes,
            ..
        } = self;
        let before = vertices.len();
        let mut moved = Vec::new();
        if vertices
            .iter()
            .any(|vertex| !vertex.position.as_vec3().is_finite())
        {
            let mut next = 0;
            moved.extend(vertices.iter().map(|vertex| {
                let own = next;
                next += u32::from(vertex.position.as_vec3().is_finite());
                own
            }));
            vertices.retain(|vertex| vertex.position.as_vec3().is_finite());
            let of_mesh = |index: &u32| moved.get(*index as usize).copied().unwrap_or_default();
            indices.iter_mut().for_each(|index| *index = of_mesh(index));
            let lost = (before - vertices.len()) as u64;
            let left_out = &mut budget.left_out;
            left_out.add_many(
                LostPart::Point,
                "not finite",
                lost,
                "of the element \"vertex\"",
            );
        }
        let local = localise(vertices.iter().map(|vertex| vertex.position));
        let transform = local.transform();
        let mut geometry = Geometry {
            topology: match is_mesh {
                true => Topology::Triangles,
                false => Topology::Points,
            },
            positions: local.positions,
            indices,
            ..Geometry::default()
        };
        if attributes.normals {
            geometry.normals = vertices.iter().map(|v| v.normal).collect();
            normals::mend(&mut geometry, "the vertices' normals", budget);
        }
        if attributes.uvs {
            let finite = |number: f32| if number.is_finite() { number } else { 0.0 };
            geometry.uvs = vertices.iter().map(|v| v.uv.map(finite)).collect();
        }
        if attributes.colours {
            let colour = |v: &Vertex| {
                let [r, g, b, a] = v.colour;
                [r, g, b, if attributes.alpha { a } else { 255 }]
            };
            geometry.colours = vertices.iter().map(colour).collect();
        }
        Placed {
            geometry,
            transform,
        }
    }
}
