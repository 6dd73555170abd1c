//! Preparation: a horizon cut into tiles, a fault kept whole, each with coarser levels of detail and a low-resolution stand-in for tests.
//!
//! After section 3.1 of Plate et al. 2004: the low- and the high-resolution version of a horizon are made of the whole horizon and then
//! cut, so that neither has cracks between its tiles. The high one is cut along its own edges, the low one, whose triangles are large,
//! exactly along the tiles' borders. What is between the two in detail is made of each tile alone, its border locked, so that a coarser
//! tile beside a finer one leaves no crack either.

mod clip;
mod cut;
mod order;
mod reduce;

use antumbra_scene::{Geometry, Mesh};
use glam::DVec3;
use rayon::prelude::*;

use crate::error::SubsurfaceError;
use crate::surface::{Surface, SurfaceKind};

/// How surfaces are prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrepareOptions {
    /// Tiles along each side of a horizon, 1 to 64. More cull finer, and cost more to test; about 10 was best in the paper and here.
    pub tiles: u32,
    /// Triangles of a surface for each triangle of its low-resolution version, at least 1.
    pub decimation: f64,
    /// Triangles of the source for each triangle of the high-resolution version: 1 keeps every detail, 2 to 3 is slightly simplified.
    pub thinning: f64,
    /// Coarser levels of detail between the high- and the low-resolution version, each with an eighth of the triangles before; 0 to 4.
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
    /// Refuses what is out of range.
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
            refuse("tiles a side", self.tiles.to_string(), "it takes 1 to 64")
        } else if !ratio(self.decimation) {
            refuse(
                "decimation",
                self.decimation.to_string(),
                "it takes 1 to 1000000",
            )
        } else if !ratio(self.thinning) {
            refuse(
                "thinning",
                self.thinning.to_string(),
                "it takes 1 to 1000000",
            )
        } else if self.levels > 4 {
            refuse(
                "levels of detail",
                self.levels.to_string(),
                "it takes 0 to 4",
            )
        } else {
            Ok(())
        }
    }
}

/// A surface ready to be drawn and culled.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedSurface {
    /// The surface's name.
    pub name: String,
    /// What it is.
    pub kind: SurfaceKind,
    /// Where the meshes' zero lies in the world. All tiles share it: borders that are the same in the meshes are the same on the screen.
    pub origin: DVec3,
    /// The tiles of a horizon that hold anything, row by row; one for a fault.
    pub tiles: Vec<SurfaceTile>,
    /// Triangles of the low-resolution version that lie upside down in plan, which edge collapses may bring about; 0 but for very rugged
    /// horizons.
    pub flipped: usize,
}

/// One tile of a horizon, or a fault.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceTile {
    /// Column and row.
    pub cell: [u32; 2],
    /// Levels of detail, and the stand-in for tests.
    pub mesh: Mesh,
}

impl PreparedSurface {
    /// Triangles of the high-resolution version.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.tiles
            .iter()
            .map(|tile| tile.mesh.triangle_count())
            .sum()
    }

    /// Triangles of the low-resolution version.
    #[must_use]
    pub fn proxy_triangles(&self) -> usize {
        let proxies = self
            .tiles
            .iter()
            .filter_map(|tile| tile.mesh.proxy.as_ref());
        proxies.map(Geometry::triangle_count).sum()
    }
}

/// Prepares surfaces, several at a time; `done` is called with the number of each as it is finished.
///
/// # Errors
/// [`SubsurfaceError::Setting`] for an option out of range, [`SubsurfaceError::BadSurface`] for a surface that does not fit together.
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
        let indices = reduce::to_ratio(&surface.geometry, options.thinning, &surface.plan).indices;
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
    let low = reduce::to_ratio(&surface.geometry, options.decimation, &surface.plan);
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
    let pieces = cut::by_centroid(&high.geometry, &high.plan, n);
    let stand_ins = clip::to_tiles(&high.geometry.positions, &high.plan, low, n);
    let tiles: Vec<(u32, Geometry, Geometry)> = (0..n * n)
        .zip(pieces)
        .zip(stand_ins)
        .filter(|((_, piece), _)| !piece.indices.is_empty())
        .map(|((number, piece), stand_in)| (number, piece, stand_in))
        .collect();
    tiles
        .into_par_iter()
        .map(|(number, piece, stand_in)| {
            let cell = [number % n, number / n];
            let name = format!("{} {},{}", high.name, cell[0], cell[1]);
            // The low-resolution version may have drawn back from a sliver at the border: there the tile stands for itself.
            let proxy = Some(stand_in).filter(|stand_in| !stand_in.indices.is_empty());
            let levels = reduce::levels(piece, options.levels, true);
            SurfaceTile {
                cell,
                mesh: mesh(name, levels, proxy),
            }
        })
        .collect()
}

fn fault(high: &Surface, low: &[u32], options: &PrepareOptions) -> Vec<SurfaceTile> {
    let whole = cut::compact(&high.geometry, &high.geometry.indices);
    if whole.indices.is_empty() {
        return Vec::new();
    }
    let bare = Geometry {
        positions: high.geometry.positions.clone(),
        ..Geometry::default()
    };
    let proxy = cut::compact(&bare, low);
    let levels = reduce::levels(whole, options.levels, false);
    vec![SurfaceTile {
        cell: [0, 0],
        mesh: mesh(high.name.clone(), levels, Some(proxy)),
    }]
}

fn mesh(name: String, levels: Vec<Geometry>, proxy: Option<Geometry>) -> Mesh {
    Mesh {
        name,
        levels: levels.into_iter().map(order::for_drawing).collect(),
        proxy: proxy.map(order::for_drawing),
    }
}
