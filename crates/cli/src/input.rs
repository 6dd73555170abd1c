//! From the command line's words to a scene, its views and a camera path.

mod found;
mod motion;
mod path;

use std::path::Path;

use antumbra::cull::{Gpu, ViewSpec};
use antumbra::formats::LeftOut;
use antumbra::measure::compare::{Playback, Script};
use antumbra::measure::path::CameraPath;
use antumbra::measure::views;
use antumbra::scene::{Camera, Scene, Stereo};
use antumbra::subsurface::VolumeSections;
use antumbra::terrain::HorizonStrategy;

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::outputs::Outputs;
use crate::strategies::Horizons;
use found::Found;

/// A scene with its name, and what fits it where the command line names nothing.
pub struct Input {
    /// The scene, with proxies.
    pub scene: Scene,
    /// Its name in reports.
    pub name: String,
    /// The camera path.
    pub path: CameraPath,
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Two eyes for each pose's camera.
    pub stereo: Option<Stereo>,
    /// The seed of a built-in scene; `None` for a file.
    pub scene_seed: Option<u64>,
    /// Slices and lenses of a volume.
    pub sections: Option<VolumeSections>,
    /// The strategy that knows the scene's terrain.
    pub horizon: Option<HorizonStrategy>,
    /// What plays in it.
    pub playback: Option<Playback>,
    /// What the scene lacks of its file.
    pub left_out: LeftOut,
}

/// What is drawn where the command line names nothing.
struct Defaults {
    scene: &'static str,
    frames: u32,
    size: [u32; 2],
}

/// On a software adapter, where no scene is named: a report within a minute.
const SMALL: Defaults = Defaults {
    scene: "subsurface:140",
    frames: 18,
    size: [640, 512],
};

/// Otherwise.
const FULL: Defaults = Defaults {
    scene: "subsurface",
    frames: 120,
    size: [1280, 1024],
};

impl Input {
    /// Loads or builds what the arguments name. A raster's horizons are found where `horizons` are used. The outputs are checked against the files that a scene file refers to.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a name of nothing and for an output that would overwrite an input; what is wrong with a file otherwise.
    pub fn open(
        args: &ViewArgs,
        horizons: Horizons,
        gpu: &Gpu,
        outputs: &mut Outputs,
    ) -> Result<Self, Failure> {
        let defaults = match args.scene.is_none() && gpu.is_cpu() {
            true => SMALL,
            false => FULL,
        };
        let named = args.scene.as_deref().unwrap_or(defaults.scene);
        let size = args.size.map_or(defaults.size, |size| size.0);
        let frames = args.frames.unwrap_or(defaults.frames) as usize;
        let mut found = Found::named(named, args, horizons)?;
        for file in &found.files {
            outputs.reads("a file of the scene", file);
        }
        outputs.check()?;
        found.add_sections(args)?;
        found.scene.ensure_proxies(&Default::default());
        found.scene.update();
        let horizon = found.horizon(args.quiet);
        let playback = motion::playback(&args.motion, found.animation.take())?;
        let bounds = match &playback {
            None => found.scene.bounds(),
            Some(playback) => motion::bounds(playback, &mut found.scene)?,
        };
        let bounds = bounds.unwrap_or(Found::NO_BOUNDS);
        let path = path::path(args, &mut found, &bounds, size, frames, playback.as_ref())?;
        let stereo = args.eyes.choose(&bounds, &path)?;
        let name = Path::new(named)
            .file_name()
            .map_or(named.to_owned(), |name| name.to_string_lossy().into_owned());
        Ok(Self {
            scene: found.scene,
            name,
            path,
            size,
            samples: args.samples,
            stereo,
            scene_seed: found.seed,
            horizon,
            sections: found.sections,
            playback,
            left_out: found.left_out,
        })
    }

    /// The views to build a stage with.
    pub fn views(&self) -> Vec<ViewSpec> {
        views::specs(self.stereo.as_ref(), self.size)
    }

    /// The cameras at a pose, one a view. The animation is at the pose's time, and lenses of the scene are rotated to face the cameras.
    ///
    /// # Errors
    /// For a pose that the path does not have.
    pub fn look(&mut self, pose: usize) -> Result<Vec<Camera>, Failure> {
        let camera = self.path.camera(pose)?;
        if let Some(playback) = &self.playback {
            playback.show(&mut self.scene, pose)?;
        }
        if let Some(sections) = &mut self.sections {
            sections.orient_to(&mut self.scene, camera.position)?;
        }
        Ok(views::cameras(self.stereo.as_ref(), &camera)?)
    }
}

/// Brings a scene to each pose: plays its animation, and rotates its lenses to face the camera.
pub struct EachPose<'a> {
    /// What plays.
    pub playback: Option<&'a mut Playback>,
    /// The lenses.
    pub sections: Option<&'a mut VolumeSections>,
}

impl Script for EachPose<'_> {
    fn set(&mut self, scene: &mut Scene, pose: usize, camera: &Camera) -> Result<(), String> {
        if let Some(playback) = &mut self.playback {
            playback.set(scene, pose, camera)?;
        }
        if let Some(sections) = &mut self.sections {
            let faced = sections.orient_to(scene, camera.position);
            faced.map_err(|error| error.to_string())?;
        }
        Ok(())
    }
}
