//! The four handles of the arenas. A key is generational: once its entity or asset is gone, the key
//! answers "unknown" for ever, even when its slot is used again.

slotmap::new_key_type! {
    /// Names an entity of a [`Scene`](crate::Scene).
    pub struct EntityKey;
    /// Names a mesh of a [`Scene`](crate::Scene).
    pub struct MeshKey;
    /// Names a material of a [`Scene`](crate::Scene).
    pub struct MaterialKey;
    /// Names an image of a [`Scene`](crate::Scene).
    pub struct ImageKey;
}
