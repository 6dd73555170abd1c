//! Three passes. The first renders the depth of proxies. The second counts, for each entity, the samples of its proxy that pass the depth test
//! against that depth. The third draws the meshes of the entities with more visible samples than a threshold.
//!
//! Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific Applications*, 2004. The passes need no
//! drawing order, and the scene needs no preparation but proxies: simplified meshes that hide what the meshes hide. The defaults are aggressive.
//! It is conservative with `latency` same-frame or on-gpu, full meshes in both passes, `scale` 1, and `threshold`, `allow` and `coarser` 0.

use std::ops::RangeInclusive;

use antumbra_cull::guard::GuardOptions;
use antumbra_cull::{
    Allowance, AtNearPlane, Counting, DeclareError, Dial, FrameGraph, Latency, MeshDetail,
    Parameter, ProxyLimits, ProxySource, SampleRule, Setting, SettingError, Step, Strategy,
    Tunable, Value, ViewNodes, VisibleSet, assign, describe, shortest,
};

/// The strategy `three-pass`.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreePass {
    /// When the counts are used.
    pub latency: Latency,
    /// How samples are counted; `None`: the first of identity, atomics, compare and queries that the device and the other settings allow.
    pub counting: Option<Counting>,
    /// An entity is drawn when more pixels of its proxy than this are visible, in pixels of the final image. `None`: the same part of every image ([`Self::threshold_for`]). The counts are compared with `threshold * scale²` times the samples a pixel, rounded
    /// down, since the first two passes draw a smaller image.
    pub threshold: Option<u32>,
    /// Percent of the image that a frame may leave out although it is visible. The entities with the fewest visible samples are left out first, and none with more than
    /// [`Allowance::LARGEST`] samples of the first two passes' image. A value above 0 raises the threshold of each frame as far as this percentage permits; it never lowers the threshold. With
    /// [`Latency::OnGpu`] a plan that was compiled while `allow` was 0 has no node for it, and turning the dial later does nothing.
    pub allow: Dial,
    /// An entity with at most this many visible pixels of the final image is drawn one level of detail coarser, with at most a quarter of this number two levels,
    /// with at most a sixteenth three. 0: never. Transparent entities (those that are blended) are always drawn at full detail.
    pub coarser: u32,
    /// The geometry of the occluders in the first pass.
    pub occluders: TestGeometry,
    /// The geometry of the occludees in the second pass.
    pub occludees: TestGeometry,
    /// A proxy is used where its deviation from its mesh, projected at the nearest depth of its box, is at most this many pixels of the final image; otherwise the mesh itself is
    /// used. Infinity, written `any`: the proxy everywhere but at the near plane.
    pub deviation: f64,
    /// Width and height of the first two passes' image as a fraction of the final image's: 0.05 to 1.
    pub scale: f64,
    /// How far the eye goes a frame, for late answers that hide nothing that has come into view meanwhile.
    pub guard: GuardOptions,
}

/// The geometry that stands for an entity in the first two passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TestGeometry {
    /// Its proxy, a simplified mesh; the full mesh where it has none.
    Proxy,
    /// Its full mesh.
    Full,
    /// Its bounding box. Refused for occluders: a box hides more than the mesh in it.
    Box,
}

impl TestGeometry {
    fn detail(self) -> MeshDetail {
        match self {
            Self::Proxy => MeshDetail::Proxy,
            Self::Full => MeshDetail::Level(0),
            Self::Box => MeshDetail::Box,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Proxy => "proxy",
            Self::Full => "full",
            Self::Box => "box",
        }
    }
}

impl Default for ThreePass {
    fn default() -> Self {
        Self {
            latency: Latency::FrameLate,
            counting: None,
            threshold: None,
            allow: Dial::new(0.0),
            coarser: 0,
            occluders: TestGeometry::Proxy,
            occludees: TestGeometry::Proxy,
            deviation: 8.0,
            scale: 0.5,
            guard: GuardOptions::OFF,
        }
    }
}

/// The words of the setting `counting`: `auto`, then those of [`Counting::ALL`] in order.
const COUNTING: &[&str] = &["auto", "queries", "atomics", "compare", "identity"];
/// The values of the settings `occluders` and `occludees`, in the order of their words in [`PARAMETERS`].
const OCCLUDERS: [TestGeometry; 2] = [TestGeometry::Proxy, TestGeometry::Full];
const OCCLUDEES: [TestGeometry; 3] = [TestGeometry::Proxy, TestGeometry::Full, TestGeometry::Box];

/// The values of `scale`.
const SCALES: RangeInclusive<f64> = 0.05..=1.0;

const PARAMETERS: &[Parameter<ThreePass>] = &[
    Parameter::words(
        "latency",
        Latency::WORDS,
        "when the counts are used",
        |s| s.latency.word(),
        |s, at| s.latency = Latency::ALL[at],
    ),
    Parameter::words(
        "counting",
        COUNTING,
        "how visible samples are counted",
        |s| s.counting.map_or(COUNTING[0], Counting::word),
        |s, at| s.counting = at.checked_sub(1).map(|at| Counting::ALL[at]),
    ),
    Parameter::whole_or_auto(
        "threshold",
        0..=1_000_000,
        "px",
        "an entity is drawn if more pixels of its proxy than this are visible, in pixels of the final image; auto: 10 in an image of 1280 x 1024, the same part of any other, at least 1",
        |s| s.threshold,
        |s, pixels| s.threshold = pixels,
    ),
    Parameter::number(
        "allow",
        0.0..=100.0,
        "% of the image",
        "part of the image that a frame may leave out although it is visible, the entities with the fewest visible samples first",
        |s| shortest(s.allow.get()),
        |s, percent| s.allow.turn(percent as f32),
    ),
    Parameter::whole(
        "coarser",
        0..=1_000_000,
        "px",
        "an entity with at most this many visible pixels is drawn one level of detail coarser, with at most a quarter of this number two levels, with at most a sixteenth three; blended entities never; 0: never",
        |s| s.coarser,
        |s, pixels| s.coarser = pixels,
    ),
    Parameter::words(
        "occluders",
        &["proxy", "full"],
        "the geometry of the occluders in the first pass",
        |s| s.occluders.word(),
        |s, at| s.occluders = OCCLUDERS[at],
    ),
    Parameter::words(
        "occludees",
        &["proxy", "full", "box"],
        "the geometry of the occludees in the second pass",
        |s| s.occludees.word(),
        |s, at| s.occludees = OCCLUDEES[at],
    ),
    Parameter::number_or_any(
        "deviation",
        0.0,
        "px",
        "the most pixels of the final image by which a proxy may deviate from its mesh; where it would deviate by more, the mesh itself is tested",
        |s| s.deviation,
        |s, pixels| s.deviation = pixels,
    ),
    Parameter::number(
        "scale",
        SCALES,
        "",
        "width and height of the first two passes' image as a fraction of the final image's",
        |s| s.scale,
        |s, scale| s.scale = scale,
    ),
    Parameter::number(
        "guard",
        GuardOptions::METRES,
        "m",
        GuardOptions::METRES_MEAN,
        |s| s.guard.metres,
        |s, metres| s.guard.metres = metres,
    ),
    Parameter::number(
        "guard-turn",
        GuardOptions::DEGREES,
        "degrees",
        GuardOptions::DEGREES_MEAN,
        |s| s.guard.degrees,
        |s, degrees| s.guard.degrees = degrees,
    ),
];

/// Below this scale [`Tunable::steps`] has one more step, at the geometric mean of the scale and 1. From it on, the two are too close for another step.
const INTERMEDIATE_STEP_BELOW: f64 = 0.75;

/// The part of the image that is too small to draw, unless a threshold is set: 10 pixels of 1280 x 1024.
const UNSEEN: f64 = 10.0 / (1280.0 * 1024.0);

impl ThreePass {
    /// The threshold in pixels for a view of so many pixels (width, height): the one that is set or, without one, ten pixels of an image of 1280 x 1024 and the
    /// same part of any other, at least 1. An entity covers the same part of an image of any size, so a fixed number of pixels would leave out more of a
    /// smaller image.
    pub fn threshold_for(&self, [width, height]: [u32; 2]) -> u32 {
        let follows = (UNSEEN * f64::from(width) * f64::from(height)).round() as u32;
        self.threshold.unwrap_or(follows.max(1))
    }

    /// Refuses values of `occluders` and `scale` that a caller can set in code but not by name.
    fn check(&self) -> Result<(), DeclareError> {
        if self.occluders == TestGeometry::Box {
            return Err(self
                .conflict("a box hides more than the mesh in it: set occluders to proxy or full"));
        }
        if !SCALES.contains(&self.scale) {
            return Err(self.conflict("scale is a number from 0.05 to 1"));
        }
        Ok(())
    }

    /// The way of counting that the settings and the device allow.
    fn counting(&self, g: &FrameGraph<'_>) -> Result<Counting, DeclareError> {
        let same_geometry = self.occluders == self.occludees;
        if let Some(way) = self.counting {
            if let Some(lacking) = way.lacking(g.gpu(), g.samples()) {
                return Err(DeclareError::Device {
                    strategy: self.name().to_owned(),
                    lacking: lacking.to_owned(),
                    instead: "set counting to auto".to_owned(),
                });
            }
            if way == Counting::Queries && self.needs_counts() {
                return Err(self.conflict("hardware queries say whether any sample is visible, not how many: set threshold, coarser and allow to 0, or counting to auto"));
            }
            if way == Counting::Identity && !same_geometry {
                return Err(self.conflict("an entity-id buffer counts what it draws: set occludees to what occluders is, or counting to auto"));
            }
            return Ok(way);
        }
        // Identity first: where both passes draw the same geometry it needs one geometry pass instead of two. Queries last: they do not count.
        let preferred = [
            Counting::Identity,
            Counting::Atomics,
            Counting::Compare,
            Counting::Queries,
        ];
        let possible = |way: &Counting| {
            way.lacking(g.gpu(), g.samples()).is_none()
                && (same_geometry || *way != Counting::Identity)
                && (!self.needs_counts() || *way != Counting::Queries)
        };
        preferred
            .into_iter()
            .find(possible)
            .ok_or_else(|| DeclareError::Device {
                strategy: self.name().to_owned(),
                lacking: "any way of counting samples".to_owned(),
                instead: "set threshold, coarser and allow to 0".to_owned(),
            })
    }

    fn needs_counts(&self) -> bool {
        self.threshold != Some(0) || self.coarser > 0 || self.allow.get() > 0.0
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
        if self.latency == Latency::FrameLate {
            // What is occluded is confirmed, whatever it was tested with.
            return self.guard.is_on()
                && self.threshold == Some(0)
                && self.allow.get() == 0.0
                && self.coarser == 0;
        }
        // Boxes are not conservative. The box of a flat entity lies in the entity's plane and may lose a pixel to it; the boxes of lines and points
        // cover fewer pixels than the lines and points.
        self.threshold == Some(0)
            && self.allow.get() == 0.0
            && self.coarser == 0
            && self.occluders == TestGeometry::Full
            && self.occludees == TestGeometry::Full
            && self.scale == 1.0
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.latency)
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        self.check()?;
        let way = self.counting(g)?;
        let size = view
            .size()
            .map(|side| ((f64::from(side) * self.scale).round() as u32).max(1));
        // `threshold` and `coarser` are in pixels of the final image; counts are in samples of an image with scale² of its area.
        let samples_a_pixel = self.scale * self.scale * f64::from(g.samples());
        let to_samples = |pixels: u32| (f64::from(pixels) * samples_a_pixel).floor() as u32;
        let rule = SampleRule {
            threshold: to_samples(self.threshold_for(view.size())),
            coarser: to_samples(self.coarser),
        };
        let candidates = g.in_frustum(view);
        let proxies = g.proxies_within(
            view,
            ProxySource {
                candidates,
                detail: self.occluders.detail(),
            },
            ProxySource {
                candidates,
                detail: self.occludees.detail(),
            },
            ProxyLimits {
                deviation: self.deviation,
                // A late answer is used a frame after it was found. What crossed the near plane then, and hid much, may lie behind the eye now.
                at_near_plane: match self.latency {
                    Latency::FrameLate => AtNearPlane::HideNothing,
                    Latency::SameFrame | Latency::OnGpu => AtNearPlane::Hide,
                },
            },
        );
        let counts = g.count_samples(view, proxies, way, size);
        let allowance = Allowance {
            percent: self.allow.shared(),
            image_samples: size[0].saturating_mul(size[1]).saturating_mul(g.samples()),
        };
        Ok(match self.latency {
            Latency::FrameLate => {
                g.visible_samples_guarded(view, candidates, counts, rule, &allowance, self.guard)
            }
            now => g.visible_samples_within(view, candidates, counts, now, rule, &allowance),
        })
    }
}

impl Tunable for ThreePass {
    fn settings(&self) -> Vec<Setting> {
        describe(PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("three-pass", PARAMETERS, self, key, value)
    }

    fn following(&self, size: [u32; 2]) -> Vec<(&'static str, Value)> {
        match self.threshold {
            Some(_) => Vec::new(),
            None => vec![("threshold", self.threshold_for(size).into())],
        }
    }

    /// The first step is conservative: full meshes at scale 1. Then come the present geometry at scale 1, at an intermediate scale and at the present scale, and last the present
    /// scale with late counts if `latency` is frame-late. All steps override `latency`, `threshold`, `allow` and `coarser`, and `counting` where it is `queries`; some override
    /// `occluders`, `occludees` and `scale`.
    fn steps(&self) -> Vec<Step> {
        // A late answer costs pixels at any setting, so the accurate steps use the answers of the same frame. A budget keeps `allow` above 0 on steps with that dial, so that a plan on the
        // GPU has the node for it.
        let undelayed = match self.latency {
            Latency::SameFrame => Latency::SameFrame,
            Latency::FrameLate | Latency::OnGpu => Latency::OnGpu,
        };
        let mut base = Step::of([
            ("latency", undelayed.word().into()),
            ("threshold", 0u32.into()),
            ("allow", 0u32.into()),
            ("coarser", 0u32.into()),
        ]);
        if self.counting == Some(Counting::Queries) {
            // A dial needs counts, and queries answer zero or not zero.
            base = base.and([("counting", "auto".into())]);
        }
        let at_scale = |scale: f64| base.clone().and([("scale", scale.into())]);
        let exact = [("occluders", "full".into()), ("occludees", "full".into())];
        let mut steps = vec![at_scale(1.0).and(exact), at_scale(1.0).with_dial("allow")];
        if self.scale < INTERMEDIATE_STEP_BELOW {
            steps.push(at_scale(self.scale.sqrt()).with_dial("allow"));
        }
        if self.scale < 1.0 {
            steps.push(base.clone().with_dial("allow"));
        }
        if self.latency == Latency::FrameLate {
            let late = [("latency", Latency::FrameLate.word().into())];
            steps.push(base.and(late).with_dial("allow"));
        }
        steps
    }
}
