//! Terrains of what the command line names: fields of rasters and meshes, and the built-in landscape, with progress.

use std::path::{Path, PathBuf};

use antumbra::demo_scenes::terrain::TerrainSceneOptions;
use antumbra::formats::load_raster_within;
use antumbra::formats::{RasterFormat, SceneFormat};
use antumbra::terrain::{
    Field, PreparedScene, RasterDetail, Terrain, TerrainError, TerrainOptions,
};

use crate::args::LoadArgs;
use crate::failure::Failure;
use crate::{progress, scene_file};

/// The default number of vertices of a field over a raster; a smaller raster has a vertex for every post.
pub const VERTICES: usize = 100_000;

/// Whether a file's ending is a raster's.
pub fn is_raster(file: &Path) -> bool {
    ending(file)
        .and_then(RasterFormat::from_extension)
        .is_some()
}

/// Whether a file's ending is a mesh's.
pub fn is_mesh(file: &Path) -> bool {
    ending(file).and_then(SceneFormat::from_extension).is_some()
}

fn ending(file: &Path) -> Option<&str> {
    file.extension().and_then(|ending| ending.to_str())
}

/// A field, and the files that it was read from.
pub struct FieldOfFile {
    /// The field.
    pub field: Field,
    /// The file, and those that it refers to.
    pub files: Vec<PathBuf>,
}

/// A field out of a file. A mesh is taken whole, and has no detail to choose.
///
/// # Errors
/// What is wrong with the file; [`Failure::Usage`] for a detail of a mesh.
pub fn field(
    file: &Path,
    detail: Option<RasterDetail>,
    args: &LoadArgs,
    quiet: bool,
) -> Result<FieldOfFile, Failure> {
    let named = |error| match error {
        TerrainError::Setting { .. } => Failure::Terrain(error),
        _ => Failure::Field {
            file: file.to_owned(),
            error: Box::new(error),
        },
    };
    if is_raster(file) {
        let detail = detail.unwrap_or(RasterDetail::Vertices(VERTICES));
        return Ok(FieldOfFile {
            field: Field::from_raster(
                &load_raster_within(file, scene_file::options(args).max_memory)?,
                detail,
            )
            .map_err(named)?,
            files: vec![file.to_owned()],
        });
    }
    if detail.is_some() {
        return Err(Failure::Usage(format!(
            "'{}' is a mesh and is taken whole: --vertices and --error are for rasters",
            file.display()
        )));
    }
    let loaded = scene_file::load(file, &[], args, quiet)?;
    Ok(FieldOfFile {
        field: Field::from_scene(&loaded.scene).map_err(named)?,
        files: loaded.files,
    })
}

/// Prepares a field.
///
/// # Errors
/// As [`Terrain::prepare`].
pub fn prepare(field: Field, options: &TerrainOptions, quiet: bool) -> Result<Terrain, Failure> {
    let bar = progress::work("finding horizons", quiet);
    bar.set_length(u64::from(options.sectors.count()));
    let terrain = Terrain::prepare(field, options, &|| bar.inc(1));
    bar.finish_and_clear();
    Ok(terrain?)
}

/// The built-in landscape.
///
/// # Errors
/// As [`TerrainSceneOptions::scene`].
pub fn built_in(options: &TerrainSceneOptions, quiet: bool) -> Result<PreparedScene, Failure> {
    let bar = progress::work("finding horizons", quiet);
    bar.set_length(u64::from(options.prepare.sectors.count()));
    let made = options.scene(&|| bar.inc(1));
    bar.finish_and_clear();
    Ok(made?)
}
