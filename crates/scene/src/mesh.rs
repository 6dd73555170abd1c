//! Meshes: geometry as plain arrays, levels of detail, and a proxy.

use crate::bounds::Aabb;
use crate::error::SceneError;
use glam::{DVec3, Vec3};

/// The geometry of an entity, in metres, in the entity's own frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// A name for messages; may be empty.
    pub name: String,
    /// The levels of detail. Level 0 is the full geometry, each further level is coarser. At least one.
    pub levels: Vec<Geometry>,
    /// The proxy for visibility tests; `None` means that the full geometry is tested.
    pub proxy: Option<Geometry>,
}

/// The type of the primitives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Topology {
    /// Triangles, three indices each, counter-clockwise from the front.
    #[default]
    Triangles,
    /// Lines, two indices each.
    Lines,
    /// Points, one index each.
    Points,
}

impl Topology {
    /// The number of indices per primitive.
    #[must_use]
    pub fn indices_per_primitive(self) -> usize {
        match self {
            Self::Triangles => 3,
            Self::Lines => 2,
            Self::Points => 1,
        }
    }
}

/// Vertices and primitives. Every attribute is either empty or as long as `positions`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// The type of the primitives.
    pub topology: Topology,
    /// Positions in metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit vectors; empty for flat shading, in which each triangle has the normal of its plane.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates, (0, 0) the image's upper left, or empty.
    pub uvs: Vec<[f32; 2]>,
    /// Linear RGBA, or empty.
    pub colours: Vec<[u8; 4]>,
    /// Indices into the vertex arrays.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// A mesh with one level and no proxy.
    #[must_use]
    pub fn new(name: impl Into<String>, geometry: Geometry) -> Self {
        Self {
            name: name.into(),
            levels: vec![geometry],
            proxy: None,
        }
    }

    /// The full geometry, level 0. Every mesh in a scene has one.
    #[must_use]
    pub fn full(&self) -> Option<&Geometry> {
        self.levels.first()
    }

    /// The number of triangles of the full geometry.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.full().map_or(0, Geometry::triangle_count)
    }

    /// The box around every level and the proxy. It contains everything that is drawn for this mesh.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        let parts = self.levels.iter().chain(&self.proxy);
        parts
            .filter_map(Geometry::bounds)
            .reduce(|a, b| a.union(&b))
    }

    /// Refuses a mesh that a renderer cannot draw. The error names mesh, part and number.
    ///
    /// # Errors
    /// [`SceneError::BadMesh`] for a mesh without a level, and as for [`Geometry::problem`].
    pub fn validate(&self) -> Result<(), SceneError> {
        let bad = |part: String, problem: String| SceneError::BadMesh {
            mesh: self.name.clone(),
            part,
            problem,
        };
        if self.levels.is_empty() {
            return Err(bad(
                "levels".into(),
                "there is none; level 0 is the full geometry".into(),
            ));
        }
        let levels = self.levels.iter().enumerate();
        let parts = levels
            .map(|(i, level)| (format!("level {i}"), level))
            .chain(self.proxy.iter().map(|proxy| ("proxy".into(), proxy)));
        for (part, geometry) in parts {
            if let Some(problem) = geometry.problem() {
                return Err(bad(part, problem));
            }
        }
        Ok(())
    }
}

impl Geometry {
    /// The number of triangles; 0 for lines and points.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        match self.topology {
            Topology::Triangles => self.indices.len() / 3,
            Topology::Lines | Topology::Points => 0,
        }
    }

    /// The corner indices of the triangles; empty for lines and points.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let of = match self.topology {
            Topology::Triangles => self.indices.as_slice(),
            Topology::Lines | Topology::Points => &[],
        };
        of.as_chunks::<3>().0.iter().copied()
    }

    /// The box around the positions; `None` if there are none.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        let mut low = Vec3::INFINITY;
        let mut high = Vec3::NEG_INFINITY;
        for &position in &self.positions {
            low = low.min(Vec3::from(position));
            high = high.max(Vec3::from(position));
        }
        (!self.positions.is_empty()).then(|| Aabb {
            min: low.as_dvec3(),
            max: high.as_dvec3(),
        })
    }

    /// A description of the first invalid value and its remedy; `None` if the geometry is valid.
    #[must_use]
    pub fn problem(&self) -> Option<String> {
        let vertices = self.positions.len();
        if u32::try_from(vertices).is_err() {
            return Some(format!(
                "{vertices} vertices are more than 32-bit indices can address; split the mesh"
            ));
        }
        let attributes = [
            ("normals", self.normals.len()),
            ("uvs", self.uvs.len()),
            ("colours", self.colours.len()),
        ];
        for (what, length) in attributes {
            if length != 0 && length != vertices {
                return Some(format!(
                    "{length} {what} for {vertices} positions; give one each or none"
                ));
            }
        }
        let flat = |what: &str, values: &[f32], width: usize| {
            let at = values.iter().position(|v| !v.is_finite())?;
            let value = values.get(at).copied().unwrap_or_default();
            Some(format!("{what} {} is not finite ({value})", at / width))
        };
        if let Some(problem) = flat("position", self.positions.as_flattened(), 3)
            .or_else(|| flat("normal", self.normals.as_flattened(), 3))
            .or_else(|| flat("uv", self.uvs.as_flattened(), 2))
        {
            return Some(problem);
        }
        let each = self.topology.indices_per_primitive();
        if !self.indices.len().is_multiple_of(each) {
            return Some(format!(
                "{} indices do not divide into {:?} of {each}",
                self.indices.len(),
                self.topology
            ));
        }
        let (at, index) = self
            .indices
            .iter()
            .enumerate()
            .find(|(_, i)| **i as usize >= vertices)?;
        Some(format!(
            "index {at} is {index}, but there are only {vertices} vertices"
        ))
    }

    /// The geometry with area-weighted vertex normals computed from the triangles, unless it already has normals. A
    /// vertex whose triangles have no area gets +Z.
    #[must_use]
    pub fn with_computed_normals(mut self) -> Self {
        if self.normals.len() == self.positions.len() {
            return self;
        }
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for triangle in self.triangles() {
            let Some([a, b, c]) = self.corners(triangle) else {
                continue;
            };
            let normal = (b - a).cross(c - a);
            for index in triangle {
                if let Some(sum) = sums.get_mut(index as usize) {
                    *sum += normal;
                }
            }
        }
        let unit = |sum: DVec3| sum.try_normalize().unwrap_or(DVec3::Z);
        self.normals = sums
            .into_iter()
            .map(|sum| unit(sum).as_vec3().to_array())
            .collect();
        self
    }

    /// The positions of a triangle's corners; `None` if an index is out of range.
    #[must_use]
    pub fn corners(&self, triangle: [u32; 3]) -> Option<[DVec3; 3]> {
        let at = |i: u32| {
            let position = self.positions.get(i as usize)?;
            Some(Vec3::from(*position).as_dvec3())
        };
        let [a, b, c] = triangle;
        Some([at(a)?, at(b)?, at(c)?])
    }

    /// The twelve triangles of a box, with corners in the order of [`Aabb::corners`], rounded outwards to f32.
    #[must_use]
    pub fn from_box(bounds: &Aabb) -> Self {
        let (min, max) = (
            bounds.min.to_array().map(crate::bounds::round_down),
            bounds.max.to_array().map(crate::bounds::round_up),
        );
        let pick = |i: usize, axis: usize| {
            let [low, high] = [min, max].map(|corner| corner.get(axis).copied().unwrap_or(0.0));
            if i & (1 << axis) == 0 { low } else { high }
        };
        Self {
            positions: (0..8)
                .map(|i| [pick(i, 0), pick(i, 1), pick(i, 2)])
                .collect(),
            indices: BOX_TRIANGLES.as_flattened().to_vec(),
            ..Self::default()
        }
    }
}

/// The triangles of a box, counter-clockwise from outside. Bit 0 of a corner's index is x, bit 1 y, bit 2 z.
const BOX_TRIANGLES: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];
