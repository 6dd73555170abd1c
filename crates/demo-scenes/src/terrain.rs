//! The built-in scene `terrain`: a landscape out of a seed, made a field by greedy insertion, with its horizons and groups, under a sun.

use std::str::FromStr;

use antumbra_terrain::horizon::{Method, Sectors};
use antumbra_terrain::{
    Field, GroupOptions, PreparedScene, RasterDetail, Terrain, TerrainError, TerrainOptions,
};

mod fractal;
mod spread;

pub use fractal::FractalOptions;
use spread::spread_boxes;

/// What the built-in scene is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TerrainSceneOptions {
    /// The landscape.
    pub landscape: FractalOptions,
    /// Vertices of the field.
    pub vertices: usize,
    /// Boxes that stand on it, at most [`Self::MAX_BOXES`].
    pub boxes: usize,
    /// How it is prepared; its groups grow from the landscape's seed.
    pub prepare: TerrainOptions,
}

impl Default for TerrainSceneOptions {
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

impl TerrainSceneOptions {
    /// The most boxes.
    pub const MAX_BOXES: usize = 1_000_000;

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
                if self.boxes > Self::MAX_BOXES {
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

impl TerrainSceneOptions {
    /// Builds the scene; `done` is told of every sector whose horizons are found.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for an option out of range.
    pub fn scene(&self, done: &(dyn Fn() + Sync)) -> Result<PreparedScene, TerrainError> {
        let seed = self.landscape.seed;
        let field = Field::from_raster(
            &self.landscape.raster()?,
            RasterDetail::Vertices(self.vertices),
        )?;
        let prepare = self.prepare.seeded(seed, &field);
        let terrain = Terrain::prepare(field, &prepare, done)?;
        let mut made = PreparedScene::from_terrain(terrain, "terrain")?;
        spread_boxes(&mut made.scene, &made.terrain, self.boxes, seed)?;
        Ok(made)
    }
}
