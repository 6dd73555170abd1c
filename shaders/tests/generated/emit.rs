//! Writes jobs as Rust statics. The text of a job is included from its files when the crate is compiled.

use std::{
    fmt::{self, Debug, Write},
    num::NonZeroU64,
};

use antumbra_shaders::{Binding, EntryPoint, Job, SharedSource, StructLayout};

/// The Rust text of all jobs.
pub fn jobs(jobs: &[Job], shared: &[SharedSource<'_>]) -> Result<String, fmt::Error> {
    let mut code = String::new();
    all(&mut code, jobs, shared)?;
    Ok(code)
}

fn all(w: &mut String, jobs: &[Job], shared: &[SharedSource<'_>]) -> fmt::Result {
    writeln!(
        w,
        "// Written by `make shaders` from `wgsl/`; a test fails where the two differ. Do not edit.\n"
    )?;
    writeln!(w, "/// Every built-in job, by name.")?;
    writeln!(w, "pub static ALL: &[&crate::Job] = &[")?;
    for job in jobs {
        writeln!(w, "&{}::JOB,", job.name)?;
    }
    writeln!(w, "];")?;
    writeln!(w, "/// The shared texts for `//!import`, by name.")?;
    writeln!(w, "pub static SHARED: &[crate::SharedSource<'static>] = &[")?;
    for source in shared {
        let name = source.name;
        writeln!(
            w,
            "crate::SharedSource {{ name: {name:?}, text: include_str!(\"../wgsl/shared/{name}.wgsl\") }},"
        )?;
    }
    writeln!(w, "];")?;
    for job in jobs {
        module(w, job)?;
    }
    Ok(())
}

fn module(w: &mut String, job: &Job) -> fmt::Result {
    let name = &job.name;
    writeln!(w, "/// `wgsl/{name}.wgsl`.\npub mod {name} {{")?;
    writeln!(
        w,
        "#[allow(unused_imports, reason = \"which of them depends on the job\")]\nuse std::{{borrow::Cow::Borrowed, num::{{NonZeroU32, NonZeroU64}}}};"
    )?;
    writeln!(w, "/// The text for wgpu, imports included.")?;
    write!(w, "pub const SOURCE: &str = concat!(")?;
    for part in job.parts.iter() {
        write!(w, "include_str!(\"../{}\"), ", part.file)?;
    }
    writeln!(w, ");")?;
    writeln!(
        w,
        "/// The job.\npub static JOB: crate::Job = crate::Job {{"
    )?;
    writeln!(w, "name: Borrowed({name:?}), source: Borrowed(SOURCE),")?;
    list(w, "parts", &job.parts, |w, part| {
        write!(
            w,
            "crate::SourcePart {{ file: Borrowed({:?}), first_line: {}, lines: {} }}",
            part.file, part.first_line, part.lines
        )
    })?;
    list(w, "entry_points", &job.entry_points, entry_point)?;
    list(w, "bindings", &job.bindings, binding)?;
    list(w, "structs", &job.structs, struct_layout)?;
    list(w, "overrides", &job.overrides, |w, constant| {
        write!(
            w,
            "crate::Override {{ key: Borrowed({:?}), required: {} }}",
            constant.key, constant.required
        )
    })?;
    writeln!(w, "immediate_size: {},", job.immediate_size)?;
    let features = job.features.iter_names().map(|(name, _)| name);
    flags(w, "features", "Features", features)?;
    let downlevel = job.downlevel.iter_names().map(|(name, _)| name);
    flags(w, "downlevel", "DownlevelFlags", downlevel)?;
    writeln!(w, "}};")?;
    names(w, job)?;
    writeln!(w, "}}")
}

/// Constants for the names and numbers of a job.
fn names(w: &mut String, job: &Job) -> fmt::Result {
    writeln!(w, "/// Names of the entry points.\npub mod entry {{")?;
    for entry in job.entry_points.iter() {
        let (constant, name) = (entry.name.to_uppercase(), &entry.name);
        writeln!(w, "/// `{name}`.\npub const {constant}: &str = {name:?};")?;
    }
    writeln!(
        w,
        "}}\n/// Places of the variables in use.\npub mod binding {{"
    )?;
    for binding in job.bindings.iter() {
        let (constant, name) = (binding.name.to_uppercase(), &binding.name);
        let (group, number) = (binding.group, binding.entry.binding);
        writeln!(
            w,
            "/// `{name}`.\npub const {constant}: crate::BindingPlace = crate::BindingPlace {{ group: {group}, binding: {number} }};"
        )?;
    }
    writeln!(
        w,
        "}}\n/// Workgroup sizes of the compute entry points.\npub mod workgroup {{"
    )?;
    for entry in job.entry_points.iter() {
        if entry.stage == wgpu::ShaderStages::COMPUTE {
            let (constant, size) = (entry.name.to_uppercase(), entry.workgroup_size);
            writeln!(
                w,
                "/// Of `{}`.\npub const {constant}: [u32; 3] = {size:?};",
                entry.name
            )?;
        }
    }
    writeln!(w, "}}")
}

fn entry_point(w: &mut String, entry: &EntryPoint) -> fmt::Result {
    write!(w, "crate::EntryPoint {{ name: Borrowed({:?}), ", entry.name)?;
    stages(w, "stage", entry.stage)?;
    write!(
        w,
        "workgroup_size: {:?}, forces_early_depth: {}, ",
        entry.workgroup_size, entry.forces_early_depth
    )?;
    list(w, "vertex_inputs", &entry.vertex_inputs, |w, input| {
        write!(
            w,
            "crate::VertexInput {{ location: {}, name: Borrowed({:?}), format: wgpu::VertexFormat::{:?} }}",
            input.location, input.name, input.format
        )
    })?;
    write!(w, "}}")
}

fn binding(w: &mut String, binding: &Binding) -> fmt::Result {
    let entry = &binding.entry;
    write!(
        w,
        "crate::Binding {{ group: {}, name: Borrowed({:?}), entry: wgpu::BindGroupLayoutEntry {{ binding: {}, ",
        binding.group, binding.name, entry.binding
    )?;
    stages(w, "visibility", entry.visibility)?;
    write!(w, "ty: ")?;
    binding_type(w, &entry.ty)?;
    let count = entry.count.map(std::num::NonZeroU32::get);
    write!(w, ", count: NonZeroU32::new({}) }}, ", count.unwrap_or(0))?;
    list(w, "uses", &binding.uses, |w, by| {
        write!(
            w,
            "crate::BindingUse {{ entry_point: Borrowed({:?}), ",
            by.entry_point
        )?;
        stages(w, "stage", by.stage)?;
        write!(w, "filters: {} }}", by.filters)
    })?;
    write!(w, "}}")
}

fn binding_type(w: &mut String, ty: &wgpu::BindingType) -> fmt::Result {
    use wgpu::{BindingType as T, BufferBindingType as B, TextureSampleType as S};
    write!(w, "wgpu::BindingType::")?;
    match ty {
        T::Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size,
        } => {
            let ty = match ty {
                B::Uniform => "Uniform".to_owned(),
                B::Storage { read_only } => format!("Storage {{ read_only: {read_only} }}"),
            };
            let size = min_binding_size.map_or(0, NonZeroU64::get);
            write!(
                w,
                "Buffer {{ ty: wgpu::BufferBindingType::{ty}, has_dynamic_offset: {has_dynamic_offset}, min_binding_size: NonZeroU64::new({size}) }}"
            )
        }
        T::Sampler(ty) => write!(w, "Sampler(wgpu::SamplerBindingType::{ty:?})"),
        T::Texture {
            sample_type,
            view_dimension,
            multisampled,
        } => {
            let sample = match sample_type {
                S::Float { filterable } => format!("Float {{ filterable: {filterable} }}"),
                S::Depth => "Depth".to_owned(),
                S::Sint => "Sint".to_owned(),
                S::Uint => "Uint".to_owned(),
            };
            write!(
                w,
                "Texture {{ sample_type: wgpu::TextureSampleType::{sample}, view_dimension: wgpu::TextureViewDimension::{view_dimension:?}, multisampled: {multisampled} }}"
            )
        }
        T::StorageTexture {
            access,
            format,
            view_dimension,
        } => write!(
            w,
            "StorageTexture {{ access: wgpu::StorageTextureAccess::{access:?}, format: wgpu::TextureFormat::{format:?}, view_dimension: wgpu::TextureViewDimension::{view_dimension:?} }}"
        ),
        T::AccelerationStructure { vertex_return } => {
            write!(
                w,
                "AccelerationStructure {{ vertex_return: {vertex_return} }}"
            )
        }
        T::ExternalTexture => write!(w, "ExternalTexture"),
    }
}

fn struct_layout(w: &mut String, layout: &StructLayout) -> fmt::Result {
    write!(
        w,
        "crate::StructLayout {{ name: Borrowed({:?}), kind: crate::LayoutKind::{:?}, size: {}, align: {}, ",
        layout.name, layout.kind, layout.size, layout.align
    )?;
    list(w, "fields", &layout.fields, |w, field| {
        write!(
            w,
            "crate::FieldLayout {{ name: Borrowed({:?}), offset: {}, size: {} }}",
            field.name, field.offset, field.size
        )
    })?;
    match &layout.tail {
        None => write!(w, "tail: None }}"),
        Some(tail) => write!(
            w,
            "tail: Some(crate::TailLayout {{ name: Borrowed({:?}), offset: {}, stride: {} }}) }}",
            tail.name, tail.offset, tail.stride
        ),
    }
}

fn list<T: Debug>(
    w: &mut String,
    field: &str,
    items: &[T],
    item: impl Fn(&mut String, &T) -> fmt::Result,
) -> fmt::Result {
    write!(w, "{field}: Borrowed(&[")?;
    for each in items {
        item(w, each)?;
        write!(w, ", ")?;
    }
    writeln!(w, "]),")
}

fn stages(w: &mut String, field: &str, stages: wgpu::ShaderStages) -> fmt::Result {
    let names = stages.iter_names().map(|(name, _)| name);
    flags(w, field, "ShaderStages", names)
}

/// Writes `field: wgpu::Type::empty().union(wgpu::Type::A)...,`, which is const; `|` is not.
fn flags<'n>(
    w: &mut String,
    field: &str,
    ty: &str,
    names: impl Iterator<Item = &'n str>,
) -> fmt::Result {
    write!(w, "{field}: wgpu::{ty}::empty()")?;
    for name in names {
        write!(w, ".union(wgpu::{ty}::{name})")?;
    }
    write!(w, ", ")
}
