//! Meshes that are tagged to hide others, and the depth that they are drawn into where they alone do.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};

use antumbra::cull::Gpu;
use bevy::camera::visibility::VisibilityRange;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::mesh::morph::MeshMorphWeights;
use bevy::mesh::skinning::SkinnedMesh;
use bevy::prelude::*;
use bevy::render::render_resource::Face;

use crate::meshes::{Drawing, Meshes, PassDesc, Pipelines, Placed, Places};

/// On an opaque mesh: hides others where [`Occluders::Tagged`](crate::Occluders::Tagged) ones do.
///
/// It hides with the faces that Bevy draws where a material culls those at the back. One with a [`StandardMaterial`] that culls those in front, or with a [`VisibilityRange`] that fades it, hides nothing; one with a skin or morph
/// targets hides only with a simpler mesh in its place. Do not tag a mesh of another material that culls the faces in front. A camera with [`Camera::invert_culling`] does not cull by tagged occluders.
#[derive(Component, Reflect, Debug, Clone, PartialEq, Default)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct Occluder {
    /// A simpler mesh to hide with, at the same place. All of it must lie within what is drawn. `None`: the mesh itself.
    pub mesh: Option<Handle<Mesh>>,
}

/// What says how an occluder is drawn.
#[derive(QueryData)]
pub(crate) struct OccluderShape {
    occluder: &'static Occluder,
    mesh: &'static Mesh3d,
    place: &'static GlobalTransform,
    material: Option<&'static MeshMaterial3d<StandardMaterial>>,
    range: Option<&'static VisibilityRange>,
    is_skinned: Has<SkinnedMesh>,
    is_morphed: Has<MeshMorphWeights>,
}

impl OccluderShapeItem<'_, '_> {
    /// `None` for what is not where its mesh says, or shows other faces.
    fn placed(&self, materials: Option<&Assets<StandardMaterial>>) -> Option<Placed> {
        let material = self.material.zip(materials);
        let material = material.and_then(|(material, materials)| materials.get(material.id()));
        let is_inside_out =
            material.is_some_and(|material| material.cull_mode == Some(Face::Front));
        let is_faded = self.range.is_some_and(|range| !range.is_abrupt());
        let is_bent = self.is_skinned || self.is_morphed;
        let mesh = match &self.occluder.mesh {
            Some(simpler) => simpler.id(),
            None if is_bent => return None,
            None => self.mesh.id(),
        };
        (!is_faded && !is_inside_out).then_some(Placed {
            mesh,
            place: self.place.affine(),
        })
    }
}

/// All that is tagged.
#[derive(SystemParam)]
pub(crate) struct TaggedMeshes<'w, 's> {
    shapes: Query<'w, 's, OccluderShape>,
    materials: Option<Res<'w, Assets<StandardMaterial>>>,
}

impl TaggedMeshes<'_, '_> {
    /// What hides of a view's list, neighbours of one mesh side by side.
    pub fn of<'a>(&self, list: impl Iterator<Item = &'a Entity>) -> Vec<Placed> {
        let materials = self.materials.as_deref();
        let found = list.filter_map(|entity| self.shapes.get(*entity).ok()?.placed(materials));
        let mut found: Vec<Placed> = found.collect();
        found.sort_by_key(|placed| placed.mesh);
        found
    }
}

/// A number for occluders: another one for others, or for the same ones elsewhere.
pub(crate) fn fingerprint(placed: &[Placed]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for one in placed {
        one.mesh.hash(&mut hasher);
        let place = one.place.to_cols_array().map(f32::to_bits);
        place.hash(&mut hasher);
    }
    hasher.finish()
}

/// A depth of our own, and what draws occluders into it.
pub(crate) struct OccluderDepth {
    gpu: Gpu,
    texture: Option<wgpu::Texture>,
    pipelines: OccluderPipelines,
}

/// The pipelines of all such depths.
#[derive(Clone, Default)]
pub(crate) struct OccluderPipelines(Arc<Mutex<Pipelines>>);

const LABEL: &str = "antumbra: occluders";

/// One sample, as Bevy draws: the nearest stays.
const PASS: PassDesc<'static> = PassDesc {
    label: LABEL,
    shader: "",
    fragment: None,
    entries: &[],
    depth: wgpu::CompareFunction::GreaterEqual,
    writes_depth: true,
};

impl OccluderDepth {
    pub fn new(gpu: &Gpu, pipelines: &OccluderPipelines) -> Self {
        Self {
            gpu: gpu.clone(),
            texture: None,
            pipelines: pipelines.clone(),
        }
    }

    /// Draws occluders. Returns the depth, with a sample a pixel.
    pub fn draw(
        &mut self,
        occluders: &[Placed],
        clip_from_world: Mat4,
        size: UVec2,
        meshes: Meshes<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> &wgpu::Texture {
        let fits = |texture: &wgpu::Texture| [texture.width(), texture.height()] == size.to_array();
        let texture = self.texture.take().filter(fits);
        let texture = texture.unwrap_or_else(|| new_texture(&self.gpu, size));
        let drawing = Drawing::new(occluders, meshes, 1);
        // Pipelines are only added: what was made before a panic is whole.
        let shared = &self.pipelines.0;
        let pipelines = &mut *shared.lock().unwrap_or_else(PoisonError::into_inner);
        drawing.prepare(&self.gpu, pipelines, &PASS);
        let any = drawing.any().and_then(|any| pipelines.of(any));
        let group = any.map(|any| {
            let device = &self.gpu.device;
            let Places { frame, places } = Places::new(device, clip_from_world, size.x, occluders);
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(LABEL),
                layout: &any.get_bind_group_layout(0),
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: frame.as_entire_binding(),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: places.as_entire_binding(),
                    },
                ],
            })
        });
        let depth = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(LABEL),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        if let Some(group) = &group {
            pass.set_bind_group(0, group, &[]);
            drawing.record(&mut pass, pipelines);
        }
        drop(pass);
        self.texture.insert(texture)
    }
}

fn new_texture(gpu: &Gpu, size: UVec2) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(LABEL),
        size: wgpu::Extent3d {
            width: size.x,
            height: size.y,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: CORE_3D_DEPTH_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
