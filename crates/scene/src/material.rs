//! How a surface looks: one colour, perhaps an image, how it shines, and whether one can see through it.

use crate::keys::ImageKey;

/// A surface's look. The default is opaque white, dull, single-sided and lit.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// For people; may be empty.
    pub name: String,
    /// Linear RGBA, 0..1, multiplied with the image and the vertex colours.
    pub base_colour: [f32; 4],
    /// sRGB image looked up with the mesh's uvs.
    pub base_colour_image: Option<ImageKey>,
    /// Two rows of three: `u' = r0 . (u, v, 1)`, `v' = r1 . (u, v, 1)`.
    pub uv_transform: [[f32; 3]; 2],
    /// From 0, plastic or paint, to 1, bare metal, whose reflections have the base colour. Looked at where the scene has an
    /// [`Environment`](crate::Environment) to reflect.
    pub metallic: f32,
    /// From 0, a mirror, to 1, which reflects from all sides alike. Looked at where the scene has an
    /// [`Environment`](crate::Environment).
    pub roughness: f32,
    /// What alpha means.
    pub alpha: AlphaMode,
    /// Whether back faces are drawn.
    pub double_sided: bool,
    /// Whether lights are ignored.
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
            alpha: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

/// What a material's alpha means.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// A sample is there when its alpha is at least `cutoff`, else it is not.
    Mask {
        /// 0..1.
        cutoff: f32,
    },
    /// Alpha blends with what is behind: an occludee only, never an occluder.
    Blend,
}

/// A picture of 8-bit RGBA samples, sRGB-encoded, first row on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// For people; may be empty.
    pub name: String,
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
    /// How it is looked up.
    pub sampler: Sampler,
}

/// How an image is looked up between and beyond its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Beyond the left and right border.
    pub wrap_u: Wrap,
    /// Beyond the upper and lower border.
    pub wrap_v: Wrap,
    /// When a pixel of the image covers several of the screen.
    pub magnify: Filter,
    /// When a pixel of the screen covers several of the image.
    pub minify: Filter,
    /// Whether smaller copies of the image are used, and how two of them are mixed.
    pub mipmaps: Option<Filter>,
}

/// What lies beyond an image's border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image again, mirrored.
    Mirror,
    /// The border's pixels.
    Clamp,
}

/// How values between pixels are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// Mixed from the neighbours.
    #[default]
    Linear,
    /// The nearest one's.
    Nearest,
}
