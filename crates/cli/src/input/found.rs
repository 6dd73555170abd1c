//! The scene that a name stands for: a file or a built-in one, with its terrain, its volume and its seed.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use antumbra::demo_scenes::subsurface::{Model, SubsurfaceScene, SubsurfaceSceneOptions};
use antumbra::demo_scenes::{self, DemoSceneError};
use antumbra::formats::{LeftOut, RasterFormat, SceneFormat};
use antumbra::scene::animation::Animation;
use antumbra::scene::{Aabb, Scene};
use antumbra::subsurface::{BrickSource, SectionPositions, SlicePosition, VolumeSections};
use antumbra::terrain::{
    self, HorizonStrategy, Landscape, PreparedScene, Terrain, TerrainInScene, TerrainOptions,
};
use glam::DVec3;

use crate::args::{SceneSetting, ViewArgs};
use crate::failure::Failure;
use crate::landscape::FieldReading;
use crate::print::warn;
use crate::strategies::Horizons;
use crate::{landscape, progress, scene_file, volume_source};

/// Bytes of a volume that are kept in memory.
const BUDGET: usize = 64 << 20;

/// A scene, and what belongs to it.
pub struct Found {
    /// The scene.
    pub scene: Scene,
    /// The seed of a built-in scene.
    pub seed: Option<u64>,
    /// The built-in sub-surface model, which has views of its own.
    pub model: Option<Model>,
    /// Slices and lenses of a volume.
    pub sections: Option<VolumeSections>,
    /// The terrain that was prepared, and its entities.
    pub terrain: Option<TerrainInScene>,
    /// A field that is shown without horizons, since nothing asks for them.
    pub landscape: Option<Landscape>,
    /// Whether it is the whole built-in grid, which has an orbit of its own.
    pub whole_grid: bool,
    /// The files that were read.
    pub files: Vec<PathBuf>,
    /// What moves in a file's scene.
    pub animation: Option<Animation>,
    /// What was left out of them.
    pub left_out: LeftOut,
}

impl From<PreparedScene> for Found {
    fn from(prepared: PreparedScene) -> Self {
        Self {
            terrain: Some(TerrainInScene {
                terrain: prepared.terrain,
                shown: prepared.shown,
            }),
            ..Self::of(prepared.scene)
        }
    }
}

impl Found {
    fn of(scene: Scene) -> Self {
        Self {
            scene,
            seed: None,
            model: None,
            sections: None,
            terrain: None,
            landscape: None,
            whole_grid: false,
            files: Vec::new(),
            animation: None,
            left_out: LeftOut::default(),
        }
    }

    /// The scene of this name.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a name of nothing; what is wrong with a file otherwise.
    pub fn named(named: &str, args: &ViewArgs, horizons: Horizons) -> Result<Self, Failure> {
        let file = Path::new(named);
        if landscape::is_raster(file) {
            return Self::raster(file, args, horizons);
        }
        if file.is_file() || landscape::is_mesh(file) {
            return Self::file(file, args);
        }
        if file.exists() || named.contains(['/', '\\']) {
            return Err(Failure::Usage(format!(
                "'{named}' is no scene: name a file (.{}, .{}) or a built-in scene ({})",
                SceneFormat::EXTENSIONS.join(", ."),
                RasterFormat::EXTENSIONS.join(", ."),
                built_in_names().join(", ")
            )));
        }
        scene_file::none(&args.load)?;
        let mut words = named.split(':');
        let name = words.next().unwrap_or_default();
        let settings: Vec<SceneSetting<'_>> = words.map(SceneSetting::read).collect();
        match name {
            "subsurface" => Self::subsurface(&settings, args),
            "terrain" => Self::terrain(&settings, args.quiet),
            _ => Self::built_in(name, &settings),
        }
    }

    /// A raster as a terrain. Its horizons take most of the time, and are found only where a strategy uses them.
    fn raster(file: &Path, args: &ViewArgs, horizons: Horizons) -> Result<Self, Failure> {
        let reading = FieldReading {
            detail: None,
            load: &args.load,
            units: args.units,
            quiet: args.quiet,
        };
        let field = landscape::field(file, &reading)?.field;
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        if horizons == Horizons::Used {
            let terrain = landscape::prepare(field, &TerrainOptions::default(), args.quiet)?;
            return Ok(PreparedScene::from_terrain(terrain, &stem)?.into());
        }
        let landscape = Landscape::new(field);
        let mut scene = Scene::new();
        scene.set_name(stem);
        landscape.show_lit(&mut scene)?;
        Ok(Self {
            landscape: Some(landscape),
            ..Self::of(scene)
        })
    }

    fn terrain(settings: &[SceneSetting<'_>], quiet: bool) -> Result<Self, Failure> {
        let mut options = demo_scenes::terrain::TerrainSceneOptions::default();
        for SceneSetting { key, value } in settings {
            options.set(key, value)?;
        }
        Ok(Self {
            seed: Some(options.landscape.seed),
            ..landscape::built_in(&options, quiet)?.into()
        })
    }

    /// A scene file, with its terrain if that was prepared. Where the file's extension is unusable, a scene without a terrain.
    fn file(file: &Path, args: &ViewArgs) -> Result<Self, Failure> {
        let attachments = [terrain::file::EXTENSION];
        let load = match args.motion.requested() {
            true => scene_file::load,
            false => scene_file::load_at_rest,
        };
        let loaded = load(file, &attachments, &args.load, args.quiet)?;
        let attachment = loaded.attachments.into_iter().next();
        let known = attachment.map(|attachment| Terrain::read(&loaded.scene, &attachment?));
        let terrain = known.and_then(|known| match known {
            Ok(known) => Some(known),
            Err(error) => {
                if !args.quiet {
                    let file = file.display();
                    warn(format!("{file}: shown without its horizons: {error}"));
                }
                None
            }
        });
        Ok(Self {
            terrain,
            files: loaded.files,
            animation: loaded.animation,
            left_out: loaded.left_out,
            ..Self::of(loaded.scene)
        })
    }

    fn subsurface(settings: &[SceneSetting<'_>], args: &ViewArgs) -> Result<Self, Failure> {
        let mut options = SubsurfaceSceneOptions::default();
        for SceneSetting { key, value } in settings {
            options.set(key, value)?;
        }
        // Sections that the command line names replace the model's own.
        if args.volume.are_named() {
            (options.slices, options.lens) = (false, false);
        }
        let bar = progress::work("preparing", args.quiet);
        let count = progress::count(&bar);
        let built = SubsurfaceScene::new(&options, &|done, total| {
            count(done as u64, total as u64);
        });
        bar.finish_and_clear();
        let mut built = built?;
        built.sections.page(&mut built.scene, &|_| false)?;
        Ok(Self {
            seed: Some(options.model.seed),
            model: Some(built.model),
            sections: Some(built.sections),
            ..Self::of(built.scene)
        })
    }

    fn built_in(name: &str, settings: &[SceneSetting<'_>]) -> Result<Self, Failure> {
        let mut size = None;
        for SceneSetting { key, value } in settings {
            if *key != "size" {
                return Err(Failure::Usage(format!(
                    "'{key}' is no setting of {name}: it has a size alone, {name}:2"
                )));
            }
            let number = value.parse();
            size =
                Some(number.map_err(|_| {
                    Failure::Usage(format!("'{value}' is no size: write {name}:2"))
                })?);
        }
        let scene = demo_scenes::by_name(name, size).map_err(|error| match error {
            DemoSceneError::UnknownName { name } => Failure::Usage(format!(
                "there is no built-in scene \"{name}\"; there are: {}",
                built_in_names().join(", ")
            )),
            error => error.into(),
        })?;
        Ok(Self {
            seed: match name {
                "turbine" => Some(demo_scenes::TurbineOptions::default().seed),
                "city" => Some(demo_scenes::CityOptions::default().seed),
                _ => Some(demo_scenes::GridOptions::default().seed),
            },
            whole_grid: name == "grid" && size.is_none(),
            ..Self::of(scene)
        })
    }

    /// The strategy of the scene's terrain, prepared for every entity that stands on it.
    pub fn horizon(&self, quiet: bool) -> Option<HorizonStrategy> {
        let TerrainInScene { terrain, shown } = self.terrain.as_ref()?;
        let horizon = HorizonStrategy::new(Arc::clone(terrain), shown);
        let bar = progress::work("finding horizons of entities", quiet);
        bar.set_length(u64::from(terrain.groups().sectors().count()));
        horizon.prepare_entities(&self.scene, &|| bar.inc(1));
        bar.finish_and_clear();
        Some(horizon)
    }

    /// Where there is no entity, the box around the origin that cameras look at.
    pub const NO_BOUNDS: Aabb = Aabb {
        min: DVec3::NEG_ONE,
        max: DVec3::ONE,
    };

    /// Adds the sections that the arguments name: of their volume, or of the model's.
    pub fn add_sections(&mut self, view: &ViewArgs) -> Result<(), Failure> {
        let args = &view.volume;
        let source: Arc<dyn BrickSource> = match (&args.file, &self.model) {
            (Some(file), _) => {
                let options = args.segy.options(view.units, view.load.memory);
                volume_source::open(file, &options, view.quiet)?
            }
            _ if !args.are_named() => return Ok(()),
            (None, Some(model)) => Arc::new(model.volume()),
            (None, None) => {
                return Err(Failure::Usage(
                    "slices and lenses need a volume: name one with --volume".to_owned(),
                ));
            }
        };
        let places = if args.slice.is_empty() && args.lens.is_empty() {
            SectionPositions::middle(source.as_ref())
        } else {
            SectionPositions {
                slices: (args.slice.iter())
                    .map(|at| SlicePosition {
                        axis: at.axis,
                        index: at.sample,
                    })
                    .collect(),
                lenses: args.lens.iter().map(|at| at.0).collect(),
            }
        };
        let mut sections = VolumeSections::spawn(&mut self.scene, source, &places, BUDGET)?;
        sections.page(&mut self.scene, &|_| false)?;
        self.sections = Some(sections);
        Ok(())
    }
}

fn built_in_names() -> Vec<&'static str> {
    ["subsurface", "terrain"]
        .into_iter()
        .chain(demo_scenes::names().iter().copied())
        .collect()
}
