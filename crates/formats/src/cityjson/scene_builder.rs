//! Construction of a scene from city objects. Each tree of objects has its origin at its own box, so that its meshes
//! are precise in f32 for any coordinates.

use super::boundary::{self, GeometryKind, Surface};
use super::document::{CityObject, Document, Geometry as Source, Transform};
use super::error::syntax_error;
use super::materials::{self, Materials};
use super::templates::TemplateTable;
use super::tree::Tree;
use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::left_out::LostPart;
use crate::polygon::Triangulator;
use antumbra_scene::{EntityKey, Scene};
use glam::{DAffine3, DVec3};

mod below;
mod mesh;

/// Builds a scene from documents.
pub(super) struct SceneBuilder<'a> {
    pub(super) budget: &'a mut Budget,
    scene: Scene,
    materials: Materials,
    triangulator: Triangulator,
    templates: TemplateTable,
}

/// The document that is being added.
struct DocumentContext<'a> {
    line: usize,
    document: &'a Document<'a>,
    transform: &'a Transform,
}

/// A city object and its entity.
struct Target<'a> {
    entity: EntityKey,
    id: &'a str,
    object: &'a CityObject<'a>,
}

/// A surface with its tint.
struct TintedSurface {
    surface: Surface,
    /// Linear RGBA, 255 for 1.
    tint: [u8; 4],
}

/// A geometry with its surfaces.
struct Shape {
    lod: f64,
    kind: GeometryKind,
    surfaces: Vec<TintedSurface>,
    /// Whether any surface has a tint.
    is_tinted: bool,
}

impl<'a> SceneBuilder<'a> {
    pub(super) fn new(budget: &'a mut Budget) -> Self {
        Self {
            budget,
            scene: Scene::new(),
            materials: Materials::default(),
            triangulator: Triangulator::new(),
            templates: TemplateTable::default(),
        }
    }

    /// The scene.
    pub(super) fn finish(self) -> Scene {
        self.scene
    }

    /// Adds a document's objects.
    pub(super) fn add_document(
        &mut self,
        document: &Document<'_>,
        transform: &Transform,
        line: usize,
    ) -> Result<(), LoadProblem> {
        let objects = document.objects.0.as_slice();
        self.budget.enter(format!("the objects of line {line}"));
        self.budget.entities(objects.len() as u64)?;
        for (id, _) in objects {
            // The entity's, and its mesh's.
            self.budget.name(id)?;
            self.budget.mesh(id)?;
        }
        if let Some(appearance) = &document.appearance {
            let textures = appearance.textures.len() as u64;
            let place = format!("line {line}");
            let reason = "textures of CityJSON";
            let left_out = &mut self.budget.left_out;
            left_out.add_many(LostPart::Image, reason, textures, &place);
            let materials = appearance.materials.len() as u64;
            let reason = "materials of CityJSON";
            left_out.add_many(LostPart::Material, reason, materials, &place);
        }
        if let Some(templates) = &document.templates {
            self.templates = TemplateTable::read(
                templates,
                &mut self.scene,
                &mut self.triangulator,
                self.budget,
            )?;
        }
        let context = DocumentContext {
            line,
            document,
            transform,
        };
        let tree = Tree::new(objects, line)?;
        let mut entities: Vec<Option<EntityKey>> = vec![None; objects.len()];
        for members in tree.trees() {
            let shapes = self.shapes(&context, members)?;
            let origin = context.origin(&shapes)?;
            for (&member, mut shapes) in members.iter().zip(shapes) {
                let Some((id, object)) = objects.get(member) else {
                    continue;
                };
                let parent = tree.parents.get(member).copied().flatten();
                let above = parent.and_then(|parent| entities.get(parent).copied().flatten());
                let local = match above {
                    None => DAffine3::from_translation(origin),
                    Some(_) => DAffine3::IDENTITY,
                };
                let entity = self.scene.spawn(above, local)?;
                self.scene.set_entity_name(entity, &**id)?;
                shapes.sort_by(|a, b| b.lod.total_cmp(&a.lod));
                let target = Target { entity, id, object };
                self.show(&context, &target, &shapes, origin)?;
                if let Some(known) = entities.get_mut(member) {
                    *known = Some(entity);
                }
            }
        }
        Ok(())
    }

    /// The shapes of a tree's objects. Footprints are left out if any object of the tree has a finer geometry.
    fn shapes(
        &mut self,
        context: &DocumentContext<'_>,
        members: &[usize],
    ) -> Result<Vec<Vec<Shape>>, LoadProblem> {
        let objects = context.document.objects.0.as_slice();
        let geometries = |member: &usize| -> &[Source<'_>] {
            objects
                .get(*member)
                .map_or(&[], |(_, object)| object.geometry.as_slice())
        };
        let has_more = members
            .iter()
            .flat_map(geometries)
            .any(|geometry| boundary::kind(geometry).is_some() && geometry.lod() >= 1.0);
        let mut all = Vec::with_capacity(members.len());
        for member in members {
            let mut shapes = Vec::new();
            for geometry in geometries(member) {
                let Some(kind) = boundary::kind(geometry) else {
                    self.note_unread(geometry, context);
                    continue;
                };
                if has_more && geometry.lod() < 1.0 {
                    continue;
                }
                let id = objects.get(*member).map_or("", |(id, _)| id);
                shapes.push(context.shape(geometry, kind, id)?);
            }
            all.push(shapes);
        }
        Ok(all)
    }

    /// Shows the finest level of detail of an object: its surfaces, with their coarser levels, and its instances, lines and points of that level.
    fn show(
        &mut self,
        context: &DocumentContext<'_>,
        target: &Target<'_>,
        shapes: &[Shape],
        origin: DVec3,
    ) -> Result<(), LoadProblem> {
        let instances = self.instances(context, target, origin);
        let lines = context.lines(target)?;
        let levels = self.levels(context, target, shapes, origin)?;
        let drawn = levels.first().map(|level| level.lod);
        let finest = (drawn.into_iter())
            .chain(instances.iter().map(|instance| instance.lod))
            .chain(lines.iter().map(|lines| lines.lod))
            .max_by(f64::total_cmp);
        if drawn.is_some() && drawn == finest {
            self.set_mesh(target, shapes, levels)?;
        }
        for instance in instances {
            if Some(instance.lod) == finest {
                self.add_instance(target, &instance)?;
            }
        }
        for lines in &lines {
            if Some(lines.lod) == finest {
                self.add_lines(context, target, lines, origin)?;
            }
        }
        Ok(())
    }

    /// Notes a geometry of a kind that does not exist.
    fn note_unread(&mut self, geometry: &Source<'_>, context: &DocumentContext<'_>) {
        let kind = &*geometry.kind;
        if !["MultiPoint", "MultiLineString", "GeometryInstance"].contains(&kind) {
            let example = format!("line {}", context.line);
            let reason = format!("of the type \"{}\"", shorten(kind));
            let left_out = &mut self.budget.left_out;
            left_out.add(LostPart::Geometry, &reason, &example);
        }
    }
}

impl DocumentContext<'_> {
    fn name(&self, id: &str) -> String {
        format!("line {}, object \"{}\"", self.line, shorten(id))
    }

    fn missing_vertex(&self, vertex: u32, id: &str) -> LoadProblem {
        LoadProblem::MissingReference {
            place: self.name(id),
            what: "vertex",
            index: u64::from(vertex),
            count: self.document.vertices.len(),
        }
    }

    /// The position of a vertex in the world (east, up, south); `None` if there is no such vertex.
    fn point(&self, vertex: u32) -> Option<DVec3> {
        let vertex = *self.document.vertices.get(vertex as usize)?;
        let Transform { scale, translate } = self.transform;
        let [x, y, z] =
            (DVec3::from(vertex) * DVec3::from(*scale) + DVec3::from(*translate)).to_array();
        Some(DVec3::new(x, z, -y))
    }

    /// A geometry's surfaces, with all vertex indices checked.
    fn shape(
        &self,
        source: &Source<'_>,
        kind: GeometryKind,
        id: &str,
    ) -> Result<Shape, LoadProblem> {
        let count = self.document.vertices.len();
        let read =
            boundary::surfaces(source).map_err(|problem| syntax_error(self.name(id), problem))?;
        let tints = materials::tints(source);
        let mut shape = Shape {
            lod: source.lod(),
            kind,
            surfaces: Vec::new(),
            is_tinted: false,
        };
        for (surface, semantics) in read {
            let beyond = surface
                .iter()
                .flatten()
                .find(|vertex| **vertex as usize >= count);
            if let Some(vertex) = beyond {
                return Err(self.missing_vertex(*vertex, id));
            }
            let tint = materials::tint_of(&tints, semantics);
            shape.is_tinted |= tint != materials::UNTINTED;
            shape.surfaces.push(TintedSurface { surface, tint });
        }
        Ok(shape)
    }

    /// The centre of the lower face of the box around the shapes; 0 if there are none. Every corner is near enough
    /// for f32.
    fn origin(&self, shapes: &[Vec<Shape>]) -> Result<DVec3, LoadProblem> {
        let corners = shapes.iter().flatten().flat_map(|shape| &shape.surfaces);
        let corners = corners.flat_map(|tinted| tinted.surface.iter().flatten());
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &vertex in corners {
            let Some(point) = self.point(vertex) else {
                continue;
            };
            if !point.as_vec3().is_finite() {
                let problem = format!("vertex {vertex} lies at {point}, which is out of range");
                return Err(syntax_error(format!("line {}", self.line), problem));
            }
            (low, high) = (low.min(point), high.max(point));
        }
        if low.x > high.x {
            return Ok(DVec3::ZERO);
        }
        let middle = low.midpoint(high);
        Ok(DVec3::new(middle.x, low.y, middle.z))
    }
}
