//! Verdicts: for each occludee, whether it is drawn and why.

use crate::candidates::Candidates;
use crate::entities::SceneTable;

/// Why an occludee is drawn or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[repr(u8)]
pub enum Verdict {
    /// Not in this frame's scene: a free slot. Not drawn.
    #[default]
    Absent,
    /// Its bounds lie outside the frustum. Not drawn.
    OutsideFrustum,
    /// No sample of its proxy passed the depth test. Not drawn.
    Occluded,
    /// Some samples passed, yet not more than the threshold. Not drawn.
    BelowThreshold,
    /// More samples passed than the threshold. Drawn.
    Visible,
    /// There is no answer from this camera cut, the entity crosses the near plane, or the scene says that it is not tested. Drawn.
    Untested,
    /// It was added after the query. Drawn.
    New,
}

impl Verdict {
    /// All verdicts about entities that are there, in the order of [`Verdicts::tally`].
    pub const ALL: [Self; 6] = [
        Self::OutsideFrustum,
        Self::Occluded,
        Self::BelowThreshold,
        Self::Visible,
        Self::Untested,
        Self::New,
    ];

    /// Whether the entity is drawn.
    pub fn draws(self) -> bool {
        matches!(self, Self::Visible | Self::Untested | Self::New)
    }

    /// The word for reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::Absent => "absent",
            Self::OutsideFrustum => "outside the frustum",
            Self::Occluded => "occluded",
            Self::BelowThreshold => "below the threshold",
            Self::Visible => "visible",
            Self::Untested => "untested (drawn)",
            Self::New => "new (drawn)",
        }
    }
}

/// The verdicts of one view in one frame, by slot.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Verdicts {
    of: Vec<Verdict>,
    /// By slot as far as it reaches; level 0 beyond.
    levels: Vec<u8>,
    /// The test results of entities that are drawn whatever the result; ascending by slot.
    noted: Vec<(u32, bool)>,
    tested: u32,
    /// Visible samples of the entities below the threshold.
    left_out: u64,
    /// Pixels of the image they were counted in; 0: unknown.
    counted_in: u32,
}

impl Verdicts {
    /// The verdicts about candidates that were all tested, where it is known of each whether it is drawn.
    pub(crate) fn of_drawn(
        table: &SceneTable,
        candidates: &Candidates,
        drawn: impl Fn(u32) -> bool,
    ) -> Self {
        let mut verdicts = Self::default();
        verdicts.reset_outside(table);
        verdicts.add_tested(candidates.inside().len() as u32);
        for slot in candidates.inside().iter().copied() {
            let verdict = match (drawn(slot), candidates.is_exempt(slot)) {
                (false, _) => Verdict::Occluded,
                (true, false) => Verdict::Visible,
                (true, true) => {
                    verdicts.note(slot, true);
                    Verdict::Untested
                }
            };
            verdicts.set(slot, verdict);
        }
        verdicts
    }

    /// Starts anew: `slots` entities, all with the same verdict.
    pub fn reset(&mut self, slots: u32, verdict: Verdict) {
        self.of.clear();
        self.of.resize(slots as usize, verdict);
        self.levels.clear();
        self.noted.clear();
        self.tested = 0;
        (self.left_out, self.counted_in) = (0, 0);
    }

    /// Starts anew: every live entity of a scene outside the frustum, every free slot absent.
    pub fn reset_outside(&mut self, table: &SceneTable) {
        self.reset(table.slots(), Verdict::Absent);
        for slot in table.live_slots() {
            self.set(slot, Verdict::OutsideFrustum);
        }
    }

    /// Adds the visible samples of an entity that is below the threshold.
    pub fn leave_out(&mut self, samples: u32) {
        self.left_out += u64::from(samples);
    }

    /// Sets the number of samples of the image that is counted in.
    pub fn share_left_out_of(&mut self, image_samples: u32) {
        self.counted_in = image_samples;
    }

    /// The part of the image, in percent, that the entities below the threshold cover by their counted samples: wrong pixels that were intended. `None`
    /// where nothing was counted.
    pub fn left_out_percent(&self) -> Option<f64> {
        let of = f64::from(self.counted_in);
        (of > 0.0).then(|| self.left_out as f64 / of * 100.0)
    }

    /// Adds to the number of tests: hardware queries, or proxies whose samples were counted.
    pub fn add_tested(&mut self, tests: u32) {
        self.tested += tests;
    }

    /// How many tests these verdicts took.
    pub fn tested(&self) -> u32 {
        self.tested
    }

    /// Whether the same entities are drawn for the same reasons and at the same levels, however many tests that took.
    pub fn agree(&self, other: &Self) -> bool {
        self.of == other.of && self.levels == other.levels
    }

    /// Sets one; slots beyond the end are ignored.
    pub fn set(&mut self, slot: u32, verdict: Verdict) {
        if let Some(place) = self.of.get_mut(slot as usize) {
            *place = verdict;
        }
    }

    /// One slot's verdict; [`Verdict::Absent`] beyond the end.
    pub fn get(&self, slot: u32) -> Verdict {
        self.of.get(slot as usize).copied().unwrap_or_default()
    }

    /// Sets the level of detail that a slot is drawn at; 0, the default, is the full mesh.
    pub fn set_level(&mut self, slot: u32, level: u8) {
        let at = slot as usize;
        if at < self.of.len() && (level > 0 || at < self.levels.len()) {
            if at >= self.levels.len() {
                self.levels.resize(at + 1, 0);
            }
            self.levels[at] = level;
        }
    }

    /// The level of detail a slot is drawn at.
    pub fn level(&self, slot: u32) -> u8 {
        self.levels.get(slot as usize).copied().unwrap_or(0)
    }

    /// Levels of detail in use: one more than the coarsest.
    pub fn levels(&self) -> u8 {
        self.levels
            .iter()
            .max()
            .map_or(1, |most| most.saturating_add(1))
    }

    /// Notes the test result of a slot that is drawn whatever the result: whether any sample was visible. Slots must be in ascending order.
    pub fn note(&mut self, slot: u32, seen: bool) {
        self.noted.push((slot, seen));
    }

    /// Whether a test found a visible sample of a slot, drawn or not; `None` before the first result. Data that is paged in to show a slot need not be fetched
    /// until this is `Some(true)`.
    pub fn seen(&self, slot: u32) -> Option<bool> {
        match self.get(slot) {
            Verdict::Absent => None,
            Verdict::OutsideFrustum | Verdict::Occluded => Some(false),
            Verdict::BelowThreshold | Verdict::Visible => Some(true),
            Verdict::Untested | Verdict::New => {
                let at = self.noted.binary_search_by_key(&slot, |noted| noted.0);
                Some(self.noted.get(at.ok()?)?.1)
            }
        }
    }

    /// Slots that are drawn, ascending.
    pub fn drawn(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        self.of
            .iter()
            .zip(0u32..)
            .filter(|(verdict, _)| verdict.draws())
            .map(|(_, slot)| slot)
    }

    /// Slots of this verdict, ascending.
    pub fn of_kind(&self, kind: Verdict) -> impl Iterator<Item = u32> + Clone + '_ {
        let all = self.of.iter().zip(0u32..);
        all.filter(move |(verdict, _)| **verdict == kind)
            .map(|(_, slot)| slot)
    }

    /// How many of each, in the order of [`Verdict::ALL`].
    pub fn tally(&self) -> [u32; 6] {
        let mut tally = [0; 6];
        for verdict in &self.of {
            if let Some(at) = Verdict::ALL.iter().position(|v| v == verdict) {
                tally[at] += 1;
            }
        }
        tally
    }
}
