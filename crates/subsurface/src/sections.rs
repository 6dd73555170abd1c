//! The slices and lenses of one volume, and the bricks they share.

use std::sync::Arc;

use antumbra_scene::{EntityKey, Scene};
use glam::DVec3;

use crate::error::SubsurfaceError;
use crate::lens::{Lens, LensOptions};
use crate::slice::{Paged, Slice, SliceOptions};
use crate::volume::{Axis, BrickSource, Bricks, SampleBox};

/// The slices and lenses of one volume in a scene.
pub struct Sections {
    /// The slices.
    pub slices: Vec<Slice>,
    /// The lenses.
    pub lenses: Vec<Lens>,
    /// The volume's bricks in memory.
    pub bricks: Bricks,
}

/// Which slices and lenses to show.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SectionPlaces {
    /// Axis and index of each slice.
    pub slices: Vec<(Axis, u32)>,
    /// The box of each lens.
    pub lenses: Vec<SampleBox>,
}

impl SectionPlaces {
    /// Three slices across the middle of a volume, one along each axis, and no lens.
    #[must_use]
    pub fn middle(source: &dyn BrickSource) -> Self {
        let size = source.layout().size;
        Self {
            slices: Axis::ALL
                .into_iter()
                .map(|axis| (axis, axis.of(size).saturating_sub(1) / 2))
                .collect(),
            lenses: Vec::new(),
        }
    }
}

impl Sections {
    /// Puts slices and lenses into a scene; they are empty until they are [paged](Self::page). At most `budget` bytes of bricks are kept.
    ///
    /// # Errors
    /// Whatever [`Bricks::new`], [`Slice::spawn`] and [`Lens::spawn`] refuse.
    pub fn spawn(
        scene: &mut Scene,
        source: Arc<dyn BrickSource>,
        places: &SectionPlaces,
        budget: usize,
    ) -> Result<Self, SubsurfaceError> {
        let layout = *source.layout();
        let mut sections = Self {
            slices: Vec::with_capacity(places.slices.len()),
            lenses: Vec::with_capacity(places.lenses.len()),
            bricks: Bricks::new(source, budget)?,
        };
        for (axis, index) in &places.slices {
            let options = SliceOptions::default();
            let slice = Slice::spawn(scene, None, &layout, *axis, *index, &options)?;
            sections.slices.push(slice);
        }
        for area in &places.lenses {
            let options = LensOptions::default();
            let lens = Lens::spawn(scene, None, &layout, *area, &options)?;
            sections.lenses.push(lens);
        }
        Ok(sections)
    }

    /// Gives all that is not hidden and out of date its samples; the bricks of what is hidden are not read. What is hidden, last frame's
    /// verdicts know.
    ///
    /// # Errors
    /// As for [`Slice::page`] and [`Lens::page`].
    pub fn page(
        &mut self,
        scene: &mut Scene,
        is_hidden: &dyn Fn(EntityKey) -> bool,
    ) -> Result<Paged, SubsurfaceError> {
        let mut sum = Paged::default();
        let mut add = |paged: Paged| {
            sum.read += paged.read;
            sum.skipped += paged.skipped;
            sum.bricks += paged.bricks;
        };
        for slice in &mut self.slices {
            add(slice.page(scene, &mut self.bricks, is_hidden)?);
        }
        for lens in &mut self.lenses {
            let hidden = is_hidden(lens.entity());
            add(lens.page(scene, &mut self.bricks, hidden)?);
        }
        Ok(sum)
    }

    /// Turns the lenses' stacks towards an eye; whether any of them changed.
    ///
    /// # Errors
    /// As for [`Lens::face`].
    pub fn face(&mut self, scene: &mut Scene, eye: DVec3) -> Result<bool, SubsurfaceError> {
        let mut changed = false;
        for lens in &mut self.lenses {
            changed |= lens.face(scene, eye)?;
        }
        Ok(changed)
    }
}
