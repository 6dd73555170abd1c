//! What is known of glTF's extensions: those that are read, those without which a scene keeps its shapes, and all others, without which a file
//! may be another scene.

use super::document::label;
use crate::error::LoadProblem;
use crate::left_out::{LeftOut, LostPart};
use gltf::json::Root;

/// The extensions that are read.
pub(super) const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    #[cfg(feature = "meshopt")]
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    #[cfg(feature = "draco")]
    DRACO,
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    #[cfg(feature = "meshopt")]
    "KHR_meshopt_compression",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "MSFT_lod",
];

/// Compressed primitives.
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

/// The beginnings of extensions that change neither shapes nor where they are: how surfaces look, what belongs to data, sound and physics.
const HARMLESS: &[&str] = &[
    "ADOBE_materials_",
    "AGI_",
    "ANTUMBRA_",
    "CESIUM_primitive_outline",
    "EXT_instance_features",
    "EXT_lights_",
    "EXT_materials_",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "EXT_texture_",
    "FB_geometry_metadata",
    // Its channels are noted one by one.
    "KHR_animation_pointer",
    "KHR_audio",
    "KHR_interactivity",
    "KHR_lights_",
    "KHR_materials_",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_physics_",
    "KHR_texture_",
    "KHR_xmp",
    "MSFT_audio_",
    "MSFT_packing_",
    "MSFT_texture_dds",
];

/// Whether an extension may change what is where.
fn is_unknown(name: &str) -> bool {
    !READ.contains(&name) && !HARMLESS.iter().any(|start| name.starts_with(start))
}

/// Refuses a file that requires what is not read.
///
/// # Errors
/// [`LoadProblem::UnsupportedExtension`].
pub(super) fn check(root: &Root) -> Result<(), LoadProblem> {
    let mut required = root.extensions_required.iter();
    if let Some(name) = required.find(|name| is_unknown(name)) {
        return Err(LoadProblem::UnsupportedExtension {
            name: name.clone(),
            supported: READ,
        });
    }
    Ok(())
}

/// An extension that may hold the data of an accessor without any: one that is not read, or a compression that the file does not require,
/// although its data has no other form.
pub(super) fn suspect(root: &Root) -> Option<&str> {
    let is_required = |name: &String| root.extensions_required.contains(name);
    let mut used = root.extensions_used.iter();
    let suspect = used.find(|name| is_unknown(name) || (*name == DRACO && !is_required(name)));
    suspect.map(String::as_str)
}

/// Notes extensions that are not read and not among the attachments, and what materials have beyond base colour and emission.
pub(super) fn note_unread(root: &Root, attachments: &[&str], left_out: &mut LeftOut) {
    let used = root.extensions_used.iter();
    for name in used.filter(|name| is_unknown(name) && !attachments.contains(&name.as_str())) {
        left_out.add(
            LostPart::Element,
            &format!("the extension {name}"),
            "the file",
        );
    }
    for (index, material) in root.materials.iter().enumerate() {
        let place = label("material", index, material.name.as_deref());
        let mut note = |reason: &str| left_out.add(LostPart::Shading, reason, &place);
        if material.normal_texture.is_some() {
            note("normal maps");
        }
        if material.occlusion_texture.is_some() {
            note("occlusion maps");
        }
        let pbr = &material.pbr_metallic_roughness;
        if pbr.metallic_roughness_texture.is_some() {
            note("maps of metalness and roughness");
        }
        let extensions = material.extensions.as_ref();
        for name in extensions.into_iter().flat_map(|e| e.others.keys()) {
            if !READ.contains(&name.as_str()) {
                note(name);
            }
        }
    }
}
