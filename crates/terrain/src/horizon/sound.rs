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

    /// Lowers the claims of all bundles, one a reach, to what they have in one sub-sector.
    fn narrow(
        &self,
        sectors: &Sectors,
        [sector, part]: [u32; 2],
        seen: [&[u32]; 2],
        claims: &mut [Claim],
    ) {
        let field = self.field;
        let reaches = sectors.reaches() as usize;
        let ways = [part, part + 1].map(|part| sectors.ray(sector, part));
        for (bundle, claims) in claims.chunks_exact_mut(reaches).enumerate() {
            // Vertices first, then edges.
            let names = match bundle.checked_sub(field.points().len()) {
                None => [bundle as u32; 2],
                Some(edge) => {
                    let half = field.edges()[edge];
                    [field.start(half), field.end(half)]
                }
            };
            let lines = Bundle::new(names.map(|vertex| field.point(vertex)), ways);
            let (starts, front) = (lines.starts(), lines.front());
            let ends = [(0, starts[0]), (1, starts[1]), (0, front), (1, front)];
            let mut found = [Claim::OPEN; Sectors::MOST_REACHES as usize];
            let mut farther = None;
            for ((reach, claim), new) in claims.iter().enumerate().zip(&mut found) {
                if claim.slope == f64::NEG_INFINITY {
                    continue;
                }
                let highest = |(side, end): (usize, usize)| {
                    let half = seen[side][names[end] as usize * reaches + reach];
                    (side, end, half)
                };
                let highest = ends.map(highest);
                *new = match farther {
                    // What stands highest is near enough: so do its walls.
                    Some((same, found)) if same == highest => found,
                    _ => self.walls(&lines, names, highest, claim.slope),
                };
                farther = Some((highest, *new));
            }
            // A wall through lower places may be the higher one in between, and what is near lies in the farther reaches too.
            let mut nearer = Claim::OPEN;
            for (claim, found) in claims.iter_mut().zip(found).rev() {
                if found.slope > nearer.slope {
                    nearer = found;
                }
                *claim = claim.and(nearer);
            }
        }
    }

    /// The claim of the walls through what stands highest on a bundle's outermost lines, and on the lines from the end in front.
    fn walls(
        &self,
        lines: &Bundle,
        names: [u32; 2],
        highest: [(usize, usize, u32); 4],
        enough: f64,
    ) -> Claim {
        let [right, left, before, after] = highest;
        let place = |(side, end, half): (usize, usize, u32)| {
            resolve(
                self.field,
                self.field.point(names[end]),
                lines.ways()[side],
                half,
            )
        };
        let ahead = |(side, end, half): (usize, usize, u32)| {
            let new = names[0] != names[1] && lines.starts()[side] != end;
            new.then(|| place((side, end, half))).flatten()
        };
        lines.claim(
            self.field,
            [right, left].map(place),
            [before, after].map(ahead),
            enough,
        )
    }
}

impl Finder for Sound<'_> {
    fn sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]) {
        let field = self.field;
        let mut bearing = Bearing::new(&self.edges);
        let reaches = self.edges.reaches(sectors);
        let none = vec![NONE; field.points().len() * reaches.len()];
        let mut seen = [none.clone(), none];
        let claimed: usize = rows.iter().map(Row::len).sum();
        let mut claims = vec![Claim::ALL; claimed];
        bearing.turn(field, sectors.ray(sector, 0));
        look(&mut bearing, &reaches, &mut seen[0]);
        for part in 0..sectors.parts() {
            let [before, after] = &mut seen;
            after.copy_from_slice(before);
            bearing.turn(field, sectors.ray(sector, part + 1));
            look(&mut bearing, &reaches, after);
            self.narrow(sectors, [sector, part], [before, after], &mut claims);
            seen.swap(0, 1);
        }
        for (reach, row) in rows.iter_mut().enumerate() {
            let places = row.vertices.iter_mut().chain(row.edges.iter_mut());
            let claims = claims.iter().skip(reach).step_by(reaches.len());
            for (horizon, claim) in places.zip(claims) {
                *horizon = rounded(*claim);
            }
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
