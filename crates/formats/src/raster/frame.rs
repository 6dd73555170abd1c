//! From the places and heights of a file to metres: one rule for all rasters, and for the surfaces of other crates.
//!
//! What a caller names is taken; else what the file says; else places that can only be degrees are degrees; else all is metres. Every step that
//! a file did not ask for in so many words is said in a note.

use glam::DVec2;

use crate::units::{LengthUnit, PlanUnit, Units};
use antumbra_scene::Raster;

/// The longest step of a grid whose places are taken for degrees without a word of the file, in degrees.
const LONGEST_STEP: f64 = 0.5;

/// The box of places in the plan, in the file's units, and the difference between the highest and the lowest height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The least x and y.
    pub low: DVec2,
    /// The greatest x and y.
    pub high: DVec2,
    /// The relief.
    pub relief: f64,
}

impl Extent {
    /// Whether these can only be degrees: they lie on the globe, and as lengths they would be a wall, `steeper` times as high as wide.
    #[must_use]
    pub fn looks_like_degrees(&self, steeper: f64) -> bool {
        let side = (self.high - self.low).max_element();
        self.is_on_globe(1.0) && side > 0.0 && self.relief > steeper * side
    }

    /// Whether places in units of so many degrees are a longitude and a latitude.
    #[must_use]
    pub fn is_on_globe(&self, degrees: f64) -> bool {
        let far = self.low.abs().max(self.high.abs()) * degrees;
        // Half a cell may lie beyond a pole.
        far.x <= 361.0 && far.y <= 91.0
    }
}

/// The metres of a file's units, and what was assumed about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Metres of a unit east and north.
    pub plan: DVec2,
    /// Metres of a unit of height.
    pub height: f64,
    /// The latitude whose parallel has its true length, in degrees; `None` where places are no degrees.
    pub latitude: Option<f64>,
    /// What was assumed or changed, for people.
    pub notes: Vec<String>,
}

/// What is known of a file's units.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    /// What the caller names.
    pub named: Units,
    /// What the file says.
    pub said: Units,
    /// Whether its places can only be degrees: see [`Extent::looks_like_degrees`].
    pub looks_like_degrees: bool,
    /// The latitude to take degrees to metres about; `None` for the middle of the file's.
    pub latitude: Option<f64>,
}

impl Frame {
    /// The frame of places within `extent`.
    ///
    /// # Errors
    /// For degrees that are on no globe.
    pub fn of(extent: &Extent, known: &Known) -> Result<Self, String> {
        let told = known.named.or(known.said);
        let guessed = told.plan.is_none() && known.looks_like_degrees;
        let plan = match told.plan {
            Some(plan) => plan,
            None if guessed => PlanUnit::DEGREES,
            None => PlanUnit::Length(LengthUnit::METRE),
        };
        let height = told.height.unwrap_or(LengthUnit::METRE);
        let mut notes = Vec::new();
        let latitude = match plan {
            PlanUnit::Length(unit) => {
                if told.plan.is_some() && unit != LengthUnit::METRE {
                    notes.push(format!("its places are {unit}, taken to metres"));
                }
                None
            }
            PlanUnit::Angle(degrees) => {
                let [low, high] = [extent.low.y, extent.high.y].map(|y| y * degrees);
                if low < -91.0 || high > 91.0 {
                    return Err(format!(
                        "its places are degrees, but reach from latitude {low} to {high}: if they are lengths, name their unit (--units m)"
                    ));
                }
                let latitude = (known.latitude).unwrap_or(f64::midpoint(low, high));
                let why = match guessed {
                    true => "it names no unit, and its places can only be degrees",
                    false => "its places are degrees",
                };
                notes.push(format!(
                    "{why}: taken to metres about latitude {latitude:.4} (--units overrides)"
                ));
                Some(latitude)
            }
        };
        if told.height.is_some() && height != LengthUnit::METRE {
            notes.push(format!("its heights are {height}, taken to metres"));
        }
        match (told.plan.is_none() && !guessed, told.height.is_none()) {
            (true, true) => notes.push("it names no unit: taken as metres (--units)".to_owned()),
            (true, false) => {
                notes.push("it names no unit of its places: taken as metres (--units)".to_owned());
            }
            (false, true) => {
                notes.push("it names no unit of its heights: taken as metres (--units)".to_owned());
            }
            (false, false) => {}
        }
        let [east, north] = plan.metres(latitude.unwrap_or_default());
        Ok(Self {
            plan: DVec2::new(east, north),
            height: height.metres(),
            latitude,
            notes,
        })
    }
}

/// A raster in the units of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct RawRaster {
    /// The raster, with places and heights as the file has them.
    pub raster: Raster,
    /// What the file says of its units.
    pub said: Units,
    /// Whether the file says where its posts lie.
    pub is_placed: bool,
    /// What else people should know.
    pub notes: Vec<String>,
}

impl RawRaster {
    /// The raster in metres, with its frame. `named` are the caller's units, `latitude` what degrees are taken to metres about.
    ///
    /// # Errors
    /// As for [`Frame::of`].
    pub fn in_metres(self, named: Units, latitude: Option<f64>) -> Result<(Raster, Frame), String> {
        let Self {
            mut raster,
            said,
            is_placed,
            notes,
        } = self;
        let extent = extent(&raster);
        let step = raster.step_u.abs().max(raster.step_v.abs()).max_element();
        let known = Known {
            named,
            said,
            looks_like_degrees: is_placed && step <= LONGEST_STEP && extent.looks_like_degrees(1.0),
            latitude,
        };
        let mut frame = Frame::of(&extent, &known)?;
        frame.notes.splice(0..0, notes);
        raster.origin *= frame.plan;
        raster.step_u *= frame.plan;
        raster.step_v *= frame.plan;
        if frame.height != 1.0 {
            for height in &mut raster.elevation {
                *height = (f64::from(*height) * frame.height) as f32;
            }
        }
        Ok((raster, frame))
    }
}

fn extent(raster: &Raster) -> Extent {
    let last = [raster.columns, raster.rows].map(|count| count.saturating_sub(1));
    let corners = [(0, 0), (last[0], 0), (0, last[1]), (last[0], last[1])];
    let corners = corners.map(|(column, row)| raster.plan_position(column, row));
    let heights = raster.elevation.iter().filter(|height| height.is_finite());
    let (least, most) = heights.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &h| {
        (low.min(h), high.max(h))
    });
    Extent {
        low: corners.into_iter().fold(DVec2::INFINITY, DVec2::min),
        high: corners.into_iter().fold(DVec2::NEG_INFINITY, DVec2::max),
        relief: (f64::from(most) - f64::from(least)).max(0.0),
    }
}
