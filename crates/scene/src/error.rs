//! The errors of a scene.

use crate::camera::CameraError;
use thiserror::Error;

/// Why a change to a [`Scene`](crate::Scene) was refused. The scene is unchanged.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SceneError {
    /// The entity was despawned, or belongs to another scene.
    #[error(
        "{entity} is not in scene \"{scene}\": it was despawned or belongs to another scene; check with Scene::contains"
    )]
    UnknownEntity {
        /// The entity's key, and its name if known.
        entity: String,
        /// The scene's name.
        scene: String,
    },
    /// The scene does not contain this asset.
    #[error("{what} {key} of {entity} is not in scene \"{scene}\": add it to this scene first")]
    UnknownAsset {
        /// "mesh", "material" or "image".
        what: &'static str,
        /// The key.
        key: String,
        /// The user of the asset.
        entity: String,
        /// The scene's name.
        scene: String,
    },
    /// A number is NaN or infinite.
    #[error("the {what} of {entity} is not finite ({value}): give finite numbers")]
    NotFinite {
        /// The entity or asset.
        entity: String,
        /// The name of the number.
        what: &'static str,
        /// The numbers as given.
        value: String,
    },
    /// The new parent is the entity itself or one of its descendants.
    #[error(
        "{child} cannot become a child of {parent}, which is {child} itself or its descendant: that would be a cycle; re-parent {parent} first"
    )]
    Cycle {
        /// The entity to move.
        child: String,
        /// Its intended parent.
        parent: String,
    },
    /// The arrays of a mesh do not fit together.
    #[error("mesh \"{mesh}\", {part}: {problem}")]
    BadMesh {
        /// The mesh's name.
        mesh: String,
        /// Which of its geometries: "level 0", "proxy".
        part: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The number of an image's bytes does not match its size.
    #[error("image of {width} x {height} pixels needs {expected} bytes of RGBA and has {actual}")]
    BadImage {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Bytes needed.
        expected: u64,
        /// Bytes given.
        actual: usize,
    },
    /// The camera is invalid.
    #[error("the camera of {entity}: {source}")]
    BadCamera {
        /// The entity.
        entity: String,
        /// What is wrong with the camera.
        #[source]
        source: CameraError,
    },
    /// A number of the light is invalid.
    #[error("the light of {entity}: {problem}")]
    BadLight {
        /// The entity.
        entity: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The intensity of the environment is invalid.
    #[error(
        "the environment of scene \"{scene}\" has the intensity {intensity}: give a finite number, 0 or more"
    )]
    BadEnvironment {
        /// The scene's name.
        scene: String,
        /// The intensity as given.
        intensity: String,
    },
    /// The scene has as many entities as 32-bit slots can index.
    #[error("a scene holds at most {limit} entities: split it into several scenes")]
    Full {
        /// The greatest number of entities.
        limit: u32,
    },
}
