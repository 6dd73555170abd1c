//! Wavefront OBJ and MTL. Each object, group and material becomes an entity, with others for its lines and points. Polygons are cut into
//! triangles, and coordinates far from the origin are kept in f64.
//!
//! The crate `tobj` is not used: it cuts concave polygons wrongly, takes lines of four vertices for polygons, and does not know continued
//! lines, options of maps or how much memory it may take.

mod lines;
mod materials;
mod mesh;
mod source;
mod weld;

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::file_resolver::FileResolver;
use crate::left_out::LostPart;
use crate::local_origin::Placed;
use crate::polygon::Triangulator;
use crate::text::legible;
use antumbra_scene::{Drawable, Material, MaterialKey, Mesh, Scene, Topology};
use materials::Libraries;
use mesh::MeshBuilder;
use source::Source;
use std::collections::HashMap;

pub(super) fn read(
    bytes: &[u8],
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<Scene, LoadProblem> {
    if bytes.starts_with(&[0xfe, 0xff]) || bytes.starts_with(&[0xff, 0xfe]) {
        return Err(LoadProblem::Syntax {
            format: "OBJ",
            place: "the file".into(),
            problem: "it is UTF-16 text; save it as UTF-8".into(),
        });
    }
    // Names in other encodings than UTF-8 need not be legible, as long as equal names stay equal.
    let text = legible(bytes, budget)?;
    let source = Source::read(&text, budget)?;
    drop(text);
    let mut libraries = Libraries::default();
    for names in &source.libraries {
        libraries.read(names, files, budget)?;
    }
    let mut scene = Scene::new();
    let mut known: HashMap<Option<usize>, MaterialKey> = HashMap::new();
    let mut builder = MeshBuilder {
        source: &source,
        triangulator: Triangulator::new(),
    };
    for part in &source.parts {
        for topology in [Topology::Triangles, Topology::Lines, Topology::Points] {
            budget.enter(format!("the object \"{}\"", shorten(&part.name)));
            let Some(placed) = builder.geometry(part, topology, budget)? else {
                continue;
            };
            let Placed {
                geometry,
                transform,
            } = placed;
            budget.entities(1)?;
            budget.mesh(&part.name)?;
            budget.name(&part.name)?;
            let material = match known.get(&part.material) {
                Some(key) => *key,
                None => {
                    let name = part
                        .material
                        .and_then(|number| source.materials.get(number));
                    let material = material(name, &mut libraries, &mut scene, files, budget)?;
                    budget.material(&material.name)?;
                    *(known.entry(part.material)).or_insert(scene.add_material(material))
                }
            };
            let mesh = scene.add_mesh(Mesh::new(part.name.clone(), geometry))?;
            let entity = scene.spawn(None, transform)?;
            scene.set_entity_name(entity, part.name.as_str())?;
            scene.set_drawable(entity, Drawable { mesh, material })?;
        }
    }
    Ok(scene)
}

/// The material of this name; a white one without a name or where no library has it.
fn material(
    name: Option<&String>,
    libraries: &mut Libraries,
    scene: &mut Scene,
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<Material, LoadProblem> {
    if let Some(name) = name {
        if let Some(found) = libraries.material(name, scene, files, budget)? {
            return Ok(found);
        }
        // Where a library itself is missing, that has been said.
        if libraries.is_read || !libraries.is_named() {
            let example = format!("material \"{}\"", shorten(name));
            let reason = "no library has it";
            budget.left_out.add(LostPart::Material, reason, &example);
        }
    }
    Ok(Material {
        double_sided: true,
        ..Material::default()
    })
}
