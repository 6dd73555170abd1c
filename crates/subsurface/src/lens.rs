//! Lenses: semi-transparent boxes inside a volume that show its strong reflectors.
//!
//! The lenses are those of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in
//! Geo-Scientific Applications*, 2004. They are transparent, so they occlude nothing, but they may be occluded. They
//! are drawn as stacks of textured sections, back to front: Cabral, Cam, Foran, *Accelerated Volume Rendering and
//! Tomographic Reconstruction Using Texture Mapping Hardware*, 1994.

mod atlas;
mod orientation;
mod stack;

pub use orientation::{AxisEnd, StackOrientation};

use antumbra_scene::{Drawable, EntityKey, Scene, SceneError};
use glam::{DAffine3, DVec3};

use crate::error::SubsurfaceError;
use crate::paging::PagingReport;
use crate::volume::{Axis, BrickCache, ColourMap, SampleBox, VolumeLayout, amplitudes};
use atlas::{Atlas, BrickSamples};
use stack::Stack;

/// The transfer function and the resolution of a lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensOptions {
    /// The colours of samples.
    pub colours: ColourMap,
    /// The opacity of a sample of the greatest amplitude, 0..1, over the shortest distance between two samples. It is
    /// corrected for the distance between the sections.
    pub opacity: f32,
    /// The amplitude below which a sample is invisible, as a fraction 0..1 of the greatest. Above it opacity grows
    /// with amplitude.
    pub threshold: f32,
    /// The greatest side of an image in pixels, 64 to 16384. Boxes that do not fit lose sections and samples, evenly.
    pub atlas_side: u32,
}

impl Default for LensOptions {
    fn default() -> Self {
        Self {
            colours: ColourMap::default(),
            opacity: 0.4,
            threshold: 0.2,
            atlas_side: 4096,
        }
    }
}

/// A semi-transparent box of a volume: one entity that blends with the background.
///
/// It has a stack of sections along each of the volume's axes. One stack is drawn at a time, chosen by
/// [`Self::orient_to`].
#[derive(Debug)]
pub struct Lens {
    entity: EntityKey,
    layout: VolumeLayout,
    area: SampleBox,
    stacks: [Stack; 3],
    orientation: StackOrientation,
    /// The box of samples in the images; `None` before the first fill.
    shown_area: Option<SampleBox>,
}

impl Lens {
    /// Adds a lens to a scene. It is empty until [`Self::page`] fills it, and oriented to an eye above it until
    /// [`Self::orient_to`] is called. `parent` should have no transform if the volume is to be at the position of its
    /// layout.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`]; [`SubsurfaceError::Outside`] and [`SubsurfaceError::Empty`] for a box that is
    /// not within the volume; [`SubsurfaceError::Setting`] for options out of range; [`SubsurfaceError::Scene`] for
    /// an unknown parent. After an error the scene has no new entity.
    pub fn spawn(
        scene: &mut Scene,
        parent: Option<EntityKey>,
        layout: &VolumeLayout,
        area: SampleBox,
        options: &LensOptions,
    ) -> Result<Self, SubsurfaceError> {
        layout.validate()?;
        area.check("a lens", layout)?;
        options.check()?;
        let entity = scene.spawn(parent, place(layout, &area))?;
        let stacks = add_stacks(scene, entity, layout, &area, options);
        let stacks = match stacks {
            Ok(stacks) => stacks,
            Err(error) => {
                scene.despawn(entity);
                return Err(error);
            }
        };
        Ok(Self {
            entity,
            layout: *layout,
            area,
            stacks,
            orientation: INITIAL,
            shown_area: None,
        })
    }

    /// The lens's entity.
    #[must_use]
    pub fn entity(&self) -> EntityKey {
        self.entity
    }

    /// The box of samples.
    #[must_use]
    pub fn area(&self) -> SampleBox {
        self.area
    }

    /// The stack that is drawn, and its order.
    #[must_use]
    pub fn orientation(&self) -> StackOrientation {
        self.orientation
    }

    /// The bricks that contain the lens's samples.
    pub fn bricks(&self) -> impl Iterator<Item = [u32; 3]> + use<> {
        self.area.bricks(&self.layout)
    }

    /// Chooses the stack whose axis is nearest to the line from the eye to the lens's centre, and draws it back to
    /// front for this eye. Returns whether the stack or its order has changed. A lens that changes counts as a new
    /// entity. If the eye is between two sections of a stack, the sections on the side of the lens's centre are in
    /// order.
    ///
    /// # Errors
    /// [`SubsurfaceError::Scene`] if the lens is no longer in the scene.
    pub fn orient_to(&mut self, scene: &mut Scene, eye: DVec3) -> Result<bool, SubsurfaceError> {
        let orientation = self.orientation_from(scene, eye)?;
        if orientation == self.orientation {
            return Ok(false);
        }
        let drawable = orientation
            .axis
            .of(self.stacks.each_ref())
            .drawable(orientation);
        scene.set_drawable(self.entity, drawable)?;
        self.orientation = orientation;
        Ok(true)
    }

    fn orientation_from(
        &self,
        scene: &Scene,
        eye: DVec3,
    ) -> Result<StackOrientation, SubsurfaceError> {
        let world = scene.world(self.entity).ok_or_else(|| {
            let (entity, scene) = (scene.describe(self.entity), scene.name().to_owned());
            SceneError::UnknownEntity { entity, scene }
        })?;
        let eye = world.inverse().transform_point3(eye);
        let away = |axis| eye.normalize_or_zero().dot(normal(&self.layout, axis));
        // The axis changes only if another is clearly nearer. At a tie, rounding would otherwise change it every
        // frame.
        let bonus = |axis| {
            if axis == self.orientation.axis {
                1e-3
            } else {
                0.0
            }
        };
        let nearness = |axis: &Axis| away(*axis).abs() + bonus(*axis);
        let nearest = Axis::ALL
            .into_iter()
            .max_by(|a, b| nearness(a).total_cmp(&nearness(b)));
        let axis = nearest.unwrap_or(self.orientation.axis);
        let side = away(axis);
        if side == 0.0 || side.is_nan() {
            return Ok(self.orientation);
        }
        Ok(StackOrientation {
            axis,
            eye_side: if side < 0.0 {
                AxisEnd::First
            } else {
                AxisEnd::Last
            },
        })
    }

    /// Fills the lens's images with its samples, unless the lens is hidden or up to date. The bricks of a hidden lens
    /// are not read. Those of a visible one are read once each. [`PagingReport`] counts images, one per axis.
    ///
    /// # Errors
    /// [`SubsurfaceError::OtherVolume`] for bricks of another volume; the errors of their source;
    /// [`SubsurfaceError::Scene`] if the lens is no longer in the scene.
    pub fn page(
        &mut self,
        scene: &mut Scene,
        bricks: &mut BrickCache,
        is_hidden: &dyn Fn(EntityKey) -> bool,
    ) -> Result<PagingReport, SubsurfaceError> {
        self.layout.same_as(bricks.layout())?;
        let mut paged = PagingReport::default();
        if self.shown_area == Some(self.area) {
            return Ok(paged);
        }
        if is_hidden(self.entity) {
            paged.skipped = self.stacks.len();
            return Ok(paged);
        }
        let before = bricks.stats().read;
        let wanted: Vec<_> = self.bricks().collect();
        let mut pixels = (self.stacks.each_ref()).map(|stack| stack.atlas.blank());
        let (stacks, area, edge) = (&self.stacks, self.area, self.layout.brick);
        bricks.visit(&wanted, |brick, samples| {
            let brick = BrickSamples {
                brick,
                edge,
                samples,
            };
            for (stack, pixels) in stacks.iter().zip(&mut pixels) {
                (stack.atlas).fill(pixels, &stack.colours, area.min, &brick);
            }
        })?;
        for (stack, pixels) in self.stacks.iter().zip(pixels) {
            scene.set_image(stack.image, stack.atlas.image(pixels))?;
            paged.updated += 1;
        }
        self.shown_area = Some(self.area);
        paged.bricks_read = bricks.stats().read - before;
        Ok(paged)
    }

    /// Moves the lens so that `min` is its first sample. Its size stays. It shows the old samples until
    /// [`Self::page`] fills it again.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; [`SubsurfaceError::Scene`] if the lens is no longer in the scene. After an error
    /// the lens has not moved.
    pub fn move_to(&mut self, scene: &mut Scene, min: [u32; 3]) -> Result<(), SubsurfaceError> {
        let from = self.area;
        let area = SampleBox {
            min,
            max: std::array::from_fn(|i| min[i].saturating_add(from.max[i] - from.min[i])),
        };
        area.check("a lens", &self.layout)?;
        scene.set_local(self.entity, place(&self.layout, &area))?;
        self.area = area;
        Ok(())
    }

    /// Removes the lens from the scene. Its meshes, materials and images stay, since other entities may use them.
    pub fn remove(self, scene: &mut Scene) {
        scene.despawn(self.entity);
    }
}

/// The orientation of a new lens.
const INITIAL: StackOrientation = StackOrientation {
    axis: Axis::Time,
    eye_side: AxisEnd::First,
};

fn add_stacks(
    scene: &mut Scene,
    entity: EntityKey,
    layout: &VolumeLayout,
    area: &SampleBox,
    options: &LensOptions,
) -> Result<[Stack; 3], SubsurfaceError> {
    scene.set_entity_name(entity, "lens")?;
    let mut stack = |axis| {
        let atlas = Atlas::new(axis, area.samples(), options.atlas_side);
        let colours = options.table(layout, axis, atlas.spacing());
        Stack::add(scene, layout, area, atlas, colours)
    };
    let stacks = [
        stack(Axis::Inline)?,
        stack(Axis::Crossline)?,
        stack(Axis::Time)?,
    ];
    let first: Drawable = INITIAL.axis.of(stacks.each_ref()).drawable(INITIAL);
    scene.set_drawable(entity, first)?;
    Ok(stacks)
}

impl LensOptions {
    fn check(&self) -> Result<(), SubsurfaceError> {
        let refuse = |what, value: String, problem: &str| {
            let problem = problem.into();
            Err(SubsurfaceError::Setting {
                what,
                value,
                problem,
            })
        };
        let Self {
            opacity,
            threshold,
            atlas_side,
            ..
        } = *self;
        if !(0.0..=1.0).contains(&opacity) {
            return refuse("a lens' opacity", opacity.to_string(), "0 to 1 is possible");
        }
        if !(0.0..1.0).contains(&threshold) {
            let problem = "0 to less than 1 is possible";
            return refuse("a lens' threshold", threshold.to_string(), problem);
        }
        if !(64..=16384).contains(&atlas_side) {
            let problem = "64 to 16384 is possible; any graphics card supports 4096";
            return refuse("a lens' atlas_side", atlas_side.to_string(), problem);
        }
        Ok(())
    }

    /// The RGBA colour of every sample in a stack with sections every `spacing` samples.
    fn table(&self, layout: &VolumeLayout, axis: Axis, spacing: f64) -> [[u8; 4]; 256] {
        let lengths = layout.steps.map(DVec3::length);
        let shortest = lengths.into_iter().fold(f64::INFINITY, f64::min);
        let steps = axis.of(lengths) * spacing / shortest;
        let (opacity, threshold) = (f64::from(self.opacity), f64::from(self.threshold));
        let colours = self.colours.table(layout);
        let strengths = amplitudes(layout);
        std::array::from_fn(|sample| {
            let [red, green, blue] = colours[sample];
            let strength = ((strengths[sample] - threshold) / (1.0 - threshold)).max(0.0);
            let alpha = 1.0 - (1.0 - opacity * strength).max(0.0).powf(steps);
            [red, green, blue, (alpha * 255.0).round() as u8]
        })
    }
}

/// The unit normal of the sections along an axis, in the direction of increasing index.
fn normal(layout: &VolumeLayout, axis: Axis) -> DVec3 {
    let [right, down] = axis.plane().map(|along| along.of(layout.steps));
    let normal = right.normalize_or_zero().cross(down.normalize_or_zero());
    (normal * normal.dot(axis.of(layout.steps)).signum()).normalize_or_zero()
}

/// The transform to the centre of a box.
fn place(layout: &VolumeLayout, area: &SampleBox) -> DAffine3 {
    let [min, max] = [area.min, area.max].map(|end| DVec3::from(end.map(f64::from)));
    DAffine3::from_translation(layout.position(min.midpoint(max)))
}
