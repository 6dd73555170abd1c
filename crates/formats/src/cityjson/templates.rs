//! Geometry templates: geometries that objects place many times, such as a tree. Each becomes one mesh, and each place an entity.

use super::boundary;
use super::document::{Geometry as Source, Templates};
use super::error::syntax_error;
use super::materials;
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use crate::polygon::{MAX_CORNERS, Triangulator};
use antumbra_scene::{Geometry, Mesh, MeshKey, Scene};
use glam::{DAffine3, DMat3, DMat4, DVec3};

/// The templates of a file, by their numbers.
#[derive(Default)]
pub(super) struct TemplateTable(Vec<Template>);

/// A template.
#[derive(Clone, Copy)]
pub(super) struct Template {
    pub(super) lod: f64,
    /// `None` for one without surfaces that can be drawn.
    pub(super) mesh: Option<MeshKey>,
}

impl TemplateTable {
    /// Makes a mesh of each template.
    ///
    /// # Errors
    /// Boundaries that do not follow the type, or vertices that do not exist; what exceeds the budget.
    pub(super) fn read(
        source: &Templates<'_>,
        scene: &mut Scene,
        triangulator: &mut Triangulator,
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let mut templates = Vec::with_capacity(source.templates.len());
        for (number, template) in source.templates.iter().enumerate() {
            let name = format!("template {number}");
            budget.enter(name.as_str());
            budget.mesh(&name)?;
            let geometry = geometry(template, &source.vertices, &name, triangulator, budget)?;
            let mesh = match geometry.indices.is_empty() {
                true => None,
                false => Some(scene.add_mesh(Mesh::new(name, geometry))?),
            };
            templates.push(Template {
                lod: template.lod(),
                mesh,
            });
        }
        Ok(Self(templates))
    }

    /// The template that an instance places.
    pub(super) fn of(&self, instance: &Source<'_>) -> Option<Template> {
        self.0.get(instance.template?).copied()
    }
}

/// From a template's coordinates to those of an instance placed at a point, both east, up, south; `None` for numbers that cannot be.
pub(super) fn placing(instance: &Source<'_>, at: DVec3) -> Option<DAffine3> {
    let numbers: [f64; 16] = match instance.matrix {
        Some(text) => serde_json::from_str(text.get()).ok()?,
        None => DMat4::IDENTITY.to_cols_array(),
    };
    // Row by row, with east, north, up.
    let matrix = DMat4::from_cols_array(&numbers).transpose();
    let placed = DAffine3::from_mat4(matrix);
    // (x, y, z) becomes (x, z, -y).
    let turn = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
    let placing = DAffine3 {
        matrix3: turn * placed.matrix3 * turn.transpose(),
        translation: turn * placed.translation + at,
    };
    let is_finite = placing.is_finite() && placing.matrix3.as_mat3().is_finite();
    is_finite.then_some(placing)
}

fn geometry(
    template: &Source<'_>,
    vertices: &[[f64; 3]],
    name: &str,
    triangulator: &mut Triangulator,
    budget: &mut Budget,
) -> Result<Geometry, LoadProblem> {
    let mut geometry = Geometry::default();
    if boundary::kind(template).is_none() {
        return Ok(geometry);
    }
    let broken = |problem: String| syntax_error(name.to_owned(), problem);
    let tints = materials::tints(template);
    for (surface, semantics) in boundary::surfaces(template).map_err(broken)? {
        let corners = surface.iter().map(Vec::len).sum::<usize>();
        budget.vertices(corners as u64)?;
        if corners > MAX_CORNERS {
            let problem =
                format!("a surface has {corners} corners; at most {MAX_CORNERS} are read");
            return Err(broken(problem));
        }
        triangulator.clear();
        for ring in &surface {
            let point = |vertex: &u32| {
                let vertex = vertices.get(*vertex as usize)?;
                let [x, y, z] = *vertex;
                let point = DVec3::new(x, z, -y);
                point.as_vec3().is_finite().then_some(point)
            };
            let points: Option<Vec<DVec3>> = ring.iter().map(point).collect();
            let points = points.ok_or_else(|| {
                let count = vertices.len();
                broken(format!(
                    "a corner is not one of the {count} finite vertices of templates"
                ))
            })?;
            triangulator.ring(points);
        }
        let triangles = triangulator.finish(&mut geometry, budget)?;
        if triangles == 0 {
            (budget.left_out).add(LostPart::Face, "without an area", name);
        }
        budget.triangles(triangles)?;
        let tint = materials::tint_of(&tints, semantics);
        geometry.colours.resize(geometry.positions.len(), tint);
    }
    if geometry
        .colours
        .iter()
        .all(|tint| *tint == materials::UNTINTED)
    {
        geometry.colours = Vec::new();
    }
    Ok(geometry)
}
