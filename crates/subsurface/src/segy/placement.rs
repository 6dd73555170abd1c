//! Where a SEG-Y file's volume lies, and what its samples mean.

use antumbra_formats::raster::{Extent, Frame, Known};
use antumbra_formats::{LengthUnit, PlanUnit, Units};
use glam::{DVec2, DVec3};

use super::gather::Gathered;
use super::header::FileHeader;
use super::lines::Lines;
use super::options::SegyOptions;
use super::trace::PositionUnit;
use crate::read::frame;
use crate::survey::{LineNumbers, PlanGrid};
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
        let interval = self.milliseconds(header, notes);
        let numbers = [lines.inline.step, lines.crossline.step].map(f64::from);
        let (corner, [inline, crossline]) = match grid {
            Some(grid) => {
                // A millisecond as a metre.
                let depth = f64::from(header.samples) * interval;
                let extent = extent(&grid, lines, depth);
                let scale = self.plan_scale(header, &extent, options, notes)?;
                let corner = grid.place(lines.inline.first.into(), lines.crossline.first.into());
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
        let depth = self.depths(interval, options, notes);
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

    /// Metres of a unit of positions within `extent`.
    fn plan_scale(
        &self,
        header: &FileHeader,
        extent: &Extent,
        options: &SegyOptions,
        notes: &mut Vec<String>,
    ) -> Result<DVec2, String> {
        let length = match header.is_feet {
            true => LengthUnit::FOOT,
            false => LengthUnit::METRE,
        };
        let said = match self.unit {
            PositionUnit::Unsaid if frame::looks_like_degrees(extent) => None,
            PositionUnit::Unsaid | PositionUnit::Length => Some(PlanUnit::Length(length)),
            PositionUnit::ArcSeconds => Some(PlanUnit::Angle(1.0 / 3600.0)),
            PositionUnit::Degrees => Some(PlanUnit::DEGREES),
            PositionUnit::Sexagesimal if options.units.plan.is_some() => None,
            PositionUnit::Sexagesimal => {
                return Err(
                    "its places are degrees, minutes and seconds in one number, which are not read: convert them to degrees or to lengths, or, if they are something else, name their unit (--units m)"
                        .to_owned(),
                );
            }
        };
        let said = match said {
            // The field is often filled in wrongly. A caller who names degrees means it.
            Some(PlanUnit::Angle(degrees))
                if options.units.plan.is_none() && !extent.is_on_globe(degrees) =>
            {
                notes.push(format!(
                    "it says that its places are degrees, but they are on no globe: taken as {length}"
                ));
                Some(PlanUnit::Length(length))
            }
            said => said,
        };
        let frame = Frame::of(
            extent,
            &Known {
                named: Units {
                    plan: options.units.plan,
                    height: None,
                },
                said: Units {
                    plan: said,
                    // Of depths other notes say more.
                    height: Some(LengthUnit::METRE),
                },
                looks_like_degrees: said.is_none(),
                latitude: options.latitude,
            },
        )?;
        notes.extend(frame.notes);
        Ok(frame.plan)
    }

    /// Milliseconds, or units of depth, between samples.
    fn milliseconds(&self, header: &FileHeader, notes: &mut Vec<String>) -> f64 {
        let intervals = [header.interval, self.interval];
        let interval = intervals.into_iter().find(|interval| *interval > 0.0);
        interval.map_or_else(
            || {
                notes.push(format!(
                    "it does not say how far its samples are apart: taken as {PLAIN_INTERVAL} ms"
                ));
                PLAIN_INTERVAL
            },
            |microseconds| microseconds / 1000.0,
        )
    }

    fn depths(&self, interval: f64, options: &SegyOptions, notes: &mut Vec<String>) -> Depths {
        if self.delays_differ {
            notes.push(
                "its traces begin at different times: all are drawn as the first begins".to_owned(),
            );
        }
        let metres = match (options.velocity, options.units.height) {
            // There and back again.
            (Some(velocity), _) => velocity / 2000.0,
            (None, Some(unit)) => unit.metres(),
            (None, None) => {
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

/// The box of a survey's corners in the plan, in the file's units.
fn extent(grid: &PlanGrid, lines: &Lines, relief: f64) -> Extent {
    let ends = |numbers: &LineNumbers| [numbers.first.into(), numbers.last()];
    let [inlines, crosslines] = [ends(&lines.inline), ends(&lines.crossline)];
    let corners = inlines.map(|inline| crosslines.map(|crossline| grid.place(inline, crossline)));
    let corners = corners.as_flattened();
    Extent {
        low: corners.iter().copied().fold(DVec2::INFINITY, DVec2::min),
        high: corners
            .iter()
            .copied()
            .fold(DVec2::NEG_INFINITY, DVec2::max),
        relief,
    }
}
