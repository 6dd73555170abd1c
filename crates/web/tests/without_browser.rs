//! The program of the page without a browser: what needs no feature is taken by a device of WebGPU's default limits.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::process::Command;

use serde_json::Value;

#[test]
fn devices_of_default_limits_take_every_shader_and_pass_the_self_test() {
    let program = env!("CARGO_BIN_EXE_antumbra-web");
    let output = Command::new(program).arg("--shaders").output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let devices = report["devices"].as_array().unwrap();
    assert_eq!(devices.len(), 2);
    for device in devices {
        let shaders = device["shaders"].as_array().unwrap();
        assert_eq!(shaders.len(), antumbra_shaders::jobs::ALL.len());
        for case in shaders {
            let outcome = case["outcome"].as_str().unwrap();
            let taken = outcome == "accepted" || outcome.starts_with("needs ");
            assert!(taken, "{case}");
        }
        let passed = |case: &&Value| case["outcome"].as_str().unwrap().starts_with("passed");
        let passed = device["self_test"]
            .as_array()
            .unwrap()
            .iter()
            .filter(passed);
        assert!(passed.count() >= 8, "{}", device["self_test"]);
    }
    // Indirect draws are for the device with features.
    assert_ne!(devices[0]["self_test"], devices[1]["self_test"]);
}
