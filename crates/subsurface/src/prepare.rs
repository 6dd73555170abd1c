//! Preparation of surfaces: a horizon is cut into tiles, a fault stays whole. Each part gets coarser levels of detail
//! and a low-resolution proxy for visibility tests.
//!
//! After section 3.1 of Plate et al. 2004. The low- and the high-resolution version are made of the whole horizon and
//! then cut, so neither has cracks between its tiles. The high-resolution version is cut along its own edges. The
//! low-resolution version has large triangles and is cut exactly along the tiles' borders. Intermediate levels are
//! made of each tile alone with a locked border, so a coarser tile beside a finer one leaves no crack either.

mod clip;
mod simplify;
mod split;
mod vertex_cache;

use antumbra_scene::{Geometry, Mesh};
use glam::DVec3;
use rayon::prelude::*;

use crate::error::SubsurfaceError;
use crate::surface::{Surface, SurfaceKind};

/// The options of preparation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrepareOptions {
    /// Tiles along each side of a horizon, 1 to 64. More tiles cull more precisely and cost more to test. About 10
    /// was best in the paper and here.
    pub tiles: u32,
    /// Triangles of a surface per triangle of its low-resolution version, at least 1.
    pub decimation: f64,
    /// Triangles of the source per triangle of the high-resolution version: 1 keeps every detail, 2 to 3 simplifies
    /// slightly.
    pub thinning: f64,
    /// Levels of detail between the high- and the low-resolution version, each with an eighth of the triangles of the
    /// one before; 0 to 4.
    pub levels: u32,
}

impl Default for PrepareOptions {
    fn default() -> Self {
        Self {
            tiles: 10,
            decimation: 100.0,
            thinning: 1.0,
            levels: 2,
        }
    }
}

impl PrepareOptions {
    /// Refuses values out of range.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`], which names the option and its range.
    pub fn check(&self) -> Result<(), SubsurfaceError> {
        let ratio = |value: f64| (1.0..=1e6).contains(&value);
        let refuse = |what, value: String, problem: &str| {
            Err(SubsurfaceError::Setting {
                what,
                value,
                problem: problem.to_owned(),
            })
        };
        if !(1..=64).contains(&self.tiles) {
            refuse(
                "tiles a side",
                self.tiles.to_string(),
                "1 to 64 is possible",
            )
        } else if !ratio(self.decimation) {
            refuse(
                "decimation",
                self.decimation.to_string(),
                "1 to 1000000 is possible",
            )
        } else if !ratio(self.thinning) {
            refuse(
                "thinning",
                self.thinning.to_string(),
                "1 to 1000000 is possible",
            )
        } else if self.levels > 4 {
            refuse(
                "levels of detail",
                self.levels.to_string(),
                "0 to 4 is possible",
            )
        } else {
            Ok(())
        }
    }
}

/// A surface that is ready to be drawn and culled.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedSurface {
    /// The surface's name.
    pub name: String,
    /// Whether it is a horizon or a fault.
    pub kind: SurfaceKind,
    /// The position of the meshes' zero in the world. All tiles share it, so equal borders in the meshes are equal on
    /// the screen.
    pub origin: DVec3,
    /// The non-empty tiles of a horizon, row by row; one tile for a fault.
    pub tiles: Vec<SurfaceTile>,
    /// Triangles of the low-resolution version that are upside down in the plan, as edge collapses may leave them. It
    /// is 0 except for very rugged horizons.
    pub flipped: usize,
}

/// A tile of a horizon, or a fault.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceTile {
    /// Column and row of the tile.
    pub cell: [u32; 2],
    /// The levels of detail, and the proxy for visibility tests.
    pub mesh: Mesh,
}

impl PreparedSurface {
    /// The number of triangles of the high-resolution version.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.tiles
            .iter()
            .map(|tile| tile.mesh.triangle_count())
            .sum()
    }

    /// The number of triangles of the low-resolution version.
    #[must_use]
    pub fn proxy_triangles(&self) -> usize {
        let proxies = self
            .tiles
            .iter()
            .filter_map(|tile| tile.mesh.proxy.as_ref());
        proxies.map(Geometry::triangle_count).sum()
    }
}

/// Prepares surfaces in parallel. `done` is called with the index of each finished surface.
///
/// # Errors
/// [`SubsurfaceError::Setting`] for an option out of range, [`SubsurfaceError::BadSurface`] for an inconsistent
/// surface.
pub fn prepare_surfaces(
    surfaces: &[Surface],
    options: &PrepareOptions,
    done: &(dyn Fn(usize) + Sync),
) -> Result<Vec<PreparedSurface>, SubsurfaceError> {
    let numbered = surfaces.par_iter().enumerate();
    numbered
        .map(|(number, surface)| {
            let prepared = prepare_surface(surface, options)?;
            done(number);
            Ok(prepared)
        })
        .collect()
}

/// Prepares one surface.
///
/// # Errors
/// As for [`prepare_surfaces`].
pub fn prepare_surface(
    surface: &Surface,
    options: &PrepareOptions,
) -> Result<PreparedSurface, SubsurfaceError> {
    options.check()?;
    surface.check()?;
    let thinned;
    let high = if options.thinning > 1.0 {
        let indices =
            simplify::to_ratio(&surface.geometry, options.thinning, &surface.plan).indices;
        thinned = Surface {
            geometry: Geometry {
                indices,
                ..surface.geometry.clone()
            },
            ..surface.clone()
        };
        &thinned
    } else {
        surface
    };
    let low = simplify::to_ratio(&surface.geometry, options.decimation, &surface.plan);
    let tiles = match surface.kind {
        SurfaceKind::Horizon => horizon(high, &low.indices, options),
        SurfaceKind::Fault => fault(high, &low.indices, options),
    };
    Ok(PreparedSurface {
        name: surface.name.clone(),
        kind: surface.kind,
        origin: surface.origin,
        tiles,
        flipped: low.flipped,
    })
}

fn horizon(high: &Surface, low: &[u32], options: &PrepareOptions) -> Vec<SurfaceTile> {
    let n = options.tiles;
    let pieces = split::by_centroid(&high.geometry, &high.plan, n);
    let proxies = clip::to_tiles(&high.geometry.positions, &high.plan, low, n);
    let tiles: Vec<(u32, Geometry, Geometry)> = (0..n * n)
        .zip(pieces)
        .zip(proxies)
        .filter(|((_, piece), _)| !piece.indices.is_empty())
        .map(|((number, piece), proxy)| (number, piece, proxy))
        .collect();
    tiles
        .into_par_iter()
        .map(|(number, piece, proxy)| {
            let cell = [number % n, number / n];
            let name = format!("{} {},{}", high.name, cell[0], cell[1]);
            // The low-resolution version may not reach a sliver at the border. Such a tile has no proxy.
            let proxy = Some(proxy).filter(|proxy| !proxy.indices.is_empty());
            let levels = simplify::levels(piece, options.levels, simplify::Border::Locked);
            SurfaceTile {
                cell,
                mesh: mesh(name, levels, proxy),
            }
        })
        .collect()
}

fn fault(high: &Surface, low: &[u32], options: &PrepareOptions) -> Vec<SurfaceTile> {
    let whole = split::compact(&high.geometry, &high.geometry.indices);
    if whole.indices.is_empty() {
        return Vec::new();
    }
    let bare = Geometry {
        positions: high.geometry.positions.clone(),
        ..Geometry::default()
    };
    let proxy = split::compact(&bare, low);
    let levels = simplify::levels(whole, options.levels, simplify::Border::Free);
    vec![SurfaceTile {
        cell: [0, 0],
        mesh: mesh(high.name.clone(), levels, Some(proxy)),
    }]
}

fn mesh(name: String, levels: Vec<Geometry>, proxy: Option<Geometry>) -> Mesh {
    Mesh {
        name,
        levels: levels.into_iter().map(vertex_cache::optimised).collect(),
        proxy: proxy.map(vertex_cache::optimised),
    }
}
