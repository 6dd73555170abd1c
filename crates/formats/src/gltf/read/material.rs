//! Materials with their colours, their emission and one image. Each is read on first use. An image costs no shape: one that cannot be had is
//! left out.

use super::document::{Document, item, label};
use crate::budget::Budget;
use crate::emission::{Emitter, MAPS_OF_EMISSION, Shown};
use crate::error::LoadProblem;
use crate::file_resolver::{FileResolver, data_of};
use crate::image::{self, ImageSource};
use crate::left_out::LostPart;
use antumbra_scene::{AlphaMode, Filter, ImageKey, Material, MaterialKey, Sampler, Scene, Wrap};
use gltf::json::material::AlphaMode as Alpha;
use gltf::json::texture::{Info, MagFilter, MinFilter, Texture, WrappingMode};
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// The materials and images that have been read.
#[derive(Default)]
pub(super) struct Materials {
    known: HashMap<Option<usize>, MaterialKey>,
    /// `None` for an image that was left out.
    images: HashMap<(usize, Sampler), Option<ImageKey>>,
}

/// The set of texture coordinates of a material's image.
pub(super) fn uv_set(document: &Document<'_>, material: Option<usize>) -> u32 {
    let material = material.and_then(|index| document.root.materials.get(index));
    let Some(info) = material.and_then(|material| Look::of(material).shown.image) else {
        return 0;
    };
    let transform = info
        .extensions
        .as_ref()
        .and_then(|e| e.texture_transform.as_ref());
    transform
        .and_then(|t| t.tex_coord)
        .unwrap_or(info.tex_coord)
}

/// What is shown of a material.
struct Look<'a> {
    shown: Shown<&'a Info>,
    metallic: f32,
    roughness: f32,
}

impl<'a> Look<'a> {
    fn of(source: &'a gltf::json::Material) -> Self {
        let pbr = &source.pbr_metallic_roughness;
        let extensions = source.extensions.as_ref();
        let gloss = extensions.and_then(|e| e.pbr_specular_glossiness.as_ref());
        let (base_colour, image) = match gloss {
            Some(gloss) => (gloss.diffuse_factor.0, gloss.diffuse_texture.as_ref()),
            None => (pbr.base_color_factor.0, pbr.base_color_texture.as_ref()),
        };
        let (metallic, roughness) = match gloss {
            Some(gloss) => (0.0, 1.0 - gloss.glossiness_factor.0),
            // A texture of metalness is not read. A material with one counts as a dielectric.
            None if pbr.metallic_roughness_texture.is_some() => (0.0, pbr.roughness_factor.0),
            None => (pbr.metallic_factor.0, pbr.roughness_factor.0),
        };
        let strength = extensions.and_then(|e| e.emissive_strength.as_ref());
        let strength = strength.map_or(1.0, |strength| strength.emissive_strength.0);
        let factor = source.emissive_factor.0.map(|part| part * strength);
        let shown = Emitter {
            base_colour,
            image,
            emission: factor,
            emission_image: source.emissive_texture.as_ref(),
            is_unlit: extensions.is_some_and(|e| e.unlit.is_some()),
        }
        .shown();
        Self {
            shown,
            metallic,
            roughness,
        }
    }
}

impl Materials {
    /// The scene's material for one of the file; `None` is the default material.
    pub(super) fn get(
        &mut self,
        index: Option<usize>,
        document: &Document<'_>,
        scene: &mut Scene,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<MaterialKey, LoadProblem> {
        if let Some(key) = self.known.get(&index) {
            return Ok(*key);
        }
        let material = match index {
            None => Material::default(),
            Some(index) => self.read(index, document, scene, files, budget)?,
        };
        budget.material(&material.name)?;
        let key = scene.add_material(material);
        self.known.insert(index, key);
        Ok(key)
    }

    fn read(
        &mut self,
        index: usize,
        document: &Document<'_>,
        scene: &mut Scene,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<Material, LoadProblem> {
        let source = item(&document.root.materials, index, "material", "a primitive")?;
        let name = source.name.clone().unwrap_or_default();
        let Look {
            shown,
            metallic,
            roughness,
        } = Look::of(source);
        let mut material = Material {
            base_colour: shown.base_colour,
            metallic,
            roughness,
            emission: shown.emission,
            alpha: match source.alpha_mode {
                Checked::Valid(Alpha::Mask) => AlphaMode::Mask {
                    cutoff: source.alpha_cutoff.unwrap_or_default().0,
                },
                Checked::Valid(Alpha::Blend) => AlphaMode::Blend,
                Checked::Valid(Alpha::Opaque) | Checked::Invalid => AlphaMode::Opaque,
            },
            double_sided: source.double_sided,
            unlit: shown.is_light
                || source
                    .extensions
                    .as_ref()
                    .is_some_and(|e| e.unlit.is_some()),
            ..Material::default()
        };
        let place = || label("material", index, Some(&name));
        if shown.loses_image {
            (budget.left_out).add(LostPart::Shading, MAPS_OF_EMISSION, &place());
        }
        if shown.was_infinite {
            let reason = "an emission that is not finite";
            (budget.left_out).add(LostPart::Shading, reason, &place());
        }
        if let Some(info) = shown.image {
            material.uv_transform = uv_transform(info);
            let place = format!("the image of {}", place());
            material.base_colour_image =
                self.image(info, &place, document, scene, files, budget)?;
        }
        material.name = name;
        Ok(material)
    }

    fn image(
        &mut self,
        info: &Info,
        place: &str,
        document: &Document<'_>,
        scene: &mut Scene,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<Option<ImageKey>, LoadProblem> {
        if budget.options.skip_images {
            return Ok(None);
        }
        let root = &document.root;
        let Some(texture) = root.textures.get(info.index.value()) else {
            return Ok(lose("no such texture", place, budget));
        };
        let sources = sources(texture);
        let Some(source) = sources.first() else {
            return Ok(lose("a texture without an image", place, budget));
        };
        let sampler = (texture.sampler).and_then(|index| root.samplers.get(index.value()));
        let sampler = sampler.map(self::sampler).unwrap_or_default();
        if let Some(key) = self.images.get(&(*source, sampler)) {
            return Ok(*key);
        }
        // The image of an extension, or else that for viewers without it. Losses of the first do not count if there is the second.
        let before = budget.left_out.clone();
        let mut key = None;
        for &source in &sources {
            budget.left_out.clone_from(&before);
            key = read_image(source, place, sampler, document, scene, files, budget)?;
            if key.is_some() {
                break;
            }
        }
        self.images.insert((*source, sampler), key);
        Ok(key)
    }
}

/// The extensions that give a texture an image of another format.
const IMAGE_EXTENSIONS: [&str; 4] = [
    "KHR_texture_basisu",
    "EXT_texture_webp",
    "EXT_texture_avif",
    "MSFT_texture_dds",
];

/// The images of a texture: those of extensions, and then its own.
fn sources(texture: &Texture) -> Vec<usize> {
    let others = texture
        .extensions
        .as_ref()
        .map(|extensions| &extensions.others);
    let of = |name: &&str| others?.get(*name)?.get("source")?.as_u64();
    let of_extensions = IMAGE_EXTENSIONS.iter().filter_map(of);
    let own = texture.source.value();
    let own = (own != u32::MAX as usize).then_some(own);
    let of_extensions = of_extensions.filter_map(|index| usize::try_from(index).ok());
    of_extensions.chain(own).collect()
}

fn read_image(
    index: usize,
    place: &str,
    sampler: Sampler,
    document: &Document<'_>,
    scene: &mut Scene,
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<Option<ImageKey>, LoadProblem> {
    let Some(image) = document.root.images.get(index) else {
        return Ok(lose("no such image", place, budget));
    };
    let place = label("image", index, image.name.as_deref());
    budget.enter(place.as_str());
    let uri = image.uri.as_deref().unwrap_or_default();
    let name = image.name.clone().unwrap_or_default();
    let file = if data_of(uri).is_some() { "" } else { uri };
    let source = ImageSource {
        place: &place,
        name: &name,
        file,
        sampler,
    };
    match (&image.uri, image.buffer_view) {
        (Some(uri), _) => {
            let found = files.fetch_cosmetic(&place, uri, budget)?;
            image::add_found(scene, found, &source, budget)
        }
        (None, Some(view)) => match document.view(&place, view.value()) {
            Ok(view) => image::add(scene, view.bytes, &source, budget),
            Err(_) => Ok(lose("its bytes are not there", &place, budget)),
        },
        (None, None) => Ok(lose("neither a uri nor a buffer view", &place, budget)),
    }
}

/// Notes an image that is left out.
fn lose(reason: &str, place: &str, budget: &mut Budget) -> Option<ImageKey> {
    budget.left_out.add(LostPart::Image, reason, place);
    None
}

fn sampler(source: &gltf::json::texture::Sampler) -> Sampler {
    let wrap = |mode: &Checked<WrappingMode>| match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    };
    use Filter::{Linear, Nearest};
    let (minify, mipmaps) = match source.min_filter {
        Some(Checked::Valid(MinFilter::Nearest)) => (Nearest, None),
        Some(Checked::Valid(MinFilter::Linear)) => (Linear, None),
        Some(Checked::Valid(MinFilter::NearestMipmapNearest)) => (Nearest, Some(Nearest)),
        Some(Checked::Valid(MinFilter::LinearMipmapNearest)) => (Linear, Some(Nearest)),
        Some(Checked::Valid(MinFilter::NearestMipmapLinear)) => (Nearest, Some(Linear)),
        Some(Checked::Valid(MinFilter::LinearMipmapLinear) | Checked::Invalid) | None => {
            (Linear, Some(Linear))
        }
    };
    Sampler {
        wrap_u: wrap(&source.wrap_s),
        wrap_v: wrap(&source.wrap_t),
        magnify: match source.mag_filter {
            Some(Checked::Valid(MagFilter::Nearest)) => Nearest,
            _ => Linear,
        },
        minify,
        mipmaps,
    }
}

/// KHR_texture_transform: scale, then rotation, then offset.
fn uv_transform(info: &Info) -> [[f32; 3]; 2] {
    let transform = info
        .extensions
        .as_ref()
        .and_then(|e| e.texture_transform.as_ref());
    let Some(transform) = transform else {
        return Material::default().uv_transform;
    };
    let ([x, y], [sx, sy]) = (transform.offset.0, transform.scale.0);
    let (sin, cos) = transform.rotation.0.sin_cos();
    [[cos * sx, sin * sy, x], [-sin * sx, cos * sy, y]]
}
