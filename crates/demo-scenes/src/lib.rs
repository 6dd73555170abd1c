//! Built-in scenes that need no file, for tests, examples and measurements.
//!
//! | Scene | Built by | Meaning of `size` | Range, default |
//! |---|---|---|---|
//! | `grid` | [`grid`] | spheres along an edge of a cube | up to 464, 26 |
//! | `layer` | [`layer`] | boxes along an edge of a plane | up to 10,000, 100 |
//! | `turbine` | [`turbine`] | which of the two aero engines | 1 to 2, 1 |
//! | `city` | [`city`] | blocks along an edge | 1 to 16, 7 |
//! | `subsurface` | `subsurface::SubsurfaceScene::new` | nodes along a side of a horizon | 2 to 4,096, 432 |
//! | `terrain` | `terrain::TerrainSceneOptions::scene` | vertices of the field | 100,000 |
//!
//! [`by_name`] builds the first four, which have no other options than a size and a seed. The last two are features of this crate, both on by default. All
//! scenes are deterministic: one seed gives one scene.
//!
#![cfg_attr(all(feature = "subsurface", feature = "terrain"), doc = "```")]
#![cfg_attr(
    not(all(feature = "subsurface", feature = "terrain")),
    doc = "```ignore"
)]
//! use antumbra_demo_scenes::subsurface::{SubsurfaceScene, SubsurfaceSceneOptions};
//! use antumbra_demo_scenes::terrain::TerrainSceneOptions;
//! use antumbra_demo_scenes::{CityOptions, TurbineOptions, by_name, city, turbine};
//!
//! let spheres = by_name("grid", Some(5))?;
//! assert_eq!(spheres.drawable_count(), 125);
//! let boxes = by_name("layer", Some(10))?;
//! assert_eq!(boxes.drawable_count(), 100);
//! let engine = turbine(TurbineOptions { size: 1, seed: 3 })?;
//! assert_eq!(engine.drawable_count(), 2_000);
//! let town = city(CityOptions { size: 1, seed: 3 })?;
//! assert!(town.drawable_count() > 1_000);
//!
//! let mut options = SubsurfaceSceneOptions::default();
//! options.set("size", "40")?;
//! let subsurface = SubsurfaceScene::new(&options, &|_done, _total| ())?;
//! assert_eq!(subsurface.surfaces.len(), 11 + 16);
//!
//! let mut options = TerrainSceneOptions::default();
//! options.set("order", "5")?;
//! options.set("size", "500")?;
//! let terrain = options.scene(&|| ())?;
//! assert!(terrain.scene.drawable_count() > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod city;
mod error;
mod grid;
mod lathe;
mod layer;
mod names;
// Some of it is for the scenes that are features.
#[cfg_attr(
    not(all(feature = "subsurface", feature = "terrain")),
    allow(dead_code)
)]
mod random;
mod shell;
mod solid;
#[cfg(feature = "subsurface")]
pub mod subsurface;
mod sun;
#[cfg(feature = "terrain")]
pub mod terrain;
mod tube;
mod turbine;

pub use city::{CityOptions, city};
pub use error::DemoSceneError;
pub use grid::{GridOptions, grid};
pub use layer::layer;
pub use turbine::{TurbineOptions, turbine};

use antumbra_scene::Scene;
use names::NAMES;

/// The names of the scenes that [`by_name`] builds.
#[must_use]
pub fn names() -> &'static [&'static str] {
    &NAMES
}

/// Builds a scene of [`names`]. The table of the [crate] says what `size` means; `None` is the default of the scene.
///
/// # Errors
/// [`DemoSceneError::UnknownName`], whose message lists the names; [`DemoSceneError::TooLarge`];
/// [`DemoSceneError::NoSuchSize`].
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
