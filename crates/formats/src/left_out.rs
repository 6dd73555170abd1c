//! What a load left out of the scene: parts by their kind and the reason, counted, with the first of each by name.
//!
//! A reader that can go on without a part says so here. Nothing is left out in silence.

use antumbra_files::words;
use std::fmt;

/// The most pairs of kind and reason that are kept apart. Reasons may quote the file, which could have any number.
const MOST_LOSSES: usize = 64;
/// The reason of a kind's losses beyond them.
const OTHER_REASONS: &str = "other reasons";
/// The most parts of a loss that are named.
const MOST_EXAMPLES: usize = 8;
/// The most characters of a reason or an example.
const MOST_CHARACTERS: usize = 160;

/// A kind of part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum LostPart {
    /// An entity with nothing to see, such as one of size zero.
    Entity,
    /// A whole geometry of a kind that is not read.
    Geometry,
    /// A polygon, a line or a triangle.
    Face,
    /// A point or a vertex.
    Point,
    /// An element, a statement or an extension that is not known.
    Element,
    /// A motion; without it the scene is in its rest pose.
    Animation,
    /// A part of a motion: what moves one property of one node.
    Channel,
    /// A skin; its mesh has the pose in which it was bound.
    Skin,
    /// A level of detail.
    Level,
    /// A library of materials, or a material.
    Material,
    /// An image.
    Image,
    /// A list of texture coordinates, normals or colours.
    Attribute,
    /// What makes a surface look richer and changes no shape and no base colour: maps of normals, occlusion or metalness, clear coats.
    Shading,
}

impl LostPart {
    /// The kind's name for this many.
    #[must_use]
    pub fn name(self, count: u64) -> &'static str {
        let [one, many] = match self {
            Self::Entity => ["entity", "entities"],
            Self::Geometry => ["geometry", "geometries"],
            Self::Face => ["face", "faces"],
            Self::Point => ["point", "points"],
            Self::Element => ["element", "elements"],
            Self::Animation => ["animation", "animations"],
            Self::Channel => ["animation channel", "animation channels"],
            Self::Skin => ["skin", "skins"],
            Self::Level => ["level of detail", "levels of detail"],
            Self::Material => ["material", "materials"],
            Self::Image => ["image", "images"],
            Self::Attribute => ["vertex attribute", "vertex attributes"],
            Self::Shading => ["shading detail", "shading details"],
        };
        if count == 1 { one } else { many }
    }
}

/// Parts of one kind that were left out for one reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// Their kind.
    pub part: LostPart,
    /// The reason, a few words.
    pub reason: String,
    /// Their number.
    pub count: u64,
    /// The first of them, each with its place in the file.
    pub examples: Vec<String>,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.part.name(self.count);
        write!(f, "{} {name} ({})", self.count, self.reason)
    }
}

/// All that a load left out, by kind and reason.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    losses: Vec<Loss>,
}

impl LeftOut {
    /// Whether nothing was left out.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.losses.is_empty()
    }

    /// The losses, by kind and then by reason.
    #[must_use]
    pub fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// The losses of all kinds but [`LostPart::Shading`]: those that a strict load refuses.
    pub(crate) fn without_shading(&self) -> Self {
        let losses = self.losses.iter();
        let more = losses.filter(|loss| loss.part != LostPart::Shading);
        Self {
            losses: more.cloned().collect(),
        }
    }

    /// Adds one part.
    pub(crate) fn add(&mut self, part: LostPart, reason: &str, example: &str) {
        self.add_many(part, reason, 1, example);
    }

    /// Adds parts, of which the first is named.
    pub(crate) fn add_many(&mut self, part: LostPart, reason: &str, count: u64, example: &str) {
        if count == 0 {
            return;
        }
        let reason = words::short(reason, MOST_CHARACTERS);
        let key = |loss: &Loss| (loss.part, loss.reason.clone());
        let place = self
            .losses
            .binary_search_by_key(&(part, reason.clone()), key);
        let place = match place {
            Ok(place) => place,
            Err(_) if self.losses.len() >= MOST_LOSSES && reason != OTHER_REASONS => {
                return self.add_many(part, OTHER_REASONS, count, example);
            }
            Err(place) => {
                let loss = Loss {
                    part,
                    reason,
                    count: 0,
                    examples: Vec::new(),
                };
                self.losses.insert(place, loss);
                place
            }
        };
        if let Some(loss) = self.losses.get_mut(place) {
            loss.count = loss.count.saturating_add(count);
            if loss.examples.len() < MOST_EXAMPLES {
                loss.examples.push(words::short(example, MOST_CHARACTERS));
            }
        }
    }
}

/// The losses in one line, without the examples.
impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, loss) in self.losses.iter().enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            write!(f, "{comma}{loss}")?;
        }
        Ok(())
    }
}
