//! Materials and their base colour images. Each is read on first use.

use super::document::{Document, item, label};
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::file_resolver::FileResolver;
use crate::image;
use antumbra_scene::{AlphaMode, Filter, ImageKey, Material, MaterialKey, Sampler, Scene, Wrap};
use gltf::json::material::AlphaMode as Alpha;
use gltf::json::texture::{Info, MagFilter, MinFilter, WrappingMode};
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// The materials and images that have been read.
#[derive(Default)]
pub(super) struct Materials {
    known: HashMap<Option<usize>, MaterialKey>,
    images: HashMap<(usize, Sampler), ImageKey>,
}

/// The set of texture coordinates of a material's base colour.
pub(super) fn uv_set(document: &Document<'_>, material: Option<usize>) -> u32 {
    let material = material.and_then(|index| document.root.materials.get(index));
    let Some(info) = material.and_then(|m| m.pbr_metallic_roughness.base_color_texture.as_ref())
    else {
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
        let pbr = &source.pbr_metallic_roughness;
        let mut material = Material {
            base_colour: pbr.base_color_factor.0,
            // A texture of metalness is not read. A material with one counts as a dielectric.
            metallic: match pbr.metallic_roughness_texture {
                None => pbr.metallic_factor.0,
                Some(_) => 0.0,
            },
            roughness: pbr.roughness_factor.0,
            alpha: match source.alpha_mode {
                Checked::Valid(Alpha::Mask) => AlphaMode::Mask {
                    cutoff: source.alpha_cutoff.unwrap_or_default().0,
                },
                Checked::Valid(Alpha::Blend) => AlphaMode::Blend,
                Checked::Valid(Alpha::Opaque) | Checked::Invalid => AlphaMode::Opaque,
            },
            double_sided: source.double_sided,
            unlit: source
                .extensions
                .as_ref()
                .is_some_and(|e| e.unlit.is_some()),
            ..Material::default()
        };
        if let Some(info) = &pbr.base_color_texture {
            material.uv_transform = uv_transform(info);
            let place = format!(
                "the base colour of {}",
                label("material", index, Some(&name))
            );
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
        let texture = item(&root.textures, info.index.value(), "texture", place)?;
        let source = texture.source.value();
        if source == u32::MAX as usize {
            tracing::warn!(
                place,
                "its image is only there in a format of an extension; left out"
            );
            return Ok(None);
        }
        let image = item(&root.images, source, "image", place)?;
        let sampler = match texture.sampler {
            None => Sampler::default(),
            Some(index) => sampler(item(&root.samplers, index.value(), "sampler", place)?),
        };
        if let Some(key) = self.images.get(&(source, sampler)) {
            return Ok(Some(*key));
        }
        let place = label("image", source, image.name.as_deref());
        budget.enter(place.as_str());
        let fetched;
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => {
                fetched = files.fetch(&place, uri, budget)?;
                fetched.as_slice()
            }
            (None, Some(view)) => document.view(&place, view.value())?.bytes,
            (None, None) => {
                return Err(LoadProblem::MissingData {
                    place,
                    problem: "it has neither a uri nor a buffer view; export the file again".into(),
                });
            }
        };
        let name = image.name.clone().unwrap_or_default();
        budget.name(&name)?;
        let key = image::add_image(scene, &place, name, bytes, sampler, budget)?;
        self.images.insert((source, sampler), key);
        Ok(Some(key))
    }
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
