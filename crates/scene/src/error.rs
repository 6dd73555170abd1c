//! What a scene refuses, and why.

use crate::camera::CameraError;
use thiserror::Error;

/// Why a change to a [`Scene`](crate::Scene) was refused. The scene is as it was before the call.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SceneError {
    /// The entity was despawned, or belongs to another scene.
    #[error(
        "{entity} is not in scene \"{scene}\": it was despawned or belongs to another scene; check with Scene::contains"
    )]
    UnknownEntity {
        /// The entity as far as it can be named.
        entity: String,
        /// The scene's name.
        scene: String,
    },
    /// An asset key that this scene does not hold.
    #[error("{what} {key} of {entity} is not in scene \"{scene}\": add it to this scene first")]
    UnknownAsset {
        /// "mesh", "material" or "image".
        what: &'static str,
        /// The key.
        key: String,
        /// Who wanted it.
        entity: String,
        /// The scene's name.
        scene: String,
    },
    /// A number that is NaN or infinite.
    #[error("the {what} of {entity} is not finite ({value}): only finite numbers are let in")]
    NotFinite {
        /// The entity or asset.
        entity: String,
        /// Which of its numbers.
        what: &'static str,
        /// The numbers as given.
        value: String,
    },
    /// The new parent is the entity itself or lies below it.
    #[error(
        "{child} cannot hang below {parent}, which hangs below {child}: that would be a cycle; re-parent {parent} first"
    )]
    Cycle {
        /// The entity that was to move.
        child: String,
        /// Its intended parent.
        parent: String,
    },
    /// A mesh whose numbers do not fit together.
    #[error("mesh \"{mesh}\", {part}: {problem}")]
    BadMesh {
        /// The mesh's name.
        mesh: String,
        /// Which of its geometries: "level 0", "proxy".
        part: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// An image whose pixels do not match its size.
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
    /// A camera that cannot look.
    #[error("the camera of {entity}: {source}")]
    BadCamera {
        /// The entity.
        entity: String,
        /// What is wrong with the camera.
        #[source]
        source: CameraError,
    },
    /// A light with a number that means nothing.
    #[error("the light of {entity}: {problem}")]
    BadLight {
        /// The entity.
        entity: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// An environment whose strength means nothing.
    #[error(
        "the environment of scene \"{scene}\" has the intensity {intensity}: give a finite number, 0 or more"
    )]
    BadEnvironment {
        /// The scene's name.
        scene: String,
        /// The intensity as given.
        intensity: String,
    },
    /// More entities than a 32-bit slot can name.
    #[error("a scene holds at most {limit} entities: split it into several scenes")]
    Full {
        /// The limit.
        limit: u32,
    },
}
