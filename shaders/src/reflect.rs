//! Makes a [`Job`] from a text: joins, parses, validates, and reflects what wgpu and Rust need to know.

use std::borrow::Cow;

use naga::{ShaderStage, valid::ModuleInfo};

use crate::{
    error::ShaderError,
    job::{EntryPoint, Job, Override},
    report, source,
    source::SharedSource,
};

mod bindings;
mod requirements;
mod structs;
mod vertex;

use requirements::Requirements;

/// Joins, parses, validates and reflects one text.
pub(crate) fn job(name: &str, text: &str, shared: &[SharedSource<'_>]) -> Result<Job, ShaderError> {
    let file = format!("wgsl/{name}.wgsl");
    let joined = source::join(&file, text, shared)?;
    let (module, info) = report::check(&joined)?;
    if module.entry_points.is_empty() {
        return Err(ShaderError::NoEntryPoint { file });
    }
    let bindings = bindings::reflect(&file, &module, &info)?;
    let Requirements {
        features,
        downlevel,
    } = requirements::reflect(&module, &bindings);
    Ok(Job {
        name: Cow::Owned(name.to_owned()),
        source: Cow::Owned(joined.text),
        parts: Cow::Owned(joined.parts),
        entry_points: Cow::Owned(entry_points(&module)),
        bindings: Cow::Owned(bindings),
        structs: Cow::Owned(structs::reflect(&module)),
        overrides: Cow::Owned(overrides(&module)),
        immediate_size: naga::valid::ImmediateSlots::size_for_module(&module),
        features,
        downlevel,
    })
}

fn entry_points(module: &naga::Module) -> Vec<EntryPoint> {
    module
        .entry_points
        .iter()
        .map(|entry| EntryPoint {
            name: Cow::Owned(entry.name.clone()),
            stage: wgpu_naga_bridge::map_naga_stage(entry.stage),
            workgroup_size: workgroup_size(entry),
            forces_early_depth: entry.early_depth_test == Some(naga::ir::EarlyDepthTest::Force),
            vertex_inputs: if entry.stage == ShaderStage::Vertex {
                Cow::Owned(vertex::inputs(module, &entry.function))
            } else {
                Cow::Borrowed(&[])
            },
        })
        .collect()
}

fn workgroup_size(entry: &naga::ir::EntryPoint) -> [u32; 3] {
    if entry.stage != ShaderStage::Compute {
        return [0; 3];
    }
    let [x, y, z] = entry.workgroup_size;
    let [set_x, set_y, set_z] = entry
        .workgroup_size_overrides
        .map_or([false; 3], |set| set.map(|expression| expression.is_some()));
    [(x, set_x), (y, set_y), (z, set_z)].map(|(size, set)| if set { 0 } else { size })
}

fn overrides(module: &naga::Module) -> Vec<Override> {
    module
        .overrides
        .iter()
        .filter_map(|(_, constant)| {
            let key = match constant.id {
                Some(id) => id.to_string(),
                None => constant.name.clone()?,
            };
            Some(Override {
                key: Cow::Owned(key),
                required: constant.init.is_none(),
            })
        })
        .collect()
}

/// The entry points that use a global, directly or through calls, by naga's analysis.
fn users<'m>(
    module: &'m naga::Module,
    info: &'m ModuleInfo,
    global: naga::Handle<naga::GlobalVariable>,
) -> impl Iterator<Item = (&'m naga::ir::EntryPoint, &'m naga::valid::FunctionInfo)> {
    module
        .entry_points
        .iter()
        .enumerate()
        .map(move |(index, entry)| (entry, info.get_entry_point(index)))
        .filter(move |(_, info)| !info[global].is_empty())
}
