//! What changes between the poses of a comparison: entities that move, slices that are pulled through a volume.

use antumbra_draw::{Gpu, GpuScene};
use antumbra_scene::{Camera, Scene, Stereo};

use crate::path::CameraPath;
use crate::{MeasureError, views};

/// Changes a scene between poses.
///
/// Poses are visited more than once and out of order, so what a script makes of a pose has to follow from the pose alone. Entities may move, get
/// other meshes, materials and images; which there are has to stay.
pub trait Script {
    /// Makes the scene what it is at a pose, seen by a camera; in stereo, by the one between the eyes.
    ///
    /// # Errors
    /// What stopped it, for the person who waits.
    fn set(&mut self, scene: &mut Scene, pose: usize, camera: &Camera) -> Result<(), String>;
}

/// Nothing changes.
impl Script for () {
    fn set(&mut self, _: &mut Scene, _: usize, _: &Camera) -> Result<(), String> {
        Ok(())
    }
}

/// A scene on a device, and what happens on it along a path.
pub(super) struct Set<'a> {
    host: &'a mut Scene,
    script: &'a mut dyn Script,
    scene: GpuScene,
    pub path: &'a CameraPath,
    stereo: Option<Stereo>,
}

impl<'a> Set<'a> {
    /// The scene as it is at the path's first pose.
    pub fn new(
        gpu: &Gpu,
        host: &'a mut Scene,
        script: &'a mut dyn Script,
        path: &'a CameraPath,
        stereo: Option<Stereo>,
    ) -> Result<Self, MeasureError> {
        let camera = run(script, host, path, 0)?;
        // Eyes that cannot be are told before anything is drawn.
        views::cameras(stereo.as_ref(), &camera)?;
        Ok(Self {
            scene: GpuScene::new(gpu, host)?,
            host,
            script,
            path,
            stereo,
        })
    }

    /// The scene as it is.
    pub fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// The scene as it is at a pose, and the cameras there, one a view.
    pub fn at(&mut self, pose: usize) -> Result<(&GpuScene, Vec<Camera>), MeasureError> {
        let camera = run(self.script, self.host, self.path, pose)?;
        self.scene.sync(self.host)?;
        Ok((&self.scene, views::cameras(self.stereo.as_ref(), &camera)?))
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
