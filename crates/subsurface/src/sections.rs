//! The slices and lenses of one volume, and the bricks they share.

use std::sync::Arc;

use antumbra_scene::{EntityKey, Scene};
use glam::DVec3;

use crate::error::SubsurfaceError;
use crate::lens::{Lens, LensOptions};
use crate::paging::PagingReport;
use crate::slice::{Slice, SliceOptions};
use crate::volume::{Axis, BrickCache, BrickSource, SampleBox};

/// The slices and lenses of one volume in a scene.
pub struct VolumeSections {
    /// The slices.
    pub slices: Vec<Slice>,
    /// The lenses.
    pub lenses: Vec<Lens>,
    /// The cache of the volume's bricks.
    pub bricks: BrickCache,
}

/// The positions of slices and lenses.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SectionPositions {
    /// The position of each slice.
    pub slices: Vec<SlicePosition>,
    /// The box of samples of each lens.
    pub lenses: Vec<SampleBox>,
}

/// Where a slice cuts a volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SlicePosition {
    /// The axis that the slice is perpendicular to.
    pub axis: Axis,
    /// The sample along that axis, counted from 0.
    pub index: u32,
}

impl SectionPositions {
    /// Three slices through the centre of a volume, one along each axis, and no lens.
    #[must_use]
    pub fn middle(source: &dyn BrickSource) -> Self {
        let size = source.layout().size;
        Self {
            slices: Axis::ALL
                .into_iter()
                .map(|axis| SlicePosition {
                    axis,
                    index: axis.of(size).saturating_sub(1) / 2,
                })
                .collect(),
            lenses: Vec::new(),
        }
    }
}

impl VolumeSections {
    /// Adds slices and lenses to a scene. They are empty until they are [paged](Self::page). At most `budget` bytes
    /// of bricks are kept in memory.
    ///
    /// # Errors
    /// As for [`BrickCache::new`], [`Slice::spawn`] and [`Lens::spawn`].
    pub fn spawn(
        scene: &mut Scene,
        source: Arc<dyn BrickSource>,
        places: &SectionPositions,
        budget: usize,
    ) -> Result<Self, SubsurfaceError> {
        let layout = *source.layout();
        let mut sections = Self {
            slices: Vec::with_capacity(places.slices.len()),
            lenses: Vec::with_capacity(places.lenses.len()),
            bricks: BrickCache::new(source, budget)?,
        };
        for SlicePosition { axis, index } in &places.slices {
            let options = SliceOptions::for_volume(&layout);
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

    /// Fills every tile and lens that is neither hidden nor up to date. The bricks of hidden ones are not read.
    /// `is_hidden` is typically answered by the verdicts of the previous frame.
    ///
    /// # Errors
    /// As for [`Slice::page`] and [`Lens::page`].
    pub fn page(
        &mut self,
        scene: &mut Scene,
        is_hidden: &dyn Fn(EntityKey) -> bool,
    ) -> Result<PagingReport, SubsurfaceError> {
        let mut sum = PagingReport::default();
        let mut add = |paged: PagingReport| {
            sum.updated += paged.updated;
            sum.skipped += paged.skipped;
            sum.bricks_read += paged.bricks_read;
        };
        for slice in &mut self.slices {
            add(slice.page(scene, &mut self.bricks, is_hidden)?);
        }
        for lens in &mut self.lenses {
            add(lens.page(scene, &mut self.bricks, is_hidden)?);
        }
        Ok(sum)
    }

    /// Orients the lenses' stacks to an eye. Returns whether any of them has changed.
    ///
    /// # Errors
    /// As for [`Lens::orient_to`].
    pub fn orient_to(&mut self, scene: &mut Scene, eye: DVec3) -> Result<bool, SubsurfaceError> {
        let mut changed = false;
        for lens in &mut self.lenses {
            changed |= lens.orient_to(scene, eye)?;
        }
        Ok(changed)
    }
}
