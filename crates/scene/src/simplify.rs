//! Proxies by mesh simplification. A visibility test needs a mesh's shape, not its details.
//!
//! The simplifier is meshoptimizer's (Arseny Kapoulkine; quadrics after Garland and Heckbert, "Surface Simplification
//! Using Quadric Error Metrics", 1997).

use crate::mesh::{Geometry, Mesh, Topology};
use glam::{DVec3, Vec3};
use meshopt::{SimplifyOptions, VertexDataAdapter};
use std::collections::{HashMap, HashSet};

/// How far proxies are simplified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProxyOptions {
    /// The fraction of the full geometry's triangles to keep.
    pub ratio: f64,
    /// The least target, in triangles.
    pub min_triangles: usize,
    /// The greatest target, in triangles.
    pub max_triangles: usize,
    /// The greatest error of the surface, as a fraction of the mesh's size. If the target cannot be reached within
    /// it, the simplifier that does not preserve the topology is used.
    pub max_error: f32,
}

impl Default for ProxyOptions {
    fn default() -> Self {
        Self {
            ratio: 0.1,
            min_triangles: 12,
            max_triangles: 2_000,
            max_error: 0.05,
        }
    }
}

impl ProxyOptions {
    /// The target for a geometry of `triangles` triangles.
    #[must_use]
    pub fn target(&self, triangles: usize) -> usize {
        let wanted = (triangles as f64 * self.ratio.clamp(0.0, 1.0)).ceil() as usize;
        wanted.max(self.min_triangles).min(self.max_triangles)
    }
}

impl Mesh {
    /// Computes the proxy from the full geometry, unless there is one already. Lines and points get no proxy: they
    /// are tested themselves. Returns whether there is a proxy now.
    pub fn ensure_proxy(&mut self, options: &ProxyOptions) -> bool {
        if self.proxy.is_none()
            && let Some(full) = self.full()
            && full.topology == Topology::Triangles
            && full.triangle_count() > 0
            && full.problem().is_none()
        {
            self.proxy = Some(proxy(full, options));
        }
        self.proxy.is_some()
    }
}

/// A proxy for `geometry` with about [`ProxyOptions::target`] triangles, and never more than the geometry has. It has
/// positions and indices only. The same input gives the same proxy.
///
/// The proxy lies partly inside and partly outside the surface, within [`ProxyOptions::max_error`]. If both geometry
/// and proxy are closed, the proxy is scaled about its centre by half of the logarithm of the lost volume. Edge
/// collapses only cut corners off, and a shrunken proxy hides too little. A proxy of the full volume hides too much.
///
/// These are tried in order: welding vertices by position and collapsing edges; the simplifier that does not preserve
/// the topology; the bounding box; and the welded geometry itself if even the box has more triangles.
#[must_use]
pub fn proxy(geometry: &Geometry, options: &ProxyOptions) -> Geometry {
    let welded = weld(geometry);
    let target = options.target(geometry.triangle_count());
    let fits = |indices: &[u32]| !indices.is_empty() && indices.len() <= target.max(1) * 3;
    if welded.indices.is_empty() {
        return boxed_or(geometry, welded);
    }
    if fits(&welded.indices) {
        return welded;
    }
    let bytes = bytemuck::cast_slice(&welded.positions);
    let Ok(vertices) = VertexDataAdapter::new(bytes, size_of::<[f32; 3]>(), 0) else {
        return boxed_or(geometry, welded);
    };
    // Where many triangles share a vertex, edge collapses would take for ever.
    if welded.is_collapsible() {
        let indices = meshopt::simplify(
            &welded.indices,
            &vertices,
            target * 3,
            options.max_error,
            SimplifyOptions::None,
            None,
        );
        if fits(&indices) {
            return filled(&welded, compact(&welded.positions, &indices));
        }
    }
    let indices = meshopt::simplify_sloppy(&welded.indices, &vertices, target * 3, 1.0, None);
    if fits(&indices) {
        return filled(&welded, compact(&welded.positions, &indices));
    }
    boxed_or(geometry, welded)
}

/// The bounding box, or `else_this` if the box is no simplification.
fn boxed_or(geometry: &Geometry, else_this: Geometry) -> Geometry {
    match geometry.bounds() {
        Some(bounds) if geometry.triangle_count() >= 12 => Geometry::from_box(&bounds),
        _ => else_this,
    }
}

/// The triangle with its least corner first; its winding is kept.
fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    match a.min(b).min(c) {
        least if least == a => [a, b, c],
        least if least == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// Welds vertices of equal position, drops triangles with fewer than three distinct corners, and keeps one of several
/// equal triangles. Vertices keep the order of first use.
fn weld(geometry: &Geometry) -> Geometry {
    let mut known: HashSet<[u32; 3]> = HashSet::with_capacity(geometry.triangle_count());
    let mut first: HashMap<[u32; 3], u32> = HashMap::new();
    let mut positions = Vec::new();
    let mut indices = Vec::with_capacity(geometry.indices.len());
    for triangle in geometry.triangles() {
        let corners = triangle.map(|index| {
            let position = geometry.positions.get(index as usize).copied()?;
            // Adding zero turns -0 into +0.
            let key = position.map(|v| (v + 0.0).to_bits());
            let next = positions.len() as u32;
            Some(*first.entry(key).or_insert_with(|| {
                positions.push(position);
                next
            }))
        });
        if let [Some(a), Some(b), Some(c)] = corners
            && a != b
            && b != c
            && c != a
            && known.insert(turned([a, b, c]))
        {
            indices.extend([a, b, c]);
        }
    }
    Geometry {
        positions,
        indices,
        ..Geometry::default()
    }
}

/// Drops unused vertices. The others keep the order of first use.
fn compact(positions: &[[f32; 3]], indices: &[u32]) -> Geometry {
    let mut renamed = vec![u32::MAX; positions.len()];
    let mut kept = Geometry::default();
    for &index in indices {
        let (Some(name), Some(position)) = (
            renamed.get_mut(index as usize),
            positions.get(index as usize),
        ) else {
            continue;
        };
        if *name == u32::MAX {
            *name = kept.positions.len() as u32;
            kept.positions.push(*position);
        }
        kept.indices.push(*name);
    }
    kept
}

/// The greatest scale of a proxy, per axis.
const MAX_GROWTH: f64 = 1.2;

/// Scales the proxy of a closed geometry half of the way, in the logarithm, to the same volume. Any other proxy is
/// unchanged.
fn filled(full: &Geometry, mut proxy: Geometry) -> Geometry {
    let (Some((volume, _)), Some((left, centre))) = (enclosed(full), enclosed(&proxy)) else {
        return proxy;
    };
    let growth = (volume / left).powf(1.0 / 6.0).clamp(1.0, MAX_GROWTH);
    let grown: Vec<[f32; 3]> = proxy
        .positions
        .iter()
        .map(|position| {
            let from_centre = Vec3::from(*position).as_dvec3() - centre;
            (centre + from_centre * growth).as_vec3().to_array()
        })
        .collect();
    // Near the limit of f32 the proxy is not scaled.
    if grown.as_flattened().iter().all(|value| value.is_finite()) {
        proxy.positions = grown;
    }
    proxy
}

/// The volume that a closed surface encloses and its centre of mass, as sums over tetrahedra from the first vertex.
/// `None` for a surface with borders, with edges that more than two triangles share, or that encloses no volume.
fn enclosed(geometry: &Geometry) -> Option<(f64, DVec3)> {
    let mut edges: HashSet<(u32, u32)> = HashSet::new();
    for [a, b, c] in geometry.triangles() {
        for edge in [(a, b), (b, c), (c, a)] {
            // A closed surface uses each edge once in each direction. An edge stays in the set until its opposite is
            // found.
            if !edges.remove(&(edge.1, edge.0)) && !edges.insert(edge) {
                return None;
            }
        }
    }
    let origin = Vec3::from(*geometry.positions.first()?).as_dvec3();
    let (mut volume, mut moment) = (0.0, DVec3::ZERO);
    for triangle in geometry.triangles() {
        let [a, b, c] = geometry.corners(triangle)?.map(|corner| corner - origin);
        let part = a.dot(b.cross(c)) / 6.0;
        volume += part;
        moment += (a + b + c) * (part / 4.0);
    }
    (edges.is_empty() && volume > 0.0).then(|| (volume, origin + moment / volume))
}
