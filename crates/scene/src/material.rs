//! Materials and images.

use crate::keys::ImageKey;

/// The appearance of a surface. The default is opaque white, rough, single-sided and lit.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// A name for messages; may be empty.
    pub name: String,
    /// Linear RGBA, 0..1, multiplied with the image and the vertex colours.
    pub base_colour: [f32; 4],
    /// An sRGB image, sampled with the mesh's texture coordinates.
    pub base_colour_image: Option<ImageKey>,
    /// The transform of texture coordinates, two rows: `u' = r0 . (u, v, 1)`, `v' = r1 . (u, v, 1)`.
    pub uv_transform: [[f32; 3]; 2],
    /// Metalness: 0 is a dielectric such as plastic or paint, 1 is bare metal, whose reflections have the base
    /// colour. Used only where the scene has an [`Environment`](crate::Environment).
    pub metallic: f32,
    /// Roughness: 0 is a mirror, 1 reflects equally from all sides. Used only where the scene has an
    /// [`Environment`](crate::Environment).
    pub roughness: f32,
    /// Linear RGB that the surface adds by itself, whatever light falls on it; 0 for none, more than 1 for a strong one.
    pub emission: [f32; 3],
    /// The meaning of alpha.
    pub alpha: AlphaMode,
    /// Whether back faces are drawn.
    pub double_sided: bool,
    /// Whether the surface ignores lights.
    pub unlit: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_colour: [1.0; 4],
            base_colour_image: None,
            uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            metallic: 0.0,
            roughness: 1.0,
            emission: [0.0; 3],
            alpha: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

/// The meaning of a material's alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// A sample is opaque if its alpha is at least `cutoff`, and absent otherwise.
    Mask {
        /// The least alpha of an opaque sample, 0..1.
        cutoff: f32,
    },
    /// Alpha blends with the background: the entity is an occludee only, never an occluder.
    Blend,
}

/// An image of 8-bit RGBA samples, sRGB-encoded, top row first.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// A name for messages; may be empty.
    pub name: String,
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
    /// How the image is sampled.
    pub sampler: Sampler,
}

/// How an image is sampled between and beyond its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Wrapping at the left and right border.
    pub wrap_u: Wrap,
    /// Wrapping at the upper and lower border.
    pub wrap_v: Wrap,
    /// The filter where one pixel of the image covers several pixels of the screen.
    pub magnify: Filter,
    /// The filter where one pixel of the screen covers several pixels of the image.
    pub minify: Filter,
    /// The filter between two mipmap levels; `None` for no mipmaps.
    pub mipmaps: Option<Filter>,
}

/// The wrapping of texture coordinates beyond an image's border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image repeats.
    #[default]
    Repeat,
    /// The image repeats, every other copy mirrored.
    Mirror,
    /// The border's pixels continue.
    Clamp,
}

/// A texture filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// Interpolation between the neighbouring pixels.
    #[default]
    Linear,
    /// The value of the nearest pixel.
    Nearest,
}
