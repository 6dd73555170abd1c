//! Three passes: the depth of the proxies, the visible samples of the proxies against it, the meshes above the threshold.
//!
//! Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific Applications*, 2004. No order of
//! drawing is needed and nothing is asked of the scene but proxies whose occlusion is that of their meshes. It errs where they are not.

use antumbra_draw::Detail;

use antumbra_cull::{
    Allowance, Close, Counting, DeclareError, Dial, FrameGraph, LATENCY_RANGE, Latency, SampleRule,
    Setting, SettingError, Step, Strategy, ViewNodes, VisibleSet, parse,
};

/// The strategy `three-pass`.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreePass {
    /// When the counts are used.
    pub latency: Latency,
    /// How samples are counted; `None` takes what is fastest here.
    pub counting: Option<Counting>,
    /// An entity is drawn when more samples of its proxy are visible, in pixels of the final image.
    pub threshold: u32,
    /// The part of the image, in percent, that a frame may leave out though it was seen: those with the fewest visible samples first, as many as
    /// share no more than that. Beside the threshold; where answers stay on the GPU it may be turned only if it was above 0 when the plan was made.
    pub allow: Dial,
    /// With at most this many visible samples an entity is drawn one level of detail coarser, with at most a quarter of them two,
    /// with a sixteenth three, in pixels of the final image; 0: never.
    pub coarser: u32,
    /// What stands in for the meshes in the first pass.
    pub occluders: StandIn,
    /// What stands in for the meshes in the second pass.
    pub occludees: StandIn,
    /// A low-resolution version stands in where it deviates from its mesh by at most so many pixels of the final image; nearer by, the mesh stands
    /// for itself. Infinity: anywhere.
    pub deviation: f64,
    /// Side of the first two passes' image as a part of the final one's: at most 1.
    pub scale: f64,
}

/// What stands in for a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StandIn {
    /// Its low-resolution version.
    Proxy,
    /// Itself.
    Full,
    /// Its bounding box; never as an occluder, since a box hides more than what is in it.
    Box,
}

impl StandIn {
    fn detail(self) -> Detail {
        match self {
            Self::Proxy => Detail::Proxy,
            Self::Full => Detail::Level(0),
            Self::Box => Detail::Box,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Proxy => "proxy",
            Self::Full => "full",
            Self::Box => "box",
        }
    }

    fn read(
        key: &str,
        value: &str,
        range: &'static str,
        allowed: &[Self],
    ) -> Result<Self, SettingError> {
        let found = allowed.iter().find(|stand_in| stand_in.word() == value);
        found.copied().ok_or_else(|| SettingError::Value {
            key: key.to_owned(),
            value: value.to_owned(),
            range,
        })
    }
}

impl Default for ThreePass {
    fn default() -> Self {
        Self {
            latency: Latency::FrameLate,
            counting: None,
            threshold: 10,
            allow: Dial::new(0.0),
            coarser: 0,
            occluders: StandIn::Proxy,
            occludees: StandIn::Proxy,
            deviation: 8.0,
            scale: 0.5,
        }
    }
}

const COUNTING_RANGE: &str = "auto, queries, atomics, compare or identity";
const THRESHOLD_RANGE: &str = "a whole number of pixels, 0 to 1000000";
const ALLOW_RANGE: &str = "a number of percent, 0 to 100";
const COARSER_RANGE: &str = "a whole number of pixels, 0 (never) to 1000000";
const OCCLUDERS_RANGE: &str = "proxy or full";
const OCCLUDEES_RANGE: &str = "proxy, full or box";
const DEVIATION_RANGE: &str = "a number of pixels from 0, or any";
const SCALE_RANGE: &str = "a number from 0.05 to 1";
/// Below this scale a budget has a step between it and full size, at their geometric mean; above, the two are too close for one more.
const BETWEEN: f64 = 0.75;

impl ThreePass {
    fn way(&self, g: &FrameGraph<'_>) -> Result<Counting, DeclareError> {
        let alike = self.occluders == self.occludees;
        if let Some(way) = self.counting {
            if let Some(lacking) = way.lacking(g.gpu()) {
                return Err(DeclareError::Device {
                    strategy: self.name().to_owned(),
                    lacking: lacking.to_owned(),
                    instead: "set counting to auto".to_owned(),
                });
            }
            if way == Counting::Queries && self.needs_counts() {
                return Err(self.conflict("hardware queries say whether any sample is visible, not how many: set threshold and coarser to 0, or counting to auto"));
            }
            if way == Counting::Identity && !alike {
                return Err(self.conflict("an entity-id buffer counts what it draws: set occludees to what occluders is, or counting to auto"));
            }
            return Ok(way);
        }
        // Where occluders are what is tested, one geometry pass does for two.
        let preferred = [
            Counting::Identity,
            Counting::Atomics,
            Counting::Compare,
            Counting::Queries,
        ];
        let possible = |way: &Counting| {
            way.lacking(g.gpu()).is_none()
                && (alike || *way != Counting::Identity)
                && (!self.needs_counts() || *way != Counting::Queries)
        };
        preferred
            .into_iter()
            .find(possible)
            .ok_or_else(|| DeclareError::Device {
                strategy: self.name().to_owned(),
                lacking: "any way of counting samples".to_owned(),
                instead: "set threshold and coarser to 0".to_owned(),
            })
    }

    fn needs_counts(&self) -> bool {
        self.threshold > 0 || self.coarser > 0 || self.allow.get() > 0.0
    }

    fn conflict(&self, conflict: &str) -> DeclareError {
        DeclareError::Settings {
            strategy: self.name().to_owned(),
            conflict: conflict.to_owned(),
        }
    }
}

impl Strategy for ThreePass {
    fn name(&self) -> &str {
        "three-pass"
    }

    fn summary(&self) -> &str {
        "draws what has more visible samples than a threshold, counted on proxies (Plate et al. 2004)"
    }

    fn conservative(&self) -> bool {
        // Not with boxes: that of a flat entity lies in its plane and may lose a pixel to it; those of lines and points cover less.
        self.latency != Latency::FrameLate
            && self.threshold == 0
            && self.allow.get() == 0.0
            && self.coarser == 0
            && self.occluders == StandIn::Full
            && self.occludees == StandIn::Full
            && self.scale == 1.0
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.latency)
    }

    fn settings(&self) -> Vec<Setting> {
        let setting = |key, value, range, meaning| Setting {
            key,
            value,
            range,
            meaning,
        };
        let counting = self
            .counting
            .map_or_else(|| "auto".to_owned(), |way| way.to_string());
        vec![
            setting(
                "latency",
                self.latency.to_string(),
                LATENCY_RANGE,
                "when the counts are used",
            ),
            setting(
                "counting",
                counting,
                COUNTING_RANGE,
                "how visible samples are counted",
            ),
            setting(
                "threshold",
                self.threshold.to_string(),
                THRESHOLD_RANGE,
                "an entity is drawn when more of its proxy's pixels are visible",
            ),
            setting(
                "allow",
                self.allow.get().to_string(),
                ALLOW_RANGE,
                "part of the image that a frame may leave out though it was seen, the smallest first",
            ),
            setting(
                "coarser",
                self.coarser.to_string(),
                COARSER_RANGE,
                "with at most so many visible pixels an entity is drawn one level of detail coarser; with a quarter of them two; 0: never",
            ),
            setting(
                "occluders",
                self.occluders.word().to_owned(),
                OCCLUDERS_RANGE,
                "what stands in for the meshes in the first pass",
            ),
            setting(
                "occludees",
                self.occludees.word().to_owned(),
                OCCLUDEES_RANGE,
                "what stands in for the meshes in the second pass",
            ),
            setting(
                "deviation",
                match self.deviation.is_finite() {
                    true => self.deviation.to_string(),
                    false => "any".to_owned(),
                },
                DEVIATION_RANGE,
                "most pixels by which a proxy may deviate from its mesh; nearer by the mesh stands for itself",
            ),
            setting(
                "scale",
                self.scale.to_string(),
                SCALE_RANGE,
                "side of the first two passes' image as a part of the final one's",
            ),
        ]
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), SettingError> {
        match key {
            "latency" => self.latency = parse(key, value, LATENCY_RANGE, |_| true)?,
            "counting" if value == "auto" => self.counting = None,
            "counting" => self.counting = Some(parse(key, value, COUNTING_RANGE, |_| true)?),
            "threshold" => {
                self.threshold = parse(key, value, THRESHOLD_RANGE, |pixels| *pixels <= 1_000_000)?
            }
            "allow" => self.allow.turn(parse(key, value, ALLOW_RANGE, |percent| {
                (0.0..=100.0).contains(percent)
            })?),
            "coarser" => {
                self.coarser = parse(key, value, COARSER_RANGE, |pixels| *pixels <= 1_000_000)?
            }
            "occluders" => {
                self.occluders = StandIn::read(
                    key,
                    value,
                    OCCLUDERS_RANGE,
                    &[StandIn::Proxy, StandIn::Full],
                )?
            }
            "occludees" => {
                self.occludees = StandIn::read(
                    key,
                    value,
                    OCCLUDEES_RANGE,
                    &[StandIn::Proxy, StandIn::Full, StandIn::Box],
                )?;
            }
            "deviation" if value == "any" => self.deviation = f64::INFINITY,
            "deviation" => {
                self.deviation = parse(key, value, DEVIATION_RANGE, |pixels: &f64| {
                    pixels.is_finite() && *pixels >= 0.0
                })?
            }
            "scale" => {
                self.scale = parse(key, value, SCALE_RANGE, |scale| {
                    (0.05..=1.0).contains(scale)
                })?
            }
            _ => {
                return Err(SettingError::Unknown {
                    strategy: self.name().to_owned(),
                    key: key.to_owned(),
                    known: self.settings().iter().map(|setting| setting.key).collect(),
                });
            }
        }
        Ok(())
    }

    fn steps(&self) -> Vec<Step> {
        // A late answer costs pixels whatever it is about.
        let now = match self.latency {
            Latency::SameFrame => "same-frame",
            Latency::FrameLate | Latency::OnGpu => "on-gpu",
        };
        let base = [
            ("latency", now),
            ("threshold", "0"),
            ("allow", "0"),
            ("coarser", "0"),
        ];
        let step = |more: &[(&'static str, &str)]| {
            let mut step = Step::of(base);
            let more = more.iter().map(|(key, value)| (*key, (*value).to_owned()));
            step.settings.extend(more);
            step
        };
        let mut steps = vec![
            step(&[("occluders", "full"), ("occludees", "full"), ("scale", "1")]),
            step(&[("scale", "1")]).with_dial("allow"),
        ];
        if self.scale < BETWEEN {
            let between = self.scale.sqrt().to_string();
            steps.push(step(&[("scale", &between)]).with_dial("allow"));
        }
        if self.scale < 1.0 {
            steps.push(step(&[]).with_dial("allow"));
        }
        if self.latency == Latency::FrameLate {
            steps.push(step(&[("latency", "frame-late")]).with_dial("allow"));
        }
        steps
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let way = self.way(g)?;
        let size = view
            .size()
            .map(|side| ((f64::from(side) * self.scale).round() as u32).max(1));
        // Settings are in pixels of the final image; the counts are of a smaller one.
        let scaled = |pixels: u32| (f64::from(pixels) * self.scale * self.scale).floor() as u32;
        let rule = SampleRule {
            threshold: scaled(self.threshold),
            coarser: scaled(self.coarser),
        };
        let candidates = g.in_frustum(view);
        let proxies = g.proxies_within(
            view,
            (candidates, self.occluders.detail()),
            (candidates, self.occludees.detail()),
            Close {
                deviation: self.deviation,
                cut_hide: self.latency != Latency::FrameLate,
            },
        );
        let counts = g.count_samples(view, proxies, way, size);
        let within = Allowance {
            percent: self.allow.shared(),
            pixels: size[0].saturating_mul(size[1]),
        };
        Ok(g.visible_samples_within(view, candidates, counts, self.latency, rule, &within))
    }
}
