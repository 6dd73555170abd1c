//! Two eyes where the command line asks for them: how far apart, and at which distance their windows meet.

use std::sync::Arc;

use antumbra::cull::{StageError, ViewInput};
use antumbra::draw::GpuScene;
use antumbra::measure::path::CameraPath;
use antumbra::scene::{Aabb, Camera, Stereo};
use antumbra::verify::{EntitySet, Oracle};
use clap::Args as ClapArgs;

use crate::failure::Failure;

/// Eyes closer together than this share of the convergence distance are looked at with ease: the "1/30 rule" of stereo
/// photography.
const INTEROCULAR_SHARE: f64 = 1.0 / 30.0;

/// Arguments of two views. Naming a distance asks for them, too.
#[derive(Debug, Clone, Copy, ClapArgs)]
pub struct StereoArgs {
    /// Draw two views, a left and a right eye's
    #[arg(long)]
    pub stereo: bool,
    /// Metres between the eyes, for --stereo; a thirtieth of the convergence distance where none is named
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = interocular)]
    pub interocular: Option<f64>,
    /// Metres from the eyes to what lies in the screen's plane, for --stereo; as far as the scene's middle is from the first
    /// pose where none is named
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = convergence)]
    pub convergence: Option<f64>,
}

impl StereoArgs {
    /// The eyes to draw, if any: with the distances that fit the scene where none are named.
    ///
    /// # Errors
    /// [`Failure::Stereo`] for a path whose cameras have no eyes; [`Failure::Usage`] where a distance has to be named.
    pub fn choose(&self, bounds: &Aabb, path: &CameraPath) -> Result<Option<Stereo>, Failure> {
        if !self.stereo && self.interocular.is_none() && self.convergence.is_none() {
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

/// What a stage is told of these views. With an oracle, also who owns their pixels.
///
/// # Errors
/// When the oracle cannot look.
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
