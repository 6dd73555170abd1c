//! Pipeline classes: what of an entity's mesh, material and transform decides which pipeline draws it.

use antumbra_scene::{AlphaMode, Topology};

use super::detail::MeshDetail;

/// What decides a pipeline ([`PipelineTraits`]), packed into an index below [`PipelineClass::COUNT`]. Sorts in drawing order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PipelineClass(u8);

/// The properties of a [`PipelineClass`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PipelineTraits {
    /// The mesh's topology.
    pub topology: Topology,
    /// The transform mirrors, so front faces are clockwise.
    pub mirrored: bool,
    /// The material draws back faces.
    pub double_sided: bool,
    /// The material's alpha mode.
    pub alpha: AlphaMode,
    /// The base colour comes from an image.
    pub textured: bool,
}

/// How a material's alpha is used, in drawing order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Alpha {
    /// Ignored.
    Opaque,
    /// Fragments below the cutoff are dropped.
    Mask,
    /// Blended over what lies behind.
    Blend,
}

impl PipelineClass {
    /// One more than the largest index.
    pub const COUNT: usize = 128;

    /// The class with these properties.
    pub fn new(traits: PipelineTraits) -> Self {
        let topology = match traits.topology {
            Topology::Triangles => 0,
            Topology::Lines => 1,
            Topology::Points => 2,
        };
        let alpha = match traits.alpha {
            AlphaMode::Opaque => 0,
            AlphaMode::Mask { .. } => 1,
            AlphaMode::Blend => 2,
        };
        Self(
            alpha << 5
                | u8::from(traits.textured) << 4
                | topology << 2
                | u8::from(traits.mirrored) << 1
                | u8::from(traits.double_sided),
        )
    }

    /// All classes, in drawing order.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT as u8).map(Self)
    }

    /// An index below [`PipelineClass::COUNT`].
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// How alpha is used.
    pub fn alpha(self) -> Alpha {
        match self.0 >> 5 {
            0 => Alpha::Opaque,
            1 => Alpha::Mask,
            _ => Alpha::Blend,
        }
    }

    /// The topology.
    pub fn topology(self) -> Topology {
        match self.0 >> 2 & 3 {
            0 => Topology::Triangles,
            1 => Topology::Lines,
            _ => Topology::Points,
        }
    }

    /// Whether the base colour comes from an image.
    pub fn textured(self) -> bool {
        self.0 & 0b1_0000 != 0
    }

    /// Whether front faces are clockwise.
    pub fn mirrored(self) -> bool {
        self.0 & 2 != 0
    }

    /// Whether back faces are drawn.
    pub fn double_sided(self) -> bool {
        self.0 & 1 != 0
    }

    /// Whether entities of this class may be occluders: opaque triangles only. What has holes or no surface hides nothing.
    pub fn occludes(self) -> bool {
        self.alpha() == Alpha::Opaque && self.topology() == Topology::Triangles
    }

    /// The class with which this class's entities are drawn in some detail: a box is made of triangles whatever it encloses.
    pub fn for_detail(self, detail: MeshDetail) -> Self {
        match detail {
            MeshDetail::Box => Self(self.0 & !0b1100),
            _ => self,
        }
    }
}
