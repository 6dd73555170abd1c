//! `antumbra doctor`: the adapters, what each of them supports of culling, and whether its driver's answers are right.

use std::time::Instant;

use antumbra::cull::{Counting, Gpu, SelfTestReport, WANTED_FEATURES, adapter_title, adapters};

use crate::args::DoctorArgs;
use crate::failure::Failure;
use crate::print::print;
use crate::watch::{USUAL_PATIENCE, Watch};

/// Lists the adapters, and tries their drivers.
///
/// # Errors
/// When there is none that Antumbra can draw with, with what to install; [`Failure::SelfTest`] where a driver is wrong.
pub fn run(args: &DoctorArgs) -> Result<(), Failure> {
    let all = pollster::block_on(adapters(wgpu::Backends::all()));
    let mut usable = 0;
    let mut wrong = Vec::new();
    for adapter in &all {
        let info = adapter.get_info();
        print(format_args!(
            "{}\n  type: {:?}; driver: {} {}",
            adapter_title(&info),
            info.device_type,
            info.driver,
            info.driver_info
        ))?;
        let gpu = told(|lines| Ok(examine(adapter, lines)))?;
        let Some(gpu) = gpu else { continue };
        usable += 1;
        if args.self_test && !told(|lines| self_test(&gpu, lines))? {
            wrong.push(gpu.title());
        }
    }
    if usable == 0 {
        let found = all
            .iter()
            .map(|adapter| adapter_title(&adapter.get_info()))
            .collect();
        return Err(antumbra::cull::DeviceError::NoAdapter {
            choice: Default::default(),
            found,
        }
        .into());
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::SelfTest(wrong)),
    }
}

/// Watches over an adapter's work, and prints the lines that it leaves, those before an error too. The watch ends first, since a reader of the lines may be slow.
fn told<T>(work: impl FnOnce(&mut Vec<String>) -> Result<T, Failure>) -> Result<T, Failure> {
    let mut lines = Vec::new();
    let watch = Watch::start(USUAL_PATIENCE);
    let done = work(&mut lines);
    drop(watch);
    lines.iter().try_for_each(print)?;
    done
}

/// Opens an adapter and describes it; `None` where Antumbra cannot draw with it.
fn examine(adapter: &wgpu::Adapter, lines: &mut Vec<String>) -> Option<Gpu> {
    match pollster::block_on(Gpu::from_adapter(adapter)) {
        Ok(gpu) => {
            describe(&gpu, lines);
            Some(gpu)
        }
        Err(error) => {
            lines.push(format!("  not usable: {error}"));
            None
        }
    }
}

/// Tries a driver with one sample a pixel and with four, and describes what was found. Whether every answer is right.
fn self_test(gpu: &Gpu, lines: &mut Vec<String>) -> Result<bool, Failure> {
    let mut passed = true;
    for samples in [1, 4] {
        if !gpu.sample_counts().contains(&samples) {
            continue;
        }
        let start = Instant::now();
        let report = gpu.self_test(samples)?;
        let milliseconds = start.elapsed().as_secs_f64() * 1e3;
        lines.push(format!("{}, in {milliseconds:.1} ms", summary(&report)));
        let report_lines = report.to_string();
        lines.extend(report_lines.lines().map(|line| format!("    {line}")));
        passed &= report.passed();
    }
    Ok(passed)
}

/// A self-test in a line.
fn summary(report: &SelfTestReport) -> String {
    let SelfTestReport { samples, .. } = report;
    let verdict = match report.failures().count() {
        0 => "every answer is right".to_owned(),
        1 => "the driver gets one thing WRONG".to_owned(),
        failures => format!("the driver gets {failures} things WRONG"),
    };
    match samples {
        1 => format!("  self-test with one sample a pixel: {verdict}"),
        _ => format!("  self-test with {samples} samples a pixel: {verdict}"),
    }
}

fn describe(gpu: &Gpu, lines: &mut Vec<String>) {
    let has = gpu.device.features();
    for (name, flag) in WANTED_FEATURES.iter_names() {
        let answer = if has.contains(flag) { "yes" } else { "no" };
        lines.push(format!("  {name}: {answer}"));
    }
    let limits = gpu.device.limits();
    lines.push(format!(
        "  limits: images {} pixels a side, buffers {} MiB, storage bindings {} MiB, 4096 queries a set",
        limits.max_texture_dimension_2d,
        limits.max_buffer_size >> 20,
        limits.max_storage_buffer_binding_size >> 20,
    ));
    for way in Counting::ALL {
        let answer = |samples| match way.lacking(gpu, samples) {
            None => "yes".to_owned(),
            Some(lacking) => format!("no, it lacks {lacking}"),
        };
        let (one, many) = (answer(1), answer(4));
        lines.push(match one == many {
            true => format!("  counting by {way}: {one}"),
            false => format!("  counting by {way}: {one}; with 4 samples a pixel: {many}"),
        });
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use antumbra::cull::AdapterChoice;

    #[test]
    fn a_driver_that_loses_a_write_is_named_as_wrong() {
        let gpu = Gpu::open(&AdapterChoice::Auto).unwrap();
        let mut lines = Vec::new();
        assert!(self_test(&gpu, &mut lines).unwrap());
        let wrong = |line: &String| line.contains("WRONG") || line.contains("FAILED");
        assert!(!lines.is_empty() && !lines.iter().any(wrong), "{lines:?}");
        let lossy = gpu.with_changed_shaders(|name, source| {
            let lost = source.replace("kept[place] =", "kept[select(place, 4u, place == 3u)] =");
            (name == "compact").then_some(lost)
        });
        assert!(!self_test(&lossy, &mut lines).unwrap());
        assert!(lines.iter().any(wrong), "{lines:?}");
        let report = lossy.self_test(1).unwrap();
        assert!(summary(&report).ends_with("the driver gets one thing WRONG"));
        assert!(
            report
                .to_string()
                .contains("compaction: FAILED. kept slot 3 of list 0")
        );
        let failure = Failure::SelfTest(vec![lossy.title()]);
        assert_eq!(failure.status(), 1);
    }
}
