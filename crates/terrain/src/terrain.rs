//! A prepared terrain: a field with its groups, its boundary, and an index of its surface.

use glam::{DVec2, DVec3};

use crate::azimuth::AzimuthRange;
use crate::boundary_tree::BoundaryTree;
use crate::crystal::GroupOptions;
use crate::error::TerrainError;
use crate::field::Field;
use crate::ground::Ground;
use crate::groups::GroupHierarchy;
use crate::horizon::{Horizons, Method, Scope, Sectors};
use crate::observer::Observer;
use crate::tile::{SplitTile, Tile};

/// How a terrain is prepared.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TerrainOptions {
    /// The sectors of directions.
    pub sectors: Sectors,
    /// How horizons are found.
    pub method: Method,
    /// How groups are made; `None` for [`GroupOptions::for_triangles`].
    pub groups: Option<GroupOptions>,
}

impl TerrainOptions {
    /// The same options with another seed of the random numbers that groups are made with.
    #[must_use]
    pub fn seeded(self, seed: u64, field: &Field) -> Self {
        let default = GroupOptions::for_triangles(field.triangles().len());
        let groups = self.groups.unwrap_or(default);
        Self {
            groups: Some(GroupOptions { seed, ..groups }),
            ..self
        }
    }
}

/// A prepared terrain.
#[derive(Debug, Clone)]
pub struct Terrain {
    field: Field,
    groups: GroupHierarchy,
    ground: Ground,
    boundary: BoundaryTree,
    /// The corners of the neighbours' triangles that its horizons depend on.
    margin: Vec<[DVec3; 3]>,
    method: Method,
}

impl Terrain {
    /// Prepares a field: rounds it to what is drawn, finds its horizons and groups its triangles. `done` is called once for each finished
    /// sector.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for a setting out of its range, [`TerrainError::NotAHeightField`] for a field that rounding spoils.
    pub fn prepare(
        field: Field,
        options: &TerrainOptions,
        done: &(dyn Fn() + Sync),
    ) -> Result<Self, TerrainError> {
        Self::prepare_tile(Tile::whole(field), options, done)
    }

    /// Prepares a tile of a field. Horizons are found over the tile and its margin; groups consist of its own triangles. A tile with a
    /// margin culls only beside the tiles that the margin belongs to: see [`TerrainTiles`](crate::TerrainTiles).
    ///
    /// # Errors
    /// As [`Self::prepare`].
    pub fn prepare_tile(
        tile: Tile,
        options: &TerrainOptions,
        done: &(dyn Fn() + Sync),
    ) -> Result<Self, TerrainError> {
        let own = tile.own_triangles();
        let SplitTile { field, with_margin } = tile.rounded()?.split()?;
        let default = GroupOptions::for_triangles(field.triangles().len());
        let groups = options.groups.unwrap_or(default);
        groups.check()?;
        let TerrainOptions {
            sectors, method, ..
        } = *options;
        let with_margin = with_margin.as_ref();
        let all = with_margin.unwrap_or(&field);
        let horizons = Horizons::find(all, sectors, method, Scope::Surface, done);
        let horizons = horizons.of_first(&field);
        let margin = with_margin.map(|all| {
            let rest = own as u32..all.triangles().len() as u32;
            rest.map(|triangle| all.corners(triangle)).collect()
        });
        let groups = GroupHierarchy::build(&field, &horizons, &groups)?;
        Ok(Self {
            margin: margin.unwrap_or_default(),
            ..Self::from_parts(field, groups, method)
        })
    }

    /// A terrain without a margin, from parts that were prepared before.
    pub(crate) fn from_parts(field: Field, groups: GroupHierarchy, method: Method) -> Self {
        Self {
            ground: Ground::new(&field),
            boundary: BoundaryTree::of(&field),
            margin: Vec::new(),
            field,
            groups,
            method,
        }
    }

    /// The field.
    #[must_use]
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// The corners of the triangles of its margin, which its horizons depend on. Metres from the field's origin.
    #[must_use]
    pub fn margin(&self) -> &[[DVec3; 3]] {
        &self.margin
    }

    /// The groups.
    #[must_use]
    pub fn groups(&self) -> &GroupHierarchy {
        &self.groups
    }

    /// How its horizons were found.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Whether culling by its horizons is conservative. Only [`Method::Sound`] guarantees that.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.method == Method::Sound
    }

    /// Whether horizons hold for an observer, metres east, north and up of the field's origin. They do if the surface within `clearance`
    /// metres in the plan is lower than the observer by more than `clearance`, and the terrain has no margin. An observer below the surface
    /// sees it from the wrong side, and what the near plane cuts away hides nothing. The observer may lie outside of the field: see
    /// [`BoundaryTree`].
    #[must_use]
    pub fn is_valid_observer(&self, at: DVec3, clearance: f64) -> bool {
        self.margin.is_empty() && self.is_lower_than(at, clearance)
    }

    /// Whether all of the surface within `clearance` metres in the plan is lower than a position by more than `clearance`.
    pub(crate) fn is_lower_than(&self, at: DVec3, clearance: f64) -> bool {
        let near = self.highest_near(at.truncate(), clearance);
        near.is_none_or(|highest| highest + clearance < at.z)
    }

    /// The height of the surface at a position in the plan, metres from the field's origin. `None` outside of the field and in its holes.
    #[must_use]
    pub fn height(&self, at: DVec2) -> Option<f64> {
        let found = self.ground.surface_at(&self.field, at);
        found.map(|found| found.height)
    }

    /// An upper bound of the surface's height near a position in the plan: see [`Ground::highest_near`].
    #[must_use]
    pub fn highest_near(&self, at: DVec2, reach: f64) -> Option<f64> {
        self.ground.highest_near(&self.field, at, reach)
    }

    /// An observer at a position, metres east, north and up of the field's origin, that sees in the directions `azimuths`. `None` where
    /// horizons do not hold: see [`Self::is_valid_observer`].
    #[must_use]
    pub fn observer(
        &self,
        at: DVec3,
        azimuths: AzimuthRange,
        clearance: f64,
    ) -> Option<Observer<'_>> {
        let observer = || {
            let observer = Observer::new(&self.groups, at, azimuths);
            let within = self.boundary.is_convex() && self.is_over(at.truncate());
            if within {
                observer
            } else {
                observer.with_boundary(&self.boundary, DVec3::ZERO)
            }
        };
        self.is_valid_observer(at, clearance).then(observer)
    }

    /// Whether a position in the plan lies over the field.
    pub(crate) fn is_over(&self, at: DVec2) -> bool {
        self.ground.surface_at(&self.field, at).is_some()
    }

    /// Whether one of its triangles has these corners.
    pub(crate) fn has_triangle(&self, corners: &[DVec3; 3]) -> bool {
        self.ground.has_triangle(&self.field, corners)
    }
}
