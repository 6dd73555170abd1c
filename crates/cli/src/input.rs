//! From the command line's words to a device, a scene and a path.

use std::path::Path;
use std::sync::Arc;

use antumbra::cull::ViewSpec;
use antumbra::demo_scenes::DemoSceneError;
use antumbra::demo_scenes::subsurface::{Model, SubsurfaceScene, SubsurfaceSceneOptions};
use antumbra::draw::Gpu;
use antumbra::formats::{LoadOptions, RasterFormat, SceneFormat, load_with_attachments};
use antumbra::measure::compare::Script;
use antumbra::measure::path::{CameraPath, Orbit, Pose};
use antumbra::measure::views;
use antumbra::scene::{Aabb, Camera, Projection, Scene, Stereo};
use antumbra::subsurface::{
    BrickSource, SectionPositions, SlicePosition, VolumeFile, VolumeSections,
};
use antumbra::terrain::{
    FlightStation, HorizonStrategy, PreparedScene, Terrain, TerrainInScene, TerrainOptions,
};
use antumbra::{demo_scenes, terrain};

use glam::DVec3;

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::landscape;
use crate::progress;

/// A scene with its name, and what fits it where the command line is silent.
pub struct Input {
    /// The scene, with proxies.
    pub scene: Scene,
    /// What reports call it.
    pub name: String,
    /// The camera path.
    pub path: CameraPath,
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
    /// Two eyes for each pose's camera.
    pub stereo: Option<Stereo>,
    /// What a built-in scene was made from; `None` for a file.
    pub scene_seed: Option<u64>,
    /// Slices and lenses of a volume.
    pub sections: Option<VolumeSections>,
    /// The strategy that knows the scene's terrain.
    pub horizon: Option<HorizonStrategy>,
}

/// Without a scene named, a software adapter gets a smaller one, so that the answer comes within a minute.
const SMALL: (&str, u32, [u32; 2]) = ("subsurface:140", 18, [640, 512]);
const FULL: (&str, u32, [u32; 2]) = ("subsurface", 120, [1280, 1024]);

/// The near plane of sub-surface views, in metres: the model is 6 km wide, and flown through.
const NEAR: f64 = 5.0;

/// Frames of the whole flight through the sub-surface model: half a minute of a screen's.
const FLIGHT: usize = 1800;

/// Metres of a flight above a terrain, and a part of a small one's width.
const FLYING: (f64, f64) = (30.0, 0.02);

/// Bytes of a volume that are kept in memory.
const BUDGET: usize = 64 << 20;

impl Input {
    /// Loads or builds what the arguments name.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a name nothing answers to; what is wrong with a file otherwise.
    pub fn open(args: &ViewArgs, gpu: &Gpu) -> Result<Self, Failure> {
        let (default_scene, frames, size) = if args.scene.is_none() && gpu.is_cpu() {
            SMALL
        } else {
            FULL
        };
        let named = args.scene.as_deref().unwrap_or(default_scene);
        let size = args.size.map_or(size, |size| size.0);
        let frames = args.frames.unwrap_or(frames) as usize;
        let mut found = Found::named(named, args.asks_for_sections())?;
        found.add_sections(args)?;
        found.scene.ensure_proxies(&Default::default());
        found.scene.update();
        let horizon = found.horizon();
        let bounds = found.bounds();
        let path = path(args, &found, &bounds, size, frames)?;
        let stereo = args.eyes.choose(&bounds, &path)?;
        let name = Path::new(named)
            .file_name()
            .map_or(named.to_owned(), |name| name.to_string_lossy().into_owned());
        Ok(Self {
            scene: found.scene,
            name,
            path,
            size,
            stereo,
            scene_seed: found.seed,
            horizon,
            sections: found.sections,
        })
    }
}

impl Input {
    /// The views to build a stage with.
    pub fn views(&self) -> Vec<ViewSpec> {
        views::specs(self.stereo.as_ref(), self.size)
    }

    /// The cameras at a pose, one a view, with the scene turned towards them.
    ///
    /// # Errors
    /// For a pose that the path does not have.
    pub fn look(&mut self, pose: usize) -> Result<Vec<Camera>, Failure> {
        let camera = self.path.camera(pose)?;
        if let Some(sections) = &mut self.sections {
            sections.orient_to(&mut self.scene, camera.position)?;
        }
        Ok(views::cameras(self.stereo.as_ref(), &camera)?)
    }
}

/// What a name stands for.
struct Found {
    scene: Scene,
    /// What a built-in scene was made from.
    seed: Option<u64>,
    /// What the scene brings its own views of.
    model: Option<Model>,
    sections: Option<VolumeSections>,
    /// What is known of its terrain.
    terrain: Option<TerrainInScene>,
    /// Whether it is the whole built-in grid, which has an orbit of its own.
    whole_grid: bool,
}

impl From<PreparedScene> for Found {
    fn from(prepared: PreparedScene) -> Self {
        Self {
            scene: prepared.scene,
            seed: None,
            model: None,
            sections: None,
            terrain: Some(TerrainInScene {
                terrain: prepared.terrain,
                shown: prepared.shown,
            }),
            whole_grid: false,
        }
    }
}

impl Found {
    /// `bare`: a built-in model comes without its own slices and lens.
    fn named(named: &str, bare: bool) -> Result<Self, Failure> {
        let file = Path::new(named);
        if landscape::is_raster(file) {
            let field = landscape::field(file, None)?;
            let terrain = landscape::prepare(field, &TerrainOptions::default(), false)?;
            let stem = file.file_stem().unwrap_or_default();
            return Ok(PreparedScene::from_terrain(terrain, &stem.to_string_lossy())?.into());
        }
        if file.is_file() || landscape::is_mesh(file) {
            return Self::file(file);
        }
        if file.exists() || named.contains(['/', '\\']) {
            return Err(Failure::Usage(format!(
                "'{named}' is no scene: name a file (.{}, .{}) or a built-in scene ({})",
                SceneFormat::EXTENSIONS.join(", ."),
                RasterFormat::EXTENSIONS.join(", ."),
                built_in_names().join(", ")
            )));
        }
        let mut words = named.split(':');
        let name = words.next().unwrap_or_default();
        let settings: Vec<(&str, &str)> = words
            .map(|word| word.split_once('=').unwrap_or(("size", word)))
            .collect();
        match name {
            "subsurface" => Self::subsurface(&settings, bare),
            "terrain" => Self::terrain(&settings),
            _ => Self::built_in(name, &settings),
        }
    }

    fn terrain(settings: &[(&str, &str)]) -> Result<Self, Failure> {
        let mut options = demo_scenes::terrain::TerrainSceneOptions::default();
        for (key, value) in settings {
            options.set(key, value)?;
        }
        Ok(Self {
            seed: Some(options.landscape.seed),
            ..landscape::built_in(&options, false)?.into()
        })
    }

    /// A scene file, and its terrain if that was prepared. Where what it says of that cannot be used it is a scene as any other.
    fn file(file: &Path) -> Result<Self, Failure> {
        let options = LoadOptions::default();
        let loaded = load_with_attachments(file, &options, &[terrain::file::EXTENSION]);
        let loaded = loaded.map_err(|error| Failure::Load {
            path: file.to_owned(),
            error,
        })?;
        let attachment = loaded.attachments.into_iter().next();
        let known = attachment.map(|attachment| Terrain::read(&loaded.scene, &attachment?));
        let terrain = known.and_then(|known| match known {
            Ok(known) => Some(known),
            Err(error) => {
                eprintln!(
                    "antumbra: {}: shown without its horizons: {error}",
                    file.display()
                );
                None
            }
        });
        Ok(Self {
            scene: loaded.scene,
            seed: None,
            model: None,
            sections: None,
            terrain,
            whole_grid: false,
        })
    }

    fn subsurface(settings: &[(&str, &str)], bare: bool) -> Result<Self, Failure> {
        let mut options = SubsurfaceSceneOptions::default();
        for (key, value) in settings {
            options.set(key, value)?;
        }
        if bare {
            (options.slices, options.lens) = (false, false);
        }
        let bar = progress::work("preparing", false);
        let built = SubsurfaceScene::new(&options, &|done, total| {
            bar.set_length(total as u64);
            bar.set_position(done as u64);
        });
        bar.finish_and_clear();
        let mut built = built?;
        built.sections.page(&mut built.scene, &|_| false)?;
        Ok(Self {
            scene: built.scene,
            seed: Some(options.model.seed),
            model: Some(built.model),
            sections: Some(built.sections),
            terrain: None,
            whole_grid: false,
        })
    }

    fn built_in(name: &str, settings: &[(&str, &str)]) -> Result<Self, Failure> {
        let mut size = None;
        for (key, value) in settings {
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
            scene,
            seed: match name {
                "turbine" => Some(demo_scenes::TurbineOptions::default().seed),
                "city" => Some(demo_scenes::CityOptions::default().seed),
                _ => Some(demo_scenes::GridOptions::default().seed),
            },
            model: None,
            sections: None,
            terrain: None,
            whole_grid: name == "grid" && size.is_none(),
        })
    }
}

impl Found {
    /// The strategy of the scene's terrain, with all that stands on it prepared.
    fn horizon(&self) -> Option<HorizonStrategy> {
        let TerrainInScene { terrain, shown } = self.terrain.as_ref()?;
        let horizon = HorizonStrategy::new(Arc::clone(terrain), shown);
        let bar = progress::work("finding horizons of entities", false);
        bar.set_length(u64::from(terrain.groups().sectors().count()));
        horizon.prepare_entities(&self.scene, &|| bar.inc(1));
        bar.finish_and_clear();
        Some(horizon)
    }

    /// The box around the scene; around nothing, one to look at.
    fn bounds(&self) -> Aabb {
        let nothing = Aabb::new(DVec3::NEG_ONE, DVec3::ONE);
        self.scene.bounds().unwrap_or(nothing)
    }

    /// Adds what the arguments ask for: of the volume they name, or of the model's own.
    fn add_sections(&mut self, args: &ViewArgs) -> Result<(), Failure> {
        let source: Arc<dyn BrickSource> = match (&args.volume, &self.model) {
            (Some(file), _) => Arc::new(VolumeFile::open(file)?),
            _ if !args.asks_for_sections() => return Ok(()),
            (None, Some(model)) => Arc::new(model.volume()),
            (None, None) => {
                return Err(Failure::Usage(
                    "slices and lenses are of a volume: name one with --volume".to_owned(),
                ));
            }
        };
        let places = if args.slice.is_empty() && args.lens.is_empty() {
            SectionPositions::middle(source.as_ref())
        } else {
            SectionPositions {
                slices: args
                    .slice
                    .iter()
                    .map(|at| SlicePosition {
                        axis: at.0,
                        index: at.1,
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

impl ViewArgs {
    /// Whether sections of a volume are asked for, in place of a model's own.
    fn asks_for_sections(&self) -> bool {
        self.volume.is_some() || !self.slice.is_empty() || !self.lens.is_empty()
    }
}

/// Turns the lenses towards each pose.
pub struct FaceLenses<'a>(pub &'a mut VolumeSections);

impl Script for FaceLenses<'_> {
    fn set(&mut self, scene: &mut Scene, _: usize, camera: &Camera) -> Result<(), String> {
        let faced = self.0.orient_to(scene, camera.position);
        faced.map(|_| ()).map_err(|error| error.to_string())
    }
}

fn built_in_names() -> Vec<&'static str> {
    ["subsurface", "terrain"]
        .into_iter()
        .chain(demo_scenes::names().iter().copied())
        .collect()
}

fn path(
    args: &ViewArgs,
    found: &Found,
    bounds: &Aabb,
    size: [u32; 2],
    frames: usize,
) -> Result<CameraPath, Failure> {
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    if let Some(model) = &found.model
        && let Some(path) = own_path(args.path.as_deref(), model, frames)?
    {
        return Ok(path);
    }
    if let Some(TerrainInScene { terrain, .. }) = &found.terrain
        && matches!(args.path.as_deref(), None | Some("flight"))
    {
        return over(terrain, frames);
    }
    match args.path.as_deref() {
        // The grid's own orbit, whole grid or a part of it.
        None | Some("orbit") if found.whole_grid => Ok(CameraPath::orbit(&Orbit::grid(frames))?),
        None | Some("orbit") => Ok(CameraPath::orbit_around(bounds, aspect, frames)?),
        Some("flight") => Ok(CameraPath::flight(bounds, args.seed, frames)?),
        Some(file) => Ok(CameraPath::load(file)?),
    }
}

/// A flight over a terrain.
fn over(terrain: &Terrain, frames: usize) -> Result<CameraPath, Failure> {
    let [low, high] = terrain.field().plan_bounds();
    let height = FLYING.0.min((high - low).max_element() * FLYING.1);
    let projection = Projection::Perspective {
        fov_y: 0.9,
        near: height / FLYING.0,
    };
    let look = |station: FlightStation| Pose::look_at(station.eye, station.target, None);
    let poses = terrain.flight(height, frames).into_iter().map(look);
    let poses = poses.collect::<Result<Vec<_>, _>>();
    let poses = poses.map_err(|error| Failure::Usage(format!("the flight: {error}")))?;
    Ok(CameraPath::new("flight", projection, poses)?)
}

/// A path that a sub-surface model brings along: its flight, or one of its views.
fn own_path(
    named: Option<&str>,
    model: &Model,
    frames: usize,
) -> Result<Option<CameraPath>, Failure> {
    let projection = |fov_y| Projection::Perspective { fov_y, near: NEAR };
    let views = model.views();
    match named {
        None | Some("flight") => {
            let fov_y = views.first().map_or(0.7, |view| view.fov_y);
            let flight = model.flight();
            let places: Vec<_> = flight.iter().map(|at| (at.eye, at.target)).collect();
            let path = CameraPath::through("flight", &places, projection(fov_y), FLIGHT, frames)?;
            Ok(Some(path))
        }
        Some(name) => {
            let Some(view) = views.iter().find(|view| view.name == name) else {
                return Ok(None);
            };
            let pose = Pose::look_at(view.position, view.target, None)
                .map_err(|error| Failure::Usage(format!("the view {name}: {error}")))?;
            let poses = vec![pose; frames];
            Ok(Some(CameraPath::new(name, projection(view.fov_y), poses)?))
        }
    }
}
