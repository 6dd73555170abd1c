//! The cases: what each plays, by name.

use std::fmt;

/// A story the kit plays to a strategy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Case {
    /// Random scenes of all kinds of geometry and material, the camera moving a little each frame.
    RandomScenes,
    /// The camera jumps to the other side of a wall and looks back: what was hidden is in plain sight.
    Cut,
    /// The camera stands inside a room, which is one entity.
    InsideBox,
    /// An entity whose box reaches over the near plane while it lies in plain sight.
    NearPlane,
    /// A hidden entity goes, and a visible one takes its slot while an answer about the first is under way.
    SlotReuse,
    /// Entities move: out from behind a wall, in front of it, and into their mirror image.
    Motion,
    /// No entity; then one; then none again.
    Empty,
    /// Everything lies behind the camera.
    Behind,
    /// Entities of a tenth of a pixel and of half the sky.
    Sizes,
    /// More occludees than a query set has queries.
    Many,
    /// A scene that outgrows its buffers, its materials and its opacity while running.
    Outgrow,
    /// Flat boxes, triangles without area, entities without extent, twins in one place.
    Flat,
    /// The same input twice.
    Repeat,
    /// Nothing moves: late answers settle.
    Still,
    /// Two views of one scene, left and right.
    Stereo,
    /// Worlds of a millimetre and of a million kilometres, and one far from the origin.
    Worlds,
    /// Angles of view of a hundredth and of 179 degrees, near planes of a tenth of a millimetre and a kilometre, parallel views.
    Lenses,
    /// Walls that cover exactly, holes of one pixel, and dust that adds up to a surface.
    Gaps,
    /// A scene of your own, played by [`Kit::check_scene`](super::Kit::check_scene); not among [`Self::ALL`].
    Custom,
}

impl Case {
    /// All of the kit's own.
    pub const ALL: [Self; 18] = [
        Self::RandomScenes,
        Self::Cut,
        Self::InsideBox,
        Self::NearPlane,
        Self::SlotReuse,
        Self::Motion,
        Self::Empty,
        Self::Behind,
        Self::Sizes,
        Self::Many,
        Self::Outgrow,
        Self::Flat,
        Self::Repeat,
        Self::Still,
        Self::Stereo,
        Self::Worlds,
        Self::Lenses,
        Self::Gaps,
    ];

    /// Its name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::RandomScenes => "random scenes",
            Self::Cut => "camera cut",
            Self::InsideBox => "camera inside a box",
            Self::NearPlane => "box across the near plane",
            Self::SlotReuse => "slot reuse",
            Self::Motion => "moving entities",
            Self::Empty => "empty scene",
            Self::Behind => "everything behind the camera",
            Self::Sizes => "sub-pixel and screen-filling",
            Self::Many => "many occludees",
            Self::Outgrow => "outgrown buffers",
            Self::Flat => "flat boxes",
            Self::Repeat => "the same input twice",
            Self::Still => "still scene",
            Self::Stereo => "two views",
            Self::Worlds => "tiny and huge worlds",
            Self::Lenses => "narrow, wide and parallel views",
            Self::Gaps => "exact covers and small gaps",
            Self::Custom => "a scene of one's own",
        }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
