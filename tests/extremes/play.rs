//! Plays a scene to every strategy, on every backend.

use antumbra::cull::{Strategy, Verdicts};
use antumbra::draw::{Gpu, GpuScene};
use antumbra::scene::{Camera, EntityKey, Scene};
use antumbra::strategies::registry;
use antumbra::verify::kit::Kit;
use antumbra::verify::{EntitySet, IdBuffer, Oracle};
use antumbra_testing::gpus;

use crate::twin::Twin;

/// Every registered strategy in settings that promise no wrong pixel. One that is registered anew must be given its own here.
pub fn strategies() -> Vec<String> {
    let exact = "threshold=0:scale=1:coarser=0:occluders=full:occludees=full";
    let registry = registry();
    let all: Vec<String> = registry
        .names()
        .flat_map(|name| {
            let settings = match name {
                "none" | "frustum" | "ideal" | "occupancy-map-single" => vec![String::new()],
                "stop-and-wait" => vec![":batch=16".to_owned()],
                "three-pass" => vec![
                    format!(":latency=same-frame:{exact}"),
                    format!(":latency=on-gpu:counting=queries:{exact}"),
                ],
                "coherent" | "stereo-coherent" | "occupancy-map" => {
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

/// A scene and how it is looked at.
pub struct Play {
    pub scene: Scene,
    pub size: [u32; 2],
    /// A camera a frame.
    pub frames: Vec<Camera>,
    /// Metres between the eyes, for strategies that need two.
    pub apart: f64,
    /// Rays of the twin around a pixel's middle: more where things are thinner than a tenth of a pixel.
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

    /// The cameras that a strategy gets: two eyes for the one that is about them.
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

    /// Every strategy draws all that owns a pixel, and the right picture, in every frame on every backend. What it answers is the verdicts of
    /// each run: by backend and strategy, then frame, then view.
    pub fn is_right(&self) -> Vec<(String, Vec<Vec<Verdicts>>)> {
        self.is_right_by(&strategies())
    }

    /// The same for some strategies alone.
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

    /// What the oracle sees in each frame, with the scene to ask for slots.
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

    /// The oracle agrees with the twin in f64 wherever the twin is sure, which is at least this share of the pixels; and at least so many entities
    /// and backgrounds own one.
    pub fn agrees_with_the_twin(&self, sure: f64, owners: usize) {
        self.agrees_with_the_twin_on(&gpus(), sure, owners);
    }

    /// The same on some backends alone.
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
                    "frame {frame}: the twin is sure of {certain} of {whole} pixels"
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

/// The number that stands for an entity in an [`IdBuffer`]; 0 for none.
pub fn id_of(scene: &GpuScene, entity: Option<EntityKey>) -> u32 {
    entity.map_or(0, |entity| scene.slot(entity).unwrap() + 1)
}
