//! Scenes that need no file.

mod chance;
mod city;
mod grid;
mod layer;
mod shell;
mod solid;
pub mod subsurface;
mod sun;
pub mod terrain;
mod tube;
mod turbine;
mod turned;

pub use city::{CityOptions, city};
pub use grid::{GridOptions, grid};
pub use layer::layer;
pub use turbine::{TurbineOptions, turbine};

use antumbra_scene::{Scene, SceneError};
use std::ops::RangeInclusive;
use thiserror::Error;

/// Why there is no such built-in scene.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DemoSceneError {
    /// A name that no built-in scene has.
    #[error("there is no built-in scene \"{name}\"; there are: {}", names().join(", "))]
    UnknownName {
        /// The name asked for.
        name: String,
    },
    /// A size that no scene can be built in.
    #[error("a {name} of size {size} has more entities than {most}; ask for a smaller one")]
    TooLarge {
        /// The scene.
        name: &'static str,
        /// The size asked for.
        size: u32,
        /// The most entities.
        most: u64,
    },
    /// A size that this scene does not come in.
    #[error("there is no {name} of size {size}; its sizes are {} to {}", sizes.start(), sizes.end())]
    NoSuchSize {
        /// The scene.
        name: &'static str,
        /// The size asked for.
        size: u32,
        /// The sizes there are.
        sizes: RangeInclusive<u32>,
    },
    /// The scene itself refused something.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The built-in scenes' names.
#[must_use]
pub fn names() -> &'static [&'static str] {
    &["grid", "layer", "turbine", "city"]
}

/// The built-in scene of this name. `size` means for a grid how many spheres an edge has, for a layer how many boxes, for a turbine which of
/// the two engines it is, for a city how many blocks an edge has; `None` is the scene's own default.
///
/// # Errors
/// [`DemoSceneError::UnknownName`], which lists the names; [`DemoSceneError::TooLarge`]; [`DemoSceneError::NoSuchSize`].
pub fn by_name(name: &str, size: Option<u32>) -> Result<Scene, DemoSceneError> {
    match name {
        "grid" => {
            let defaults = GridOptions::default();
            grid(GridOptions {
                per_side: size.unwrap_or(defaults.per_side),
                ..defaults
            })
        }
        "layer" => layer(size.unwrap_or(100)),
        "turbine" => {
            let defaults = TurbineOptions::default();
            turbine(TurbineOptions {
                size: size.unwrap_or(defaults.size),
                ..defaults
            })
        }
        "city" => {
            let defaults = CityOptions::default();
            city(CityOptions {
                size: size.unwrap_or(defaults.size),
                ..defaults
            })
        }
        _ => Err(DemoSceneError::UnknownName { name: name.into() }),
    }
}
