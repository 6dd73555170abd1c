//! A field with all that is known of it beforehand: its groups, what hides them, and where its surface is.

use glam::{DVec2, DVec3};

use crate::crystal::GroupOptions;
use crate::cull::{Arc, Eye};
use crate::error::TerrainError;
use crate::field::Field;
use crate::ground::Ground;
use crate::groups::Groups;
use crate::horizon::{Horizons, Method, Scope, Sectors};

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
        let field = field.rounded()?;
        let default = GroupOptions::for_triangles(field.triangles().len());
        let groups = options.groups.unwrap_or(default);
        groups.check()?;
        let horizons = Horizons::find(
            &field,
            options.sectors,
            options.method,
            Scope::Surface,
            done,
        );
        let groups = Groups::make(&field, &horizons, &groups)?;
        Ok(Self::from_parts(field, groups, options.method))
    }

    /// What was prepared before.
    pub(crate) fn from_parts(field: Field, groups: Groups, method: Method) -> Self {
        Self {
            ground: Ground::new(&field),
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

    /// Whether horizons may be believed from a place, metres east, north and up of the field's origin, with nothing of the surface nearer
    /// than `clearance` metres: whoever stands below the surface sees it from the wrong side, whoever stands outside or looks across
    /// a gap may see under it, and what a near plane cuts away hides nothing.
    #[must_use]
    pub fn trusts(&self, at: DVec3, clearance: f64) -> bool {
        let plan = at.truncate();
        let over = self.ground.below(&self.field, plan);
        let near = self.ground.highest_near(&self.field, plan, clearance);
        self.field.outline().whole
            && over.is_some()
            && near.is_some_and(|highest| highest + clearance < at.z)
    }

    /// The highest place of the surface within some metres of a place in the plan: see [`Ground::highest_near`].
    #[must_use]
    pub fn highest_near(&self, place: DVec2, reach: f64) -> Option<f64> {
        self.ground.highest_near(&self.field, place, reach)
    }

    /// Somebody at a place who looks in some directions; `None` where horizons say nothing: see [`Self::trusts`].
    #[must_use]
    pub fn eye(&self, at: DVec3, sight: Arc, clearance: f64) -> Option<Eye<'_>> {
        self.trusts(at, clearance)
            .then(|| Eye::new(&self.groups, at, sight))
    }
}
