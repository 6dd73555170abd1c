//! `antumbra doctor`: the adapters, and what each of them supports of culling.

use antumbra::cull::{Counting, Gpu, WANTED_FEATURES, adapter_title, adapters};

use crate::failure::Failure;
use crate::print::print;

/// Lists the adapters.
///
/// # Errors
/// When there is none that Antumbra can draw with, with what to install.
pub fn run() -> Result<(), Failure> {
    let all = pollster::block_on(adapters(wgpu::Backends::all()));
    let mut usable = 0;
    for adapter in &all {
        let info = adapter.get_info();
        print(format_args!(
            "{}\n  type: {:?}; driver: {} {}",
            adapter_title(&info),
            info.device_type,
            info.driver,
            info.driver_info
        ))?;
        match pollster::block_on(Gpu::from_adapter(adapter)) {
            Ok(gpu) => {
                usable += 1;
                describe(&gpu)?;
            }
            Err(error) => print(format_args!("  not usable: {error}"))?,
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
    Ok(())
}

fn describe(gpu: &Gpu) -> Result<(), Failure> {
    let has = gpu.device.features();
    for (name, flag) in WANTED_FEATURES.iter_names() {
        let answer = if has.contains(flag) { "yes" } else { "no" };
        print(format_args!("  {name}: {answer}"))?;
    }
    let limits = gpu.device.limits();
    print(format_args!(
        "  limits: images {} pixels a side, buffers {} MiB, storage bindings {} MiB, 4096 queries a set",
        limits.max_texture_dimension_2d,
        limits.max_buffer_size >> 20,
        limits.max_storage_buffer_binding_size >> 20,
    ))?;
    for way in Counting::ALL {
        let answer = |samples| match way.lacking(gpu, samples) {
            None => "yes".to_owned(),
            Some(lacking) => format!("no, it lacks {lacking}"),
        };
        let (one, many) = (answer(1), answer(4));
        match one == many {
            true => print(format_args!("  counting by {way}: {one}"))?,
            false => print(format_args!(
                "  counting by {way}: {one}; with 4 samples a pixel: {many}"
            ))?,
        }
    }
    Ok(())
}
