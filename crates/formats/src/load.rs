//! Scenes from files. A file is hostile until it is read: every number in it is checked against the bytes that are really
//! there before memory is taken for it, nothing recurses, and nothing outside the file's own folder is opened.

use crate::attachment::Attachment;
use crate::budget::Budget;
use crate::error::{LoadError, LoadProblem};
use crate::files::{self, Files};
use crate::{cityjson, gltf, obj, ply, stl};
use antumbra_scene::{Drawable, Geometry, Material, Mesh, Scene};
use glam::DAffine3;
use std::path::Path;

/// The file formats that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SceneFormat {
    /// CityJSON 1 or 2, a document or a sequence of features a line; which of the two is told from the text.
    CityJson,
    /// glTF 2.0, JSON or binary; which of the two is told from the bytes.
    Gltf,
    /// Wavefront OBJ with MTL.
    Obj,
    /// Stanford PLY, ASCII or binary.
    Ply,
    /// STL, ASCII or binary.
    Stl,
}

impl SceneFormat {
    /// The file name extensions that are known, for messages.
    pub const EXTENSIONS: &'static [&'static str] =
        &["glb", "gltf", "json", "jsonl", "obj", "ply", "stl"];

    /// The format of a file with this extension, in either case of letters.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "glb" | "gltf" => Some(Self::Gltf),
            "json" | "jsonl" => Some(Self::CityJson),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            _ => None,
        }
    }
}

/// How much a file may ask for. What it asks for beyond is refused before memory is taken for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadOptions {
    /// Bytes of the file and of all files it refers to, together.
    pub max_file_bytes: u64,
    /// Vertices of all meshes; one costs up to 36 bytes.
    pub max_vertices: u64,
    /// Triangles, lines and points of all meshes; one costs up to 12 bytes.
    pub max_triangles: u64,
    /// Entities; one costs about 500 bytes.
    pub max_entities: u64,
    /// Pixels of all images; one costs 4 bytes.
    pub max_image_pixels: u64,
    /// Objects and arrays in a glTF's or a CityJSON document's JSON or in one line of a CityJSON sequence, and a sixteenth of
    /// its commas; one costs up to about 700 bytes while the file is read.
    pub max_json_objects: u64,
    /// Leave images out; materials keep their colours.
    pub skip_images: bool,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            max_file_bytes: 2 << 30,
            max_vertices: 64_000_000,
            max_triangles: 128_000_000,
            max_entities: 4_000_000,
            max_image_pixels: 1 << 28,
            max_json_objects: 6_000_000,
            skip_images: false,
        }
    }
}

/// A scene, and what others had to say of it.
#[derive(Debug)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// Of the attachments that were asked for, those that the file has, or what is wrong with them: the scene is what it is without them.
    pub attachments: Vec<Result<Attachment, LoadError>>,
}

/// Reads a scene from a file; its format is told by the extension (.glb, .gltf, .json and .jsonl for CityJSON,
/// .obj, .ply, .stl).
///
/// The scene is named after the file and has been [`update`](Scene::update)d by nobody yet.
///
/// # Errors
/// One [`LoadProblem`] each for what can be wrong with a file, with the file's name around it.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, LoadError> {
    Ok(load_with_attachments(path, options, &[])?.scene)
}

/// As [`load`], with the attachments of these names, which glTF alone can have.
///
/// # Errors
/// As [`load`].
pub fn load_with_attachments(
    path: &Path,
    options: &LoadOptions,
    attachments: &[&str],
) -> Result<LoadedScene, LoadError> {
    let error = |problem| LoadError {
        file: Some(path.to_owned()),
        problem: Box::new(problem),
    };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let read = || {
        let Some(format) = SceneFormat::from_extension(extension) else {
            return Err(LoadProblem::UnknownExtension {
                extension: extension.to_owned(),
                known: SceneFormat::EXTENSIONS,
            });
        };
        let mut budget = Budget::new(options);
        let bytes = files::read(path, &mut budget)?;
        read_format(format, &bytes, path.parent(), attachments, budget)
    };
    let (mut scene, attachments) = read().map_err(error)?;
    if let Some(stem) = path.file_stem().and_then(|stem| stem.to_str()) {
        scene.set_name(stem);
    }
    let attachments = attachments.into_iter();
    Ok(LoadedScene {
        scene,
        attachments: attachments.map(|found| found.map_err(error)).collect(),
    })
}

/// Reads a scene from memory. Files it refers to are looked for below `base`, or refused without one.
///
/// # Errors
/// As [`load`].
pub fn load_slice(
    format: SceneFormat,
    bytes: &[u8],
    base: Option<&Path>,
    options: &LoadOptions,
) -> Result<Scene, LoadError> {
    Ok(load_slice_with_attachments(format, bytes, base, options, &[])?.scene)
}

/// As [`load_slice`], with the attachments of these names.
///
/// # Errors
/// As [`load`].
pub fn load_slice_with_attachments(
    format: SceneFormat,
    bytes: &[u8],
    base: Option<&Path>,
    options: &LoadOptions,
    attachments: &[&str],
) -> Result<LoadedScene, LoadError> {
    let error = |problem| LoadError {
        file: None,
        problem: Box::new(problem),
    };
    let mut budget = Budget::new(options);
    let (scene, attachments) = (budget.bytes(bytes.len() as u64))
        .and_then(|()| read_format(format, bytes, base, attachments, budget))
        .map_err(error)?;
    let attachments = attachments.into_iter();
    Ok(LoadedScene {
        scene,
        attachments: attachments.map(|found| found.map_err(error)).collect(),
    })
}

/// Reads a glTF scene, JSON or binary, from memory: [`load_slice`] with [`SceneFormat::Gltf`].
///
/// # Errors
/// As [`load`].
pub fn load_gltf_slice(
    bytes: &[u8],
    base: Option<&Path>,
    options: &LoadOptions,
) -> Result<Scene, LoadError> {
    load_slice(SceneFormat::Gltf, bytes, base, options)
}

/// An attachment, or what is wrong with it.
pub(crate) type Found = Result<Attachment, LoadProblem>;

fn read_format(
    format: SceneFormat,
    bytes: &[u8],
    base: Option<&Path>,
    attachments: &[&str],
    mut budget: Budget,
) -> Result<(Scene, Vec<Found>), LoadProblem> {
    let files = Files::new(base);
    let scene = match format {
        SceneFormat::CityJson => cityjson::read(bytes, &mut budget),
        SceneFormat::Gltf => return gltf::read::read(bytes, &files, attachments, &mut budget),
        SceneFormat::Obj => obj::read(bytes, &files, &mut budget),
        SceneFormat::Ply => single("ply", ply::read(bytes, &mut budget)?),
        SceneFormat::Stl => single("stl", stl::read(bytes, &mut budget)?),
    };
    Ok((scene?, Vec::new()))
}

/// A scene of one entity, for the formats that hold one mesh.
fn single(name: &str, geometry: Geometry) -> Result<Scene, LoadProblem> {
    let mut scene = Scene::new();
    let drawable = Drawable {
        mesh: scene.add_mesh(Mesh::new(name, geometry))?,
        material: scene.add_material(Material {
            // Such files seldom agree on which side is the front.
            double_sided: true,
            ..Material::default()
        }),
    };
    let entity = scene.spawn(None, DAffine3::IDENTITY)?;
    scene.set_entity_name(entity, name)?;
    scene.set_drawable(entity, drawable)?;
    Ok(scene)
}
