//! Loading of scenes.
//!
//! Files are treated as hostile. Every number in a file is checked against the bytes that exist before memory is
//! allocated for it. Nothing recurses, and nothing outside the file's own folder is opened.

use crate::budget::Budget;
use crate::error::{LoadError, LoadProblem};
use crate::file_resolver::{self, FileResolver};
use crate::gltf::Attachment;
use crate::left_out::LeftOut;
use crate::options::LoadOptions;
use crate::read_scene::ReadScene;
use crate::{cityjson, gltf, obj, ply, stl};
use antumbra_scene::animation::Animation;
use antumbra_scene::{Geometry, Scene};
use std::path::{Path, PathBuf};

/// The scene formats that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SceneFormat {
    /// CityJSON 1 or 2: a document, or a sequence with one feature per line. The contents determine which.
    CityJson,
    /// glTF 2.0, JSON or binary. The contents determine which.
    Gltf,
    /// Wavefront OBJ with MTL.
    Obj,
    /// Stanford PLY, ASCII or binary.
    Ply,
    /// STL, ASCII or binary.
    Stl,
}

impl SceneFormat {
    /// The known file name extensions, for messages.
    pub const EXTENSIONS: &'static [&'static str] =
        &["glb", "gltf", "json", "jsonl", "obj", "ply", "stl"];

    /// The format with this file name extension, in upper or lower case.
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

/// A scene and its attachments.
#[derive(Debug)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// What moves in it by itself; it is at rest until [`Animation::pose`] is called.
    pub animation: Option<Animation>,
    /// The attachments that were requested and that the file has, each with an error if it is invalid. The scene does
    /// not depend on them.
    pub attachments: Vec<Result<Attachment, LoadError>>,
    /// The files that were read, each once: the scene's own, and those that it refers to.
    pub files: Vec<PathBuf>,
    /// What the scene lacks of the file.
    pub left_out: LeftOut,
}

impl LoadedScene {
    /// The scene at rest for good: nothing moves it any longer, so that its meshes may get levels, proxies and all else that is found out about a lasting shape.
    #[must_use]
    pub fn at_rest(mut self) -> Self {
        if let Some(animation) = self.animation.take() {
            animation.stop(&mut self.scene);
        }
        self
    }

    /// The scene, and what belongs to it, unless it has nothing to draw: neither a triangle nor a line nor a point. Files of cameras or
    /// lights alone are scenes too, so loading does not refuse them.
    ///
    /// # Errors
    /// [`LoadProblem::NothingToDraw`], with what was left out.
    pub fn drawable(self) -> Result<Self, LoadProblem> {
        let has_indices = |geometry: &Geometry| !geometry.indices.is_empty();
        let mut drawables = self.scene.drawables();
        let shown = drawables.any(|(_, drawable)| {
            let mesh = self.scene.mesh(drawable.mesh);
            mesh.and_then(|mesh| mesh.full()).is_some_and(has_indices)
        });
        drop(drawables);
        match shown {
            true => Ok(self),
            false => Err(LoadProblem::NothingToDraw {
                left_out: self.left_out.to_string(),
            }),
        }
    }
}

/// Loads a scene from a file. The extension determines the format (.glb, .gltf, .json and .jsonl for CityJSON, .obj,
/// .ply, .stl).
///
/// The scene is named after the file, and at rest for good: [`load_with_attachments`] gives what moves in it too. [`update`](Scene::update) has not been called yet.
///
/// # Errors
/// A [`LoadProblem`] with the file's name.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, LoadError> {
    let loaded = load_with_attachments(path, options, &[])?;
    Ok(loaded.at_rest().scene)
}

/// As [`load`], with the attachments of these names. Only glTF has attachments.
///
/// # Errors
/// As for [`load`].
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
    let mut budget = Budget::new(options);
    let mut read = || {
        let Some(format) = SceneFormat::from_extension(extension) else {
            return Err(LoadProblem::UnknownExtension {
                extension: extension.to_owned(),
                known: SceneFormat::EXTENSIONS,
            });
        };
        let bytes = file_resolver::read(path, &mut budget)?;
        read_format(format, &bytes, path.parent(), attachments, &mut budget)
    };
    let ReadScene {
        mut scene,
        animation,
        attachments,
    } = read().map_err(error)?;
    let left_out = left_out(&mut budget).map_err(error)?;
    if let Some(stem) = path.file_stem().and_then(|stem| stem.to_str()) {
        scene.set_name(stem);
    }
    let attachments = attachments.into_iter();
    Ok(LoadedScene {
        scene,
        animation,
        attachments: attachments.map(|found| found.map_err(error)).collect(),
        files: budget.take_files(),
        left_out,
    })
}

/// Loads a scene from memory, at rest for good. Files it refers to are looked up below `base`, or refused without one.
///
/// # Errors
/// As for [`load`].
pub fn load_slice(
    format: SceneFormat,
    bytes: &[u8],
    base: Option<&Path>,
    options: &LoadOptions,
) -> Result<Scene, LoadError> {
    let loaded = load_slice_with_attachments(format, bytes, base, options, &[])?;
    Ok(loaded.at_rest().scene)
}

/// As [`load_slice`], with the attachments of these names.
///
/// # Errors
/// As for [`load`].
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
    let ReadScene {
        scene,
        animation,
        attachments,
    } = (budget.bytes(bytes.len() as u64))
        .and_then(|()| read_format(format, bytes, base, attachments, &mut budget))
        .map_err(error)?;
    let left_out = left_out(&mut budget).map_err(error)?;
    let attachments = attachments.into_iter();
    Ok(LoadedScene {
        scene,
        animation,
        attachments: attachments.map(|found| found.map_err(error)).collect(),
        files: budget.take_files(),
        left_out,
    })
}

/// What the reader left out.
///
/// # Errors
/// [`LoadProblem::LeftOut`] where the load is strict and anything but shading details was left out.
fn left_out(budget: &mut Budget) -> Result<LeftOut, LoadProblem> {
    let left_out = std::mem::take(&mut budget.left_out);
    let grave = left_out.without_shading();
    if budget.options.strict && !grave.is_empty() {
        return Err(LoadProblem::LeftOut {
            left_out: grave.to_string(),
        });
    }
    Ok(left_out)
}

fn read_format(
    format: SceneFormat,
    bytes: &[u8],
    base: Option<&Path>,
    attachments: &[&str],
    budget: &mut Budget,
) -> Result<ReadScene, LoadProblem> {
    let files = FileResolver::new(base);
    let scene = match format {
        SceneFormat::CityJson => cityjson::read(bytes, budget),
        SceneFormat::Gltf => return gltf::read::read(bytes, &files, attachments, budget),
        SceneFormat::Obj => obj::read(bytes, &files, budget),
        SceneFormat::Ply => ply::read(bytes, budget),
        SceneFormat::Stl => stl::read(bytes, budget),
    };
    Ok(ReadScene {
        scene: scene?,
        animation: None,
        attachments: Vec::new(),
    })
}
