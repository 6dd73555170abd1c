//! The built-in scene `subsurface`: the model out of a seed, cut into tiles, with wells, three slices and a lens, under two lamps.

use std::sync::Arc;

use antumbra_scene::{Drawable, EntityKey, Material, Mesh, Scene};
use glam::DAffine3;

use antumbra_subsurface::{
    Axis, BrickSource, PrepareOptions, SampleBox, SectionPositions, SlicePosition, SubsurfaceError,
    Surface, SurfaceEntities, SurfaceKind, VolumeLayout, VolumeSections, prepare_surfaces,
    surface_material,
};

mod model;

pub use model::{
    FlightPoint, Model, ModelFault, ModelLight, ModelOptions, ModelVolume, Viewpoint, Well,
};

/// What the built-in scene is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubsurfaceSceneOptions {
    /// The model.
    pub model: ModelOptions,
    /// How its surfaces are cut and simplified.
    pub prepare: PrepareOptions,
    /// Whether three slices through the seismic volume are shown.
    pub slices: bool,
    /// Whether a lens is.
    pub lens: bool,
    /// Bytes of the volume that are kept in memory.
    pub budget: usize,
}

impl Default for SubsurfaceSceneOptions {
    fn default() -> Self {
        Self {
            model: ModelOptions::default(),
            prepare: PrepareOptions::default(),
            slices: true,
            lens: true,
            budget: 64 << 20,
        }
    }
}

impl SubsurfaceSceneOptions {
    /// The settings by name, for messages: what [`Self::set`] knows.
    pub const KEYS: [&str; 8] = [
        "size",
        "seed",
        "tiles",
        "decimation",
        "thinning",
        "levels",
        "slices",
        "lens",
    ];

    /// Sets one by name. `size` is the number of nodes along a side of a horizon.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`] for a name that is none, or a value that cannot be read. Ranges are checked when the scene is built.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), SubsurfaceError> {
        match key {
            "size" => self.model.nodes_per_side = read("size", value)?,
            "seed" => self.model.seed = read("seed", value)?,
            "tiles" => self.prepare.tiles = read("tiles", value)?,
            "decimation" => self.prepare.decimation = read("decimation", value)?,
            "thinning" => self.prepare.thinning = read("thinning", value)?,
            "levels" => self.prepare.levels = read("levels", value)?,
            "slices" => self.slices = read("slices", value)?,
            "lens" => self.lens = read("lens", value)?,
            _ => {
                return Err(SubsurfaceError::Setting {
                    what: "a setting of the scene subsurface",
                    value: format!("`{key}`"),
                    problem: format!("there are: {}", Self::KEYS.join(", ")),
                });
            }
        }
        Ok(())
    }
}

fn read<T: std::str::FromStr>(what: &'static str, value: &str) -> Result<T, SubsurfaceError> {
    value.parse().map_err(|_| SubsurfaceError::Setting {
        what,
        value: format!("`{value}`"),
        problem: match std::any::type_name::<T>() {
            "bool" => "write true or false".to_owned(),
            _ => "write a number".to_owned(),
        },
    })
}

/// The built-in scene and what its parts are.
pub struct SubsurfaceScene {
    /// The scene.
    pub scene: Scene,
    /// What it shows.
    pub model: Model,
    /// Horizons from the top down, then faults.
    pub surfaces: Vec<SurfaceEntities>,
    /// The wells' entities.
    pub wells: Vec<EntityKey>,
    /// Inline, crossline and time slice, and the lens; empty until they are paged.
    pub sections: VolumeSections,
}

impl SubsurfaceScene {
    /// Builds the scene. `progress` is told how many of its surfaces are done, and of how many; it is called from several threads.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`] for an option out of range, and for a model so coarse that nothing is left of a surface
    /// [`SubsurfaceError::BadSurface`].
    pub fn new(
        options: &SubsurfaceSceneOptions,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Self, SubsurfaceError> {
        let model = Model::new(&options.model)?;
        let sources = surfaces(&model)?;
        let done = std::sync::atomic::AtomicUsize::new(0);
        let prepared = prepare_surfaces(&sources, &options.prepare, &|_| {
            let done = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            progress(done + 1, sources.len());
        })?;
        drop(sources);
        let mut scene = Scene::new();
        scene.set_name("subsurface");
        let mut surfaces = Vec::with_capacity(prepared.len());
        let mut numbers = [0, 0];
        for surface in prepared {
            let number = &mut numbers[usize::from(surface.kind == SurfaceKind::Fault)];
            let look = surface_material(&surface.name, surface.kind, *number);
            *number += 1;
            let material = scene.add_material(look);
            surfaces.push(surface.spawn(&mut scene, None, material)?);
        }
        let wells = show_wells(&model, &mut scene)?;
        for ModelLight { position, light } in model.lights() {
            let lamp = scene.spawn(None, DAffine3::from_translation(position))?;
            scene.set_entity_name(lamp, "lamp")?;
            scene.set_light(lamp, light)?;
        }
        let volume = Arc::new(model.volume());
        let places = places(volume.layout(), options);
        let sections = VolumeSections::spawn(&mut scene, volume, &places, options.budget)?;
        Ok(Self {
            scene,
            model,
            surfaces,
            wells,
            sections,
        })
    }
}

fn surfaces(model: &Model) -> Result<Vec<Surface>, SubsurfaceError> {
    use rayon::prelude::*;
    let horizons = model.options().horizons as usize;
    let all = 0..horizons + model.faults().len();
    all.into_par_iter()
        .map(|number| match number.checked_sub(horizons) {
            None => model.horizon(number),
            Some(fault) => model.fault(fault),
        })
        .collect()
}

fn show_wells(model: &Model, scene: &mut Scene) -> Result<Vec<EntityKey>, SubsurfaceError> {
    let material = scene.add_material(Material {
        name: "well".to_owned(),
        base_colour: [0.9, 0.9, 0.92, 1.0],
        ..Material::default()
    });
    let wells = model.wells().into_iter().map(|well| {
        let entity = scene.spawn(None, DAffine3::from_translation(well.origin))?;
        scene.set_entity_name(entity, well.name.as_str())?;
        let mesh = scene.add_mesh(Mesh::new(well.name, well.geometry))?;
        scene.set_drawable(entity, Drawable { mesh, material })?;
        Ok(entity)
    });
    wells.collect()
}

/// Slices behind the middle as the views see it, so that they hide without hiding all; a lens in the open corner, where layers are cut away.
fn places(layout: &VolumeLayout, options: &SubsurfaceSceneOptions) -> SectionPositions {
    let at = |axis: Axis, share: f64| {
        let last = f64::from(axis.of(layout.size).saturating_sub(1));
        (last * share).round() as u32
    };
    let slices = [
        (Axis::Inline, 0.38),
        (Axis::Crossline, 0.62),
        (Axis::Time, 0.93),
    ];
    let corner = |shares: [f64; 3]| {
        let [inline, crossline, time] = shares;
        [
            at(Axis::Inline, inline),
            at(Axis::Crossline, crossline),
            at(Axis::Time, time),
        ]
    };
    let lens = SampleBox {
        min: corner([0.62, 0.2, 0.3]),
        max: corner([0.8, 0.38, 0.48]),
    };
    SectionPositions {
        slices: slices
            .into_iter()
            .filter(|_| options.slices)
            .map(|(axis, share)| SlicePosition {
                axis,
                index: at(axis, share),
            })
            .collect(),
        lenses: Some(lens).filter(|_| options.lens).into_iter().collect(),
    }
}
