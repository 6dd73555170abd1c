//! Meshes in three shared arenas: positions (all that a depth pass reads), the other attributes, and indices.
//!
//! Every mesh also gets its bounding box as a geometry of twelve triangles, so that box tests use the same position function as all other
//! passes. The box is widened a little: it must cover every sample that its contents cover after rounding. All boxes share their indices.

mod deform;

use antumbra_scene::{Aabb, Geometry, Mesh, solid_part};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use crate::arena::Arena;
use crate::error::DrawError;
use antumbra_cull::{Gpu, IndexRange, MeshRanges, OrientedBox};

/// A vertex's attributes other than its position.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Attributes {
    /// Unit normal as signed 16-bit fractions; all zero where the mesh has none. The fourth is padding.
    pub normal: [i16; 4],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Linear RGBA.
    pub colour: [u8; 4],
}

/// The vertices and indices of a box.
const BOX_VERTICES: u64 = 8;
const BOX_INDICES: u64 = 36;

/// The arenas of all meshes.
#[derive(Debug)]
pub struct MeshArenas {
    positions: Arena<[f32; 3]>,
    attributes: Arena<Attributes>,
    indices: Arena<u32>,
    /// The first index of all boxes, once there is one.
    box_indices: Option<u64>,
}

/// What stays true of a mesh's shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LastingShape {
    /// All that can be found out. The deviation is that of its proxy, in the mesh's own units.
    Rigid {
        /// In the mesh's own units.
        deviation: f64,
    },
    /// Nothing: its vertices move.
    Deforming,
}

/// The buffers of the arenas.
pub struct MeshBuffers<'a> {
    /// Positions, three f32 each.
    pub positions: &'a wgpu::Buffer,
    /// [`Attributes`].
    pub attributes: &'a wgpu::Buffer,
    /// Indices, u32.
    pub indices: &'a wgpu::Buffer,
}

impl MeshArenas {
    /// Empty arenas.
    ///
    /// # Errors
    /// [`DrawError::TooLarge`] where the device cannot hold their initial capacity.
    pub fn new(gpu: &Gpu) -> Result<Self, DrawError> {
        Ok(Self {
            positions: Arena::new(gpu, "vertex positions", wgpu::BufferUsages::VERTEX, 1 << 12)?,
            attributes: Arena::new(
                gpu,
                "vertex attributes",
                wgpu::BufferUsages::VERTEX,
                1 << 12,
            )?,
            indices: Arena::new(gpu, "indices", wgpu::BufferUsages::INDEX, 1 << 14)?,
            box_indices: None,
        })
    }

    /// The buffers.
    pub fn buffers(&self) -> MeshBuffers<'_> {
        MeshBuffers {
            positions: self.positions.buffer(),
            attributes: self.attributes.buffer(),
            indices: self.indices.buffer(),
        }
    }

    /// Makes room for meshes that will be added, at once: an arena that grows step by step leaves the memory of each step behind.
    ///
    /// # Errors
    /// As for [`Self::add`].
    pub fn reserve<'a>(
        &mut self,
        gpu: &Gpu,
        meshes: impl Iterator<Item = &'a Mesh>,
    ) -> Result<(), DrawError> {
        let mut vertices = 0;
        let mut indices = match self.box_indices {
            Some(_) => 0,
            None => BOX_INDICES,
        };
        for mesh in meshes {
            for geometry in mesh.levels.iter().chain(&mesh.proxy) {
                vertices += geometry.positions.len() as u64;
                indices += geometry.indices.len() as u64;
            }
            vertices += BOX_VERTICES;
        }
        self.positions.reserve_more(gpu, vertices)?;
        self.attributes.reserve_more(gpu, vertices)?;
        self.indices.reserve_more(gpu, indices)
    }

    /// Uploads all geometries of a mesh.
    ///
    /// # Errors
    /// [`DrawError::TooLarge`] where an arena would exceed the device's limits.
    pub fn add(
        &mut self,
        gpu: &Gpu,
        mesh: &Mesh,
        lasting: LastingShape,
    ) -> Result<MeshRanges, DrawError> {
        let levels = mesh
            .levels
            .iter()
            .map(|level| self.append(gpu, level))
            .collect::<Result<Vec<_>, _>>()?;
        let full = levels.first().copied().unwrap_or_default();
        let proxy = match &mesh.proxy {
            Some(proxy) => self.append(gpu, proxy)?,
            None => full,
        };
        let bounds = mesh.bounds();
        let (boxed, box_margin) = match bounds {
            Some(bounds) => {
                let margin = box_margin(&bounds);
                let boxed = Geometry::from_box(&widened(&bounds, margin));
                let first_index = match self.box_indices {
                    Some(first) => first,
                    None => self.indices.append(gpu, &boxed.indices)?,
                };
                self.box_indices = Some(first_index);
                (self.append_vertices(gpu, &boxed, first_index)?, margin)
            }
            None => (IndexRange::default(), 0.0),
        };
        Ok(MeshRanges {
            levels,
            proxy,
            boxed,
            box_margin,
            deviation: match lasting {
                LastingShape::Rigid { deviation } => deviation,
                LastingShape::Deforming => 0.0,
            },
            roundness: match (lasting, bounds) {
                (LastingShape::Rigid { .. }, Some(bounds)) => roundness(mesh, &bounds),
                _ => OrientedBox::ANGULAR,
            },
            solid: match (lasting, bounds, mesh.full()) {
                (LastingShape::Rigid { .. }, Some(bounds), Some(full)) => solid_part(full, &bounds),
                _ => 0.0,
            },
            bounds: bounds.unwrap_or(Aabb::EMPTY),
        })
    }

    /// Writes what was added.
    pub fn flush(&mut self, gpu: &Gpu) {
        self.positions.flush(gpu);
        self.attributes.flush(gpu);
        self.indices.flush(gpu);
    }

    fn append(&mut self, gpu: &Gpu, geometry: &Geometry) -> Result<IndexRange, DrawError> {
        let first_index = self.indices.append(gpu, &geometry.indices)?;
        self.append_vertices(gpu, geometry, first_index)
    }

    /// Appends the vertices of a geometry whose indices are there already.
    fn append_vertices(
        &mut self,
        gpu: &Gpu,
        geometry: &Geometry,
        first_index: u64,
    ) -> Result<IndexRange, DrawError> {
        let base_vertex = self.positions.append(gpu, &geometry.positions)?;
        self.attributes.append(gpu, &attributes(geometry))?;
        let too_many = DrawError::TooLarge {
            what: "vertices and indices",
            bytes: base_vertex,
            most: i32::MAX as u64,
        };
        let (Ok(first_index), Ok(base_vertex)) =
            (u32::try_from(first_index), i32::try_from(base_vertex))
        else {
            return Err(too_many);
        };
        Ok(IndexRange {
            first_index,
            index_count: geometry.indices.len() as u32,
            base_vertex,
            corners: geometry.topology.indices_per_primitive() as u32,
        })
    }
}

/// By how much a box is wider than its contents on every side, in the mesh's own units: three hundredths of half the largest extent, so that flat
/// boxes get a thickness too, and boxes of eight pixels are wide enough for every rasteriser ([`antumbra_cull::query_detail`]); plus the rounding error of f32 at these coordinates.
fn box_margin(bounds: &Aabb) -> f64 {
    let largest = (bounds.max - bounds.min).max_element() * 0.5;
    let reach = bounds.min.abs().max(bounds.max.abs()).max_element();
    largest * 3e-2 + reach * f64::from(f32::EPSILON) * 8.0
}

/// How round a mesh is, in all its forms.
fn roundness(mesh: &Mesh, bounds: &Aabb) -> f32 {
    let geometries = mesh.levels.iter().chain(&mesh.proxy);
    let vertices = geometries.flat_map(|geometry| &geometry.positions);
    let points = vertices.map(|vertex| Vec3::from(*vertex).as_dvec3());
    bounds.roundness(points).min(OrientedBox::ANGULAR)
}

/// Widens bounds by a margin. A rasteriser snaps each vertex by itself, so a box must be wider than its contents by more than that.
fn widened(bounds: &Aabb, margin: f64) -> Aabb {
    let end = DVec3::splat(f64::from(f32::MAX));
    Aabb {
        min: (bounds.min - margin).max(-end),
        max: (bounds.max + margin).min(end),
    }
}

fn attributes(geometry: &Geometry) -> Vec<Attributes> {
    let fraction = |v: f32| (v.clamp(-1.0, 1.0) * f32::from(i16::MAX)).round() as i16;
    (0..geometry.positions.len())
        .map(|i| {
            let normal = geometry.normals.get(i).map_or([0; 4], |n| {
                [fraction(n[0]), fraction(n[1]), fraction(n[2]), 0]
            });
            Attributes {
                normal,
                uv: geometry.uvs.get(i).copied().unwrap_or_default(),
                colour: geometry.colours.get(i).copied().unwrap_or([255; 4]),
            }
        })
        .collect()
}

/// Vertex buffer 0: positions.
pub const POSITION_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<[f32; 3]>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
};

/// Vertex buffer 1: the slot of each instance.
pub const SLOT_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<u32>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![1 => Uint32],
};

/// Vertex buffer 1 of draws into patches: the slot and the patch number of each instance.
pub const SLOT_PATCH_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 2 * size_of::<u32>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![1 => Uint32, 5 => Uint32],
};

/// Vertex buffer 2: [`Attributes`].
pub const ATTRIBUTE_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Attributes>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![2 => Snorm16x4, 3 => Float32x2, 4 => Unorm8x4],
};
