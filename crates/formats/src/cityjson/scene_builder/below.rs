//! What is placed below an object's entity, with entities of its own: instances of templates, lines and points.

use super::super::boundary::{self, GeometryKind, Ring};
use super::super::error::syntax_error;
use super::super::templates;
use super::{DocumentContext, SceneBuilder, Target};
use crate::error::{LoadProblem, shorten};
use crate::left_out::LostPart;
use crate::local_origin::localise;
use antumbra_scene::{Drawable, Geometry, Mesh, MeshKey, Topology};
use glam::{DAffine3, DVec3};

/// An instance of a template that can be drawn.
pub(super) struct Instance {
    pub(super) lod: f64,
    /// The template's number.
    number: usize,
    mesh: MeshKey,
    placing: DAffine3,
}

/// Lines or points of one geometry.
pub(super) struct Lines {
    pub(super) lod: f64,
    topology: Topology,
    /// The vertices of each; a point is a line of one.
    each: Vec<Ring>,
}

impl DocumentContext<'_> {
    /// The lines and points of an object, those that have any.
    ///
    /// # Errors
    /// Lists that are not what their type says, or a vertex that does not exist.
    pub(super) fn lines(&self, target: &Target<'_>) -> Result<Vec<Lines>, LoadProblem> {
        let mut all = Vec::new();
        for geometry in &target.object.geometry {
            let each = boundary::lines(geometry)
                .map_err(|problem| syntax_error(self.name(target.id), problem))?;
            let Some(each) = each else {
                continue;
            };
            let count = self.document.vertices.len();
            let beyond = |vertex: &&u32| **vertex as usize >= count;
            if let Some(vertex) = each.iter().flatten().find(beyond) {
                return Err(self.missing_vertex(*vertex, target.id));
            }
            let (topology, least) = match &*geometry.kind {
                "MultiPoint" => (Topology::Points, 1),
                _ => (Topology::Lines, 2),
            };
            if each.iter().any(|line| line.len() >= least) {
                all.push(Lines {
                    lod: geometry.lod(),
                    topology,
                    each,
                });
            }
        }
        Ok(all)
    }
}

impl SceneBuilder<'_> {
    /// The instances of an object that can be drawn. The others are noted.
    pub(super) fn instances(
        &mut self,
        context: &DocumentContext<'_>,
        target: &Target<'_>,
        origin: DVec3,
    ) -> Vec<Instance> {
        let mut drawn = Vec::new();
        let all = target.object.geometry.iter();
        for instance in all.filter(|geometry| geometry.kind == "GeometryInstance") {
            let anchor = boundary::anchor(instance).and_then(|vertex| context.point(vertex));
            let placing = anchor.and_then(|anchor| templates::placing(instance, anchor - origin));
            let template = self.templates.of(instance);
            let mesh = template.and_then(|template| template.mesh);
            let (Some(template), Some(mesh), Some(placing)) = (template, mesh, placing) else {
                let reason = "an instance without a template or a place";
                let left_out = &mut self.budget.left_out;
                left_out.add(LostPart::Geometry, reason, &context.name(target.id));
                continue;
            };
            drawn.push(Instance {
                lod: template.lod,
                number: instance.template.unwrap_or_default(),
                mesh,
                placing,
            });
        }
        drawn
    }

    /// Adds an instance of a template, as an entity below its object's.
    pub(super) fn add_instance(
        &mut self,
        target: &Target<'_>,
        instance: &Instance,
    ) -> Result<(), LoadProblem> {
        let kind = GeometryKind::Surfaces;
        let material = (self.materials).material(&mut self.scene, &target.object.kind, kind);
        let what = format!("template {}", instance.number);
        let drawable = Drawable {
            mesh: instance.mesh,
            material,
        };
        self.add_below(target, &what, instance.placing, drawable)
    }

    /// Adds lines or points of an object, as an entity below it.
    pub(super) fn add_lines(
        &mut self,
        context: &DocumentContext<'_>,
        target: &Target<'_>,
        lines: &Lines,
        origin: DVec3,
    ) -> Result<(), LoadProblem> {
        let vertices = lines.each.iter().flatten();
        let total = vertices.clone().count() as u64;
        self.budget
            .enter(format!("the lines of \"{}\"", shorten(target.id)));
        self.budget.vertices(total)?;
        self.budget.triangles(total)?;
        let mut indices = Vec::new();
        let mut first = 0;
        for line in &lines.each {
            let each = first..first + line.len() as u32;
            match lines.topology {
                Topology::Points => indices.extend(each),
                _ => indices.extend(each.skip(1).flat_map(|end| [end - 1, end])),
            }
            first += line.len() as u32;
        }
        let points = vertices.filter_map(|vertex| context.point(*vertex));
        let local = localise(points.map(|point| point - origin));
        let placing = local.transform();
        let shown = Geometry {
            topology: lines.topology,
            positions: local.positions,
            indices,
            ..Geometry::default()
        };
        self.budget.mesh(target.id)?;
        let kind = GeometryKind::Surfaces;
        let material = (self.materials).material(&mut self.scene, &target.object.kind, kind);
        let mesh = self.scene.add_mesh(Mesh::new(target.id, shown))?;
        let what = match lines.topology {
            Topology::Points => "points",
            _ => "lines",
        };
        self.add_below(target, what, placing, Drawable { mesh, material })
    }

    /// Adds an entity below an object's, named after it.
    fn add_below(
        &mut self,
        target: &Target<'_>,
        what: &str,
        placing: DAffine3,
        drawable: Drawable,
    ) -> Result<(), LoadProblem> {
        self.budget.entities(1)?;
        let name = format!("{}, {what}", target.id);
        self.budget.name(&name)?;
        let entity = self.scene.spawn(Some(target.entity), placing)?;
        self.scene.set_entity_name(entity, name)?;
        self.scene.set_drawable(entity, drawable)?;
        Ok(())
    }
}
