//! Reading of glTF 2.0.
//!
//! The crate `gltf` parses the JSON. Accessors are read here and checked against the bytes. The crate's validation
//! assumes well-meaning files and is not used.
//!
//! All primitive modes, sparse accessors and component types are read, and animations with their skins and morph targets, cameras, lights, base colours with their
//! images, emission, the extensions in `extensions::READ`, and of the extras whether an entity is tested. Skins and morph targets that no animation moves are baked
//! into the mesh at rest. Node transforms are f64. What costs no shape, such as an image that is missing, is left out and noted.

mod accessor;
mod attachments;
mod container;
mod deformation;
mod document;
#[cfg(feature = "draco")]
mod draco;
mod extensions;
mod extras;
mod geometry;
mod keyframes;
mod lights_and_cameras;
mod material;
#[cfg(feature = "meshopt")]
mod meshopt;
mod morph;
mod motions;
mod nodes;
mod parts;
mod pointers;
mod rig;
mod skin;
mod transform;
mod tree;

use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::file_resolver::FileResolver;
use crate::read_scene::ReadScene;
use document::Document;
use motions::Motions;
use nodes::NodeScene;
use tree::Tree;

pub(crate) fn read(
    bytes: &[u8],
    files: &FileResolver<'_>,
    attachments: &[&str],
    budget: &mut Budget,
) -> Result<ReadScene, LoadProblem> {
    let parts = container::split(bytes)?;
    let json = container::parse(parts.json, budget)?;
    let document = Document::open(json, parts.binary, files, budget)?;
    #[cfg(feature = "meshopt")]
    let document = {
        let decoded = meshopt::decode_views(&document, budget)?;
        document.with_decoded(decoded)
    };
    extensions::note_unread(&document.root, attachments, &mut budget.left_out);
    let tree = Tree::read(&document)?;
    let motions = Motions::read(&document, &tree, budget)?;
    let NodeScene {
        scene,
        entities,
        deformed,
    } = nodes::build(&document, &tree, &motions, files, budget)?;
    let animation = rig::build(&document, &tree, motions, &entities, deformed, budget)?;
    let wanted = attachments.iter();
    let found = wanted.filter_map(|name| attachments::read(&document, name, &entities));
    Ok(ReadScene {
        scene,
        animation,
        attachments: found.collect(),
    })
}
