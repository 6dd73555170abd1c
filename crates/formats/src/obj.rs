//! Wavefront OBJ and MTL, read by the crate `tobj`. Each object or group becomes an entity, and polygons become fans
//! of triangles.

mod check;

use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::file_resolver::{self, FileResolver};
use crate::image;
use antumbra_scene::{
    AlphaMode, Drawable, Geometry, Material, MaterialKey, Mesh, Sampler, Scene, Topology,
};
use glam::DAffine3;
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Bytes of a material of a library in memory, without its name.
const LIBRARY_MATERIAL: u64 = 512;

pub(super) fn read(
    bytes: &[u8],
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<Scene, LoadProblem> {
    let broken = |problem: String| LoadProblem::Syntax {
        format: "OBJ",
        place: "the file".into(),
        problem,
    };
    if bytes.starts_with(&[0xfe, 0xff]) || bytes.starts_with(&[0xff, 0xfe]) {
        return Err(broken("it is UTF-16 text; save it as UTF-8".into()));
    }
    // Names in other encodings than UTF-8 need not be legible, as long as equal names stay equal.
    let text = check::shapes(&String::from_utf8_lossy(bytes), budget)?;
    let options = tobj::LoadOptions {
        single_index: true,
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
    };
    // Without the material library the colours are missing, not the shapes.
    let shared = RefCell::new(budget);
    let refused: RefCell<Option<LoadProblem>> = RefCell::new(None);
    let known_libraries = RefCell::new(HashSet::new());
    let library = |name: &Path| {
        // A library that is named again adds nothing.
        if !known_libraries.borrow_mut().insert(name.to_owned()) {
            return Ok((Vec::new(), Default::default()));
        }
        let read = || {
            let name = name.to_str().ok_or(tobj::LoadError::OpenFileFailed)?;
            let path = files
                .resolve(name)
                .map_err(|_| tobj::LoadError::OpenFileFailed)?;
            let bytes = file_resolver::read(&path, &mut shared.borrow_mut());
            bytes.map_err(|problem| {
                // A library that is missing costs the colours, one that exceeds the limits the file.
                if !matches!(problem, LoadProblem::Io { .. }) {
                    refused.borrow_mut().get_or_insert(problem);
                }
                tobj::LoadError::OpenFileFailed
            })
        };
        let bytes = read()?;
        let text = check::materials(&String::from_utf8_lossy(&bytes));
        let count = text
            .lines()
            .filter(|line| line.starts_with("newmtl"))
            .count() as u64;
        let mut budget = shared.borrow_mut();
        budget.enter(format!(
            "the material library \"{}\"",
            shorten(&name.to_string_lossy())
        ));
        if let Err(problem) = budget.memory(count * LIBRARY_MATERIAL + text.len() as u64) {
            refused.borrow_mut().get_or_insert(problem);
            return Err(tobj::LoadError::GenericFailure);
        }
        drop(budget);
        tobj::load_mtl_buf(&mut text.as_bytes())
    };
    let (models, materials) = tobj::load_obj_buf(&mut text.as_bytes(), &options, library)
        .map_err(|e| broken(shorten(&e.to_string())))?;
    let budget = shared.into_inner();
    if let Some(problem) = refused.into_inner() {
        return Err(problem);
    }
    let materials = materials.unwrap_or_else(|error| {
        tracing::warn!(%error, "the OBJ's material library cannot be read; its surfaces are white");
        Vec::new()
    });
    let mut scene = Scene::new();
    let mut known: HashMap<Option<usize>, MaterialKey> = HashMap::new();
    let models: Vec<tobj::Model> = models
        .into_iter()
        .filter(|model| !model.mesh.indices.is_empty())
        .collect();
    let part = |model: &tobj::Model| format!("the object \"{}\"", shorten(&model.name));
    for model in &models {
        budget.enter(part(model));
        budget.vertices(model.mesh.positions.len() as u64 / 3)?;
        budget.entities(1)?;
        budget.mesh(&model.name)?;
        budget.name(&model.name)?;
    }
    scene.reserve(models.len());
    for model in models {
        let geometry = geometry(&model.mesh);
        let id = model.mesh.material_id.filter(|id| *id < materials.len());
        let material = match known.get(&id) {
            Some(key) => *key,
            None => {
                budget.enter(part(&model));
                let source = id.and_then(|id| materials.get(id));
                let material = material(source, &mut scene, files, budget)?;
                budget.material(&material.name)?;
                *known.entry(id).or_insert(scene.add_material(material))
            }
        };
        let mesh = scene.add_mesh(Mesh::new(model.name.clone(), geometry))?;
        let entity = scene.spawn(None, DAffine3::IDENTITY)?;
        scene.set_entity_name(entity, model.name)?;
        scene.set_drawable(entity, Drawable { mesh, material })?;
    }
    Ok(scene)
}

fn geometry(mesh: &tobj::Mesh) -> Geometry {
    let positions = mesh.positions.as_chunks::<3>().0.to_vec();
    let normals = mesh.normals.as_chunks::<3>().0;
    let uvs = mesh.texcoords.as_chunks::<2>().0;
    let colours = mesh.vertex_color.as_chunks::<3>().0;
    // If some vertices lack an attribute, tobj returns fewer values than positions.
    let complete = |count: usize| count == positions.len();
    Geometry {
        topology: Topology::Triangles,
        normals: if complete(normals.len()) {
            normals.to_vec()
        } else {
            Vec::new()
        },
        uvs: if complete(uvs.len()) {
            // OBJ counts v from the bottom.
            uvs.iter().map(|[u, v]| [*u, 1.0 - v]).collect()
        } else {
            Vec::new()
        },
        colours: if complete(colours.len()) {
            let byte = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
            colours
                .iter()
                .map(|&[r, g, b]| [byte(r), byte(g), byte(b), 255])
                .collect()
        } else {
            Vec::new()
        },
        indices: mesh.indices.clone(),
        positions,
    }
}

fn material(
    source: Option<&tobj::Material>,
    scene: &mut Scene,
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<Material, LoadProblem> {
    let mut material = Material {
        double_sided: true,
        ..Material::default()
    };
    let Some(source) = source else {
        return Ok(material);
    };
    material.name.clone_from(&source.name);
    let finite = |c: f32| if c.is_finite() { c } else { 1.0 };
    let [r, g, b] = source.diffuse.unwrap_or([1.0; 3]).map(finite);
    let alpha = finite(source.dissolve.unwrap_or(1.0));
    material.base_colour = [r, g, b, alpha];
    if alpha < 1.0 {
        material.alpha = AlphaMode::Blend;
    }
    if let Some(name) = source
        .diffuse_texture
        .as_deref()
        .filter(|_| !budget.options.skip_images)
    {
        let place = format!("the image of material \"{}\"", shorten(&source.name));
        let path = files.resolve(name).map_err(|problem| LoadProblem::BadUri {
            place: place.clone(),
            uri: shorten(name),
            problem,
        })?;
        let bytes = file_resolver::read(&path, budget)?;
        let image = image::add_image(
            scene,
            &place,
            name.to_owned(),
            &bytes,
            Sampler::default(),
            budget,
        )?;
        material.base_colour_image = Some(image);
        // In most exporters a texture replaces the colour, and Kd is then black.
        if [r, g, b] == [0.0; 3] {
            material.base_colour = [1.0, 1.0, 1.0, alpha];
        }
    }
    Ok(material)
}
