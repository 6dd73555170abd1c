//! Antumbra's shaders: WGSL, one file for each job, checked and reflected with naga.
//!
//! What naga finds out about the built-in jobs is written into `src/generated.rs` ahead of time, so that a program that depends on this crate
//! does not compile naga a second time for a build script.
//!
//! Reflected layouts and struct checks are as in wgsl_to_wgpu and wgsl_bindgen. Imports are plain text inclusion, since a preprocessor that
//! rewrites the module would lose `@early_depth_test` and `override`.
//!
//! # How to add a shader
//!
//! 1. Put one file for the job into `wgsl/`, such as `wgsl/depth.wgsl`. Its name becomes the module [`jobs`]`::depth`. Give it a comment that
//!    says what it does, and at least one entry point.
//! 2. Import what it needs from `wgsl/shared/` in its first lines: `//!import position` includes `wgsl/shared/position.wgsl` and that file's
//!    imports, each file once. All passes that share a depth buffer must use the position function from there.
//! 3. Run `make shaders`. It reports an error of naga with the file and the line, and otherwise writes `src/generated.rs`.
//! 4. Check each struct that Rust fills: [`assert_layout!`] next to the `#[repr(C)]` type fails the build where a size or an offset differs,
//!    and names the field.
//! 5. Create the pipeline: [`module`] makes the shader module, [`BindGroups::of`] the layouts of its entry points, and
//!    `jobs::depth::entry::VERTEX` is an entry point's name. The device needs [`Job::features`] and [`Job::downlevel`].
//! 6. Run `cargo test -p antumbra-shaders`. It translates every job into each language of [`Job::languages`] and validates it with wgpu, so
//!    that an error of one backend is found on any machine.
//!
//! Strategies of other crates have their own text: [`Job::from_wgsl`] does all of this at run time, with the same shared files.

mod error;
mod groups;
mod job;
mod layout;
mod reflect;
mod report;
mod source;

pub use error::ShaderError;
pub use groups::{BindGroupError, BindGroups};
pub use job::{
    Binding, BindingPlace, BindingUse, EntryPoint, FieldLayout, Job, JobEntry, Language,
    LayoutKind, Override, SourceLine, SourcePart, StructLayout, TailLayout, VertexInput,
};
pub use layout::{LayoutMismatch, RustField, check_layout};
pub use source::SharedSource;

#[doc(hidden)]
pub use layout::{
    built_in_layout as __built_in_layout, demand_layout as __demand_layout,
    field_size as __field_size,
};

/// The built-in jobs: one module for each file of `wgsl/`, written by `make shaders`.
pub mod jobs {
    include!("generated.rs");

    /// The built-in job with a name.
    pub fn find(name: &str) -> Option<&'static crate::Job> {
        ALL.iter().copied().find(|job| job.name == name)
    }
}

impl Job {
    /// Parses, validates and reflects a WGSL text at run time. It may `//!import` the built-in shared files.
    ///
    /// # Errors
    /// [`ShaderError`] with the file, named `wgsl/NAME.wgsl`, and the line.
    ///
    /// ```
    /// let job = antumbra_shaders::Job::from_wgsl("fill", "
    ///     @group(0) @binding(0) var<storage, read_write> out: array<u32>;
    ///     @compute @workgroup_size(64)
    ///     fn fill(@builtin(global_invocation_id) at: vec3<u32>) { out[at.x] = 7u; }
    /// ")?;
    /// assert_eq!(job.entry_points[0].workgroup_size, [64, 1, 1]);
    /// assert_eq!(job.layout_entries(0)[0].visibility, wgpu::ShaderStages::COMPUTE);
    /// # Ok::<(), antumbra_shaders::ShaderError>(())
    /// ```
    pub fn from_wgsl(name: &str, text: &str) -> Result<Self, ShaderError> {
        Self::from_wgsl_with(name, text, jobs::SHARED)
    }

    /// [`Job::from_wgsl`] with other files to import.
    ///
    /// # Errors
    /// [`ShaderError`] with the file and the line.
    pub fn from_wgsl_with(
        name: &str,
        text: &str,
        shared: &[SharedSource<'_>],
    ) -> Result<Self, ShaderError> {
        reflect::job(name, text, shared)
    }
}

/// Creates the job's shader module, labelled with the job's name. The device must have [`Job::features`]; wgpu reports missing ones to the error
/// scope.
pub fn module(device: &wgpu::Device, job: &Job) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(&job.name),
        source: wgpu::ShaderSource::Wgsl(job.source.as_ref().into()),
    })
}
