//! Sound horizons: claimed only where every direction of the sector is blocked, whatever the field does between the lines looked along.
//!
//! Exact horizons are found along the ends of every sub-sector; between two of them, the terrain is walked from the one to the other. See
//! [`Bundle`].

use super::bearing::{Bearing, Edges};
use super::bundle::{Bundle, Claim};
use super::crossing::resolve;
use super::rays::look;
use super::{Finder, Horizon, Row, Sectors};
use crate::field::{Field, NONE};

/// A slope so much smaller than what was computed is below what is true: heights are a thousand kilometres at most, and so are distances.
const ROUNDING: f64 = 1e-9;

pub(super) struct Sound<'a> {
    field: &'a Field,
    edges: Edges,
}

impl<'a> Sound<'a> {
    pub fn new(field: &'a Field) -> Self {
        Self {
            field,
            edges: Edges::new(field),
        }
    }

    /// Lowers the claims of all bundles to what they have in one sub-sector.
    fn narrow(
        &self,
        sectors: &Sectors,
        [sector, part]: [u32; 2],
        seen: [&[u32]; 2],
        row: &mut [Claim],
    ) {
        let field = self.field;
        let ways = [part, part + 1].map(|part| sectors.ray(sector, part));
        for (bundle, claim) in row.iter_mut().enumerate() {
            if claim.slope == f64::NEG_INFINITY {
                continue;
            }
            // Vertices first, then edges.
            let names = match bundle.checked_sub(field.points().len()) {
                None => [bundle as u32; 2],
                Some(edge) => {
                    let half = field.edges()[edge];
                    [field.start(half), field.end(half)]
                }
            };
            let lines = Bundle::new(names.map(|vertex| field.point(vertex)), ways);
            let highest = |side: usize, end: usize| {
                let vertex = names[end];
                let half = seen[side][vertex as usize];
                resolve(field, field.point(vertex), ways[side], half)
            };
            let starts = lines.starts();
            let at = [0, 1].map(|side| highest(side, starts[side]));
            let ahead = [0, 1].map(|side| {
                let new = names[0] != names[1] && starts[side] != lines.front();
                new.then(|| highest(side, lines.front())).flatten()
            });
            let found = lines.claim(field, at, ahead, claim.slope);
            claim.slope = claim.slope.min(found.slope);
            claim.distance = claim.distance.max(found.distance);
        }
    }
}

impl Finder for Sound<'_> {
    fn sector(&self, sectors: &Sectors, sector: u32, row: &mut Row<'_>) {
        let field = self.field;
        let mut bearing = Bearing::new(&self.edges);
        let vertices = field.points().len();
        let mut seen = [vec![NONE; vertices], vec![NONE; vertices]];
        let mut claims = vec![Claim::ALL; row.vertices.len() + row.edges.len()];
        bearing.turn(field, sectors.ray(sector, 0));
        look(&mut bearing, &mut seen[0]);
        for part in 0..sectors.parts() {
            let [before, after] = &mut seen;
            after.copy_from_slice(before);
            bearing.turn(field, sectors.ray(sector, part + 1));
            look(&mut bearing, after);
            self.narrow(sectors, [sector, part], [before, after], &mut claims);
            seen.swap(0, 1);
        }
        let places = row.vertices.iter_mut().chain(row.edges.iter_mut());
        for (horizon, claim) in places.zip(&claims) {
            *horizon = rounded(*claim);
        }
    }
}

/// The claim with fewer bits, and no more than it says.
pub(super) fn rounded(claim: Claim) -> Horizon {
    let slope = claim.slope - ROUNDING * (1.0 + claim.slope.abs());
    let [mut low, mut far] = [slope, claim.distance].map(|number| number as f32);
    if f64::from(low) > slope {
        low = low.next_down();
    }
    if f64::from(far) < claim.distance {
        far = far.next_up();
    }
    Horizon {
        slope: low,
        distance: far,
    }
}
