//! A field shown as it is, without horizons and groups: what strategies need that know nothing of terrains. Preparation takes seconds where horizons
//! take minutes.

use antumbra_scene::{Drawable, Mesh, Scene};
use glam::{DAffine3, DVec2};

use crate::error::TerrainError;
use crate::field::Field;
use crate::flight::{FlightStation, flight};
use crate::ground::Ground;
use crate::show::{add_sun, geometry, ground_material, normals};
use crate::world::to_world;

/// Triangles of an entity.
const TRIANGLES: usize = 256;

/// A field with an index of its surface.
#[derive(Debug, Clone)]
pub struct Landscape {
    field: Field,
    ground: Ground,
}

impl Landscape {
    /// Indexes a field.
    #[must_use]
    pub fn new(field: Field) -> Self {
        Self {
            ground: Ground::new(&field),
            field,
        }
    }

    /// The field.
    #[must_use]
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// Adds the field to a scene as entities of neighbouring triangles, in the colour of grass, and a sun in the south-west.
    ///
    /// # Errors
    /// [`TerrainError::Scene`] when the scene is full.
    pub fn show_lit(&self, scene: &mut Scene) -> Result<(), TerrainError> {
        let field = &self.field;
        let material = ground_material(scene);
        let transform = DAffine3::from_translation(to_world(field.origin()));
        let root = scene.spawn(None, transform)?;
        scene.set_entity_name(root, "terrain")?;
        let normals = normals(field, &[]);
        // A field's triangles are in an order in which neighbours are near each other.
        let triangles: Vec<u32> = (0..field.triangles().len() as u32).collect();
        for (number, triangles) in triangles.chunks(TRIANGLES).enumerate() {
            let entity = scene.spawn(Some(root), DAffine3::IDENTITY)?;
            let name = format!("tile {number}");
            scene.set_entity_name(entity, name.as_str())?;
            let mesh = scene.add_mesh(Mesh::new(name, geometry(field, &normals, triangles)))?;
            scene.set_drawable(entity, Drawable { mesh, material })?;
        }
        add_sun(scene)
    }

    /// The stations of a flight over the field: see [`Terrain::flight`](crate::Terrain::flight).
    #[must_use]
    pub fn flight(&self, height: f64, stations: usize) -> Vec<FlightStation> {
        let highest = |at: DVec2, reach| self.ground.highest_near(&self.field, at, reach);
        flight(&self.field, &highest, height, stations)
    }
}
