//! Stereo on the command line: the distance between the eyes, and the distance at which their views converge.

use std::sync::Arc;

use antumbra::cull::{StageError, ViewInput};
use antumbra::draw::GpuScene;
use antumbra::measure::path::CameraPath;
use antumbra::scene::{Aabb, Camera, Stereo};
use antumbra::verify::{EntitySet, Oracle};
use clap::Args as ClapArgs;

use crate::failure::Failure;

/// The default distance between the eyes, as a share of the convergence distance: the "1/30 rule" of stereo photography.
const INTEROCULAR_SHARE: f64 = 1.0 / 30.0;

/// Arguments of stereo views. A given distance implies two views.
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
    /// Whether two views are requested.
    pub fn requested(&self) -> bool {
        self.stereo || self.interocular.is_some() || self.convergence.is_some()
    }

    /// The two eyes if they are requested, otherwise `None`. A distance that is not given is derived from the scene's bounds and the first
    /// pose.
    ///
    /// # Errors
    /// [`Failure::Stereo`] for a path whose cameras have no stereo views; [`Failure::Usage`] where the convergence distance cannot be derived.
    pub fn choose(&self, bounds: &Aabb, path: &CameraPath) -> Result<Option<Stereo>, Failure> {
        if !self.requested() {
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

/// A stage's inputs, one for each camera. With an oracle, each input has the reference: the entities that own pixels.
///
/// # Errors
/// Those of [`Oracle::render`].
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
