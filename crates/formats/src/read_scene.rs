//! The result of a reader, before the name of the file is added to its errors.

use crate::error::LoadProblem;
use crate::gltf::Attachment;
use antumbra_scene::Scene;
use antumbra_scene::animation::Animation;

/// A scene, and the attachments that were requested and found, each with the reason if it is invalid.
pub(crate) struct ReadScene {
    pub(crate) scene: Scene,
    pub(crate) animation: Option<Animation>,
    pub(crate) attachments: Vec<Result<Attachment, LoadProblem>>,
}
