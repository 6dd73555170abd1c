//! Jobs: the text of a shader with its reflected entry points, bindings, struct layouts and device requirements. Plain data, the same for
//! built-in jobs and for those that are parsed at run time.

use std::borrow::Cow;

/// A WGSL file with its imports, parsed, validated and reflected by naga.
///
/// Built-in jobs are statics in [`crate::jobs`]. `Job::from_wgsl` makes one from any text.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The file's name without `.wgsl`.
    pub name: Cow<'static, str>,
    /// The text for wgpu: the file, then each imported file once.
    pub source: Cow<'static, str>,
    /// The files of the lines of `source`, in order.
    pub parts: Cow<'static, [SourcePart]>,
    /// The entry points, in the file's order.
    pub entry_points: Cow<'static, [EntryPoint]>,
    /// The bindings that at least one entry point uses, by group and binding number.
    pub bindings: Cow<'static, [Binding]>,
    /// The structs of uniform, storage and immediate variables and of vertex inputs, by name.
    pub structs: Cow<'static, [StructLayout]>,
    /// The pipeline-overridable constants, in the file's order.
    pub overrides: Cow<'static, [Override]>,
    /// Bytes of `var<immediate>`, 0 without one.
    pub immediate_size: u32,
    /// The device features that the job needs; where either of two features is enough, the weaker one.
    pub features: wgpu::Features,
    /// The downlevel flags that the job needs: storage access by stage, compute, and so on.
    pub downlevel: wgpu::DownlevelFlags,
}

/// Consecutive lines of [`Job::source`] from one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcePart {
    /// The file, such as `wgsl/shared/position.wgsl`.
    pub file: Cow<'static, str>,
    /// The line of [`Job::source`] that is line 1 of the file; lines count from 1.
    pub first_line: u32,
    /// Number of lines.
    pub lines: u32,
}

/// An entry point.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryPoint {
    /// The function's name.
    pub name: Cow<'static, str>,
    /// Its stage.
    pub stage: wgpu::ShaderStages,
    /// Invocations of a workgroup; 0 for a dimension that an override constant sets, and for stages other than compute.
    pub workgroup_size: [u32; 3],
    /// Whether depth is always tested before the fragment shader (`@early_depth_test(force)`).
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
    /// The format that matches the WGSL type without conversion, such as `Float32x3` for `vec3<f32>`. A buffer may have another format of
    /// the same kind (`Unorm8x4` for `vec4<f32>`).
    pub format: wgpu::VertexFormat,
}

/// A resource variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// `@group`.
    pub group: u32,
    /// The variable's name.
    pub name: Cow<'static, str>,
    /// The layout entry for all entry points of the job: visible to the stages that use it, and filterable if one of them samples it with a
    /// sampler that is not a comparison sampler.
    pub entry: wgpu::BindGroupLayoutEntry,
    /// The entry points that use it.
    pub uses: Cow<'static, [BindingUse]>,
}

/// An entry point's use of a binding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BindingUse {
    /// The entry point's name.
    pub entry_point: Cow<'static, str>,
    /// Its stage.
    pub stage: wgpu::ShaderStages,
    /// For a texture: whether the entry point samples it with a filtering sampler.
    pub filters: bool,
}

/// The layout of a WGSL struct in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructLayout {
    /// The struct's name in WGSL.
    pub name: Cow<'static, str>,
    /// What the offsets mean.
    pub kind: LayoutKind,
    /// Size in bytes, padding at the end included. For a struct that ends in a runtime-sized array, the bytes before the array.
    pub size: u32,
    /// Alignment in bytes.
    pub align: u32,
    /// The members in order, without a runtime-sized array at the end.
    pub fields: Cow<'static, [FieldLayout]>,
    /// The runtime-sized array at the end, if any.
    pub tail: Option<TailLayout>,
}

/// What the offsets of a [`StructLayout`] mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutKind {
    /// WGSL's memory layout, of a uniform, storage or immediate variable.
    Memory,
    /// A vertex input: attributes packed tightly in order of location, like a `#[repr(C)]` struct of them. A buffer may have another
    /// layout.
    Vertex,
}

/// One member of a [`StructLayout`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldLayout {
    /// The member's name in WGSL.
    pub name: Cow<'static, str>,
    /// Offset from the struct's start in bytes.
    pub offset: u32,
    /// Size in bytes, padding inside of the member included (an `array<vec3<f32>, 2>` has 32), padding after it excluded.
    pub size: u32,
}

/// A runtime-sized array at a struct's end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TailLayout {
    /// The member's name in WGSL.
    pub name: Cow<'static, str>,
    /// Offset from the struct's start in bytes.
    pub offset: u32,
    /// Stride of the elements in bytes.
    pub stride: u32,
}

/// A pipeline-overridable constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Its key in `wgpu::PipelineCompilationOptions::constants`: its `@id` in decimal, else its name.
    pub key: Cow<'static, str>,
    /// Whether it has no default, so that a pipeline must set it.
    pub required: bool,
}

/// A shading language. Tests translate each job into the languages of [`Job::languages`].
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

/// A line of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SourceLine<'a> {
    /// The file, such as `wgsl/shared/position.wgsl`.
    pub file: &'a str,
    /// The line, from 1.
    pub line: u32,
}

/// The place of a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BindingPlace {
    /// `@group`.
    pub group: u32,
    /// `@binding`.
    pub binding: u32,
}

/// An entry point by name, with its job.
#[derive(Clone, Copy, Debug)]
pub struct JobEntry<'a> {
    /// The job.
    pub job: &'a Job,
    /// The entry point's name.
    pub entry_point: &'a str,
}

impl Job {
    /// The file and line of a line of [`Job::source`], counted from 1, for reading a device's messages; `None` for a line that does not exist.
    pub fn locate(&self, line: u32) -> Option<SourceLine<'_>> {
        self.parts.iter().find_map(|part| {
            let within = line.checked_sub(part.first_line)?;
            (within < part.lines).then(|| SourceLine {
                file: part.file.as_ref(),
                line: within + 1,
            })
        })
    }

    /// An entry point of this job by name, for [`BindGroups::of`](crate::BindGroups::of). The name is not checked here.
    pub fn entry<'a>(&'a self, entry_point: &'a str) -> JobEntry<'a> {
        JobEntry {
            job: self,
            entry_point,
        }
    }

    /// The entry point with a name.
    pub fn entry_point(&self, name: &str) -> Option<&EntryPoint> {
        self.entry_points.iter().find(|entry| entry.name == name)
    }

    /// The binding of a variable.
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.bindings.iter().find(|binding| binding.name == name)
    }

    /// The layout of a WGSL struct.
    pub fn struct_layout(&self, name: &str) -> Option<&StructLayout> {
        self.structs.iter().find(|layout| layout.name == name)
    }

    /// Number of bind groups: one more than the highest group number in use.
    pub fn group_count(&self) -> u32 {
        self.bindings
            .iter()
            .map(|binding| binding.group + 1)
            .max()
            .unwrap_or(0)
    }

    /// The entries of a bind group layout for all entry points of the job; empty for a group that the job does not use.
    pub fn layout_entries(&self, group: u32) -> Vec<wgpu::BindGroupLayoutEntry> {
        self.bindings
            .iter()
            .filter(|binding| binding.group == group)
            .map(|binding| binding.entry)
            .collect()
    }

    /// The languages that the job must translate to: all four, except that a forced early depth test and the draw index exist only in SPIR-V
    /// and GLSL, and multiview in all but GLSL (wgpu has it on no desktop GL).
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
