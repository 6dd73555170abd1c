//! One tile of a slice: a quad with an image of its own.

use std::ops::Range;

use antumbra_scene::{Drawable, EntityKey, Geometry, ImageKey, Material, Mesh, Scene};
use glam::{DAffine3, DVec3};

use super::picture;
use crate::error::SubsurfaceError;
use crate::volume::{Axis, UNKNOWN, VolumeLayout};

/// A piece of a slice: an entity with two triangles and an image. It takes up half a sample more than its samples to every side, so that no gap
/// is left to its neighbours, but ends with the volume's last sample.
#[derive(Debug)]
pub struct SliceTile {
    pub(super) entity: EntityKey,
    pub(super) image: ImageKey,
    pub(super) area: [Range<u32>; 2],
    /// The section in the image.
    pub(super) shows: Option<u32>,
}

impl SliceTile {
    /// Puts a tile below a slice's entity, which stands at the section's first sample.
    pub(super) fn spawn(
        scene: &mut Scene,
        slice: EntityKey,
        layout: &VolumeLayout,
        axis: Axis,
        area: [Range<u32>; 2],
    ) -> Result<Self, SubsurfaceError> {
        let [right, down] = axis.plane().map(|along| along.of(layout.steps));
        let [across, along] = axis.plane().map(|along| along.of(layout.size));
        let [across, along] = [ends(&area[0], across), ends(&area[1], along)];
        let middle = right * across.middle() + down * along.middle();
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let geometry = Geometry {
            positions: (corners.iter())
                .map(|[u, v]| {
                    let corner: DVec3 = right * across.place[*u] + down * along.place[*v] - middle;
                    corner.as_vec3().to_array()
                })
                .collect(),
            uvs: (corners.iter())
                .map(|[u, v]| [across.in_image[*u], along.in_image[*v]])
                .collect(),
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Geometry::default()
        };
        let name = format!("{axis} slice tile {},{}", area[0].start, area[1].start);
        let [red, green, blue] = UNKNOWN;
        let image = scene.add_image(picture([1, 1], vec![red, green, blue, u8::MAX]))?;
        let material = scene.add_material(Material {
            name: name.clone(),
            base_colour_image: Some(image),
            double_sided: true,
            unlit: true,
            ..Material::default()
        });
        let mesh = scene.add_mesh(Mesh::new(name.clone(), geometry))?;
        let entity = scene.spawn(Some(slice), DAffine3::from_translation(middle))?;
        scene.set_entity_name(entity, name)?;
        scene.set_drawable(entity, Drawable { mesh, material })?;
        scene.set_tested(entity, false)?;
        Ok(Self {
            entity,
            image,
            area,
            shows: None,
        })
    }

    /// Its entity.
    #[must_use]
    pub fn entity(&self) -> EntityKey {
        self.entity
    }

    /// Its image.
    #[must_use]
    pub fn image(&self) -> ImageKey {
        self.image
    }

    /// Its samples to the right and down, along the axes of [`Axis::plane`].
    #[must_use]
    pub fn area(&self) -> [Range<u32>; 2] {
        self.area.clone()
    }

    /// The section that its image shows; `None` before it was filled.
    #[must_use]
    pub fn shown_section(&self) -> Option<u32> {
        self.shows
    }
}

/// Where a tile begins and ends along an axis.
struct Ends {
    /// In samples.
    place: [f64; 2],
    /// In parts of the image, whose pixels' middles are the samples.
    in_image: [f32; 2],
}

impl Ends {
    fn middle(&self) -> f64 {
        f64::midpoint(self.place[0], self.place[1])
    }
}

fn ends(samples: &Range<u32>, size: u32) -> Ends {
    let start = f64::from(samples.start);
    let place = [
        (start - 0.5).max(0.0),
        (f64::from(samples.end) - 0.5).min(f64::from(size - 1)),
    ];
    let count = f64::from(samples.end) - start;
    Ends {
        place,
        in_image: place.map(|at| ((at - start + 0.5) / count) as f32),
    }
}
