//! How wrong a frame is: pixels and entities against the reference's id buffer, FLIP against its
//! picture, and images that show a person where.
//!
//! An id buffer holds the entity id each pixel belongs to, row by row from the top left, and one
//! agreed id for the background.

use crate::MeasureError;

mod caption;
mod flip;
mod mark;
mod png;

pub use caption::{Panel, side_by_side};
pub use flip::{Flip, flip};
pub use mark::mark_wrong;
pub use png::save_png;

/// Which pixels of a frame differ from the reference.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct WrongPixels {
    /// How many.
    pub count: usize,
    /// Whether, a pixel; row by row from the top left.
    pub mask: Vec<bool>,
}

impl WrongPixels {
    /// The wrong pixels in percent of all; 0 for a frame without pixels.
    pub fn percent(&self) -> f64 {
        if self.mask.is_empty() {
            0.0
        } else {
            100.0 * self.count as f64 / self.mask.len() as f64
        }
    }
}

/// An entity and the number of pixels it owns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Owner {
    /// The entity's id as the buffer has it.
    pub id: u32,
    /// How many pixels show it; at least 1.
    pub pixels: u32,
}

/// Compares a frame's id buffer with the reference's, pixel by pixel.
///
/// # Errors
/// When the buffers differ in length.
pub fn wrong_pixels(reference_ids: &[u32], ids: &[u32]) -> Result<WrongPixels, MeasureError> {
    if reference_ids.len() != ids.len() {
        return Err(MeasureError::SizeMismatch {
            what: "id buffer",
            got: format!("{} pixels", ids.len()),
            expected: format!("{} pixels", reference_ids.len()),
        });
    }
    let mask: Vec<bool> = reference_ids.iter().zip(ids).map(|(a, b)| a != b).collect();
    let count = mask.iter().filter(|wrong| **wrong).count();
    Ok(WrongPixels { count, mask })
}

/// The entities that own a pixel, by ascending id; pixels of the `background` id belong to nobody.
pub fn owners(ids: &[u32], background: u32) -> Vec<Owner> {
    // Pixels of an entity lie in runs: counting runs first leaves little to sort.
    let mut runs: Vec<Owner> = Vec::new();
    for &id in ids.iter().filter(|id| **id != background) {
        match runs.last_mut() {
            Some(run) if run.id == id => run.pixels = run.pixels.saturating_add(1),
            _ => runs.push(Owner { id, pixels: 1 }),
        }
    }
    runs.sort_unstable_by_key(|run| run.id);
    runs.dedup_by(|next, kept| {
        let same = next.id == kept.id;
        if same {
            kept.pixels = kept.pixels.saturating_add(next.pixels);
        }
        same
    });
    runs
}

/// The false culls: owners of reference pixels that are not among `drawn`, ascending ids.
pub fn false_culls(reference: &[Owner], drawn: &[u32]) -> Vec<Owner> {
    debug_assert!(drawn.is_sorted(), "drawn ids ascend");
    reference
        .iter()
        .filter(|owner| drawn.binary_search(&owner.id).is_err())
        .copied()
        .collect()
}

/// How many of the `drawn` entities own no pixel of the reference; `reference` as [`owners`] gives
/// it.
pub fn overdrawn(reference: &[Owner], drawn: &[u32]) -> usize {
    drawn
        .iter()
        .filter(|id| {
            reference
                .binary_search_by_key(id, |owner| &owner.id)
                .is_err()
        })
        .count()
}
