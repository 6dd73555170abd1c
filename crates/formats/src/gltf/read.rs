//! glTF 2.0. The `gltf` crate parses the JSON; the accessors are read here, checked against the bytes that are there, and
//! the crate's validation, which expects well-meaning files, is not relied upon.
//!
//! Read are all primitive modes, sparse accessors and component types, default morph weights, skins in their rest pose (baked
//! into the mesh), cameras, base colours and their images, and the extensions in [`SUPPORTED`], and of extras
//! whether an entity is tested. Animations are not. Nodes are placed in f64.

mod accessor;
mod attachments;
mod container;
mod document;
mod extras;
mod geometry;
mod material;
mod nodes;
mod skin;
mod transform;
mod tree;

use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::files::Files;
use crate::load::Found;
use antumbra_scene::Scene;
use document::Document;

/// The extensions that a file may require.
const SUPPORTED: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "MSFT_lod",
];

pub(crate) fn read(
    bytes: &[u8],
    files: &Files<'_>,
    attachments: &[&str],
    budget: &mut Budget,
) -> Result<(Scene, Vec<Found>), LoadProblem> {
    let parts = container::split(bytes)?;
    let json = container::parse(parts.json, budget)?;
    let document = Document::open(json, parts.binary, files, budget)?;
    let (scene, entities) = nodes::place(&document, files, budget)?;
    let wanted = attachments.iter();
    let found = wanted.filter_map(|name| attachments::read(&document, name, &entities));
    Ok((scene, found.collect()))
}
