//! A field with all that is known of it beforehand: its groups, what hides them, and where its surface is.

use glam::{DVec2, DVec3};

use crate::crystal::GroupOptions;
use crate::cull::{Arc, Eye};
use crate::cut::Part;
use crate::error::TerrainError;
use crate::field::Field;
use crate::ground::Ground;
use crate::groups::Groups;
use crate::horizon::{Horizons, Method, Scope, Sectors};
use crate::rim::Rim;

/// How a terrain is prepared.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TerrainOptions {
    /// Sectors of directions.
    pub sectors: Sectors,
    /// How horizons are found.
    pub method: Method,
    /// How groups are grown; `None` is [`GroupOptions::for_triangles`].
    pub groups: Option<GroupOptions>,
}

impl TerrainOptions {
    /// The same with groups that grow from a seed.
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
    groups: Groups,
    ground: Ground,
    rim: Rim,
    /// Corners of the triangles around it that its horizons rest on, and that are others' own.
    margin: Vec<[DVec3; 3]>,
    method: Method,
}

impl Terrain {
    /// Finds the horizons of a field and groups its triangles. `done` is told of every sector finished. The field is rounded to what is drawn.
    ///
    /// # Errors
    /// [`TerrainError`]: settings out of their ranges, or a field that rounding spoils.
    pub fn prepare(
        field: Field,
        options: &TerrainOptions,
        done: &(dyn Fn() + Sync),
    ) -> Result<Self, TerrainError> {
        Self::prepare_part(Part::whole(field), options, done)
    }

    /// The same for a block of a field: horizons are found over it and its margin, groups are of its own triangles. One that has a margin is believed
    /// only beside the blocks that this belongs to: see [`Blocks`](crate::Blocks).
    ///
    /// # Errors
    /// As [`Self::prepare`].
    pub fn prepare_part(
        part: Part,
        options: &TerrainOptions,
        done: &(dyn Fn() + Sync),
    ) -> Result<Self, TerrainError> {
        let own = part.own();
        let (field, around) = part.rounded()?.split()?;
        let default = GroupOptions::for_triangles(field.triangles().len());
        let groups = options.groups.unwrap_or(default);
        groups.check()?;
        let TerrainOptions {
            sectors, method, ..
        } = *options;
        let around = around.as_ref();
        let over = around.unwrap_or(&field);
        let horizons = Horizons::find(over, sectors, method, Scope::Surface, done);
        let horizons = horizons.first(&field);
        let margin = around.map(|around| {
            let rest = own as u32..around.triangles().len() as u32;
            rest.map(|triangle| around.corners(triangle)).collect()
        });
        let groups = Groups::make(&field, &horizons, &groups)?;
        Ok(Self {
            margin: margin.unwrap_or_default(),
            ..Self::from_parts(field, groups, method)
        })
    }

    /// What was prepared before, and has no margin.
    pub(crate) fn from_parts(field: Field, groups: Groups, method: Method) -> Self {
        Self {
            ground: Ground::new(&field),
            rim: Rim::of(&field),
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

    /// The corners of the triangles around it that its horizons rest on: those of its margin.
    #[must_use]
    pub fn margin(&self) -> &[[DVec3; 3]] {
        &self.margin
    }

    /// Its groups.
    #[must_use]
    pub fn groups(&self) -> &Groups {
        &self.groups
    }

    /// How its horizons were found.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Whether nobody sees what is said to be hidden from them: [`Method::Sound`] alone promises so.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.method == Method::Sound
    }

    /// Whether horizons may be believed from a place, metres east, north and up of the field's origin: whether nothing of the surface below
    /// it, or beside it within `clearance` metres, is as high or within those of it. Whoever stands below the surface sees it from the
    /// wrong side, and what a near plane cuts away hides nothing. The place may lie outside of the field: see [`Rim`]. Never, if the terrain has a
    /// margin.
    #[must_use]
    pub fn trusts(&self, at: DVec3, clearance: f64) -> bool {
        self.margin.is_empty() && self.is_below(at, clearance)
    }

    /// Whether a place is above all of the surface that lies within so many metres in the plan, by more than those.
    pub(crate) fn is_below(&self, at: DVec3, clearance: f64) -> bool {
        let near = self.highest_near(at.truncate(), clearance);
        near.is_none_or(|highest| highest + clearance < at.z)
    }

    /// The height of the surface at a place in the plan, metres; `None` outside of the field and in its holes.
    #[must_use]
    pub fn height(&self, place: DVec2) -> Option<f64> {
        let below = self.ground.below(&self.field, place);
        below.map(|(_, height)| height)
    }

    /// The highest place of the surface within some metres of a place in the plan: see [`Ground::highest_near`].
    #[must_use]
    pub fn highest_near(&self, place: DVec2, reach: f64) -> Option<f64> {
        self.ground.highest_near(&self.field, place, reach)
    }

    /// Somebody at a place who looks in some directions; `None` where horizons say nothing: see [`Self::trusts`].
    #[must_use]
    pub fn eye(&self, at: DVec3, sight: Arc, clearance: f64) -> Option<Eye<'_>> {
        let eye = || {
            let eye = Eye::new(&self.groups, at, sight);
            let within = self.rim.is_whole() && self.is_over(at.truncate());
            if within {
                eye
            } else {
                eye.past(&self.rim, DVec3::ZERO)
            }
        };
        self.trusts(at, clearance).then(eye)
    }

    /// Whether a place in the plan lies over the field.
    pub(crate) fn is_over(&self, place: DVec2) -> bool {
        self.ground.below(&self.field, place).is_some()
    }

    /// Whether one of its triangles has just these corners.
    pub(crate) fn has(&self, corners: &[DVec3; 3]) -> bool {
        self.ground.has(&self.field, corners)
    }
}
