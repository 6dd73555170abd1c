//! Semi-transparent boxes inside a volume, which show its strong reflectors.
//!
//! The lenses are those of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific Applications*,
//! 2004: transparent, so they hide nothing, but they may be hidden. They are drawn as stacks of textured sections, back to front: Cabral, Cam,
//! Foran, *Accelerated Volume Rendering and Tomographic Reconstruction Using Texture Mapping Hardware*, 1994.

mod atlas;
mod stack;

use antumbra_scene::{Drawable, EntityKey, Scene, SceneError};
use glam::{DAffine3, DVec3};

use crate::error::SubsurfaceError;
use crate::slice::PagingReport;
use crate::volume::{Axis, BrickCache, ColourMap, SampleBox, VolumeLayout, amplitudes};
use atlas::Atlas;
use stack::Stack;

/// What a lens lets through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensOptions {
    /// What samples look like.
    pub colours: ColourMap,
    /// How much of what is behind a sample of the greatest amplitude covers, 0..1, over the shortest way from sample to sample. Sections that
    /// lie farther apart cover as much more.
    pub opacity: f32,
    /// The amplitude below which a sample is not seen, 0..1 of the greatest; from there on opacity grows with amplitude.
    pub threshold: f32,
    /// The longest side of an image, in pixels; boxes that do not fit lose sections and samples, evenly. 64 to 16384.
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

/// From which side a stack of sections is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct StackOrientation {
    /// The axis along which the sections lie behind each other.
    pub axis: Axis,
    /// The end of the axis on whose side the eye is. The section at the other end is the farthest and is drawn first.
    pub eye_side: AxisEnd,
}

/// An end of one of a volume's axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AxisEnd {
    /// The end with sample 0.
    First,
    /// The end with the last sample.
    Last,
}

/// A semi-transparent box of a volume: one entity that blends with what is behind it.
///
/// It has a stack of sections along each of the volume's axes and is drawn with one of them at a time, the one that [`Self::orient_to`] chose.
#[derive(Debug)]
pub struct Lens {
    entity: EntityKey,
    layout: VolumeLayout,
    area: SampleBox,
    stacks: [Stack; 3],
    facing: StackOrientation,
    /// The box in the images.
    shows: Option<SampleBox>,
}

impl Lens {
    /// Puts a lens into a scene. It is empty until [`Self::page`] fills it, and to be looked at from above until [`Self::orient_to`] is told where
    /// the eye is. `parent` is to be without a transform if the volume is to lie where its layout says.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`]; [`SubsurfaceError::Outside`] and [`SubsurfaceError::Empty`] for a box that is not within the volume;
    /// [`SubsurfaceError::Setting`] for options out of their range; [`SubsurfaceError::Scene`] for an unknown parent. No entity is left then.
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
        let furnished = furnish(scene, entity, layout, &area, options);
        let stacks = match furnished {
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
            facing: FIRST,
            shows: None,
        })
    }

    /// Its entity.
    #[must_use]
    pub fn entity(&self) -> EntityKey {
        self.entity
    }

    /// Its samples.
    #[must_use]
    pub fn area(&self) -> SampleBox {
        self.area
    }

    /// The stack that is drawn.
    #[must_use]
    pub fn orientation(&self) -> StackOrientation {
        self.facing
    }

    /// The bricks that hold its samples.
    pub fn bricks(&self) -> impl Iterator<Item = [u32; 3]> + use<> {
        self.area.bricks(&self.layout)
    }

    /// Draws the stack whose axis is nearest the line from the eye to the lens' middle, back to front as seen from the eye; whether that is
    /// another than before. A lens that changes counts as a new entity, one that does not is left alone. For an eye between two sections of a
    /// stack, those on the side of the lens' middle are in order.
    ///
    /// # Errors
    /// [`SubsurfaceError::Scene`] when the lens is no longer in the scene.
    pub fn orient_to(&mut self, scene: &mut Scene, eye: DVec3) -> Result<bool, SubsurfaceError> {
        let facing = self.facing_from(scene, eye)?;
        if facing == self.facing {
            return Ok(false);
        }
        let drawable = facing.axis.of(self.stacks.each_ref()).drawable(facing);
        scene.set_drawable(self.entity, drawable)?;
        self.facing = facing;
        Ok(true)
    }

    fn facing_from(&self, scene: &Scene, eye: DVec3) -> Result<StackOrientation, SubsurfaceError> {
        let world = scene.world(self.entity).ok_or_else(|| {
            let (entity, scene) = (scene.describe(self.entity), scene.name().to_owned());
            SceneError::UnknownEntity { entity, scene }
        })?;
        let eye = world.inverse().transform_point3(eye);
        let away = |axis| eye.normalize_or_zero().dot(normal(&self.layout, axis));
        // The axis stays unless another is clearly nearer: at a tie, rounding would otherwise choose anew every frame.
        let bonus = |axis| if axis == self.facing.axis { 1e-3 } else { 0.0 };
        let nearness = |axis: &Axis| away(*axis).abs() + bonus(*axis);
        let nearest = Axis::ALL
            .into_iter()
            .max_by(|a, b| nearness(a).total_cmp(&nearness(b)));
        let axis = nearest.unwrap_or(self.facing.axis);
        let side = away(axis);
        if side == 0.0 || side.is_nan() {
            return Ok(self.facing);
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

    /// Gives the lens its samples unless it is hidden or shows them already. The bricks of a hidden lens are not read, those of a shown one
    /// each once. [`PagingReport`] counts its images, one for each axis.
    ///
    /// # Errors
    /// [`SubsurfaceError::OtherVolume`] for bricks of another volume; what their source says; [`SubsurfaceError::Scene`] when the lens is no
    /// longer in the scene.
    pub fn page(
        &mut self,
        scene: &mut Scene,
        bricks: &mut BrickCache,
        is_hidden: &dyn Fn(EntityKey) -> bool,
    ) -> Result<PagingReport, SubsurfaceError> {
        self.layout.same_as(bricks.layout())?;
        let mut paged = PagingReport::default();
        if self.shows == Some(self.area) {
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
            for (stack, pixels) in stacks.iter().zip(&mut pixels) {
                (stack.atlas).fill(pixels, &stack.colours, area.min, (brick, edge, samples));
            }
        })?;
        for (stack, pixels) in self.stacks.iter().zip(pixels) {
            scene.set_image(stack.image, stack.atlas.image(pixels))?;
            paged.updated += 1;
        }
        self.shows = Some(self.area);
        paged.bricks_read = bricks.stats().read - before;
        Ok(paged)
    }

    /// Moves the lens, as large as it is, so that `min` is its first sample. It shows what it did until [`Self::page`] fills it again.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; [`SubsurfaceError::Scene`] when the lens is no longer in the scene. Nothing moves then.
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

    /// Takes the lens out of the scene. Its meshes, materials and images, which others might use, stay.
    pub fn remove(self, scene: &mut Scene) {
        scene.despawn(self.entity);
    }
}

/// What a new lens is drawn with.
const FIRST: StackOrientation = StackOrientation {
    axis: Axis::Time,
    eye_side: AxisEnd::First,
};

fn furnish(
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
    let first: Drawable = FIRST.axis.of(stacks.each_ref()).drawable(FIRST);
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
            let problem = "64 to 16384 is possible, and 4096 what any graphics card takes";
            return refuse("a lens' atlas_side", atlas_side.to_string(), problem);
        }
        Ok(())
    }

    /// The colour and opacity of every sample in a stack with sections every `spacing` samples.
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

/// The direction in which the sections along an axis follow each other, perpendicular to them.
fn normal(layout: &VolumeLayout, axis: Axis) -> DVec3 {
    let [right, down] = axis.plane().map(|along| along.of(layout.steps));
    let normal = right.normalize_or_zero().cross(down.normalize_or_zero());
    (normal * normal.dot(axis.of(layout.steps)).signum()).normalize_or_zero()
}

/// Where the middle of a box lies.
fn place(layout: &VolumeLayout, area: &SampleBox) -> DAffine3 {
    let [min, max] = [area.min, area.max].map(|end| DVec3::from(end.map(f64::from)));
    DAffine3::from_translation(layout.position(min.midpoint(max)))
}
