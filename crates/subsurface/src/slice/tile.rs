//! A tile of a slice: a quad with an image.

use std::ops::Range;

use antumbra_scene::{Drawable, EntityKey, Geometry, ImageKey, Material, Mesh, Scene};
use glam::{DAffine3, DVec3};

use crate::error::SubsurfaceError;
use crate::image::clamped_image;
use crate::volume::{Axis, UNKNOWN, VolumeLayout};

/// A tile of a slice: an entity with two triangles and an image. It extends half a sample beyond its samples on every
/// side, so that there is no gap to its neighbours, but ends at the volume's last sample.
#[derive(Debug)]
pub struct SliceTile {
    pub(super) entity: EntityKey,
    pub(super) image: ImageKey,
    pub(super) area: [Range<u32>; 2],
    /// The index of the section in the image; `None` before the first fill.
    pub(super) shown: Option<u32>,
}

impl SliceTile {
    /// Adds a tile as a child of a slice's entity, which is at the section's first sample.
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
        let image = scene.add_image(clamped_image([1, 1], vec![red, green, blue, u8::MAX]))?;
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
            shown: None,
        })
    }

    /// The tile's entity.
    #[must_use]
    pub fn entity(&self) -> EntityKey {
        self.entity
    }

    /// The tile's image.
    #[must_use]
    pub fn image(&self) -> ImageKey {
        self.image
    }

    /// The tile's samples to the right and down, along the axes of [`Axis::plane`].
    #[must_use]
    pub fn area(&self) -> [Range<u32>; 2] {
        self.area.clone()
    }

    /// The index of the section in the tile's image; `None` before the first fill.
    #[must_use]
    pub fn shown_section(&self) -> Option<u32> {
        self.shown
    }
}

/// The ends of a tile along an axis.
struct Ends {
    /// Positions in samples.
    place: [f64; 2],
    /// Texture coordinates. The centres of the image's pixels are the samples.
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
