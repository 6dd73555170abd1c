//! A camera with a judge: what was asked in which frame, and what has come back.

use std::collections::VecDeque;

use antumbra::cull::Gpu;
use antumbra::cull::judge::{
    DepthRange, Eye, HostDepth, Judge, JudgeError, JudgeOptions, JudgeView, Phases,
};
use antumbra::glam as ours;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::prelude::*;

use crate::audit::{Audited, Auditing, Counter};
use crate::culler::{Judging, SharedJudging};
use crate::occludees::{Found, Kind, Occludees};
use crate::settings::{AntumbraCulling, Budget, CullingReport};

/// A camera that culls.
pub(crate) struct View {
    pub judging: SharedJudging,
    pub image: Image2d,
    asked: VecDeque<Asked>,
    answers: Option<Answers>,
    /// Where the camera was in the last frame, and how far it had come since the one before.
    last: Option<Place>,
    /// The distance of what was nearest to the camera in the last frame.
    nearest: f32,
    /// The settings' cuts in the last frame.
    cuts: u32,
    is_cut: bool,
    /// Pixels, under a budget of wrong ones.
    dial: f32,
    /// The matrix of the last frame, and whether it was another one before.
    matrix: Mat4,
    has_moved: bool,
    auditing: Auditing,
}

/// What a judge has to know of a camera's image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Image2d {
    pub size: UVec2,
    pub samples: u32,
}

/// A frame in which a test was asked for.
#[derive(Debug, Clone, Copy)]
struct Asked {
    /// The judge's number of it.
    frame: u64,
    /// The boxes that were tested.
    epoch: u64,
    place: Vec3,
}

/// What has come back.
#[derive(Debug)]
struct Answers {
    of: Asked,
    hidden: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Place {
    at: Vec3,
    step: f32,
}

/// Answers for a frame.
pub(crate) struct Verdicts<'a> {
    answers: &'a Answers,
    /// Where the camera is now.
    eye: Vec3,
    /// What is nearer than this is drawn.
    near: f32,
}

/// Frames that are remembered until their answers come. More than a judge has under way.
const MOST_ASKED: usize = 16;

impl View {
    /// # Errors
    /// [`JudgeError`] where the device cannot test against such a depth.
    pub fn new(gpu: &Gpu, image: Image2d) -> Result<Self, JudgeError> {
        let depth = HostDepth {
            format: CORE_3D_DEPTH_FORMAT,
            samples: image.samples,
            range: DepthRange::Reversed,
        };
        let view = JudgeView::main(image.size.x, image.size.y, depth);
        let options = JudgeOptions {
            phases: Phases::Late,
            list: true,
            ..JudgeOptions::default()
        };
        Ok(Self {
            judging: SharedJudging::new(Judging {
                judge: Judge::new(gpu, vec![view], options)?,
                counter: Counter::new(gpu),
            }),
            image,
            asked: VecDeque::new(),
            answers: None,
            last: None,
            nearest: f32::INFINITY,
            cuts: 0,
            is_cut: true,
            dial: Budget::FIRST_SHIFT,
            matrix: Mat4::ZERO,
            has_moved: false,
            auditing: Auditing::default(),
        })
    }

    /// Takes over what has come back. Never waits.
    pub fn collect(
        &mut self,
        settings: &AntumbraCulling,
        occludees: &Occludees,
        report: &mut CullingReport,
    ) {
        let shared = self.judging.clone();
        let mut judging = shared.lock();
        let Judging { judge, counter } = &mut *judging;
        if let Some(pixels) = counter.take()
            && let Some(has_moved) = self.auditing.end()
        {
            let image = self.image.size.as_vec2();
            let wrong = 100.0 * pixels as f32 / (image.x * image.y);
            report.wrong = Some(wrong);
            report.audits += 1;
            if has_moved {
                self.note_wrong(settings, wrong);
            }
        }
        let Some(hidden) = judge.hidden(0).ok().flatten() else {
            return;
        };
        let frame = hidden.frame;
        let known = self.answers.as_ref().map(|answers| answers.of.frame);
        let of = self.asked.iter().find(|asked| asked.frame == frame);
        let Some(of) = of.filter(|_| known != Some(frame)).copied() else {
            return;
        };
        self.auditing.note_answers(frame, |entity| {
            let found = occludees.find(Kind::Mesh, entity);
            found.is_none_or(|found| hidden.contains(found.index))
        });
        let mut words = self
            .answers
            .take()
            .map_or_else(Vec::new, |answers| answers.hidden);
        words.clear();
        words.extend_from_slice(hidden.words());
        self.answers = Some(Answers { of, hidden: words });
        self.asked.retain(|asked| asked.frame >= frame);
    }

    /// Forgets what was known if the camera has jumped: because its owner says so, or because it has come farther than to what was nearest to it, and much farther than in the frame before.
    pub fn follow(&mut self, settings: &AntumbraCulling, eye: Vec3) {
        let step = self.last.map_or(0.0, |last| last.at.distance(eye));
        let before = self.last.map_or(0.0, |last| last.step);
        let has_jumped = step > self.nearest && step > before * JUMP;
        if std::mem::replace(&mut self.cuts, settings.cuts) != settings.cuts || has_jumped {
            self.is_cut = true;
            self.answers = None;
            self.asked.clear();
        }
        self.last = Some(Place { at: eye, step });
    }

    /// Notes how near to the camera something is that is drawn.
    pub fn note_nearest(&mut self, nearest: f32) {
        self.nearest = nearest;
    }

    /// What is known for a camera that is here, and has its near plane so far away. Nothing where the budget cannot be kept.
    pub fn verdicts(
        &self,
        settings: &AntumbraCulling,
        eye: Vec3,
        near: f32,
    ) -> Option<Verdicts<'_>> {
        let answers = self.answers.as_ref()?;
        let is_over_budget =
            matches!(settings.budget, Budget::WrongPixels(_)) && self.dial > Budget::MOST_SHIFT;
        if is_over_budget && self.has_moved && !settings.frozen {
            return None;
        }
        // What was hidden from where it was frozen stays so wherever the camera is taken.
        let eye = match settings.frozen {
            true => answers.of.place,
            false => eye,
        };
        let near = near * NEAR_ROOM + answers.of.place.distance(eye);
        Some(Verdicts { answers, eye, near })
    }

    /// The eye that a test is asked for.
    pub fn eye(&mut self, settings: &AntumbraCulling, clip_from_world: Mat4) -> Eye {
        self.has_moved = std::mem::replace(&mut self.matrix, clip_from_world) != clip_from_world;
        let matrix = ours::Mat4::from_cols_array(&clip_from_world.to_cols_array());
        Eye {
            cut: std::mem::take(&mut self.is_cut),
            shift: self.shift(settings),
            // Bevy's shaders compute in f32 from the world's origin.
            ..Eye::new(matrix, ours::DVec3::ZERO)
        }
    }

    /// Whether the depth of the frame that was asked about last is to be copied, for it is audited.
    pub fn begin_audit(&mut self, settings: &AntumbraCulling, culled: &[Entity]) -> bool {
        let is_due = self.auditing.is_due(settings.audit) && !culled.is_empty();
        if let Some(asked) = self.asked.back().filter(|_| is_due) {
            self.auditing.begin(Audited {
                frame: asked.frame,
                clip_from_world: self.matrix,
                has_moved: self.has_moved,
                culled: culled.to_vec(),
            });
        }
        is_due
    }

    /// What an audit has found not to be hidden, to be counted.
    pub fn take_suspects(&mut self) -> Option<Audited> {
        self.auditing.take_suspects()
    }

    /// The pixels by which what is hidden must be so on all sides.
    pub fn shift(&self, settings: &AntumbraCulling) -> f32 {
        let wanted = match settings.budget {
            Budget::Shift(pixels) => pixels,
            Budget::WrongPixels(_) if self.has_moved => self.dial,
            // While the camera stands still, nothing is uncovered.
            Budget::WrongPixels(_) => LEAST_SHIFT,
        };
        // Written so that what is not a number is the least.
        wanted.min(Budget::MOST_SHIFT).max(LEAST_SHIFT)
    }

    /// Turns the dial by the wrong pixels, in percent, of a frame in which the camera moved. Past its end, nothing is culled in motion until it has come back.
    fn note_wrong(&mut self, settings: &AntumbraCulling, wrong: f32) {
        let Budget::WrongPixels(allowed) = settings.budget else {
            return;
        };
        if wrong > allowed {
            self.dial = (self.dial * 2.0).min(Budget::MOST_SHIFT * 2.0);
        } else if wrong < allowed * 0.25 {
            self.dial = (self.dial * 0.9).max(LEAST_SHIFT);
        }
    }

    /// Notes that a test was asked for.
    pub fn note_asked(&mut self, frame: u64, epoch: u64) {
        let place = self.last.map_or(Vec3::ZERO, |last| last.at);
        self.asked.push_back(Asked {
            frame,
            epoch,
            place,
        });
        while self.asked.len() > MOST_ASKED {
            self.asked.pop_front();
        }
    }

    /// The matrix of the last frame that was asked about.
    pub fn matrix(&self) -> Mat4 {
        self.matrix
    }

    /// How many frames old the answers are.
    pub fn age(&self) -> Option<u32> {
        let newest = self.asked.back()?.frame;
        let answers = self.answers.as_ref()?;
        Some((newest + 1).saturating_sub(answers.of.frame) as u32)
    }
}

/// Takes in the jitter of temporal antialiasing.
const LEAST_SHIFT: f32 = 1.0;
/// A step of the camera that is so many times longer than the one before may be a jump.
const JUMP: f32 = 4.0;
/// The corners of the near plane are farther from the eye than its middle: for 120 degrees high and 16:9, 3.7 times.
const NEAR_ROOM: f32 = 4.0;

impl Verdicts<'_> {
    /// Whether something is left out. It was hidden, it is where it was tested, and the camera has not come near to it.
    pub fn hides(&self, found: &Found) -> bool {
        let word = self.answers.hidden.get(found.index as usize / 32);
        let is_hidden = word.is_some_and(|word| word >> (found.index % 32) & 1 != 0);
        is_hidden
            && found.since <= self.answers.of.epoch
            && found.now.distance(self.eye) > self.near
    }
}
