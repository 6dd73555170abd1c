//! The cases that the kit plays, and their names.

use std::fmt;

/// A story that the kit plays to a strategy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Case {
    /// Random scenes with all kinds of geometry and material; the camera moves a little each frame.
    RandomScenes,
    /// The camera jumps to the other side of a wall and looks back: what was hidden is now visible.
    Cut,
    /// The camera stands inside a room, which is one entity.
    InsideBox,
    /// A visible entity whose box crosses the near plane.
    NearPlane,
    /// A hidden entity is removed, and a visible one takes its slot while an answer about the first is on its way.
    SlotReuse,
    /// Entities move: out from behind a wall, in front of it, and into their mirror image.
    Motion,
    /// No entity, then one, then none again.
    Empty,
    /// Everything is behind the camera.
    Behind,
    /// Entities as small as a tenth of a pixel and as large as half the sky.
    Sizes,
    /// More occludees than a query set has queries.
    Many,
    /// A scene that outgrows its buffers, and gets its first new materials and transparent entities, while it runs.
    Outgrow,
    /// Flat boxes, triangles without area, entities without extent, coplanar twins.
    Flat,
    /// The same input twice.
    Repeat,
    /// Nothing moves: late answers settle.
    Still,
    /// Two views of one scene, left and right.
    Stereo,
    /// Two views of different projections: one in perspective, one parallel.
    Projections,
    /// A view that gets larger, then smaller, while the camera moves.
    Resize,
    /// Worlds of a millimetre and of a million kilometres, and one far from the origin.
    Worlds,
    /// Fields of view of a hundredth of a degree and of 179 degrees, near planes at a tenth of a millimetre and at a kilometre, orthographic views.
    Lenses,
    /// Walls that cover exactly, holes of one pixel, and grains that add up to a closed surface.
    Gaps,
    /// A scene of the caller, played by [`Kit::check_scene`](super::Kit::check_scene); not in [`Self::ALL`].
    Custom,
}

impl Case {
    /// All cases that bring their own scene, in the order in which the default kit plays them.
    pub const ALL: [Self; 20] = [
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
        Self::Projections,
        Self::Resize,
        Self::Worlds,
        Self::Lenses,
        Self::Gaps,
    ];

    /// The cases that are played in [other setups](super::OtherSetups::Brief): what they may break.
    pub const BRIEF: [Self; 5] = [
        Self::RandomScenes,
        Self::Cut,
        Self::Still,
        Self::Projections,
        Self::Resize,
    ];

    /// The case with this name, as messages write it; `None` for another text.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|case| case.name() == name)
    }

    /// The name in messages.
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
            Self::Projections => "two projections",
            Self::Resize => "resized view",
            Self::Worlds => "tiny and huge worlds",
            Self::Lenses => "narrow, wide and parallel views",
            Self::Gaps => "exact covers and small gaps",
            Self::Custom => "custom scene",
        }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
