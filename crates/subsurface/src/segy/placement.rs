//! Where a SEG-Y file's volume lies, and what its samples mean.

use antumbra_formats::{LengthUnit, PlanUnit, Units};
use glam::{DVec2, DVec3};

use super::gather::Gathered;
use super::header::FileHeader;
use super::lines::Lines;
use super::options::SegyOptions;
use super::trace::PositionUnit;
use crate::volume::VolumeLayout;

/// The step between traces of a file without positions, in metres.
const PLAIN_STEP: f64 = 25.0;
/// Milliseconds between samples of a file that does not say.
const PLAIN_INTERVAL: f64 = 4.0;
/// Samples along an edge of a brick.
pub(super) const BRICK: u32 = 32;

impl Gathered {
    /// Where the volume lies, and what its samples mean.
    pub(super) fn layout(
        &self,
        header: &FileHeader,
        lines: &Lines,
        options: &SegyOptions,
        notes: &mut Vec<String>,
    ) -> Result<VolumeLayout, String> {
        let grid = self.fit.grid();
        let numbers = [lines.inline.step, lines.crossline.step].map(f64::from);
        let (corner, [inline, crossline]) = match grid {
            Some(grid) => {
                let corner = grid.place(lines.inline.first.into(), lines.crossline.first.into());
                let scale = self.plan_scale(header, options, corner, notes)?;
                let inline = grid.inline * scale * numbers[0];
                let crossline = grid.crossline * scale * numbers[1];
                let off = grid.off * scale.max_element();
                if off > 0.1 * inline.length().min(crossline.length()) {
                    notes.push(format!(
                        "its positions lie {off:.1} m beside a regular grid on average: drawn on the grid that fits best"
                    ));
                }
                (corner * scale, [inline, crossline])
            }
            None => {
                notes.push(format!(
                    "its traces have no positions that span a plan: lines and traces are taken {PLAIN_STEP} m apart"
                ));
                (
                    DVec2::ZERO,
                    [DVec2::Y, DVec2::X].map(|step| step * PLAIN_STEP),
                )
            }
        };
        let depth = self.depths(header, options, notes);
        let range = match options.range {
            Some(range) => range,
            None => {
                let found = self.amplitudes.range();
                let found = found.ok_or("none of its live traces has a sample that is a number")?;
                let [low, high] = found.range;
                if found.is_clipped {
                    notes.push(format!(
                        "the largest thousandth of its samples is beyond {low} to {high}, and drawn as these (--range)"
                    ));
                }
                found.range
            }
        };
        let world = |plan: DVec2| DVec3::new(plan.x, 0.0, -plan.y);
        let size = [lines.inline.count, lines.crossline.count];
        let [inlines, crosslines] = size.map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        Ok(VolumeLayout {
            size: [inlines, crosslines, header.samples],
            brick: BRICK,
            origin: world(corner) - DVec3::Y * depth.first,
            steps: [world(inline), world(crossline), DVec3::NEG_Y * depth.step],
            range,
        })
    }

    /// Metres of a unit of positions.
    fn plan_scale(
        &self,
        header: &FileHeader,
        options: &SegyOptions,
        corner: DVec2,
        notes: &mut Vec<String>,
    ) -> Result<DVec2, String> {
        let length = match header.is_feet {
            true => LengthUnit::FOOT,
            false => LengthUnit::METRE,
        };
        let said = match self.unit {
            PositionUnit::ArcSeconds => PlanUnit::Angle(1.0 / 3600.0),
            PositionUnit::Degrees => PlanUnit::DEGREES,
            PositionUnit::Length => PlanUnit::Length(length),
        };
        let is_on_globe = |plan| match plan {
            PlanUnit::Angle(degrees) => (corner.y * degrees).abs() <= 91.0,
            PlanUnit::Length(_) => true,
        };
        let plan = match options.units.plan {
            Some(named) => named,
            None if is_on_globe(said) => said,
            // The field is often filled in wrongly.
            None => {
                notes.push(format!(
                    "it says that its places are degrees, but they are on no globe: taken as {length}"
                ));
                PlanUnit::Length(length)
            }
        };
        let latitude = match plan {
            PlanUnit::Length(unit) => {
                if unit != LengthUnit::METRE {
                    notes.push(format!("its places are {unit}, taken to metres"));
                }
                0.0
            }
            PlanUnit::Angle(degrees) => {
                let latitude = corner.y * degrees;
                if latitude.abs() > 91.0 {
                    return Err(format!(
                        "its places are degrees, but have a latitude of {latitude}: name their unit (--units m)"
                    ));
                }
                notes.push(format!(
                    "its places are degrees: taken to metres about latitude {latitude:.4} (--units overrides)"
                ));
                latitude
            }
        };
        Ok(DVec2::from_array(plan.metres(latitude)))
    }

    fn depths(
        &self,
        header: &FileHeader,
        options: &SegyOptions,
        notes: &mut Vec<String>,
    ) -> Depths {
        let intervals = [header.interval, self.interval];
        let interval = intervals.into_iter().find(|interval| *interval > 0.0);
        let interval = interval.map_or_else(
            || {
                notes.push(format!(
                    "it does not say how far its samples are apart: taken as {PLAIN_INTERVAL} ms"
                ));
                PLAIN_INTERVAL
            },
            |microseconds| microseconds / 1000.0,
        );
        if self.delays_differ {
            notes.push(
                "its traces begin at different times: all are drawn as the first begins".to_owned(),
            );
        }
        let metres = match (options.units, options.velocity) {
            (
                Units {
                    height: Some(unit), ..
                },
                _,
            ) => unit.metres(),
            // There and back again.
            (_, Some(velocity)) => velocity / 2000.0,
            (_, None) => {
                notes.push(
                    "a millisecond of its traces is drawn as a metre, as is right for depths in metres (--velocity, --units)"
                        .to_owned(),
                );
                1.0
            }
        };
        Depths {
            first: self.delay.unwrap_or_default() * metres,
            step: interval * metres,
        }
    }
}
/// The depth of the first sample, and the distance of samples, in metres.
struct Depths {
    first: f64,
    step: f64,
}
