//! Attachments: extensions of a whole glTF that other code defines.

use antumbra_scene::EntityKey;
use serde_json::{Map, Value};

/// An extension of a whole glTF that other code defines: properties as JSON, bulk data as bytes, and the entities
/// that both refer to. [`save_glb_with_attachments`](crate::save_glb_with_attachments) writes it,
/// [`load_with_attachments`](crate::load_with_attachments) reads it.
///
/// In the file, the object `extensions` of the glTF has a member with this name. It contains the properties, an array
/// `nodes` with the nodes of the entities, and a `bufferView` if there are bytes. The name is listed in
/// `extensionsUsed` but not in `extensionsRequired`, so other readers show the scene without it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attachment {
    /// The extension's name: by convention a prefix in capital letters, an underscore, and a word.
    pub name: String,
    /// Entities of the scene.
    pub entities: Vec<EntityKey>,
    /// Small data as JSON. Numbers that must be exact to the last bit belong in `bytes`. The names
    /// [`NODES`](Self::NODES) and [`BUFFER_VIEW`](Self::BUFFER_VIEW) are reserved.
    pub properties: Map<String, Value>,
    /// Large data. In the file they begin at a multiple of four bytes.
    pub bytes: Vec<u8>,
}

impl Attachment {
    /// The reserved property with the nodes of the entities.
    pub const NODES: &'static str = "nodes";
    /// The reserved property with the buffer view of the bytes.
    pub const BUFFER_VIEW: &'static str = "bufferView";
}
