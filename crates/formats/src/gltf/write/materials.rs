//! Materials, textures and images of a written file. Each is added on first use.

use super::binary::Binary;
use super::error::SaveProblem;
use super::json::{
    self, EmissiveStrength, Empty, MaterialExtensions, Pbr, TextureExtensions, TextureInfo,
    TextureTransform,
};
use ::image::codecs::png::PngEncoder;
use ::image::{ExtendedColorType, ImageEncoder};
use antumbra_scene::{
    AlphaMode, Filter, Image, ImageKey, Material, MaterialKey, Sampler, Scene, Wrap,
};
use std::collections::HashMap;

/// The materials, textures, images and samplers that have been added.
#[derive(Default)]
pub(super) struct MaterialTable<'a> {
    pub(super) materials: Vec<json::Material<'a>>,
    pub(super) textures: Vec<json::Texture>,
    pub(super) images: Vec<json::Image<'a>>,
    pub(super) samplers: Vec<json::Sampler>,
    known_materials: HashMap<MaterialKey, u32>,
    known_images: HashMap<ImageKey, u32>,
    known_samplers: HashMap<Sampler, u32>,
}

impl<'a> MaterialTable<'a> {
    /// The index of a scene's material in the file.
    pub(super) fn material(
        &mut self,
        scene: &'a Scene,
        key: MaterialKey,
        binary: &mut Binary<'_>,
    ) -> Result<Option<u32>, SaveProblem> {
        if let Some(known) = self.known_materials.get(&key) {
            return Ok(Some(*known));
        }
        let Some(source) = scene.material(key) else {
            return Ok(None);
        };
        let bad = |problem: String| SaveProblem::BadMaterial {
            material: source.name.clone(),
            problem,
        };
        if source.base_colour.iter().any(|c| !c.is_finite()) {
            let colour = source.base_colour;
            return Err(bad(format!(
                "its base colour is {colour:?}; give finite numbers"
            )));
        }
        let shine = [
            ("metallic", source.metallic),
            ("roughness", source.roughness),
        ];
        if let Some((what, value)) = shine.iter().find(|(_, value)| !value.is_finite()) {
            return Err(bad(format!(
                "its {what} is {value}; give a number from 0 to 1"
            )));
        }
        let emission = source.emission;
        if emission
            .iter()
            .any(|light| !(light.is_finite() && *light >= 0.0))
        {
            return Err(bad(format!(
                "its emission is {emission:?}; give finite numbers from 0 on"
            )));
        }
        // Factors go to 1, and a strength beyond.
        let strength = emission.into_iter().fold(1.0, f32::max);
        let (alpha_mode, alpha_cutoff) = match source.alpha {
            AlphaMode::Opaque => (None, None),
            AlphaMode::Mask { cutoff } if !cutoff.is_finite() => {
                return Err(bad(format!(
                    "its cutoff is {cutoff}; give a number from 0 to 1"
                )));
            }
            AlphaMode::Mask { cutoff } => (Some("MASK"), Some(cutoff)),
            AlphaMode::Blend => (Some("BLEND"), None),
        };
        let image = source.base_colour_image;
        let image = image.and_then(|key| Some((key, scene.image(key)?)));
        let texture = match image {
            // A PNG has at least one pixel, so an empty image is left out.
            Some((key, image)) if !image.rgba.is_empty() => Some(TextureInfo {
                index: self.texture(key, image, binary)?,
                extensions: texture_transform(source).map_err(bad)?,
            }),
            _ => None,
        };
        self.materials.push(json::Material {
            name: &source.name,
            pbr_metallic_roughness: Pbr {
                base_color_factor: source.base_colour,
                base_color_texture: texture,
                metallic_factor: source.metallic,
                roughness_factor: source.roughness,
            },
            emissive_factor: (emission != [0.0; 3]).then(|| emission.map(|light| light / strength)),
            alpha_mode,
            alpha_cutoff,
            double_sided: source.double_sided,
            extensions: (source.unlit || strength > 1.0).then(|| MaterialExtensions {
                strength: (strength > 1.0).then_some(EmissiveStrength {
                    emissive_strength: strength,
                }),
                unlit: source.unlit.then_some(Empty {}),
            }),
        });
        let index = self.materials.len() as u32 - 1;
        self.known_materials.insert(key, index);
        Ok(Some(index))
    }

    /// The index of an image's texture. There is one texture per image, since an image of the scene has its own
    /// sampler.
    fn texture(
        &mut self,
        key: ImageKey,
        image: &'a Image,
        binary: &mut Binary<'_>,
    ) -> Result<u32, SaveProblem> {
        if let Some(known) = self.known_images.get(&key) {
            return Ok(*known);
        }
        let mut png = Vec::new();
        PngEncoder::new(&mut png)
            .write_image(
                &image.rgba,
                image.width,
                image.height,
                ExtendedColorType::Rgba8,
            )
            .map_err(|refused| SaveProblem::BadImage {
                image: image.name.clone(),
                problem: refused.to_string(),
            })?;
        self.images.push(json::Image {
            name: &image.name,
            mime_type: "image/png",
            buffer_view: binary.file(png),
        });
        let next = self.samplers.len() as u32;
        let sampler = *self.known_samplers.entry(image.sampler).or_insert(next);
        if sampler == next {
            self.samplers.push(sampler_of(image.sampler));
        }
        self.textures.push(json::Texture {
            sampler,
            source: self.images.len() as u32 - 1,
        });
        let index = self.textures.len() as u32 - 1;
        self.known_images.insert(key, index);
        Ok(index)
    }
}

fn sampler_of(sampler: Sampler) -> json::Sampler {
    use Filter::{Linear, Nearest};
    let wrap = |wrap| match wrap {
        Wrap::Repeat => 10497,
        Wrap::Mirror => 33648,
        Wrap::Clamp => 33071,
    };
    json::Sampler {
        mag_filter: match sampler.magnify {
            Nearest => 9728,
            Linear => 9729,
        },
        min_filter: match (sampler.minify, sampler.mipmaps) {
            (Nearest, None) => 9728,
            (Linear, None) => 9729,
            (Nearest, Some(Nearest)) => 9984,
            (Linear, Some(Nearest)) => 9985,
            (Nearest, Some(Linear)) => 9986,
            (Linear, Some(Linear)) => 9987,
        },
        wrap_s: wrap(sampler.wrap_u),
        wrap_t: wrap(sampler.wrap_v),
    }
}

/// The material's uv transform as scale, then rotation, then offset, or the reason why it cannot be represented so.
fn texture_transform(material: &Material) -> Result<Option<TextureExtensions>, String> {
    let transform = material.uv_transform;
    if transform == Material::default().uv_transform {
        return Ok(None);
    }
    let [[a, b, x], [c, d, y]] = transform;
    // a = cos * sx, c = -sin * sx, b = sin * sy, d = cos * sy.
    let turned = a * d - b * c;
    let (sx, sy) = (a.hypot(c), b.hypot(d).copysign(turned));
    let rotation = if sx > 0.0 {
        (-c).atan2(a)
    } else {
        (b * sy.signum()).atan2(d * sy.signum())
    };
    let (sin, cos) = rotation.sin_cos();
    let again = [cos * sx, sin * sy, -sin * sx, cos * sy];
    let slack = sx.max(sy.abs()) * 1e-5;
    let same = [a, b, c, d]
        .iter()
        .zip(again)
        .all(|(is, was)| (is - was).abs() <= slack);
    if !same || !(x + y).is_finite() {
        return Err(format!(
            "its uv transform {transform:?} is no scale, rotation and offset, and glTF has no other; apply it to the uvs"
        ));
    }
    Ok(Some(TextureExtensions {
        transform: TextureTransform {
            offset: [x, y],
            rotation,
            scale: [sx, sy],
        },
    }))
}
