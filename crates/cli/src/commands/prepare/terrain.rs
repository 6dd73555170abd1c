//! A raster, a mesh or the built-in landscape made into a terrain with its horizons.

use std::path::Path;

use antumbra::demo_scenes::terrain::TerrainSceneOptions;
use antumbra::terrain::{
    GroupOptions, PreparedScene, RasterDetail, Sectors, Terrain, TerrainOptions,
};

use crate::args::{PrepareArgs, SceneSetting, TerrainArgs};
use crate::failure::Failure;
use crate::landscape;
use crate::outputs::Outputs;
use crate::print::print;
use crate::scene_file;

/// Whether a word names the built-in landscape.
pub fn is_built_in(input: &Path) -> bool {
    let text = input.to_string_lossy();
    text.split(':').next() == Some("terrain") && !input.is_file()
}

/// Makes the terrain and writes the scene that shows it.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn scene(args: &PrepareArgs, outputs: &mut Outputs) -> Result<(), Failure> {
    let [input] = args.input.as_slice() else {
        return Err(Failure::Usage("a terrain is made of one input".to_owned()));
    };
    let stem = args.output.file_stem().unwrap_or_default();
    let mut made = if is_built_in(input) {
        scene_file::none(&args.load)?;
        built_in(&input.to_string_lossy(), args)?
    } else if landscape::is_raster(input) || landscape::is_mesh(input) {
        PreparedScene::from_terrain(out_of(input, args, outputs)?, "terrain")?
    } else {
        return Err(Failure::Usage(format!(
            "'{}' is neither a raster (.npz, .asc, .grd, .tif) nor a mesh (.glb, .gltf, .obj, .ply, .stl) by its ending",
            input.display()
        )));
    };
    made.scene.set_name(stem.to_string_lossy());
    made.terrain.save(&made.scene, &made.shown, &args.output)?;
    match args.quiet {
        true => Ok(()),
        false => summarise(args, &made.terrain),
    }
}

fn summarise(args: &PrepareArgs, terrain: &Terrain) -> Result<(), Failure> {
    let (field, groups) = (terrain.field(), terrain.groups());
    let crystals = groups.groups().iter().filter(|group| group.is_leaf());
    let reaches = match groups.sectors().reaches() {
        1 => String::new(),
        reaches => format!(" with {reaches} reaches"),
    };
    print(format_args!(
        "{}: {} vertices and {} triangles; {} groups that hide together, {} triangles in none; horizons in {} sectors of {}, {}{reaches}",
        args.output.display(),
        field.points().len(),
        field.triangles().len(),
        crystals.count(),
        groups.ungrouped().len(),
        groups.sectors().count(),
        groups.sectors().parts(),
        terrain.method(),
    ))?;
    match field.boundary().convex {
        true => Ok(()),
        false => print("it has holes or dents: horizon culls what is seen over their rims alone"),
    }
}

fn out_of(input: &Path, args: &PrepareArgs, outputs: &mut Outputs) -> Result<Terrain, Failure> {
    let TerrainArgs {
        vertices, error, ..
    } = args.terrain;
    let vertices = vertices.map(RasterDetail::Vertices);
    let detail = vertices.or(error.map(RasterDetail::Error));
    let sectors = sectors(&args.terrain, Sectors::default())?;
    let reading = landscape::FieldReading {
        detail,
        load: &args.load,
        units: args.units,
        quiet: args.quiet,
    };
    let landscape::FieldOfFile { field, files } = landscape::field(input, &reading)?;
    files
        .iter()
        .for_each(|file| outputs.reads("a file of the input", file));
    outputs.check()?;
    let options = TerrainOptions {
        sectors,
        method: args.terrain.method.unwrap_or_default(),
        groups: args.terrain.seeds.map(GroupOptions::of_seeds),
    };
    let options = match args.terrain.seed {
        Some(seed) => options.seeded(seed, &field),
        None => options,
    };
    landscape::prepare(field, &options, args.quiet)
}

fn built_in(named: &str, args: &PrepareArgs) -> Result<PreparedScene, Failure> {
    let wanted = &args.terrain;
    if wanted.error.is_some() {
        return Err(Failure::Usage(
            "the built-in terrain has a number of vertices: --error is for rasters".to_owned(),
        ));
    }
    let mut options = TerrainSceneOptions::default();
    for SceneSetting { key, value } in named.split(':').skip(1).map(SceneSetting::read) {
        options.set(key, value)?;
    }
    options.vertices = wanted.vertices.unwrap_or(options.vertices);
    options.landscape.seed = wanted.seed.unwrap_or(options.landscape.seed);
    options.prepare.method = wanted.method.unwrap_or(options.prepare.method);
    let groups = wanted.seeds.map(GroupOptions::of_seeds);
    options.prepare.groups = groups.or(options.prepare.groups);
    options.prepare.sectors = sectors(wanted, options.prepare.sectors)?;
    landscape::built_in(&options, args.quiet)
}

/// The sectors that are named; `other` for what is not.
fn sectors(wanted: &TerrainArgs, other: Sectors) -> Result<Sectors, Failure> {
    let count = wanted.sectors.unwrap_or(other.count());
    let parts = wanted.parts.unwrap_or(other.parts());
    let reaches = wanted.reaches.unwrap_or(other.reaches());
    Ok(Sectors::new(count, parts)?.with_reaches(reaches)?)
}
