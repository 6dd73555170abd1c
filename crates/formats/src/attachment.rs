//! What somebody else keeps in a scene's file, and only they understand: an extension of the whole glTF, by name.

use antumbra_scene::EntityKey;
use serde_json::{Map, Value};

/// An extension of a whole glTF whose meaning is somebody else's: facts as JSON, bulk data as bytes, and the entities that both
/// speak of. [`save_glb_with_attachments`](crate::save_glb_with_attachments) writes it, [`load_with_attachments`](crate::load_with_attachments) reads it back.
///
/// In the file, `extensions` of the glTF has an object of this name: the properties, an array `nodes` with the entities' nodes, and where there are
/// bytes a `bufferView`. The name stands in `extensionsUsed` and is not required, so that every other reader shows the scene without it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attachment {
    /// The extension's name; by custom a prefix in capital letters, an underscore, and what it is.
    pub name: String,
    /// Entities of the scene.
    pub entities: Vec<EntityKey>,
    /// Small things. Numbers that must come back to the last bit belong to the bytes. [`NODES`](Self::NODES) and
    /// [`BUFFER_VIEW`](Self::BUFFER_VIEW) are no names for any of them.
    pub properties: Map<String, Value>,
    /// Large things; they begin at a multiple of four bytes in the file.
    pub bytes: Vec<u8>,
}

impl Attachment {
    /// The fact that names the entities' nodes in a file.
    pub const NODES: &'static str = "nodes";
    /// The fact that names the buffer view of the bytes in a file.
    pub const BUFFER_VIEW: &'static str = "bufferView";
}
