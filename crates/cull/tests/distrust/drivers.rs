//! The self-test itself, on right drivers and on faulty ones.

use antumbra_cull::{Capability, Gpu, Outcome};
use antumbra_testing::{gpus, is_swiftshader};

use crate::faults::ALL;

/// What drivers are known to get wrong.
fn is_known_to_fail(gpu: &Gpu, samples: u32, capability: Capability) -> bool {
    capability == Capability::FragmentCompare && samples > 1 && is_swiftshader(gpu)
}

#[test]
fn right_drivers_pass_with_one_sample_and_with_four() {
    for gpu in gpus() {
        for samples in [1, 4] {
            let report = gpu.self_test(samples).unwrap();
            let at = format!("{}, {samples} samples a pixel:\n{report}", gpu.title());
            assert_eq!(report.samples, samples);
            for capability in Capability::ALL {
                let outcome = report.outcome(capability).unwrap();
                // OpenGL cannot read the samples of what was drawn.
                let reads = samples == 1 || gpu.reads_drawn_samples();
                let by_sample = matches!(
                    capability,
                    Capability::FragmentCompare
                        | Capability::IdHistogram
                        | Capability::DepthPyramid
                        | Capability::BoxTest
                );
                match outcome {
                    Outcome::Failed(_) if is_known_to_fail(gpu, samples, capability) => {}
                    Outcome::Passed { answers } => assert!(*answers >= 10, "{at}"),
                    Outcome::NotAvailable(_) => assert!(by_sample && !reads, "{at}"),
                    _ => panic!("{at}"),
                }
            }
        }
    }
}

#[test]
fn a_device_runs_it_once() {
    for gpu in gpus() {
        let [first, second] = [gpu, &gpu.clone()].map(|gpu| gpu.self_test(1).unwrap());
        assert!(std::sync::Arc::ptr_eq(&first, &second));
    }
}

#[test]
fn samples_that_the_device_does_not_have_are_refused() {
    for gpu in gpus() {
        let error = gpu.self_test(3).unwrap_err();
        assert!(error.to_string().contains("3 samples a pixel"), "{error}");
    }
}

#[test]
fn each_fault_is_found_in_what_it_breaks_and_nowhere_else() {
    for gpu in gpus() {
        for fault in ALL {
            let report = fault.on(gpu).self_test(1).unwrap();
            let found: Vec<Capability> = report.failures().map(|(broken, _)| broken).collect();
            let mut breaks = fault.breaks.to_vec();
            // A box test reads the pyramid, so that it may be wrong with it.
            let with_pyramid = fault.breaks.contains(&Capability::DepthPyramid);
            if with_pyramid && found.contains(&Capability::BoxTest) {
                breaks.push(Capability::BoxTest);
            }
            assert_eq!(
                found,
                breaks,
                "{} on {}:\n{report}",
                fault.name,
                gpu.title()
            );
            for (_, failure) in report.failures() {
                assert_ne!(failure.expected, failure.found);
                assert!(failure.wrong >= 1 && failure.wrong <= failure.answers);
            }
        }
    }
}
