//! Terrains of what the command line names: fields of rasters and meshes, and the built-in landscape, with progress.

use std::path::{Path, PathBuf};

use antumbra::demo_scenes::terrain::TerrainSceneOptions;
use antumbra::formats::{RasterFormat, RasterOptions, SceneFormat, Units, load_raster_with};
use antumbra::terrain::{
    Field, PreparedScene, RasterDetail, Terrain, TerrainError, TerrainOptions,
};

use crate::args::LoadArgs;
use crate::failure::Failure;
use crate::{notes, progress, scene_file};

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

/// How a field is read.
#[derive(Debug, Clone, Copy)]
pub struct FieldReading<'a> {
    /// The detail of a raster's field; by default a number of vertices.
    pub detail: Option<RasterDetail>,
    /// How the file is loaded.
    pub load: &'a LoadArgs,
    /// The units of a raster.
    pub units: Option<Units>,
    /// Whether nothing is said.
    pub quiet: bool,
}

/// A field out of a file. A mesh is taken whole, and has no detail to choose. What was assumed is said.
///
/// # Errors
/// What is wrong with the file; [`Failure::Usage`] for a detail of a mesh.
pub fn field(file: &Path, reading: &FieldReading<'_>) -> Result<FieldOfFile, Failure> {
    let FieldReading { detail, quiet, .. } = *reading;
    let named = |error| match error {
        TerrainError::Setting { .. } => Failure::Terrain(error),
        _ => Failure::Field {
            file: file.to_owned(),
            error: Box::new(error),
        },
    };
    if is_raster(file) {
        let detail = detail.unwrap_or(RasterDetail::Vertices(VERTICES));
        scene_file::none(reading.load)?;
        let bar = progress::spin("reading", quiet);
        let raster_options = RasterOptions {
            max_memory: scene_file::options(reading.load).max_memory,
            units: reading.units.unwrap_or_default(),
            ..RasterOptions::default()
        };
        let loaded = load_raster_with(file, &raster_options);
        bar.finish_and_clear();
        let loaded = loaded?;
        notes::say(file, &loaded.notes, quiet);
        let bar = progress::spin("making triangles", quiet);
        let field = Field::from_raster(&loaded.raster, detail);
        bar.finish_and_clear();
        return Ok(FieldOfFile {
            field: field.map_err(named)?,
            files: vec![file.to_owned()],
        });
    }
    if detail.is_some() {
        return Err(Failure::Usage(format!(
            "'{}' is a mesh and is taken whole: --vertices and --error are for rasters",
            file.display()
        )));
    }
    let loaded = scene_file::load_at_rest(file, &[], reading.load, quiet)?;
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
