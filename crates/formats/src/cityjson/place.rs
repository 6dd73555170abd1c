//! City objects become entities. Each tree of them stands where its box does, so that its meshes are exact in f32 however far
//! the file's coordinates are from 0.

use super::boundary::{self, Surface};
use super::document::{CityObject, Document, Geometry as Source, Transform};
use super::look::{self, Looks};
use super::surface::{MAX_CORNERS, Triangulator};
use super::tree::Tree;
use super::{broken, shorten};
use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::{Drawable, EntityKey, Geometry, Mesh, Scene};
use glam::{DAffine3, DVec3};

/// Makes a scene out of documents.
pub(super) struct Placer<'a> {
    pub(super) budget: &'a mut Budget,
    scene: Scene,
    looks: Looks,
    triangulator: Triangulator,
    /// Geometries that are none of surfaces.
    unread: u64,
    /// Surfaces without an area.
    flat: u64,
}

/// One document, while it is placed.
struct Site<'a> {
    line: usize,
    document: &'a Document<'a>,
    transform: &'a Transform,
}

/// A geometry that is read, with its surfaces as they are in the file.
struct Shape {
    lod: f64,
    is_solid: bool,
    surfaces: Vec<(Surface, [u8; 4])>,
    /// Whether any surface has a tint.
    is_tinted: bool,
}

impl<'a> Placer<'a> {
    pub(super) fn new(budget: &'a mut Budget) -> Self {
        Self {
            budget,
            scene: Scene::new(),
            looks: Looks::default(),
            triangulator: Triangulator::new(),
            unread: 0,
            flat: 0,
        }
    }

    /// The scene, and a word about what is not in it.
    pub(super) fn finish(self) -> Scene {
        if self.unread > 0 {
            let count = self.unread;
            tracing::warn!(
                count,
                "CityJSON geometries of points, lines or templates; left out"
            );
        }
        if self.flat > 0 {
            let count = self.flat;
            tracing::warn!(count, "CityJSON surfaces without an area; left out");
        }
        self.scene
    }

    /// Adds a document's objects.
    pub(super) fn place(
        &mut self,
        document: &Document<'_>,
        transform: &Transform,
        line: usize,
    ) -> Result<(), LoadProblem> {
        let objects = document.objects.0.as_slice();
        self.budget.entities(objects.len() as u64)?;
        let site = Site {
            line,
            document,
            transform,
        };
        let tree = Tree::new(objects, line)?;
        let mut entities: Vec<Option<EntityKey>> = vec![None; objects.len()];
        for members in tree.trees() {
            let shapes = self.shapes(&site, members)?;
            let origin = site.origin(&shapes)?;
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
                self.dress(&site, entity, (id, object), &shapes, origin)?;
                if let Some(known) = entities.get_mut(member) {
                    *known = Some(entity);
                }
            }
        }
        Ok(())
    }

    /// What the objects of a tree look like. Footprints are left out where anything in the tree has more than that.
    fn shapes(
        &mut self,
        site: &Site<'_>,
        members: &[usize],
    ) -> Result<Vec<Vec<Shape>>, LoadProblem> {
        let objects = site.document.objects.0.as_slice();
        let geometries = |member: &usize| -> &[Source<'_>] {
            objects
                .get(*member)
                .map_or(&[], |(_, object)| object.geometry.as_slice())
        };
        let has_more = members
            .iter()
            .flat_map(geometries)
            .any(|geometry| boundary::is_solid(geometry).is_some() && geometry.lod() >= 1.0);
        let mut all = Vec::with_capacity(members.len());
        for member in members {
            let mut shapes = Vec::new();
            for geometry in geometries(member) {
                let Some(is_solid) = boundary::is_solid(geometry) else {
                    self.unread += 1;
                    continue;
                };
                if has_more && geometry.lod() < 1.0 {
                    continue;
                }
                let id = objects.get(*member).map_or("", |(id, _)| id);
                shapes.push(site.shape(geometry, is_solid, id)?);
            }
            all.push(shapes);
        }
        Ok(all)
    }

    /// Gives an entity its mesh: shapes of the same level together, the finest first.
    fn dress(
        &mut self,
        site: &Site<'_>,
        entity: EntityKey,
        (id, object): (&str, &CityObject<'_>),
        shapes: &[Shape],
        origin: DVec3,
    ) -> Result<(), LoadProblem> {
        let mut levels = Vec::new();
        for shapes in shapes.chunk_by(|a, b| a.lod == b.lod) {
            let level = self.level(site, id, shapes, origin)?;
            if !level.indices.is_empty() {
                levels.push(level);
            }
        }
        if levels.is_empty() {
            return Ok(());
        }
        let is_solid = shapes.iter().all(|shape| shape.is_solid);
        let drawable = Drawable {
            mesh: self.scene.add_mesh(Mesh {
                name: id.to_owned(),
                proxy: stand_in(&levels),
                levels,
            })?,
            material: self.looks.material(&mut self.scene, &object.kind, is_solid),
        };
        self.scene.set_drawable(entity, drawable)?;
        Ok(())
    }

    fn level(
        &mut self,
        site: &Site<'_>,
        id: &str,
        shapes: &[Shape],
        origin: DVec3,
    ) -> Result<Geometry, LoadProblem> {
        let surfaces = || shapes.iter().flat_map(|shape| &shape.surfaces);
        let corners = |surface: &Surface| surface.iter().map(Vec::len).sum::<usize>();
        let total = surfaces()
            .map(|(surface, _)| corners(surface))
            .sum::<usize>();
        self.budget.vertices(total as u64)?;
        let is_tinted = shapes.iter().any(|shape| shape.is_tinted);
        let mut level = Geometry::default();
        for (surface, tint) in surfaces() {
            if corners(surface) > MAX_CORNERS {
                let problem = format!(
                    "a surface has {} corners; at most {MAX_CORNERS} are read: divide it",
                    corners(surface)
                );
                return Err(broken(site.name(id), problem));
            }
            self.triangulator.clear();
            for ring in surface {
                let corners = ring.iter().filter_map(|vertex| site.point(*vertex));
                self.triangulator
                    .ring(corners.map(|corner| corner - origin));
            }
            let triangles = self.triangulator.finish(&mut level);
            self.flat += u64::from(triangles == 0);
            self.budget.triangles(triangles)?;
            if is_tinted {
                level.colours.resize(level.positions.len(), *tint);
            }
        }
        Ok(level)
    }
}

impl Site<'_> {
    fn name(&self, id: &str) -> String {
        format!("line {}, object \"{}\"", self.line, shorten(id))
    }

    /// A vertex in the world, if there is one of that number: east, up, south.
    fn point(&self, vertex: u32) -> Option<DVec3> {
        let vertex = *self.document.vertices.get(vertex as usize)?;
        let Transform { scale, translate } = self.transform;
        let [x, y, z] =
            (DVec3::from(vertex) * DVec3::from(*scale) + DVec3::from(*translate)).to_array();
        Some(DVec3::new(x, z, -y))
    }

    /// A geometry's surfaces, every corner of which is known to be there.
    fn shape(&self, source: &Source<'_>, is_solid: bool, id: &str) -> Result<Shape, LoadProblem> {
        let count = self.document.vertices.len();
        let read = boundary::surfaces(source).map_err(|problem| broken(self.name(id), problem))?;
        let kinds = source.semantics.as_ref();
        let tints: Vec<_> = (kinds.into_iter().flat_map(|semantics| &semantics.surfaces))
            .map(|surface| look::tint(&surface.kind))
            .collect();
        let mut shape = Shape {
            lod: source.lod(),
            is_solid,
            surfaces: Vec::new(),
            is_tinted: false,
        };
        for (surface, kind) in read {
            let beyond = surface
                .iter()
                .flatten()
                .find(|vertex| **vertex as usize >= count);
            if let Some(vertex) = beyond {
                return Err(LoadProblem::MissingReference {
                    place: self.name(id),
                    what: "vertex",
                    index: u64::from(*vertex),
                    count,
                });
            }
            let tint = kind.and_then(|kind| tints.get(kind)).copied();
            let tint = tint.unwrap_or(look::UNTINTED);
            shape.is_tinted |= tint != look::UNTINTED;
            shape.surfaces.push((surface, tint));
        }
        Ok(shape)
    }

    /// The middle of the lower face of the box around the shapes; 0 without one. Every corner is near enough for f32.
    fn origin(&self, shapes: &[Vec<Shape>]) -> Result<DVec3, LoadProblem> {
        let corners = shapes.iter().flatten().flat_map(|shape| &shape.surfaces);
        let corners = corners.flat_map(|(surface, _)| surface.iter().flatten());
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &vertex in corners {
            let Some(point) = self.point(vertex) else {
                continue;
            };
            if !point.as_vec3().is_finite() {
                let problem = format!("vertex {vertex} lies at {point}, which is no place");
                return Err(broken(format!("line {}", self.line), problem));
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

/// The shape of the coarsest of several levels. Its walls stand where the building's are, which those of a simplified building
/// do not: in a street that hides too much.
fn stand_in(levels: &[Geometry]) -> Option<Geometry> {
    let [full, .., coarsest] = levels else {
        return None;
    };
    let is_coarser = coarsest.indices.len() <= full.indices.len();
    is_coarser.then(|| Geometry {
        positions: coarsest.positions.clone(),
        indices: coarsest.indices.clone(),
        ..Geometry::default()
    })
}
