//! The mesh of an object: its levels of detail, of which the coarsest may stand in for it.

use super::super::boundary::{GeometryKind, Surface};
use super::super::error::syntax_error;
use super::{DocumentContext, SceneBuilder, Shape, Target, TintedSurface};
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use crate::polygon::MAX_CORNERS;
use antumbra_scene::{Drawable, Geometry, Mesh};
use glam::DVec3;

/// A level of detail that has triangles.
pub(super) struct Level {
    pub(super) lod: f64,
    geometry: Geometry,
}

impl SceneBuilder<'_> {
    /// The levels of an object's mesh that have triangles. Shapes of the same level of detail are joined, finest first.
    pub(super) fn levels(
        &mut self,
        context: &DocumentContext<'_>,
        target: &Target<'_>,
        shapes: &[Shape],
        origin: DVec3,
    ) -> Result<Vec<Level>, LoadProblem> {
        let mut levels = Vec::new();
        for shapes in shapes.chunk_by(|a, b| a.lod == b.lod) {
            let lod = shapes.first().map_or(f64::NEG_INFINITY, |shape| shape.lod);
            let geometry = self.level(context, target.id, shapes, origin)?;
            if !geometry.indices.is_empty() {
                levels.push(Level { lod, geometry });
            }
        }
        Ok(levels)
    }

    /// Sets an entity's mesh.
    pub(super) fn set_mesh(
        &mut self,
        target: &Target<'_>,
        shapes: &[Shape],
        levels: Vec<Level>,
    ) -> Result<(), LoadProblem> {
        let levels: Vec<_> = levels.into_iter().map(|level| level.geometry).collect();
        let is_solid = |shape: &Shape| shape.kind == GeometryKind::Solids;
        let kind = if shapes.iter().all(is_solid) {
            GeometryKind::Solids
        } else {
            GeometryKind::Surfaces
        };
        let drawable = Drawable {
            mesh: self.scene.add_mesh(Mesh {
                name: target.id.to_owned(),
                proxy: proxy_of(&levels),
                levels,
            })?,
            material: self
                .materials
                .material(&mut self.scene, &target.object.kind, kind),
        };
        self.scene.set_drawable(target.entity, drawable)?;
        Ok(())
    }

    fn level(
        &mut self,
        context: &DocumentContext<'_>,
        id: &str,
        shapes: &[Shape],
        origin: DVec3,
    ) -> Result<Geometry, LoadProblem> {
        let surfaces = || shapes.iter().flat_map(|shape| &shape.surfaces);
        let corners = |surface: &Surface| surface.iter().map(Vec::len).sum::<usize>();
        let total = surfaces()
            .map(|tinted| corners(&tinted.surface))
            .sum::<usize>();
        self.budget.vertices(total as u64)?;
        let is_tinted = shapes.iter().any(|shape| shape.is_tinted);
        let mut level = Geometry::default();
        for TintedSurface { surface, tint } in surfaces() {
            if corners(surface) > MAX_CORNERS {
                let problem = format!(
                    "a surface has {} corners; at most {MAX_CORNERS} are read: divide it",
                    corners(surface)
                );
                return Err(syntax_error(context.name(id), problem));
            }
            self.triangulator.clear();
            for ring in surface {
                let corners = ring.iter().filter_map(|vertex| context.point(*vertex));
                self.triangulator
                    .ring(corners.map(|corner| corner - origin));
            }
            let triangles = self.triangulator.finish(&mut level, self.budget)?;
            if triangles == 0 {
                let left_out = &mut self.budget.left_out;
                left_out.add(LostPart::Face, "without an area", &context.name(id));
            }
            self.budget.triangles(triangles)?;
            if is_tinted {
                level.colours.resize(level.positions.len(), *tint);
            }
        }
        Ok(level)
    }
}

/// The proxy: the coarsest of several levels. Its walls are where the building's are. Those of a simplified mesh are
/// not, which hides too much in a street.
fn proxy_of(levels: &[Geometry]) -> Option<Geometry> {
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
