//! Horizons, faults and picks made into a scene; cell properties made into a volume.

use std::path::Path as FilePath;

use antumbra::demo_scenes::subsurface::{Model, SubsurfaceSceneOptions};
use antumbra::formats::save_glb;
use antumbra::scene::Scene;
use antumbra::subsurface::read::{self, GridFile, ReadOptions, SurfaceFile, ZPositive};
use antumbra::subsurface::segy::SegyFile;
use antumbra::subsurface::{
    BrickSource, PrepareOptions, PreparedSurface, Surface, SurfaceKind, VolumeLayout,
    add_default_lights, prepare_surfaces, surface_material, write_volume,
};

use crate::args::{Kind, PrepareArgs, SceneSetting, Way};
use crate::failure::Failure;
use crate::notes::{self, Notes};
use crate::print::print;
use crate::{progress, volume_source};

/// Horizons and faults into a scene.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn scene(args: &PrepareArgs) -> Result<(), Failure> {
    let options = PrepareOptions {
        tiles: args.subsurface.tiles,
        decimation: args.subsurface.decimation,
        thinning: args.subsurface.thinning,
        levels: args.subsurface.levels,
    };
    // Wrong usage is found before anything is read.
    options.check()?;
    let mut surfaces = Vec::new();
    let mut options_of_file = read_options(args);
    let mut notes = Notes::default();
    for input in &args.input {
        let file = read_surfaces(args, input, &options_of_file)?;
        notes.add(input, &file.notes);
        // All that is in degrees is taken to metres alike.
        options_of_file.latitude = options_of_file.latitude.or(file.latitude);
        surfaces.extend(file.surfaces);
    }
    notes.say(args.quiet);
    let bar = progress::work("preparing", args.quiet);
    bar.set_length(surfaces.len() as u64);
    let prepared = prepare_surfaces(&surfaces, &options, &|_| bar.inc(1));
    bar.finish_and_clear();
    let prepared = prepared?;
    drop(surfaces);
    let triangles: usize = prepared.iter().map(PreparedSurface::triangles).sum();
    let proxies: usize = prepared.iter().map(PreparedSurface::proxy_triangles).sum();
    let tiles: usize = prepared.iter().map(|surface| surface.tiles.len()).sum();
    let flipped: usize = prepared.iter().map(|surface| surface.flipped).sum();
    let is_fault = |surface: &&PreparedSurface| surface.kind == SurfaceKind::Fault;
    let faults = prepared.iter().filter(is_fault).count();
    let horizons = prepared.len() - faults;
    let mut scene = Scene::new();
    let name = args.output.file_stem().unwrap_or_default();
    scene.set_name(name.to_string_lossy());
    let mut numbers = [0, 0];
    for surface in prepared {
        let number = &mut numbers[usize::from(surface.kind == SurfaceKind::Fault)];
        let material = scene.add_material(surface_material(&surface.name, surface.kind, *number));
        *number += 1;
        surface.spawn(&mut scene, None, material)?;
    }
    add_default_lights(&mut scene)?;
    save_glb(&scene, &args.output)?;
    if !args.quiet {
        print(format_args!(
            "{}: {horizons} horizons and {faults} faults in {tiles} entities, {triangles} triangles; proxies of {proxies}",
            args.output.display()
        ))?;
        if flipped > 0 {
            print(format_args!(
                "{flipped} triangles of the proxies are upside down in plan"
            ))?;
        }
    }
    Ok(())
}

fn read_surfaces(
    args: &PrepareArgs,
    input: &FilePath,
    options: &ReadOptions,
) -> Result<SurfaceFile, Failure> {
    if let Some(model) = model(input)? {
        let bar = progress::work("making", args.quiet);
        let horizons = model.options().horizons as usize;
        let all = 0..horizons + model.faults().len();
        bar.set_length(all.len() as u64);
        let surfaces = all.map(|number| {
            bar.inc(1);
            match number.checked_sub(horizons) {
                None => model.horizon(number),
                Some(fault) => model.fault(fault),
            }
        });
        let surfaces = surfaces.collect::<Result<Vec<Surface>, _>>();
        bar.finish_and_clear();
        return Ok(SurfaceFile {
            surfaces: surfaces?,
            latitude: None,
            notes: Vec::new(),
        });
    }
    let bar = progress::work("reading", args.quiet);
    let file = read::surface_file(input, options, &mut progress::count(&bar));
    bar.finish_and_clear();
    Ok(file?)
}

fn read_options(args: &PrepareArgs) -> ReadOptions {
    ReadOptions {
        z_positive: args.subsurface.positive.map(|way| match way {
            Way::Down => ZPositive::Down,
            Way::Up => ZPositive::Up,
        }),
        kind: args.subsurface.kind.map(|kind| match kind {
            Kind::Horizon => SurfaceKind::Horizon,
            Kind::Fault => SurfaceKind::Fault,
        }),
        longest_edge: args.subsurface.longest_edge,
        max_memory: args.load.memory,
        surface_column: args.subsurface.surface_column.clone(),
        units: args.units.unwrap_or_default(),
        latitude: None,
    }
}

/// The built-in model, if that is what the word names.
fn model(input: &FilePath) -> Result<Option<Model>, Failure> {
    let text = input.to_string_lossy();
    let mut words = text.split(':');
    if words.next() != Some("subsurface") || input.is_file() {
        return Ok(None);
    }
    let mut options = SubsurfaceSceneOptions::default();
    for SceneSetting { key, value } in words.map(SceneSetting::read) {
        options.set(key, value)?;
    }
    Ok(Some(Model::new(&options.model)?))
}

/// Cell properties into a volume.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn volume(args: &PrepareArgs) -> Result<(), Failure> {
    let [input] = args.input.as_slice() else {
        return Err(Failure::Usage("a volume is made of one input".to_owned()));
    };
    if let Some(model) = model(input)? {
        return write(args, "subsurface", &model.volume());
    }
    if SegyFile::is_named(input) {
        return segy(args, input);
    }
    let Some(grid_file) = &args.subsurface.grid else {
        return Err(Failure::Usage(format!(
            "'{}' has values of cells: name the grid they belong to with --grid GRID, a .roff, .grdecl or .egrid file",
            input.display()
        )));
    };
    let options = read_options(args);
    let GridFile { grid, notes } = read::grid_file(grid_file, &options)?;
    notes::say(grid_file, &notes, args.quiet);
    let wanted = args.subsurface.property.as_deref();
    let property = read::property_of(&grid, input, wanted, &options)?;
    let [i, j, k] = grid.size();
    let wide = 2 * i.max(j);
    let samples = args
        .subsurface
        .samples
        .map_or([wide, wide, 2 * k], |samples| samples.0);
    let bar = progress::work("resampling", args.quiet);
    let volume = grid.volume(&property, samples, &mut progress::count(&bar));
    bar.finish_and_clear();
    let volume = volume?;
    write(args, volume.name(), &volume)
}

/// A SEG-Y file into a volume.
fn segy(args: &PrepareArgs, input: &FilePath) -> Result<(), Failure> {
    let options = args.segy.options(args.units, args.load.memory);
    let volume = volume_source::segy(input, &options, args.quiet)?;
    let name = input.file_stem().unwrap_or_default().to_string_lossy();
    let bar = progress::work("writing", args.quiet);
    let written = volume.write(&args.output, &name, &mut progress::count(&bar));
    bar.finish_and_clear();
    written?;
    summarise(args, volume.layout())
}

fn write(args: &PrepareArgs, name: &str, source: &dyn BrickSource) -> Result<(), Failure> {
    let bar = progress::work("writing", args.quiet);
    let written = write_volume(&args.output, name, source, &mut progress::count(&bar));
    bar.finish_and_clear();
    written?;
    summarise(args, source.layout())
}

fn summarise(args: &PrepareArgs, layout: &VolumeLayout) -> Result<(), Failure> {
    if !args.quiet {
        let [i, c, t] = layout.size;
        let [low, high] = layout.range;
        print(format_args!(
            "{}: {i} x {c} x {t} samples, {low} to {high}, in bricks of {}",
            args.output.display(),
            layout.brick
        ))?;
    }
    Ok(())
}
