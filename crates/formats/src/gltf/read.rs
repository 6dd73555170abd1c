//! Reading of glTF 2.0.
//!
//! The crate `gltf` parses the JSON. Accessors are read here and checked against the bytes. The crate's validation
//! assumes well-meaning files and is not used.
//!
//! All primitive modes, sparse accessors and component types are read, and default morph weights, skins in their rest
//! pose (baked into the mesh), cameras, lights, base colours with their images, the extensions in
//! `container::SUPPORTED`, and of the extras whether an entity is tested. Animations are not read. Node transforms
//! are f64.

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
use crate::file_resolver::FileResolver;
use crate::read_scene::ReadScene;
use document::Document;
use nodes::NodeScene;

pub(crate) fn read(
    bytes: &[u8],
    files: &FileResolver<'_>,
    attachments: &[&str],
    budget: &mut Budget,
) -> Result<ReadScene, LoadProblem> {
    let parts = container::split(bytes)?;
    let json = container::parse(parts.json, budget)?;
    let document = Document::open(json, parts.binary, files, budget)?;
    let NodeScene { scene, entities } = nodes::build(&document, files, budget)?;
    let wanted = attachments.iter();
    let found = wanted.filter_map(|name| attachments::read(&document, name, &entities));
    Ok(ReadScene {
        scene,
        attachments: found.collect(),
    })
}
