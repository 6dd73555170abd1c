//! All that the engine has to do with Antumbra: it hands in boxes, eyes and depths, and gets indirect draws.

use antumbra::cull::Gpu;
use antumbra::cull::judge::*;
use antumbra::scene::Aabb;
use glam::{DAffine3, DVec3};

use super::engine::{DEPTH, Engine};

pub struct Culling {
    pub instances: Instances,
    pub judge: Judge,
    draws: JudgeDraws,
    /// The slots of each mesh's objects. An object's slot is its index as an instance.
    templates: Vec<DrawTemplate>,
    stale: bool,
}

impl Culling {
    pub fn new(
        gpu: &Gpu,
        sizes: &[[u32; 2]],
        engine: &Engine,
        options: JudgeOptions,
    ) -> Result<Self, JudgeError> {
        let (samples, range) = (engine.samples, DepthRange::Forward);
        let view = |(number, size): (usize, &[u32; 2])| JudgeView {
            name: format!("view {number}"),
            size: *size,
            depth: HostDepth {
                format: DEPTH,
                samples,
                range,
            },
        };
        let views = sizes.iter().enumerate().map(view).collect();
        let template = |mesh: &super::engine::Mesh| DrawTemplate {
            elements: mesh.indices,
            first_element: mesh.first_index,
            base_vertex: mesh.base_vertex,
            members: Vec::new(),
        };
        let templates: Vec<_> = engine.meshes.iter().map(template).collect();
        Ok(Self {
            instances: Instances::new(gpu),
            judge: Judge::new(gpu, views, options)?,
            draws: JudgeDraws::new(gpu, DrawKind::Indexed, &templates)?,
            templates,
            stale: true,
        })
    }

    pub fn insert(&mut self, mesh: usize, at: DAffine3) -> Result<InstanceId, JudgeError> {
        let bounds = Aabb::from_centre(DVec3::ZERO, DVec3::ONE);
        let part = Part::Both;
        let id = self.instances.insert(InstanceDesc { bounds, at, part })?;
        self.templates[mesh].members.push(id.index());
        self.stale = true;
        Ok(id)
    }

    pub fn remove(&mut self, mesh: usize, id: InstanceId) -> Result<(), JudgeError> {
        let members = &mut self.templates[mesh].members;
        members.retain(|slot| *slot != id.index());
        self.stale = true;
        self.instances.remove(id)
    }

    pub fn begin(
        &mut self,
        eyes: &[Eye],
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        if std::mem::take(&mut self.stale) {
            self.draws.set(&self.templates)?;
        }
        self.judge.begin(&mut self.instances, eyes, encoder)?;
        Ok(())
    }

    /// Writes the draws of a view: one a mesh, and the slots that they draw.
    pub fn write(
        &mut self,
        view: usize,
        chosen: Chosen,
        into: DrawBuffers<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        self.judge
            .write_draws(view, chosen, &self.draws, into, encoder)
    }
}
