//! A lens's sections along one axis as meshes, one per drawing order.

use antumbra_scene::{
    AlphaMode, Drawable, Geometry, ImageKey, Material, MaterialKey, Mesh, MeshKey, Scene,
};
use glam::{DMat3, DVec3};

use super::atlas::Atlas;
use super::orientation::{AxisEnd, StackOrientation};
use crate::error::SubsurfaceError;
use crate::image::clamped_image;
use crate::volume::{SampleBox, VolumeLayout};

/// A stack of sections that share an image.
#[derive(Debug)]
pub(super) struct Stack {
    pub(super) atlas: Atlas,
    /// The RGBA colour of every sample.
    pub(super) colours: [[u8; 4]; 256],
    pub(super) image: ImageKey,
    material: MaterialKey,
    /// The sections from the first to the last.
    upwards: MeshKey,
    /// The sections from the last to the first.
    downwards: MeshKey,
}

impl Stack {
    /// Adds the stack's meshes, relative to the box's centre, and a transparent image.
    pub(super) fn add(
        scene: &mut Scene,
        layout: &VolumeLayout,
        area: &SampleBox,
        atlas: Atlas,
        colours: [[u8; 4]; 256],
    ) -> Result<Self, SubsurfaceError> {
        let name = format!("lens along the {} axis", atlas.axis());
        let image = scene.add_image(clamped_image([1, 1], vec![0; 4]))?;
        let material = scene.add_material(Material {
            name: name.clone(),
            base_colour_image: Some(image),
            alpha: AlphaMode::Blend,
            double_sided: true,
            unlit: true,
            ..Material::default()
        });
        let upwards = sections(layout, area, &atlas);
        let downwards = Geometry {
            indices: (upwards.indices.rchunks_exact(6).flatten().copied()).collect(),
            ..upwards.clone()
        };
        let mut mesh = |geometry, order: &str| {
            scene.add_mesh(Mesh {
                name: format!("{name}, {order}"),
                levels: vec![geometry],
                proxy: Some(bounding_box(layout, area)),
            })
        };
        Ok(Self {
            upwards: mesh(upwards, "first to last")?,
            downwards: mesh(downwards, "last to first")?,
            atlas,
            colours,
            image,
            material,
        })
    }

    /// The drawable for an orientation.
    pub(super) fn drawable(&self, orientation: StackOrientation) -> Drawable {
        let mesh = match orientation.eye_side {
            AxisEnd::First => self.downwards,
            AxisEnd::Last => self.upwards,
        };
        let material = self.material;
        Drawable { mesh, material }
    }
}

/// A function from positions in the box, in samples from its first, to metres from its centre.
fn from_centre(layout: &VolumeLayout, area: &SampleBox) -> impl Fn(DVec3) -> [f32; 3] {
    let [x, y, z] = layout.steps;
    let steps = DMat3::from_cols(x, y, z);
    let middle = last(area) / 2.0;
    move |place| (steps * (place - middle)).as_vec3().to_array()
}

/// The box's last sample, counted from its first.
fn last(area: &SampleBox) -> DVec3 {
    DVec3::from(area.samples().map(|count| f64::from(count) - 1.0))
}

/// Two triangles per section, from the first section to the last.
fn sections(layout: &VolumeLayout, area: &SampleBox, atlas: &Atlas) -> Geometry {
    let axis = atlas.axis();
    let metres = from_centre(layout, area);
    let ends = axis.plane().map(|along| along.of(last(area).to_array()));
    let mut geometry = Geometry::default();
    for (number, at) in atlas.sections().iter().enumerate() {
        let corners = atlas.corners(number);
        let first = geometry.positions.len() as u32;
        for [u, v] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
            let place = axis.place(f64::from(*at), [ends[0] * u as f64, ends[1] * v as f64]);
            geometry.positions.push(metres(DVec3::from(place)));
            geometry.uvs.push([corners[u][0], corners[v][1]]);
        }
        let quad = [0, 1, 2, 0, 2, 3].map(|corner| first + corner);
        geometry.indices.extend(quad);
    }
    geometry
}

/// The twelve triangles of the lens's box, which need not be axis-aligned.
fn bounding_box(layout: &VolumeLayout, area: &SampleBox) -> Geometry {
    let metres = from_centre(layout, area);
    let last = last(area);
    let unit = Geometry::from_box(&antumbra_scene::Aabb {
        min: DVec3::ZERO,
        max: DVec3::ONE,
    });
    let mut indices = unit.indices;
    let [x, y, z] = layout.steps;
    if x.cross(y).dot(z) < 0.0 {
        // The volume's axes are left-handed. The triangles are reversed, so that they face outwards.
        indices
            .as_chunks_mut::<3>()
            .0
            .iter_mut()
            .for_each(|corners| corners.reverse());
    }
    Geometry {
        positions: (unit.positions.iter())
            .map(|corner| metres(DVec3::from(corner.map(f64::from)) * last))
            .collect(),
        indices,
        ..Geometry::default()
    }
}
