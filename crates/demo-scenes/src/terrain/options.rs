//! The options of the scene `terrain`, and how each is set by name.

use super::fractal::FractalOptions;
use antumbra_terrain::horizon::{Method, Sectors};
use antumbra_terrain::{GroupOptions, TerrainError, TerrainOptions};
use std::str::FromStr;

/// Options of the scene `terrain`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TerrainSceneOptions {
    /// The landscape.
    pub landscape: FractalOptions,
    /// Vertices of the field.
    pub vertices: usize,
    /// Number of boxes on the terrain, at most [`Self::MAX_BOXES`].
    pub boxes: usize,
    /// How the field is prepared. Its groups grow from the seed of the landscape.
    pub prepare: TerrainOptions,
}

impl Default for TerrainSceneOptions {
    /// 100,000 vertices from 1,025 x 1,025 posts.
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
    /// Maximum of [`Self::boxes`].
    pub const MAX_BOXES: usize = 1_000_000;

    /// Sets an option by its name. `size` is the number of vertices; `sectors`, `parts` and `reaches` are options of
    /// the horizons; `seeds` is the number of groups.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for an unknown name, and for a value that cannot be parsed or is out of range.
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
