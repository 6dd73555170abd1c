//! Stereo on the command line: the distance between the eyes, and the distance at which their views converge.

use std::sync::Arc;

use antumbra::cull::{StageError, ViewInput};
use antumbra::draw::GpuScene;
use antumbra::measure::path::CameraPath;
use antumbra::scene::{Aabb, Camera, Stereo};
use antumbra::verify::{EntitySet, Oracle};
use clap::Args as ClapArgs;

use crate::failure::Failure;

/// The distance between the eyes, as a share of the convergence distance, that is comfortable to view: the "1/30 rule" of stereo
/// photography.
const INTEROCULAR_SHARE: f64 = 1.0 / 30.0;

/// Arguments of two views. Each distance implies them.
#[derive(Debug, Clone, Copy, ClapArgs)]
pub struct StereoArgs {
    /// Draw two views, for the left and the right eye
    #[arg(long)]
    pub stereo: bool,
    /// Metres between the eyes; by default a thirtieth of the convergence distance. Implies --stereo
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = interocular)]
    pub interocular: Option<f64>,
    /// Metres from the eyes to the plane of the screen; by default the distance from the first pose to the scene's middle. Implies --stereo
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = convergence)]
    pub convergence: Option<f64>,
}

impl StereoArgs {
    /// Whether two views are drawn.
    pub fn are_asked_for(&self) -> bool {
        self.stereo || self.interocular.is_some() || self.convergence.is_some()
    }

    /// The two eyes, if they are drawn. Distances that are not given are chosen to suit the scene.
    ///
    /// # Errors
    /// [`Failure::Stereo`] for a path whose cameras have no eyes; [`Failure::Usage`] where a distance has to be named.
    pub fn choose(&self, bounds: &Aabb, path: &CameraPath) -> Result<Option<Stereo>, Failure> {
        if !self.are_asked_for() {
            return Ok(None);
        }
        let Some(camera) = path.cameras().next() else {
            return Ok(None);
        };
        let to_middle = bounds.centre().distance(camera.position);
        if self.convergence.is_none() && to_middle <= 0.0 {
            return Err(Failure::Usage(
                "the path begins in the middle of the scene: say with --convergence how far away the screen's plane lies"
                    .to_owned(),
            ));
        }
        let convergence = self.convergence.unwrap_or(to_middle);
        let interocular = self.interocular.unwrap_or(convergence * INTEROCULAR_SHARE);
        let stereo = Stereo::new(interocular, convergence)?;
        stereo.eyes(&camera)?;
        Ok(Some(stereo))
    }
}

/// A stage's inputs for these views. With an oracle, each has the entities that own its pixels.
///
/// # Errors
/// When the oracle fails.
pub fn inputs(
    mut oracle: Option<&mut Oracle>,
    scene: &GpuScene,
    cameras: &[Camera],
) -> Result<Vec<ViewInput<'static>>, StageError> {
    let input = |camera: &Camera| {
        let reference = match &mut oracle {
            Some(oracle) => {
                let image = oracle.render(scene, camera, EntitySet::InFrustum)?;
                Some(Arc::new(image.owners()))
            }
            None => None,
        };
        Ok(ViewInput {
            reference,
            ..ViewInput::new(*camera)
        })
    };
    cameras.iter().map(input).collect()
}

fn metres(text: &str, range: &str) -> Result<f64, String> {
    text.parse()
        .map_err(|_| format!("it takes metres, {range}"))
}

fn interocular(text: &str) -> Result<f64, String> {
    let interocular = metres(text, "0 or more")?;
    let checked = Stereo::new(interocular, 1.0).map_err(|error| error.to_string())?;
    Ok(checked.interocular)
}

fn convergence(text: &str) -> Result<f64, String> {
    let convergence = metres(text, "above 0")?;
    let checked = Stereo::new(0.0, convergence).map_err(|error| error.to_string())?;
    Ok(checked.convergence)
}
