//! The camera path that the command line names, or the one that suits the scene.

use antumbra::demo_scenes::subsurface::Model;
use antumbra::measure::compare::Playback;
use antumbra::measure::path::{CameraPath, Orbit, Pose, Waypoint};
use antumbra::scene::{Aabb, Camera, Projection, Scene};
use antumbra::terrain::{Field, FlightStation};

use super::found::Found;
use crate::args::{PathArg, ViewArgs};
use crate::failure::Failure;

/// The near plane of sub-surface views, in metres: the model is 6 km wide, and flown through.
const NEAR: f64 = 5.0;

/// Frames of the whole flight through the sub-surface model: half a minute at 60 frames a second.
const FLIGHT: usize = 1800;

/// The height of a flight above a terrain.
struct Flying {
    metres: f64,
    /// At most this share of the terrain's width.
    share: f64,
}

const FLYING: Flying = Flying {
    metres: 30.0,
    share: 0.02,
};

/// The path: one that the scene brings along, a built-in one, or a file.
///
/// # Errors
/// [`Failure::Usage`] for a camera that the scene does not have; what is wrong with a file otherwise.
pub fn path(
    args: &ViewArgs,
    found: &mut Found,
    bounds: &Aabb,
    size: [u32; 2],
    frames: usize,
    playback: Option<&Playback>,
) -> Result<CameraPath, Failure> {
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let named = args.path.as_ref();
    if let Some(model) = &found.model
        && let Some(path) = own_path(named, model, frames)?
    {
        return Ok(path);
    }
    if matches!(named, None | Some(PathArg::Flight)) {
        if let Some(shown) = &found.terrain {
            let terrain = &shown.terrain;
            return over(terrain.field(), |height| terrain.flight(height, frames));
        }
        if let Some(landscape) = &found.landscape {
            return over(landscape.field(), |height| landscape.flight(height, frames));
        }
    }
    match named {
        // The grid's own orbit, whole grid or a part of it.
        None | Some(PathArg::Orbit) if found.whole_grid => {
            Ok(CameraPath::orbit(&Orbit::grid(frames))?)
        }
        None | Some(PathArg::Orbit) => Ok(CameraPath::orbit_around(bounds, aspect, frames)?),
        Some(PathArg::Flight) => Ok(CameraPath::flight(bounds, args.seed, frames)?),
        Some(PathArg::Camera(name)) => {
            let name = name.as_deref();
            match playback {
                None => still(&found.scene, name, frames),
                Some(playback) => carried(&mut found.scene, name, frames, playback),
            }
        }
        Some(PathArg::Named(file)) => Ok(CameraPath::load(file)?),
    }
}

/// The path of a camera of the scene that its animation may carry along.
fn carried(
    scene: &mut Scene,
    name: Option<&str>,
    frames: usize,
    playback: &Playback,
) -> Result<CameraPath, Failure> {
    let mut path: Option<CameraPath> = None;
    let mut poses = Vec::with_capacity(frames);
    for frame in 0..frames {
        playback.show(scene, frame)?;
        let here = still(scene, name, 1)?;
        poses.extend_from_slice(here.poses());
        path.get_or_insert(here);
    }
    playback.show(scene, 0)?;
    let first = path.map_or_else(|| still(scene, name, 1), Ok)?;
    Ok(CameraPath::new(first.name(), first.projection(), poses)?)
}

/// A path that stays at a camera of the scene: the one of this name, or the first for `None`.
fn still(scene: &Scene, name: Option<&str>, frames: usize) -> Result<CameraPath, Failure> {
    let cameras: Vec<(&str, Camera)> = scene
        .cameras()
        .map(|(entity, camera)| (scene.entity_name(entity), camera))
        .collect();
    let found = cameras
        .iter()
        .find(|(known, _)| name.is_none_or(|name| *known == name));
    let Some((known, camera)) = found else {
        let given = match name {
            None => "camera".to_owned(),
            Some(name) => format!("camera:{name}"),
        };
        let known: Vec<&str> = cameras
            .iter()
            .map(|(known, _)| match known.is_empty() {
                true => "(without a name)",
                false => known,
            })
            .collect();
        return Err(Failure::Usage(match known.is_empty() {
            true => format!("--path {given}: the scene has no camera"),
            false => format!(
                "--path {given}: the scene has no camera of that name; its cameras are: {}",
                known.join(", ")
            ),
        }));
    };
    let pose = Pose {
        position: camera.position,
        rotation: camera.rotation,
        cut: false,
    };
    let title = match known.is_empty() {
        true => "camera",
        false => known,
    };
    Ok(CameraPath::new(
        title,
        camera.projection,
        vec![pose; frames],
    )?)
}

/// A flight over a terrain, whose stations are those at a height above it.
fn over(
    field: &Field,
    stations: impl Fn(f64) -> Vec<FlightStation>,
) -> Result<CameraPath, Failure> {
    let [low, high] = field.plan_bounds();
    let height = FLYING.metres.min((high - low).max_element() * FLYING.share);
    let projection = Projection::Perspective {
        fov_y: 0.9,
        near: height / FLYING.metres,
    };
    let look = |station: FlightStation| Pose::look_at(station.eye, station.target, None);
    let poses = stations(height).into_iter().map(look);
    let poses = poses.collect::<Result<Vec<_>, _>>();
    let poses = poses.map_err(|error| Failure::Usage(format!("the flight: {error}")))?;
    Ok(CameraPath::new("flight", projection, poses)?)
}

/// A path of a sub-surface model: its flight, or one of its views.
fn own_path(
    named: Option<&PathArg>,
    model: &Model,
    frames: usize,
) -> Result<Option<CameraPath>, Failure> {
    let projection = |fov_y| Projection::Perspective { fov_y, near: NEAR };
    let views = model.views();
    match named {
        None | Some(PathArg::Flight) => {
            let fov_y = views.first().map_or(0.7, |view| view.fov_y);
            let flight = model.flight();
            let waypoints: Vec<_> = (flight.iter())
                .map(|at| Waypoint {
                    eye: at.eye,
                    target: at.target,
                })
                .collect();
            let path =
                CameraPath::through("flight", &waypoints, projection(fov_y), FLIGHT, frames)?;
            Ok(Some(path))
        }
        Some(PathArg::Named(name)) => {
            let Some(view) = views.iter().find(|view| view.name == name) else {
                return Ok(None);
            };
            let pose = Pose::look_at(view.position, view.target, None)
                .map_err(|error| Failure::Usage(format!("the view {name}: {error}")))?;
            let poses = vec![pose; frames];
            Ok(Some(CameraPath::new(name, projection(view.fov_y), poses)?))
        }
        Some(PathArg::Orbit | PathArg::Camera(_)) => Ok(None),
    }
}
