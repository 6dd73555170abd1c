//! Plays a scene to every strategy, on every backend.

use antumbra::cull::{Gpu, Strategy, Verdicts};
use antumbra::draw::GpuScene;
use antumbra::scene::{Camera, EntityKey, Scene};
use antumbra::strategies::registry;
use antumbra::verify::kit::Kit;
use antumbra::verify::{EntitySet, IdBuffer, Oracle};
use antumbra_testing::gpus;

use crate::twin::Twin;

/// Every registered strategy, in conservative settings. A strategy that is newly registered needs its settings here.
pub fn strategies() -> Vec<String> {
    let exact = "threshold=0:scale=1:coarser=0:occluders=full:occludees=full";
    let registry = registry();
    let all: Vec<String> = registry
        .names()
        .flat_map(|name| {
            let settings = match name {
                "none" | "frustum" | "ideal" | "depth-pyramid" | "occupancy-map-single" => {
                    vec![String::new()]
                }
                "stop-and-wait" => vec![":batch=16".to_owned()],
                "three-pass" => vec![
                    format!(":latency=same-frame:{exact}"),
                    format!(":latency=on-gpu:counting=queries:{exact}"),
                ],
                "coherent" | "stereo-coherent" | "occupancy-map" | "chc-plus-plus" => {
                    vec![":latency=same-frame".to_owned()]
                }
                other => panic!("say here which settings of '{other}' promise no wrong pixel"),
            };
            settings
                .into_iter()
                .map(|settings| format!("{name}{settings}"))
                .collect::<Vec<_>>()
        })
        .collect();
    for text in &all {
        assert!(made(text).conservative(), "{text}");
    }
    all
}

pub fn made(text: &str) -> Box<dyn Strategy> {
    registry().parse(text).unwrap()
}

/// A scene, and a camera path through it.
pub struct Play {
    pub scene: Scene,
    pub size: [u32; 2],
    /// One camera a frame.
    pub frames: Vec<Camera>,
    /// Metres between the eyes, for strategies that need two views.
    pub apart: f64,
    /// The twin's rays around the centre of a pixel, in each direction; more for objects thinner than a tenth of a pixel.
    pub steps: i32,
}

impl Play {
    pub fn new(scene: Scene, frames: Vec<Camera>) -> Self {
        Self {
            scene,
            size: [64, 48],
            frames,
            apart: 0.02,
            steps: 1,
        }
    }

    /// The cameras that a strategy gets in each frame: two for a stereo strategy.
    fn eyes(&self, strategy: &str) -> Vec<Vec<Camera>> {
        let stereo = strategy.starts_with("stereo");
        let eyes = |left: &Camera| {
            let right = Camera {
                position: left.position + left.right() * self.apart,
                ..*left
            };
            if stereo {
                vec![*left, right]
            } else {
                vec![*left]
            }
        };
        self.frames.iter().map(eyes).collect()
    }

    /// Asserts that every strategy draws every owner of a pixel, and the correct image, in every frame on every backend. Returns the verdicts
    /// of each run (backend and strategy), by frame, then by view.
    pub fn is_right(&self) -> Vec<(String, Vec<Vec<Verdicts>>)> {
        self.is_right_by(&strategies())
    }

    /// The same for some of the strategies.
    pub fn is_right_by(&self, strategies: &[String]) -> Vec<(String, Vec<Vec<Verdicts>>)> {
        let mut all = Vec::new();
        let mut failures = Vec::new();
        for gpu in gpus() {
            for text in strategies {
                match self.by(gpu, text, || made(text)) {
                    Ok(verdicts) => all.push((format!("{} {text}", gpu.title()), verdicts)),
                    Err(failure) => failures.push(failure),
                }
            }
        }
        assert!(failures.is_empty(), "{}", failures.join("\n"));
        all
    }

    /// The same for one strategy on one device.
    pub fn by(
        &self,
        gpu: &Gpu,
        name: &str,
        make: impl Fn() -> Box<dyn Strategy>,
    ) -> Result<Vec<Vec<Verdicts>>, String> {
        let kit = Kit {
            size: self.size,
            ..Kit::default()
        };
        kit.check_scene(gpu, make, &self.scene, &self.eyes(name))
            .map_err(|failure| failure.to_string())
    }

    /// The oracle's id buffer of each frame, and the scene to look up slots in.
    pub fn seen(&self, gpu: &Gpu) -> (GpuScene, Vec<IdBuffer>) {
        let scene = GpuScene::new(gpu, &mut self.scene.clone()).unwrap();
        let mut oracle = Oracle::new(&scene, self.size);
        let images = self
            .frames
            .iter()
            .map(|camera| oracle.render(&scene, camera, EntitySet::InFrustum).unwrap())
            .collect();
        (scene, images)
    }

    /// Asserts that the oracle agrees with the twin wherever the twin is certain; that this is at least a share `sure` of the pixels; and that
    /// at least `owners` entities, the background among them, own one.
    pub fn agrees_with_the_twin(&self, sure: f64, owners: usize) {
        self.agrees_with_the_twin_on(&gpus(), sure, owners);
    }

    /// The same on some of the backends.
    pub fn agrees_with_the_twin_on(&self, gpus: &[&Gpu], sure: f64, owners: usize) {
        let twin = Twin::of(&self.scene);
        let looks: Vec<_> = (self.frames.iter())
            .map(|camera| twin.look(camera, self.size, self.steps))
            .collect();
        for gpu in gpus {
            let (scene, images) = self.seen(gpu);
            for (frame, (expected, image)) in looks.iter().zip(&images).enumerate() {
                let certain = expected.iter().flatten().count();
                let whole = expected.len() as f64;
                assert!(
                    certain as f64 >= sure * whole,
                    "frame {frame}: the twin is certain of {certain} of {whole} pixels"
                );
                let mut found: Vec<_> = expected.iter().flatten().collect();
                found.sort_unstable();
                found.dedup();
                assert!(found.len() >= owners, "frame {frame}: {found:?}");
                let wrong: Vec<_> = (expected.iter().zip(&image.ids))
                    .enumerate()
                    .filter_map(|(pixel, (expected, id))| {
                        let expected = id_of(&scene, (*expected)?);
                        (expected != *id).then_some((pixel, expected, *id))
                    })
                    .collect();
                assert!(
                    wrong.is_empty(),
                    "{}, frame {frame}: {} pixels are not the twin's (pixel, twin, oracle): {:?}",
                    gpu.title(),
                    wrong.len(),
                    &wrong[..wrong.len().min(10)]
                );
            }
        }
    }
}

/// The id of an entity in an [`IdBuffer`]; 0 for none.
pub fn id_of(scene: &GpuScene, entity: Option<EntityKey>) -> u32 {
    entity.map_or(0, |entity| scene.slot(entity).unwrap() + 1)
}
