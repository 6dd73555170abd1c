//! A judge of two views finds for each of them what a judge of that view alone finds: neither gets the other's answers, masks or memory.

use antumbra_cull::judge::*;
use antumbra_testing::engine::{Drawn, Engine};
use antumbra_testing::gpus;
use glam::DAffine3;

use crate::play::{Play, bits, cube, hosts, orbit};

const SIZE: [u32; 2] = [120, 90];
/// The steps of the orbit between the two eyes: they see most of the world from other sides.
const APART: u32 = 40;

/// A judge, with instances of its own, and engines that draw everything for each of its views.
struct Judged {
    judge: Judge,
    instances: Instances,
    ids: Vec<InstanceId>,
    engines: Vec<Engine>,
}

impl Judged {
    fn new(
        gpu: &antumbra_cull::Gpu,
        depth: HostDepth,
        names: &[&str],
        places: &[DAffine3],
    ) -> Self {
        let views = names.iter().map(|name| JudgeView {
            name: (*name).to_owned(),
            size: SIZE,
            depth,
        });
        let mut instances = Instances::new(gpu);
        let insert = |at: &DAffine3| {
            let (bounds, part) = (cube(), Part::Both);
            let desc = InstanceDesc {
                bounds,
                at: *at,
                part,
            };
            instances.insert(desc).unwrap()
        };
        let ids = places.iter().map(insert).collect();
        Self {
            judge: Judge::new(gpu, views.collect(), JudgeOptions::default()).unwrap(),
            instances,
            ids,
            engines: names
                .iter()
                .map(|_| Engine::new(gpu, SIZE, depth))
                .collect(),
        }
    }

    /// Judges a frame. Returns the masks of each view: what is drawn first, and what is drawn besides.
    fn frame(
        &mut self,
        gpu: &antumbra_cull::Gpu,
        eyes: &[Eye],
        places: &[DAffine3],
    ) -> Vec<[Vec<u32>; 2]> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.judge
            .begin(&mut self.instances, eyes, &mut encoder)
            .unwrap();
        let all: Vec<u32> = (0..places.len() as u32).collect();
        let places: Vec<_> = places.iter().copied().map(Some).collect();
        for (engine, eye) in self.engines.iter_mut().zip(eyes) {
            engine.place(&places);
            engine.look(eye.clip_from_relative, eye.position);
            engine.draw(&mut encoder, Drawn::List(&all), true);
        }
        let depths: Vec<_> = self.engines.iter().map(Engine::depth).collect();
        self.judge.test(&depths, &mut encoder).unwrap();
        gpu.queue.submit([encoder.finish()]);
        gpu.wait().unwrap();
        let mask = |view, chosen| bits(gpu, self.judge.mask(view, chosen).unwrap());
        let both = |view| [Chosen::First, Chosen::Rest].map(|chosen| mask(view, chosen));
        (0..eyes.len()).map(both).collect()
    }
}

#[test]
fn each_view_has_the_answers_that_it_has_alone() {
    for gpu in gpus() {
        let (depth, projection) = hosts()[0];
        let mut source = Play::new(gpu, SIZE, depth, Phases::Two, 3);
        let mut places: Vec<_> = (0..500).map(|_| source.anywhere()).collect();
        let mut both = Judged::new(gpu, depth, &["left", "right"], &places);
        let mut alone = ["left", "right"].map(|name| Judged::new(gpu, depth, &[name], &places));
        let mut differ = 0;
        for step in 0..5 {
            let eyes = [step, step + APART].map(|number| orbit(projection, number));
            let found = both.frame(gpu, &eyes, &places);
            for (view, one) in alone.iter_mut().enumerate() {
                let expected = one.frame(gpu, &eyes[view..=view], &places).remove(0);
                assert_eq!(found[view], expected, "view {view}, step {step}");
            }
            differ += usize::from(found[0] != found[1]);
            // Some move: what is known of them is about another place.
            for number in (step as usize..places.len()).step_by(7) {
                places[number] = source.anywhere();
                for judged in alone.iter_mut().chain([&mut both]) {
                    let id = judged.ids[number];
                    judged.instances.move_to(id, places[number]).unwrap();
                }
            }
        }
        assert!(differ >= 4, "the views differ in {differ} frames only");
    }
}
