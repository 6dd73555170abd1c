//! The error type of the built-in scenes.

use crate::names::NAMES;
use antumbra_scene::SceneError;
use std::ops::RangeInclusive;
use thiserror::Error;

/// The reason why a built-in scene cannot be built.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DemoSceneError {
    /// No built-in scene has this name.
    #[error("there is no built-in scene \"{name}\"; there are: {}", NAMES.join(", "))]
    UnknownName {
        /// The requested name.
        name: String,
    },
    /// The scene would have too many entities.
    #[error("a {name} of size {size} has more entities than {max_entities}; ask for a smaller one")]
    TooLarge {
        /// The scene.
        name: &'static str,
        /// The requested size.
        size: u32,
        /// The maximum number of entities.
        max_entities: u64,
    },
    /// The scene does not exist in this size.
    #[error("there is no {name} of size {size}; its sizes are {} to {}", sizes.start(), sizes.end())]
    NoSuchSize {
        /// The scene.
        name: &'static str,
        /// The requested size.
        size: u32,
        /// The valid sizes.
        sizes: RangeInclusive<u32>,
    },
    /// The scene rejected an entity, mesh or image.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
