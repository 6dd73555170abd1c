//! The options of the scene `subsurface`, and how each is set by name.

use super::model::ModelOptions;
use antumbra_subsurface::{PrepareOptions, SubsurfaceError};

/// Options of the scene `subsurface`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubsurfaceSceneOptions {
    /// The model.
    pub model: ModelOptions,
    /// How its surfaces are divided into tiles and simplified.
    pub prepare: PrepareOptions,
    /// Whether the scene has three slices through the seismic volume.
    pub slices: bool,
    /// Whether the scene has a lens.
    pub lens: bool,
    /// Size of the cache of bricks, in bytes.
    pub budget: usize,
}

impl Default for SubsurfaceSceneOptions {
    fn default() -> Self {
        Self {
            model: ModelOptions::default(),
            prepare: PrepareOptions::default(),
            slices: true,
            lens: true,
            budget: 64 << 20,
        }
    }
}

impl SubsurfaceSceneOptions {
    /// The names of the options that [`Self::set`] takes.
    pub const KEYS: [&str; 8] = [
        "size",
        "seed",
        "tiles",
        "decimation",
        "thinning",
        "levels",
        "slices",
        "lens",
    ];

    /// Sets an option by its name. `size` is the number of nodes along a side of a horizon.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`] for an unknown name, and for a value that cannot be parsed. Ranges are checked
    /// when the scene is built.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), SubsurfaceError> {
        match key {
            "size" => self.model.nodes_per_side = read("size", value)?,
            "seed" => self.model.seed = read("seed", value)?,
            "tiles" => self.prepare.tiles = read("tiles", value)?,
            "decimation" => self.prepare.decimation = read("decimation", value)?,
            "thinning" => self.prepare.thinning = read("thinning", value)?,
            "levels" => self.prepare.levels = read("levels", value)?,
            "slices" => self.slices = read("slices", value)?,
            "lens" => self.lens = read("lens", value)?,
            _ => {
                return Err(SubsurfaceError::Setting {
                    what: "a setting of the scene subsurface",
                    value: format!("`{key}`"),
                    problem: format!("there are: {}", Self::KEYS.join(", ")),
                });
            }
        }
        Ok(())
    }
}

fn read<T: std::str::FromStr>(what: &'static str, value: &str) -> Result<T, SubsurfaceError> {
    value.parse().map_err(|_| SubsurfaceError::Setting {
        what,
        value: format!("`{value}`"),
        problem: match std::any::type_name::<T>() {
            "bool" => "write true or false".to_owned(),
            _ => "write a number".to_owned(),
        },
    })
}
