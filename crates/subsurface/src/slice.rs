//! Opaque sections through a volume, cut into tiles that get their samples only when somebody sees them.
//!
//! The slices are those of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific Applications*,
//! 2004: few polygons, so they hide what is behind them and are drawn without a test. That the bricks of hidden parts are not read is what the
//! paper plans as its next step.

mod tile;

pub use tile::SliceTile;

use antumbra_scene::{EntityKey, Image, Sampler, Scene, Wrap};
use glam::{DAffine3, DVec3};

use crate::error::SubsurfaceError;
use crate::volume::{Axis, BrickCache, ColourMap, SampleBox, VolumeLayout};

/// The longest side of a tile's image, in pixels: more than any graphics card must take.
const MAX_TILE_SIDE: u32 = 4096;

/// How a slice is cut and what its samples look like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SliceOptions {
    /// Bricks along a side of a tile.
    pub tile_bricks: u32,
    /// What samples look like.
    pub colours: ColourMap,
}

impl Default for SliceOptions {
    fn default() -> Self {
        Self {
            tile_bricks: 2,
            colours: ColourMap::default(),
        }
    }
}

/// What a call to page did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PagingReport {
    /// Images that got their samples.
    pub updated: usize,
    /// Images that are out of date and stay so, since nobody sees them.
    pub skipped: usize,
    /// Bricks that had to be read for it; others were in memory.
    pub bricks_read: u64,
}

/// An opaque section through a volume: an entity with a tile below it for every few bricks.
///
/// The tiles hide what is behind them and are not tested for visibility ([`Scene::set_tested`]).
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
    /// Puts a slice into a scene, at `index` along `axis`. Its tiles show one plain colour until [`Self::page`] fills them. `parent` is to be
    /// without a transform if the volume is to lie where its layout says.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`]; [`SubsurfaceError::Outside`] for a section that the volume does not have; [`SubsurfaceError::Setting`]
    /// for tiles of no brick or more than 4096 samples a side; [`SubsurfaceError::Scene`] for an unknown parent. The scene is as before then.
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
        let entity = scene.spawn(parent, place(layout, axis, index))?;
        let mut slice = Self {
            entity,
            layout: *layout,
            axis,
            index,
            colours: options.colours.table(layout),
            tiles: Vec::new(),
        };
        match slice.furnish(scene, side) {
            Ok(()) => Ok(slice),
            Err(error) => {
                scene.despawn(entity);
                Err(error)
            }
        }
    }

    fn furnish(&mut self, scene: &mut Scene, side: u32) -> Result<(), SubsurfaceError> {
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

    /// The entity above the tiles.
    #[must_use]
    pub fn entity(&self) -> EntityKey {
        self.entity
    }

    /// The axis along which the slice has a fixed place.
    #[must_use]
    pub fn axis(&self) -> Axis {
        self.axis
    }

    /// Its place along that axis.
    #[must_use]
    pub fn index(&self) -> u32 {
        self.index
    }

    /// Its tiles, row after row.
    #[must_use]
    pub fn tiles(&self) -> &[SliceTile] {
        &self.tiles
    }

    /// The bricks that hold a tile's samples.
    pub fn bricks(&self, tile: &SliceTile) -> impl Iterator<Item = [u32; 3]> + use<> {
        let [right, down] = &tile.area;
        let area = SampleBox {
            min: self.axis.place(self.index, [right.start, down.start]),
            max: self.axis.place(self.index, [right.end - 1, down.end - 1]),
        };
        area.bricks(&self.layout)
    }

    /// Moves the slice along its axis. Its tiles show what they did until [`Self::page`] fills them again.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; [`SubsurfaceError::Scene`] when it is no longer in the scene. Nothing moves then.
    pub fn move_to(&mut self, scene: &mut Scene, index: u32) -> Result<(), SubsurfaceError> {
        check(&self.layout, self.axis, index)?;
        scene.set_local(self.entity, place(&self.layout, self.axis, index))?;
        self.index = index;
        scene.set_entity_name(self.entity, self.name())?;
        Ok(())
    }

    /// Gives the tiles that are not hidden their samples, unless they show them already. The bricks of hidden tiles are not read.
    ///
    /// # Errors
    /// [`SubsurfaceError::OtherVolume`] for bricks of another volume; what their source says; [`SubsurfaceError::Scene`] when the slice is no
    /// longer in the scene. Tiles before the one that failed are filled.
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
            if tile.shows == Some(index) {
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
            let image = picture(size, pixels.collect::<Vec<_>>().into_flattened());
            scene.set_image(tile.image, image)?;
            tile.shows = Some(index);
            paged.updated += 1;
        }
        paged.bricks_read = bricks.stats().read - before;
        Ok(paged)
    }

    /// Takes the slice out of the scene. Its meshes, materials and images, which others might use, stay.
    pub fn remove(self, scene: &mut Scene) {
        scene.despawn(self.entity);
    }

    fn name(&self) -> String {
        format!("{} slice {}", self.axis, self.index)
    }
}

/// Pixels as an image that does not go on beyond its border.
pub(crate) fn picture([width, height]: [u32; 2], rgba: Vec<u8>) -> Image {
    Image {
        name: String::new(),
        width,
        height,
        rgba,
        sampler: Sampler {
            wrap_u: Wrap::Clamp,
            wrap_v: Wrap::Clamp,
            ..Sampler::default()
        },
    }
}

fn check(layout: &VolumeLayout, axis: Axis, index: u32) -> Result<(), SubsurfaceError> {
    let section = SampleBox {
        min: axis.place(index, [0; 2]),
        max: axis.place(index, [0; 2]),
    };
    section.check(&format!("{axis} slice {index}"), layout)
}

/// Where the first sample of a section lies.
fn place(layout: &VolumeLayout, axis: Axis, index: u32) -> DAffine3 {
    let first = DVec3::from(axis.place(f64::from(index), [0.0; 2]));
    DAffine3::from_translation(layout.position(first))
}
