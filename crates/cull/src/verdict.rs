//! Verdicts: for each occludee, whether it is drawn and why.

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
    /// No answer about it from this camera cut, it reaches over the near plane, or the scene says that it is not tested. Drawn.
    Untested,
    /// It came after the answer was asked for. Drawn.
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
    /// What a test said of those that are drawn whatever it says; ascending.
    noted: Vec<(u32, bool)>,
    asked: u32,
    /// Visible samples of those below the threshold.
    left_out: u64,
    /// Pixels of the image they were counted in; 0: unknown.
    counted_in: u32,
}

impl Verdicts {
    /// Starts anew: `slots` entities, all with the same verdict.
    pub fn reset(&mut self, slots: u32, verdict: Verdict) {
        self.of.clear();
        self.of.resize(slots as usize, verdict);
        self.levels.clear();
        self.noted.clear();
        self.asked = 0;
        (self.left_out, self.counted_in) = (0, 0);
    }

    /// Notes the visible samples of an entity that is left out all the same.
    pub fn leave_out(&mut self, samples: u32) {
        self.left_out += u64::from(samples);
    }

    /// Says of how many pixels an image is that samples were counted in.
    pub fn share_left_out_of(&mut self, pixels: u32) {
        self.counted_in = pixels;
    }

    /// What those below the threshold have of the image by the samples that were counted, in percent: wrong pixels that were meant. `None` where
    /// nobody counted.
    pub fn left_out_percent(&self) -> Option<f64> {
        let of = f64::from(self.counted_in);
        (of > 0.0).then(|| self.left_out as f64 / of * 100.0)
    }

    /// Counts entities that were asked about: hardware queries, or proxies whose samples were counted.
    pub fn add_tested(&mut self, asked: u32) {
        self.asked += asked;
    }

    /// How many entities were asked about to reach these verdicts.
    pub fn tested(&self) -> u32 {
        self.asked
    }

    /// Whether the same entities are drawn for the same reasons and at the same levels, however many were asked about.
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

    /// Has a slot drawn at a level of detail; 0 is the full mesh, and what is drawn where nobody says otherwise.
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

    /// Notes what a test said of a slot that is drawn whatever it says: whether any sample was visible. Slots come in ascending order.
    pub fn note(&mut self, slot: u32, seen: bool) {
        self.noted.push((slot, seen));
    }

    /// Whether a test found a visible sample of a slot, be it drawn or not; `None` where no test has said anything yet. What would be fetched to
    /// show a slot need not be until this is `Some(true)`.
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
