//! Pipelines are compiled once a device, whoever asks for them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{ComputePipeline, Gpu};
use antumbra_shaders::jobs;
use antumbra_testing::gpus;

/// Another text of the compaction.
fn changed(name: &str, source: &str) -> Option<String> {
    (name == jobs::compact::JOB.name).then(|| format!("{source}\n// changed\n"))
}

#[test]
fn a_device_compiles_a_pipeline_once() {
    for gpu in gpus() {
        let of = |gpu: &Gpu, entry| ComputePipeline::new(gpu, &jobs::compact::JOB, entry);
        let made = of(gpu, "mark");
        assert_eq!(made, of(&gpu.clone(), "mark"));
        assert_ne!(made, of(gpu, "scan"));
        let faulty = gpu.with_changed_shaders(changed);
        let other = of(&faulty, "mark");
        assert_ne!(made, other, "another text is another pipeline");
        assert_eq!(other, of(&faulty, "mark"));
        // What a fault leaves alone is shared.
        let rest = |gpu: &Gpu| ComputePipeline::new(gpu, &jobs::pyramid_rest::JOB, "rest");
        assert_eq!(rest(gpu), rest(&faulty));
    }
}

#[test]
fn many_threads_get_the_same() {
    for gpu in gpus() {
        let made: Vec<_> = std::thread::scope(|scope| {
            let ask = || ComputePipeline::new(gpu, &jobs::judge_first::JOB, "choose");
            let all: Vec<_> = (0..8).map(|_| scope.spawn(ask)).collect();
            all.into_iter().map(|one| one.join().unwrap()).collect()
        });
        assert!(made.iter().all(|one| *one == made[0]));
    }
}
