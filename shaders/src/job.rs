//! What is known of a job before any device exists: its text, its entry points, its bindings, its struct layouts and
//! what it asks of a device. Plain data, the same for the jobs built in and for those parsed while the program runs.

use std::borrow::Cow;

/// One WGSL file, its imports resolved, parsed, validated and reflected by naga.
///
/// Built-in jobs are statics in [`crate::jobs`]; `Job::from_wgsl` makes one of any text.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The file's name without `.wgsl`.
    pub name: Cow<'static, str>,
    /// The text for wgpu: the file itself, then each imported file once.
    pub source: Cow<'static, str>,
    /// Which lines of `source` came from which file, in order.
    pub parts: Cow<'static, [SourcePart]>,
    /// In the file's order.
    pub entry_points: Cow<'static, [EntryPoint]>,
    /// Bindings that at least one entry point uses, by group and binding number.
    pub bindings: Cow<'static, [Binding]>,
    /// Structs that a uniform, storage or immediate variable or a vertex input is made of, by name.
    pub structs: Cow<'static, [StructLayout]>,
    /// Pipeline-overridable constants, in the file's order.
    pub overrides: Cow<'static, [Override]>,
    /// Bytes of `var<immediate>`, 0 without one.
    pub immediate_size: u32,
    /// Device features without which the job does not validate; of two that would do, the weaker.
    pub features: wgpu::Features,
    /// What wgpu calls downlevel flags: storage access by stage, compute, and so on.
    pub downlevel: wgpu::DownlevelFlags,
}

/// A run of lines of [`Job::source`] that came from one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcePart {
    /// The file, e.g. `wgsl/shared/position.wgsl`.
    pub file: Cow<'static, str>,
    /// The part's first line in the joined text, counted from 1. It is line 1 of the file.
    pub first_line: u32,
    /// Number of lines.
    pub lines: u32,
}

/// A function that a pipeline can start at.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryPoint {
    /// The function's name.
    pub name: Cow<'static, str>,
    /// The one stage it belongs to.
    pub stage: wgpu::ShaderStages,
    /// Invocations a workgroup; 0 for a dimension that an override constant sets, and for other stages than compute.
    pub workgroup_size: [u32; 3],
    /// Whether depth is tested before the fragment shader, whatever the shader writes (`@early_depth_test(force)`).
    pub forces_early_depth: bool,
    /// Vertex attributes by location; empty for other stages.
    pub vertex_inputs: Cow<'static, [VertexInput]>,
}

/// One `@location` of a vertex entry point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexInput {
    /// The shader location.
    pub location: u32,
    /// The argument's or struct member's name.
    pub name: Cow<'static, str>,
    /// The format that carries the WGSL type without conversion, e.g. `Float32x3` for `vec3<f32>`. A buffer may hold
    /// another one of the same kind (`Unorm8x4` for `vec4<f32>`).
    pub format: wgpu::VertexFormat,
}

/// A resource variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// `@group`.
    pub group: u32,
    /// The variable's name.
    pub name: Cow<'static, str>,
    /// As reflected over all entry points of the job: visible to those that use it, filterable if one of them samples it
    /// with a sampler that is not a comparison.
    pub entry: wgpu::BindGroupLayoutEntry,
    /// Who uses it.
    pub uses: Cow<'static, [BindingUse]>,
}

/// That one entry point uses a binding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BindingUse {
    /// The entry point's name.
    pub entry_point: Cow<'static, str>,
    /// Its stage.
    pub stage: wgpu::ShaderStages,
    /// For a texture: whether it is sampled with a filtering sampler there.
    pub filters: bool,
}

/// The layout of a WGSL struct in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructLayout {
    /// The struct's name in WGSL.
    pub name: Cow<'static, str>,
    /// What the offsets mean.
    pub kind: LayoutKind,
    /// Bytes, padding at the end included. A struct that ends in a runtime-sized array: the bytes before the array.
    pub size: u32,
    /// Bytes.
    pub align: u32,
    /// In order, without a runtime-sized array at the end.
    pub fields: Cow<'static, [FieldLayout]>,
    /// The runtime-sized array at the end, if any.
    pub tail: Option<TailLayout>,
}

/// What the offsets of a [`StructLayout`] mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutKind {
    /// WGSL's memory layout, in a uniform, storage or immediate variable.
    Memory,
    /// A vertex input: attributes packed tightly in order of location, as a `#[repr(C)]` struct of them would be.
    /// A buffer is free to hold them otherwise.
    Vertex,
}

/// One member of a [`StructLayout`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldLayout {
    /// The member's name in WGSL.
    pub name: Cow<'static, str>,
    /// Bytes from the struct's start.
    pub offset: u32,
    /// Bytes, padding inside of the member included (an `array<vec3<f32>, 2>` has 32), padding after it not.
    pub size: u32,
}

/// A runtime-sized array at a struct's end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TailLayout {
    /// The member's name in WGSL.
    pub name: Cow<'static, str>,
    /// Bytes from the struct's start.
    pub offset: u32,
    /// Bytes from one element to the next.
    pub stride: u32,
}

/// A pipeline-overridable constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// What `wgpu::PipelineCompilationOptions::constants` calls it: its `@id` in decimal, else its name.
    pub key: Cow<'static, str>,
    /// Whether it has no default, so that a pipeline must set it.
    pub required: bool,
}

/// Shading languages that a job is claimed to translate to. The tests hold the claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// For Vulkan.
    SpirV,
    /// For OpenGL and OpenGL ES.
    Glsl,
    /// For Metal.
    Msl,
    /// For Direct3D 12.
    Hlsl,
}

impl Job {
    /// The file and the line in it of a line of [`Job::source`], counted from 1: to read a device's message with.
    pub fn locate(&self, line: u32) -> Option<(&str, u32)> {
        self.parts.iter().find_map(|part| {
            let within = line.checked_sub(part.first_line)?;
            (within < part.lines).then(|| (part.file.as_ref(), within + 1))
        })
    }

    /// The entry point of that name.
    pub fn entry_point(&self, name: &str) -> Option<&EntryPoint> {
        self.entry_points.iter().find(|entry| entry.name == name)
    }

    /// The binding of that variable name.
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.bindings.iter().find(|binding| binding.name == name)
    }

    /// The layout of that WGSL struct.
    pub fn struct_layout(&self, name: &str) -> Option<&StructLayout> {
        self.structs.iter().find(|layout| layout.name == name)
    }

    /// Number of bind groups: the highest group number in use and one more.
    pub fn group_count(&self) -> u32 {
        self.bindings
            .iter()
            .map(|binding| binding.group + 1)
            .max()
            .unwrap_or(0)
    }

    /// The entries of one bind group layout for all entry points of the job together. Empty for a group it does not use.
    pub fn layout_entries(&self, group: u32) -> Vec<wgpu::BindGroupLayoutEntry> {
        self.bindings
            .iter()
            .filter(|binding| binding.group == group)
            .map(|binding| binding.entry)
            .collect()
    }

    /// The languages the job must translate to: all four, except that a forced early depth test and the draw index exist
    /// for SPIR-V and GLSL alone, and several views for all but GLSL (wgpu offers them on no desktop GL).
    pub fn languages(&self) -> &'static [Language] {
        use Language::{Glsl, Hlsl, Msl, SpirV};
        let no_direct3d_or_metal =
            wgpu::Features::SHADER_EARLY_DEPTH_TEST | wgpu::Features::SHADER_DRAW_INDEX;
        match (
            self.features.intersects(no_direct3d_or_metal),
            self.features.contains(wgpu::Features::MULTIVIEW),
        ) {
            (false, false) => &[SpirV, Glsl, Msl, Hlsl],
            (true, false) => &[SpirV, Glsl],
            (false, true) => &[SpirV, Msl, Hlsl],
            (true, true) => &[SpirV],
        }
    }
}
