//! Prepared surfaces as entities of a scene.

use antumbra_scene::{Drawable, EntityKey, Light, Material, MaterialKey, Scene};
use glam::{DAffine3, DVec3};

use crate::error::SubsurfaceError;
use crate::palette::colour;
use crate::prepare::PreparedSurface;
use crate::surface::SurfaceKind;

/// A surface in a scene. Moving or removing `root` moves or removes the whole surface, at any time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SurfaceEntities {
    /// The surface's name.
    pub name: String,
    /// Whether it is a horizon or a fault.
    pub kind: SurfaceKind,
    /// The parent entity of all tiles. It has the surface's name.
    pub root: EntityKey,
    /// The tiles, in the order of [`PreparedSurface::tiles`].
    pub tiles: Vec<EntityKey>,
}

impl PreparedSurface {
    /// Adds the surface to a scene, below `parent` or as a root.
    ///
    /// # Errors
    /// [`SubsurfaceError::Scene`] for an unknown parent or material, or an invalid mesh.
    pub fn spawn(
        self,
        scene: &mut Scene,
        parent: Option<EntityKey>,
        material: MaterialKey,
    ) -> Result<SurfaceEntities, SubsurfaceError> {
        // All tiles have one transform, so what meets in the meshes meets on the screen.
        let root = scene.spawn(parent, DAffine3::from_translation(self.origin))?;
        scene.set_entity_name(root, self.name.as_str())?;
        let mut tiles = Vec::with_capacity(self.tiles.len());
        for tile in self.tiles {
            let entity = scene.spawn(Some(root), DAffine3::IDENTITY)?;
            scene.set_entity_name(entity, tile.mesh.name.as_str())?;
            let mesh = scene.add_mesh(tile.mesh)?;
            scene.set_drawable(entity, Drawable { mesh, material })?;
            tiles.push(entity);
        }
        Ok(SurfaceEntities {
            name: self.name,
            kind: self.kind,
            root,
            tiles,
        })
    }
}

/// The material of a surface: one colour, lit, visible from both sides. Horizons use the spectrum from the top down,
/// faults use reds.
#[must_use]
pub fn surface_material(name: &str, kind: SurfaceKind, index: usize) -> Material {
    Material {
        name: name.to_owned(),
        base_colour: colour(kind, index),
        double_sided: true,
        ..Material::default()
    }
}

/// Adds two point lights above all drawables of a scene, one in the south-east and a weaker one in the north-west:
/// the two positional lights of Plate et al. A scene without drawables gets none.
///
/// # Errors
/// [`SubsurfaceError::Scene`] if the scene is full.
pub fn add_default_lights(scene: &mut Scene) -> Result<(), SubsurfaceError> {
    scene.update();
    let Some(bounds) = scene.bounds() else {
        return Ok(());
    };
    let radius = bounds.half_extents().length();
    let lamps = [
        (DVec3::new(1.1, 1.3, 0.8), [1.0, 0.96, 0.9], 3.0),
        (DVec3::new(-1.0, 0.9, -1.1), [0.82, 0.9, 1.0], 1.0),
    ];
    for (place, colour, lux) in lamps {
        let place = place * radius;
        let lamp = scene.spawn(None, DAffine3::from_translation(bounds.centre() + place))?;
        scene.set_entity_name(lamp, "lamp")?;
        let light = Light::Point {
            colour,
            // The intensity in candela for this illuminance at the centre.
            intensity: (lux * place.length_squared()) as f32,
            range: None,
        };
        scene.set_light(lamp, light)?;
    }
    Ok(())
}
