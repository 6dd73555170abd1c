//! What is placed below an object's entity, with entities of its own: instances of templates, lines and points.

use super::super::boundary::{self, GeometryKind};
use super::super::error::syntax_error;
use super::super::templates;
use super::{DocumentContext, SceneBuilder, Target};
use crate::error::{LoadProblem, shorten};
use crate::left_out::LostPart;
use crate::local_origin::localise;
use antumbra_scene::{Drawable, Geometry, Mesh, Topology};
use glam::{DAffine3, DVec3};

impl SceneBuilder<'_> {
    /// Places the instances of templates of an object's finest level. Returns that level, if the object has any that are placed. Coarser ones
    /// than `finest`, the finest of its own shapes, are not.
    pub(super) fn add_instances(
        &mut self,
        context: &DocumentContext<'_>,
        target: &Target<'_>,
        finest: f64,
        origin: DVec3,
    ) -> Result<Option<f64>, LoadProblem> {
        let instances = target.object.geometry.iter();
        let instances = instances.filter(|geometry| geometry.kind == "GeometryInstance");
        let templates = &self.templates;
        let lods = instances
            .clone()
            .filter_map(|instance| templates.of(instance));
        let best = lods.map(|template| template.lod).max_by(f64::total_cmp);
        let wanted = best.filter(|best| *best >= finest);
        for instance in instances {
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
            if Some(template.lod) != wanted {
                continue;
            }
            let kind = GeometryKind::Surfaces;
            let material = (self.materials).material(&mut self.scene, &target.object.kind, kind);
            let what = format!("template {}", instance.template.unwrap_or_default());
            self.add_below(target, &what, placing, Drawable { mesh, material })?;
        }
        Ok(wanted)
    }

    /// Adds an object's lines and points, as entities below it.
    pub(super) fn add_lines(
        &mut self,
        context: &DocumentContext<'_>,
        target: &Target<'_>,
        origin: DVec3,
    ) -> Result<(), LoadProblem> {
        for geometry in &target.object.geometry {
            let lines = boundary::lines(geometry)
                .map_err(|problem| syntax_error(context.name(target.id), problem))?;
            let Some(lines) = lines else {
                continue;
            };
            let vertices = lines.iter().flatten();
            let count = context.document.vertices.len();
            if let Some(vertex) = vertices.clone().find(|vertex| **vertex as usize >= count) {
                return Err(context.missing_vertex(*vertex, target.id));
            }
            let topology = match &*geometry.kind {
                "MultiPoint" => Topology::Points,
                _ => Topology::Lines,
            };
            let total = vertices.clone().count() as u64;
            self.budget
                .enter(format!("the lines of \"{}\"", shorten(target.id)));
            self.budget.vertices(total)?;
            self.budget.triangles(total)?;
            let mut indices = Vec::new();
            let mut first = 0;
            for line in &lines {
                let each = first..first + line.len() as u32;
                match topology {
                    Topology::Points => indices.extend(each),
                    _ => indices.extend(each.skip(1).flat_map(|end| [end - 1, end])),
                }
                first += line.len() as u32;
            }
            if indices.is_empty() {
                continue;
            }
            let points = vertices.filter_map(|vertex| context.point(*vertex));
            let local = localise(points.map(|point| point - origin));
            let placing = local.transform();
            let shown = Geometry {
                topology,
                positions: local.positions,
                indices,
                ..Geometry::default()
            };
            self.budget.mesh(target.id)?;
            let kind = GeometryKind::Surfaces;
            let material = (self.materials).material(&mut self.scene, &target.object.kind, kind);
            let mesh = self.scene.add_mesh(Mesh::new(target.id, shown))?;
            let what = match topology {
                Topology::Points => "points",
                _ => "lines",
            };
            self.add_below(target, what, placing, Drawable { mesh, material })?;
        }
        Ok(())
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
