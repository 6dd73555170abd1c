//! The ways in which a hierarchy is built.

use std::fmt;
use std::str::FromStr;

/// The source of a hierarchy's inner nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HierarchyShape {
    /// The scene's groups.
    Groups,
    /// A bounding volume hierarchy over all leaves, without regard to groups.
    Bvh,
    /// The scene's groups. Groups with more than [`HierarchyShape::MAX_UNDIVIDED`] members are divided by bounding
    /// volume hierarchies.
    #[default]
    Divided,
}

impl HierarchyShape {
    /// All shapes.
    pub const ALL: [Self; 3] = [Self::Groups, Self::Bvh, Self::Divided];
    /// The words for the shapes, in the order of [`Self::ALL`].
    pub const WORDS: &[&str] = &["groups", "boxes", "divided"];
    /// The greatest number of members of a group that is not divided.
    pub const MAX_UNDIVIDED: usize = 16;

    /// The word for the shape in settings and messages.
    pub fn word(self) -> &'static str {
        match self {
            Self::Groups => "groups",
            Self::Bvh => "boxes",
            Self::Divided => "divided",
        }
    }
}

impl fmt::Display for HierarchyShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for HierarchyShape {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let mut all = Self::ALL.into_iter();
        all.find(|shape| shape.word() == text).ok_or(())
    }
}
