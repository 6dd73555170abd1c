//! Slices: opaque sections through a volume, cut into tiles that are filled only when they are visible.
//!
//! The slices are those of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in
//! Geo-Scientific Applications*, 2004. They have few polygons, so they serve as occluders and are drawn without a
//! test. The paper plans as its next step that the bricks of hidden parts are not read.

mod tile;

pub use tile::SliceTile;

use antumbra_scene::{EntityKey, Scene};
use glam::{DAffine3, DVec3};

use crate::error::SubsurfaceError;
use crate::image::clamped_image;
use crate::paging::PagingReport;
use crate::volume::{Axis, BrickCache, ColourMap, SampleBox, VolumeLayout};

/// The greatest side of a tile's image in pixels. It is within what any graphics card supports.
const MAX_TILE_SIDE: u32 = 4096;

/// The most tiles of a slice. Each is an entity with a mesh, a material and an image, some 6 KB.
const MAX_TILES: u64 = 1 << 14;

/// The tiles and the colours of a slice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SliceOptions {
    /// Bricks along a side of a tile.
    pub tile_bricks: u32,
    /// The colours of samples.
    pub colours: ColourMap,
}

/// Samples along a side of a tile that is worth an entity of its own.
const TILE_SIDE: u32 = 64;

impl SliceOptions {
    /// The default, with more bricks a tile where a volume's bricks are small.
    #[must_use]
    pub fn for_volume(layout: &VolumeLayout) -> Self {
        let usual = Self::default();
        Self {
            tile_bricks: usual
                .tile_bricks
                .max(TILE_SIDE.div_ceil(layout.brick.max(1))),
            ..usual
        }
    }
}

impl Default for SliceOptions {
    fn default() -> Self {
        Self {
            tile_bricks: 2,
            colours: ColourMap::default(),
        }
    }
}

/// An opaque section through a volume: an entity with a child tile for every few bricks.
///
/// The tiles occlude, and are not tested for visibility ([`Scene::set_tested`]).
#[derive(Debug)]
pub struct Slice {
    entity: EntityKey,
    layout: VolumeLayout,
    axis: Axis,
    index: u32,
    colours: [[u8; 3]; 256],
    tiles: Vec<SliceTile>,
}

impl Slice {
    /// Adds a slice to a scene, at `index` along `axis`. Its tiles have one plain colour until [`Self::page`] fills
    /// them. `parent` should have no transform if the volume is to be at the position of its layout.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`], also for a slice of more than 16,384 tiles; [`SubsurfaceError::Outside`] for a
    /// section outside the volume; [`SubsurfaceError::Setting`] for tiles of no brick or more than 4096 samples a side;
    /// [`SubsurfaceError::Scene`] for an unknown parent. After an error the scene has no new entity.
    pub fn spawn(
        scene: &mut Scene,
        parent: Option<EntityKey>,
        layout: &VolumeLayout,
        axis: Axis,
        index: u32,
        options: &SliceOptions,
    ) -> Result<Self, SubsurfaceError> {
        layout.validate()?;
        check(layout, axis, index)?;
        let side = options.tile_bricks.saturating_mul(layout.brick);
        if side == 0 || side > MAX_TILE_SIDE {
            let most = MAX_TILE_SIDE / layout.brick;
            return Err(SubsurfaceError::Setting {
                what: "the bricks along a tile of a slice",
                value: options.tile_bricks.to_string(),
                problem: format!(
                    "with bricks of {} samples, 1 to {most} are possible",
                    layout.brick
                ),
            });
        }
        let tiles = axis
            .plane()
            .map(|along| u64::from(along.of(layout.size).div_ceil(side)));
        let [right, down] = tiles;
        if right * down > MAX_TILES {
            return Err(SubsurfaceError::BadLayout {
                problem: format!(
                    "with bricks of {} samples an edge a slice has {right} x {down} tiles of {} bricks, and {MAX_TILES} are the most: write the volume with larger bricks",
                    layout.brick, options.tile_bricks
                ),
            });
        }
        let entity = scene.spawn(parent, place(layout, axis, index))?;
        let mut slice = Self {
            entity,
            layout: *layout,
            axis,
            index,
            colours: options.colours.table(layout),
            tiles: Vec::new(),
        };
        match slice.add_tiles(scene, side) {
            Ok(()) => Ok(slice),
            Err(error) => {
                scene.despawn(entity);
                Err(error)
            }
        }
    }

    fn add_tiles(&mut self, scene: &mut Scene, side: u32) -> Result<(), SubsurfaceError> {
        scene.set_entity_name(self.entity, self.name())?;
        let [right, down] = self.axis.plane().map(|along| {
            let size = along.of(self.layout.size);
            let starts = (0..size).step_by(side as usize);
            starts.map(move |start| start..size.min(start + side))
        });
        for down in down {
            for right in right.clone() {
                let area = [right, down.clone()];
                let tile = SliceTile::spawn(scene, self.entity, &self.layout, self.axis, area)?;
                self.tiles.push(tile);
            }
        }
        Ok(())
    }

    /// The parent entity of the tiles.
    #[must_use]
    pub fn entity(&self) -> EntityKey {
        self.entity
    }

    /// The axis that the slice is perpendicular to.
    #[must_use]
    pub fn axis(&self) -> Axis {
        self.axis
    }

    /// The slice's sample index along the axis.
    #[must_use]
    pub fn index(&self) -> u32 {
        self.index
    }

    /// The tiles, row by row.
    #[must_use]
    pub fn tiles(&self) -> &[SliceTile] {
        &self.tiles
    }

    /// The bricks that contain a tile's samples.
    pub fn bricks(&self, tile: &SliceTile) -> impl Iterator<Item = [u32; 3]> + use<> {
        let [right, down] = &tile.area;
        let area = SampleBox {
            min: self.axis.place(self.index, [right.start, down.start]),
            max: self.axis.place(self.index, [right.end - 1, down.end - 1]),
        };
        area.bricks(&self.layout)
    }

    /// Moves the slice along its axis. Its tiles show the old samples until [`Self::page`] fills them again.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; [`SubsurfaceError::Scene`] if the slice is no longer in the scene. After an
    /// error the slice has not moved.
    pub fn move_to(&mut self, scene: &mut Scene, index: u32) -> Result<(), SubsurfaceError> {
        check(&self.layout, self.axis, index)?;
        scene.set_local(self.entity, place(&self.layout, self.axis, index))?;
        self.index = index;
        scene.set_entity_name(self.entity, self.name())?;
        Ok(())
    }

    /// Fills the tiles that are neither hidden nor up to date. The bricks of hidden tiles are not read.
    ///
    /// # Errors
    /// [`SubsurfaceError::OtherVolume`] for bricks of another volume; the errors of their source;
    /// [`SubsurfaceError::Scene`] if the slice is no longer in the scene. Tiles before the failed one are filled.
    pub fn page(
        &mut self,
        scene: &mut Scene,
        bricks: &mut BrickCache,
        is_hidden: &dyn Fn(EntityKey) -> bool,
    ) -> Result<PagingReport, SubsurfaceError> {
        self.layout.same_as(bricks.layout())?;
        let before = bricks.stats().read;
        let mut paged = PagingReport::default();
        let (axis, index) = (self.axis, self.index);
        for tile in &mut self.tiles {
            if tile.shown == Some(index) {
                continue;
            }
            if is_hidden(tile.entity) {
                paged.skipped += 1;
                continue;
            }
            let [right, down] = &tile.area;
            let mut samples = vec![0; right.len() * down.len()];
            bricks.section(axis, index, tile.area.clone(), &mut samples)?;
            let pixels = samples.iter().map(|sample| {
                let [red, green, blue] = self.colours[usize::from(*sample)];
                [red, green, blue, u8::MAX]
            });
            let size = [right.len() as u32, down.len() as u32];
            let image = clamped_image(size, pixels.collect::<Vec<_>>().into_flattened());
            scene.set_image(tile.image, image)?;
            tile.shown = Some(index);
            paged.updated += 1;
        }
        paged.bricks_read = bricks.stats().read - before;
        Ok(paged)
    }

    /// Removes the slice from the scene. Its meshes, materials and images stay, since other entities may use them.
    pub fn remove(self, scene: &mut Scene) {
        scene.despawn(self.entity);
    }

    fn name(&self) -> String {
        format!("{} slice {}", self.axis, self.index)
    }
}

fn check(layout: &VolumeLayout, axis: Axis, index: u32) -> Result<(), SubsurfaceError> {
    let section = SampleBox {
        min: axis.place(index, [0; 2]),
        max: axis.place(index, [0; 2]),
    };
    section.check(&format!("{axis} slice {index}"), layout)
}

/// The transform to the first sample of a section.
fn place(layout: &VolumeLayout, axis: Axis, index: u32) -> DAffine3 {
    let first = DVec3::from(axis.place(f64::from(index), [0.0; 2]));
    DAffine3::from_translation(layout.position(first))
}
