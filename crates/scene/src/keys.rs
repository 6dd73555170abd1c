//! The keys of the scene's arenas. A key is generational: after its entity or asset is removed, the key stays
//! invalid, even when its slot is reused.

slotmap::new_key_type! {
    /// The key of an entity of a [`Scene`](crate::Scene).
    pub struct EntityKey;
    /// The key of a mesh of a [`Scene`](crate::Scene).
    pub struct MeshKey;
    /// The key of a material of a [`Scene`](crate::Scene).
    pub struct MaterialKey;
    /// The key of an image of a [`Scene`](crate::Scene).
    pub struct ImageKey;
}
