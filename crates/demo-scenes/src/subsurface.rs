//! The scene `subsurface`: horizons, faults and wells of a seeded model, three slices and a lens of its seismic
//! volume, and two point lights.

use std::sync::Arc;

use antumbra_scene::{Drawable, EntityKey, Material, Mesh, Scene};
use glam::DAffine3;

use antumbra_subsurface::{
    Axis, BrickSource, SampleBox, SectionPositions, SlicePosition, SubsurfaceError, Surface,
    SurfaceEntities, SurfaceKind, VolumeLayout, VolumeSections, prepare_surfaces, surface_material,
};

mod model;
mod options;

pub use model::{
    FlightPoint, Model, ModelFault, ModelLight, ModelOptions, ModelVolume, Viewpoint, Well,
};
pub use options::SubsurfaceSceneOptions;

/// The scene `subsurface` and the entities of its parts.
pub struct SubsurfaceScene {
    /// The scene.
    pub scene: Scene,
    /// The model that the scene shows.
    pub model: Model,
    /// The surfaces: horizons from the top down, then faults.
    pub surfaces: Vec<SurfaceEntities>,
    /// The entities of the wells.
    pub wells: Vec<EntityKey>,
    /// Inline slice, crossline slice, time slice and lens. They draw nothing until they are paged.
    pub sections: VolumeSections,
}

impl SubsurfaceScene {
    /// Builds the scene. `progress(done, total)` is called after each surface, from several threads.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`] for an option out of range; [`SubsurfaceError::BadSurface`] if the model is so
    /// coarse that a surface has no cell left.
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
            let material = surface_material(&surface.name, surface.kind, *number);
            *number += 1;
            let material = scene.add_material(material);
            surfaces.push(surface.spawn(&mut scene, None, material)?);
        }
        let wells = spawn_wells(&model, &mut scene)?;
        for ModelLight { position, light } in model.lights() {
            let lamp = scene.spawn(None, DAffine3::from_translation(position))?;
            scene.set_entity_name(lamp, "lamp")?;
            scene.set_light(lamp, light)?;
        }
        let volume = Arc::new(model.volume());
        let positions = section_positions(volume.layout(), options);
        let sections = VolumeSections::spawn(&mut scene, volume, &positions, options.budget)?;
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

fn spawn_wells(model: &Model, scene: &mut Scene) -> Result<Vec<EntityKey>, SubsurfaceError> {
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

/// Positions of the slices and the lens. The slices lie behind the centre as the viewpoints see it, so that they hide
/// a part of the model. The lens lies in the open corner, where the layers are cut away.
fn section_positions(layout: &VolumeLayout, options: &SubsurfaceSceneOptions) -> SectionPositions {
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
