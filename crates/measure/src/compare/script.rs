//! Scripts: changes of a scene between the poses of a comparison, such as moving entities or a slice that moves through a volume.

use antumbra_cull::Gpu;
use antumbra_draw::GpuScene;
use antumbra_scene::{Camera, Scene, Stereo};

use crate::path::CameraPath;
use crate::{MeasureError, views};

/// Changes a scene between poses.
///
/// Poses are visited more than once and out of order, so the scene at a pose must depend on the pose alone. Entities may move and change their
/// meshes, materials and images. The set of entities must stay the same.
pub trait Script {
    /// Brings the scene to a pose, which is seen by `camera`; in stereo, by the camera between the eyes.
    ///
    /// # Errors
    /// A message for the user.
    fn set(&mut self, scene: &mut Scene, pose: usize, camera: &Camera) -> Result<(), String>;
}

/// The script that changes nothing.
impl Script for () {
    fn set(&mut self, _: &mut Scene, _: usize, _: &Camera) -> Result<(), String> {
        Ok(())
    }
}

/// A scene on a device, with its script and path.
pub(super) struct ScriptedScene<'a> {
    host: &'a mut Scene,
    script: &'a mut dyn Script,
    scene: GpuScene,
    pub path: &'a CameraPath,
    stereo: Option<Stereo>,
}

/// A scene at a pose.
pub(super) struct PosedScene<'a> {
    pub scene: &'a GpuScene,
    /// The camera of each view.
    pub cameras: Vec<Camera>,
}

impl<'a> ScriptedScene<'a> {
    /// The scene at the path's first pose.
    pub fn new(
        gpu: &Gpu,
        host: &'a mut Scene,
        script: &'a mut dyn Script,
        path: &'a CameraPath,
        stereo: Option<Stereo>,
    ) -> Result<Self, MeasureError> {
        let camera = run(script, host, path, 0)?;
        // Reports stereo parameters that are not valid before anything is drawn.
        views::cameras(stereo.as_ref(), &camera)?;
        Ok(Self {
            scene: GpuScene::new(gpu, host)?,
            host,
            script,
            path,
            stereo,
        })
    }

    /// The scene at its current pose.
    pub fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// Brings the scene to a pose.
    pub fn at(&mut self, pose: usize) -> Result<PosedScene<'_>, MeasureError> {
        let camera = run(self.script, self.host, self.path, pose)?;
        self.scene.sync(self.host)?;
        Ok(PosedScene {
            scene: &self.scene,
            cameras: views::cameras(self.stereo.as_ref(), &camera)?,
        })
    }
}

fn run(
    script: &mut dyn Script,
    scene: &mut Scene,
    path: &CameraPath,
    pose: usize,
) -> Result<Camera, MeasureError> {
    let camera = path.camera(pose)?;
    let outcome = script.set(scene, pose, &camera);
    outcome.map_err(|problem| MeasureError::Script { pose, problem })?;
    Ok(camera)
}
