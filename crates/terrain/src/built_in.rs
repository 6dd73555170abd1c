//! The built-in scene `terrain`: a landscape out of a seed, made a field by greedy insertion, with its horizons and groups, under a sun.

use std::f64::consts::TAU;
use std::str::FromStr;
use std::sync::Arc;

use antumbra_scene::{Light, Material, Scene};
use glam::{DAffine3, DQuat, DVec2, DVec3, EulerRot};

use crate::crystal::GroupOptions;
use crate::error::TerrainError;
use crate::field::Field;
use crate::file::PreparedScene;
use crate::fractal::FractalOptions;
use crate::horizon::{Method, Sectors};
use crate::show::{ShownTerrain, to_world};
use crate::spread::spread_boxes;
use crate::terrain::{Terrain, TerrainOptions};
use crate::tin::Detail;

/// What the built-in scene is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuiltInOptions {
    /// The landscape.
    pub landscape: FractalOptions,
    /// Vertices of the field.
    pub vertices: usize,
    /// Boxes that stand on it, at most [`Self::MOST_BOXES`].
    pub boxes: usize,
    /// How it is prepared; its groups grow from the landscape's seed.
    pub prepare: TerrainOptions,
}

impl Default for BuiltInOptions {
    /// 100,000 vertices of 1,025 x 1,025 posts.
    fn default() -> Self {
        Self {
            landscape: FractalOptions::default(),
            vertices: 100_000,
            boxes: 0,
            prepare: TerrainOptions::default(),
        }
    }
}

impl BuiltInOptions {
    /// The most boxes.
    pub const MOST_BOXES: usize = 1_000_000;

    /// Sets one by name. `size` is the number of vertices; `sectors`, `parts` and `reaches` are those of horizons, `seeds` those of groups.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for a name that is none, or a value that cannot be read or is out of its range.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), TerrainError> {
        let sectors = self.prepare.sectors;
        match key {
            "size" => self.vertices = read("size", value)?,
            "boxes" => {
                self.boxes = read("boxes", value)?;
                if self.boxes > Self::MOST_BOXES {
                    return Err(TerrainError::Setting {
                        what: "the number of boxes",
                        value: self.boxes.to_string(),
                        problem: "give at most 1000000",
                    });
                }
            }
            "seed" => self.landscape.seed = read("seed", value)?,
            "order" => self.landscape.order = read("order", value)?,
            "relief" => self.landscape.relief = read("relief", value)?,
            "roughness" => self.landscape.roughness = read("roughness", value)?,
            "sectors" => {
                self.prepare.sectors = Sectors::new(read("sectors", value)?, sectors.parts())?
                    .with_reaches(sectors.reaches())?;
            }
            "parts" => {
                self.prepare.sectors = Sectors::new(sectors.count(), read("parts", value)?)?
                    .with_reaches(sectors.reaches())?;
            }
            "reaches" => {
                self.prepare.sectors = sectors.with_reaches(read("reaches", value)?)?;
            }
            "method" => self.prepare.method = read::<Method>("method", value)?,
            "seeds" => {
                self.prepare.groups = Some(GroupOptions::of_seeds(read("seeds", value)?));
            }
            _ => {
                return Err(TerrainError::Setting {
                    what: "a setting of the scene terrain",
                    value: format!("`{key}`"),
                    problem: "there are: size, boxes, seed, order, relief, roughness, sectors, parts, reaches, method, seeds",
                });
            }
        }
        Ok(())
    }
}

fn read<T: FromStr>(what: &'static str, value: &str) -> Result<T, TerrainError> {
    value.parse().map_err(|_| TerrainError::Setting {
        what,
        value: format!("`{value}`"),
        problem: match what {
            "method" => "write sound, rays or thesis",
            _ => "write a number",
        },
    })
}

impl BuiltInOptions {
    /// Builds the scene; `done` is told of every sector whose horizons are found.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for an option out of range.
    pub fn scene(&self, done: &(dyn Fn() + Sync)) -> Result<PreparedScene, TerrainError> {
        let seed = self.landscape.seed;
        let field = Field::over(&self.landscape.raster()?, Detail::Vertices(self.vertices))?;
        let prepare = self.prepare.seeded(seed, &field);
        let terrain = Terrain::prepare(field, &prepare, done)?;
        let mut made = PreparedScene::of(terrain, "terrain")?;
        spread_boxes(&mut made.scene, &made.terrain, self.boxes, seed)?;
        Ok(made)
    }
}

impl PreparedScene {
    /// A scene that shows a terrain and nothing else.
    ///
    /// # Errors
    /// As [`Terrain::show_lit`].
    pub fn of(terrain: Terrain, name: &str) -> Result<Self, TerrainError> {
        let mut scene = Scene::new();
        scene.set_name(name);
        let shown = terrain.show_lit(&mut scene)?;
        Ok(Self {
            scene,
            terrain: Arc::new(terrain),
            shown,
        })
    }
}

impl Terrain {
    /// Puts the terrain into a scene in the colour of grass, with a sun in the south-west.
    ///
    /// # Errors
    /// As [`Terrain::show`].
    pub fn show_lit(&self, scene: &mut Scene) -> Result<ShownTerrain, TerrainError> {
        let material = scene.add_material(Material {
            name: "ground".to_owned(),
            base_colour: [0.36, 0.42, 0.24, 1.0],
            double_sided: true,
            ..Material::default()
        });
        let shown = self.show(scene, material)?;
        let slanting = DQuat::from_euler(EulerRot::YXZ, -0.7, -0.6, 0.0);
        let sun = scene.spawn(None, DAffine3::from_quat(slanting))?;
        scene.set_entity_name(sun, "sun")?;
        let light = Light::Directional {
            colour: [1.0, 0.97, 0.9],
            illuminance: 3.2,
        };
        scene.set_light(sun, light)?;
        Ok(shown)
    }

    /// Stations of a flight over the terrain, `height` metres above what lies within a hundred metres, and the place that is looked at
    /// from each: a figure of eight around the middle, in the world.
    #[must_use]
    pub fn flight(&self, height: f64, stations: usize) -> Vec<[DVec3; 2]> {
        let [low, high] = self.field().plan_bounds();
        let (middle, size) = ((low + high) / 2.0, (high - low) * 0.32);
        let plan = |turn: f64| {
            let angle = turn * TAU;
            middle + DVec2::new(angle.sin(), (2.0 * angle).sin() * 0.6) * size
        };
        let above = |place: DVec2| {
            let highest = self.highest_near(place, 100.0).unwrap_or_default();
            place.extend(highest + height)
        };
        (0..stations)
            .map(|station| {
                let turn = station as f64 / stations as f64;
                let [here, ahead] = [turn, turn + 0.02].map(|turn| above(plan(turn)));
                let level = DVec3::new(ahead.x, ahead.y, ahead.z.min(here.z) - height * 0.5);
                [here, level].map(|place| to_world(place + self.field().origin()))
            })
            .collect()
    }
}
