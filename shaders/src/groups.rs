//! Bind group layouts of a pipeline whose entry points are in several jobs.

use thiserror::Error;
use wgpu::{BindingType, TextureSampleType};

use crate::{Binding, BindingUse, Job, JobEntry};

/// The bind group layouts of one pipeline, merged from its entry points. Each binding is visible to the stages that use it.
///
/// ```no_run
/// # fn pipeline(device: &wgpu::Device) -> Result<(), antumbra_shaders::BindGroupError> {
/// use antumbra_shaders::{BindGroups, jobs::depth};
/// let groups = BindGroups::of(&[depth::JOB.entry(depth::entry::VERTEX)])?;
/// let layouts = groups.bind_group_layouts(device, "depth");
/// let pipeline_layout = groups.pipeline_layout(device, "depth", &layouts);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BindGroups {
    groups: Vec<Vec<wgpu::BindGroupLayoutEntry>>,
    immediate_size: u32,
    features: wgpu::Features,
    downlevel: wgpu::DownlevelFlags,
}

/// Why entry points cannot be in one pipeline.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BindGroupError {
    /// A job has no entry point with the name.
    #[error("job `{job}` has no entry point `{entry_point}`; it has: {known}")]
    UnknownEntryPoint {
        /// The job's name.
        job: String,
        /// The name.
        entry_point: String,
        /// The names that the job has.
        known: String,
    },
    /// Two jobs have different bindings at one place.
    #[error(
        "@group({group}) @binding({binding}) is {first_type:?} for `{first}` of job `{first_job}`, but {second_type:?} for `{second}` of job `{second_job}`; give one of them another number"
    )]
    Conflict {
        /// Group of both.
        group: u32,
        /// Binding number of both.
        binding: u32,
        /// The first job.
        first_job: String,
        /// Its variable.
        first: String,
        /// Its type.
        first_type: Box<BindingType>,
        /// The second job.
        second_job: String,
        /// Its variable.
        second: String,
        /// Its type.
        second_type: Box<BindingType>,
    },
    /// There is no such binding.
    #[error("no entry point of the pipeline uses @group({group}) @binding({binding})")]
    UnknownBinding {
        /// The group.
        group: u32,
        /// The binding.
        binding: u32,
    },
}

impl BindGroups {
    /// The layouts for these entry points.
    ///
    /// # Errors
    /// [`BindGroupError`] for an entry point that does not exist, or where two jobs have different bindings at one place.
    pub fn of(entry_points: &[JobEntry<'_>]) -> Result<Self, BindGroupError> {
        let mut merging = Merging {
            found: Vec::new(),
            groups: Self {
                groups: Vec::new(),
                immediate_size: 0,
                features: wgpu::Features::empty(),
                downlevel: wgpu::DownlevelFlags::empty(),
            },
        };
        for JobEntry { job, entry_point } in entry_points {
            let Some(entry) = job.entry_point(entry_point) else {
                let known: Vec<&str> = job.entry_points.iter().map(|e| e.name.as_ref()).collect();
                return Err(BindGroupError::UnknownEntryPoint {
                    job: job.name.to_string(),
                    entry_point: (*entry_point).to_owned(),
                    known: known.join(", "),
                });
            };
            for binding in job.bindings.iter() {
                let is_own = |used: &&BindingUse| {
                    used.entry_point == *entry_point && used.stage == entry.stage
                };
                if let Some(used) = binding.uses.iter().find(is_own) {
                    merging.add(job, binding, used)?;
                }
            }
            merging.require(job);
        }
        Ok(merging.finish())
    }

    /// The layouts for all entry points of these jobs.
    ///
    /// # Errors
    /// [`BindGroupError::Conflict`] where two jobs have different bindings at one place.
    pub fn of_jobs(jobs: &[&Job]) -> Result<Self, BindGroupError> {
        let all: Vec<JobEntry<'_>> = jobs
            .iter()
            .flat_map(|job| {
                let entries = job.entry_points.iter();
                entries.map(|entry| job.entry(&entry.name))
            })
            .collect();
        Self::of(&all)
    }

    /// Gives a buffer binding a dynamic offset, which WGSL cannot express.
    ///
    /// # Errors
    /// [`BindGroupError::UnknownBinding`] where there is no such binding, or it is not a buffer.
    pub fn dynamic_offset(mut self, group: u32, binding: u32) -> Result<Self, BindGroupError> {
        match self.entry_mut(group, binding).map(|entry| &mut entry.ty) {
            Some(BindingType::Buffer {
                has_dynamic_offset, ..
            }) => *has_dynamic_offset = true,
            _ => return Err(BindGroupError::UnknownBinding { group, binding }),
        }
        Ok(self)
    }

    /// Number of groups: one more than the highest group number in use.
    pub fn len(&self) -> usize {
        self.groups.len()
    }

    /// Whether there is no binding.
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// The entries of a group by binding number; empty for a group that is not used.
    pub fn entries(&self, group: u32) -> &[wgpu::BindGroupLayoutEntry] {
        usize::try_from(group)
            .ok()
            .and_then(|group| self.groups.get(group))
            .map_or(&[], Vec::as_slice)
    }

    /// An entry, to change what cannot be reflected before layouts are made, such as the length of a binding array.
    pub fn entry_mut(
        &mut self,
        group: u32,
        binding: u32,
    ) -> Option<&mut wgpu::BindGroupLayoutEntry> {
        self.groups
            .get_mut(usize::try_from(group).ok()?)?
            .iter_mut()
            .find(|entry| entry.binding == binding)
    }

    /// Bytes of `var<immediate>`: the maximum over the jobs.
    pub fn immediate_size(&self) -> u32 {
        self.immediate_size
    }

    /// The device features that the jobs need.
    pub fn features(&self) -> wgpu::Features {
        self.features
    }

    /// The downlevel flags that the jobs need.
    pub fn downlevel(&self) -> wgpu::DownlevelFlags {
        self.downlevel
    }

    /// Creates the layouts of all groups in order, unused groups in between included.
    pub fn bind_group_layouts(
        &self,
        device: &wgpu::Device,
        label: &str,
    ) -> Vec<wgpu::BindGroupLayout> {
        self.groups
            .iter()
            .map(|entries| {
                device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                    label: Some(label),
                    entries,
                })
            })
            .collect()
    }

    /// Creates the pipeline layout from the layouts of the groups.
    pub fn pipeline_layout(
        &self,
        device: &wgpu::Device,
        label: &str,
        layouts: &[wgpu::BindGroupLayout],
    ) -> wgpu::PipelineLayout {
        let layouts: Vec<Option<&wgpu::BindGroupLayout>> = layouts.iter().map(Some).collect();
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &layouts,
            immediate_size: self.immediate_size,
        })
    }
}

/// The bindings so far, each with its job.
struct Merging<'j> {
    found: Vec<Found<'j>>,
    groups: BindGroups,
}

struct Found<'j> {
    job: &'j Job,
    binding: &'j Binding,
    entry: wgpu::BindGroupLayoutEntry,
}

impl<'j> Merging<'j> {
    fn add(
        &mut self,
        job: &'j Job,
        binding: &'j Binding,
        used: &BindingUse,
    ) -> Result<(), BindGroupError> {
        let mut entry = binding.entry;
        entry.visibility = used.stage;
        // The job's entry is for all of its entry points. This one may load without a filtering sampler.
        if let BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable },
            ..
        } = &mut entry.ty
        {
            *filterable = used.filters;
        }
        let place = |found: &&mut Found<'_>| {
            found.binding.group == binding.group && found.entry.binding == entry.binding
        };
        let Some(found) = self.found.iter_mut().find(place) else {
            self.found.push(Found {
                job,
                binding,
                entry,
            });
            return Ok(());
        };
        match united(found.entry.ty, entry.ty) {
            Some(ty) if found.entry.count == entry.count => {
                found.entry.ty = ty;
                found.entry.visibility |= used.stage;
                Ok(())
            }
            _ => Err(BindGroupError::Conflict {
                group: binding.group,
                binding: entry.binding,
                first_job: found.job.name.to_string(),
                first: found.binding.name.to_string(),
                first_type: Box::new(found.entry.ty),
                second_job: job.name.to_string(),
                second: binding.name.to_string(),
                second_type: Box::new(entry.ty),
            }),
        }
    }

    fn require(&mut self, job: &Job) {
        self.groups.immediate_size = self.groups.immediate_size.max(job.immediate_size);
        self.groups.features |= job.features;
        self.groups.downlevel |= job.downlevel;
    }

    fn finish(mut self) -> BindGroups {
        self.found
            .sort_by_key(|found| (found.binding.group, found.entry.binding));
        for found in &self.found {
            let group = usize::try_from(found.binding.group).unwrap_or(usize::MAX);
            while self.groups.groups.len() <= group {
                self.groups.groups.push(Vec::new());
            }
            if let Some(entries) = self.groups.groups.get_mut(group) {
                entries.push(found.entry);
            }
        }
        self.groups
    }
}

/// The type that serves both: the larger buffer, the filterable texture. `None` where there is none.
fn united(a: BindingType, b: BindingType) -> Option<BindingType> {
    use BindingType::{Buffer, Texture};
    match (a, b) {
        (
            Buffer {
                ty,
                has_dynamic_offset,
                min_binding_size,
            },
            Buffer {
                ty: other,
                min_binding_size: other_size,
                ..
            },
        ) => (ty == other).then_some(Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size: min_binding_size.max(other_size),
        }),
        (
            Texture {
                sample_type: TextureSampleType::Float { filterable: a },
                view_dimension,
                multisampled,
            },
            Texture {
                sample_type: TextureSampleType::Float { filterable: b },
                view_dimension: other_dimension,
                multisampled: other_multisampled,
            },
        ) => (view_dimension == other_dimension && multisampled == other_multisampled).then_some(
            Texture {
                sample_type: TextureSampleType::Float { filterable: a || b },
                view_dimension,
                multisampled,
            },
        ),
        _ => (a == b).then_some(a),
    }
}
