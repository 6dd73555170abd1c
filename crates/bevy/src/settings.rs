//! What a camera is told, and what it tells.

use bevy::prelude::*;

/// On a camera: leave out what is hidden behind something else. Each camera has its own answers.
///
/// The camera needs no prepass, and may have any number of samples. What it draws is what hides: the depth of its opaque pass, or, where [`Self::occluders`] says so, meshes that are tagged. The answers come
/// a frame or more later, so that pixels may be wrong where a moving camera, or a moving occluder, uncovers something; [`Budget`] says how many may be.
#[derive(Component, Reflect, Debug, Clone, PartialEq)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
#[require(Camera3d, CullingReport)]
pub struct AntumbraCulling {
    /// How to cull.
    pub strategy: Strategy,
    /// What hides.
    pub occluders: Occluders,
    /// How many pixels may be wrong while the camera moves.
    pub budget: Budget,
    /// How often wrong pixels are counted.
    pub audit: Audit,
    /// Keeps the answers of the last frame, so that the camera can be flown away to look at what is culled.
    pub frozen: bool,
    /// Whether point and spot lights whose whole reach is hidden are left out, with their shadow maps. Each camera that has the light in view must ask for that, and find it hidden.
    pub lights: bool,
    /// Incremented by [`Self::cut`].
    pub cuts: u32,
}

impl Default for AntumbraCulling {
    fn default() -> Self {
        Self {
            strategy: Strategy::default(),
            occluders: Occluders::default(),
            budget: Budget::default(),
            audit: Audit::default(),
            frozen: false,
            lights: false,
            cuts: 0,
        }
    }
}

impl AntumbraCulling {
    /// Says that the camera jumps in this frame: nothing that was known is used. A jump that is far for what is near to the camera is noticed without.
    pub fn cut(&mut self) {
        self.cuts = self.cuts.wrapping_add(1);
    }
}

/// How a camera culls.
#[derive(Reflect, Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum Strategy {
    /// Not at all: Bevy's lists stay as they are, and nothing is tested.
    Off,
    /// By the newest test that has come back from the GPU, of an earlier frame.
    #[default]
    FrameLate,
}

/// What hides others from a camera. Boxes alone never do.
#[derive(Reflect, Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum Occluders {
    /// What the camera draws: the depth of its opaque pass.
    #[default]
    Depth,
    /// Meshes with [`Occluder`](crate::Occluder), which are drawn into a depth for this alone, with one sample a pixel. For cameras whose depth cannot be read: those that draw into a part of their target, and those
    /// with several samples on OpenGL. It costs a pass over the tagged meshes.
    Tagged,
}

/// How many pixels may be wrong while the camera moves. What is hidden must be so by some pixels, and the more these are, the less is uncovered before new answers arrive.
#[derive(Reflect, Debug, Clone, Copy, PartialEq)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub enum Budget {
    /// Always as many pixels on all sides, at rest too: 0 to [`Budget::MOST_SHIFT`], and at least 1 where samples are not those of the depth, for the camera jitters or tagged occluders hide.
    Shift(f32),
    /// As many, on the side that the camera uncovers as it goes, and an eighth of them on the others, as keep the wrong pixels below this share of the image in percent, as the [`Audit`] counts them. Without an audit it stays at [`Budget::FIRST_SHIFT`].
    WrongPixels(f32),
}

impl Budget {
    /// The pixels that a budget of wrong pixels begins with.
    pub const FIRST_SHIFT: f32 = 32.0;
    /// The most that it comes to. Where even that is too little, nothing is culled while the camera moves.
    pub const MOST_SHIFT: f32 = 128.0;
}

impl Default for Budget {
    fn default() -> Self {
        Self::WrongPixels(0.02)
    }
}

/// How often wrong pixels are counted: what was culled and turned out not to be hidden in that very frame is drawn against a copy of its depth, and its samples are counted.
#[derive(Reflect, Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum Audit {
    /// Never.
    Off,
    /// Every so many frames.
    Every(u32),
}

impl Default for Audit {
    fn default() -> Self {
        Self::Every(8)
    }
}

/// On a camera with [`AntumbraCulling`]: what the last frame came to.
#[derive(Component, Reflect, Debug, Clone, PartialEq, Default)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CullingReport {
    /// Meshes that are drawn.
    pub drawn: u32,
    /// Meshes in the frustum that are left out, sorted.
    pub culled: Vec<Entity>,
    /// Lights in view whose reach is hidden from this camera, where it asks for that.
    pub lights: u32,
    /// How many frames old the answers are; `None` where there are none, and everything is drawn.
    pub age: Option<u32>,
    /// The pixels by which what is left out was hidden, on the side that the camera uncovers; 0 where nothing is known. For a camera at rest, with a budget of wrong pixels: 0, or 1 where it jitters or tagged
    /// occluders hide.
    pub shift: f32,
    /// The wrong pixels of the last frame that was audited, in percent of the image: those that a mesh would have changed which was left out. Exact for opaque, one-sided meshes that stand still and are not bent; with
    /// [`Occluders::Tagged`] it may be too high, as it knows of no other occluders.
    pub wrong: Option<f32>,
    /// Frames that were audited.
    pub audits: u32,
    /// Why this camera does not cull, where it cannot.
    pub fault: Option<String>,
}
