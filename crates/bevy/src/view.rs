//! A judge, what it was asked in which frame, and what has come back.

use std::collections::VecDeque;

use antumbra::cull::Gpu;
use antumbra::cull::judge::{
    DepthRange, Drift, Eye, HostDepth, Judge, JudgeError, JudgeOptions, JudgeView, Phases,
};
use antumbra::glam as ours;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::prelude::*;

use crate::culler::{Judging, SharedJudging};
use crate::dial::Margin;
use crate::occludees::{Found, Occludees};
use crate::occluders::{OccluderDepth, OccluderPipelines};

/// What is tested from one point: a camera, or a face of a light's shadow maps.
pub(crate) struct View {
    pub judging: SharedJudging,
    pub image: Image2d,
    asked: VecDeque<Asked>,
    answers: Option<Answers>,
    is_cut: bool,
}

/// What a judge has to know of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Image2d {
    pub size: UVec2,
    pub samples: u32,
}

/// Where a view is seen from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    pub eye: Vec3,
    pub clip_from_world: Mat4,
    /// The distance of the near plane; 0 where it is not one of a perspective.
    pub near: f32,
}

/// What a test is asked with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Request {
    pub pose: Pose,
    /// The pixels by which what is hidden must be so.
    pub margin: Margin,
    /// Which way the eye goes: a direction of any length.
    pub way: Vec3,
    /// Whether the view has been moving.
    pub is_moving: bool,
    /// What hides: another number for other occluders, or the same ones elsewhere.
    pub occluders: u64,
}

/// A frame in which a test was asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked {
    /// The judge's number of it.
    frame: u64,
    /// The boxes that were tested.
    epoch: u64,
    pub request: Request,
}

/// What has come back.
#[derive(Debug)]
pub(crate) struct Answers {
    pub of: Asked,
    hidden: Vec<u32>,
}

/// Answers for a frame.
pub(crate) struct Verdicts<'a> {
    answers: &'a Answers,
    /// Where the eye is now.
    eye: Vec3,
    /// What is nearer than this is drawn.
    near: f32,
}

/// Frames that are remembered until their answers come. More than a judge has under way.
const MOST_ASKED: usize = 16;
/// The corners of the near plane are farther from the eye than its middle: for 120 degrees high and 16:9, 3.7 times.
const NEAR_ROOM: f32 = 4.0;

impl View {
    /// # Errors
    /// [`JudgeError`] where the device cannot test against such a depth.
    pub fn new(
        gpu: &Gpu,
        image: Image2d,
        pipelines: &OccluderPipelines,
    ) -> Result<Self, JudgeError> {
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
                counter: None,
                occluders: OccluderDepth::new(gpu, pipelines),
            }),
            image,
            asked: VecDeque::new(),
            answers: None,
            is_cut: true,
        })
    }

    /// Takes over the newest answers. Never waits. Returns their frame if they were not known yet.
    pub fn collect(&mut self) -> Option<u64> {
        let shared = self.judging.clone();
        let mut judging = shared.lock();
        let hidden = judging.judge.hidden(0).ok().flatten()?;
        let frame = hidden.frame;
        let of = *self.asked.iter().find(|asked| asked.frame == frame)?;
        let before = self.answers.take();
        if before.as_ref().is_some_and(|known| known.of.frame == frame) {
            self.answers = before;
            return None;
        }
        let mut words = before.map_or_else(Vec::new, |answers| answers.hidden);
        words.clear();
        words.extend_from_slice(hidden.words());
        self.answers = Some(Answers { of, hidden: words });
        self.asked.retain(|asked| asked.frame >= frame);
        Some(frame)
    }

    /// Forgets what was known, and what is under way.
    pub fn forget(&mut self) {
        self.is_cut = true;
        self.answers = None;
        self.asked.clear();
    }

    /// What is known.
    pub fn answers(&self) -> Option<&Answers> {
        self.answers.as_ref()
    }

    /// How many frames old the answers are.
    pub fn age(&self) -> Option<u32> {
        let newest = self.asked.back()?.frame;
        let answers = self.answers.as_ref()?;
        Some((newest + 1).saturating_sub(answers.of.frame) as u32)
    }

    /// The last test that was asked for.
    pub fn newest(&self) -> Option<&Asked> {
        self.asked.back()
    }

    /// Asks for a test in this frame.
    ///
    /// # Errors
    /// [`JudgeError`] for a matrix that gives no image, or a size that the device does not have.
    pub fn ask(
        &mut self,
        request: Request,
        size: UVec2,
        occludees: &mut Occludees,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        let columns = request.pose.clip_from_world.to_cols_array();
        let Margin { sides, ahead } = request.margin;
        let eye = Eye {
            cut: std::mem::take(&mut self.is_cut),
            shift: sides,
            drift: Drift {
                way: ours::Vec3::from_array(request.way.to_array()),
                pixels: ahead,
            },
            // Bevy's shaders compute in f32 from the world's origin.
            ..Eye::new(ours::Mat4::from_cols_array(&columns), ours::DVec3::ZERO)
        };
        let shared = self.judging.clone();
        let judge = &mut shared.lock().judge;
        if self.image.size != size {
            judge.resize(0, size.to_array())?;
            self.image.size = size;
        }
        let report = judge.begin(&mut occludees.instances, &[eye], encoder)?;
        self.asked.push_back(Asked {
            frame: report.frame,
            epoch: occludees.epoch,
            request,
        });
        while self.asked.len() > MOST_ASKED {
            self.asked.pop_front();
        }
        Ok(())
    }
}

impl Asked {
    /// The judge's number of the frame.
    pub fn frame(&self) -> u64 {
        self.frame
    }
}

impl Answers {
    /// What is known for a view that is seen from elsewhere now.
    pub fn verdicts(&self, pose: Pose) -> Verdicts<'_> {
        Verdicts {
            answers: self,
            eye: pose.eye,
            near: pose.near * NEAR_ROOM + self.of.request.pose.eye.distance(pose.eye),
        }
    }

    /// Whether an instance was hidden.
    pub fn contains(&self, index: u32) -> bool {
        let word = self.hidden.get(index as usize / 32);
        word.is_some_and(|word| word >> (index % 32) & 1 != 0)
    }
}

impl Verdicts<'_> {
    /// The pixels by which what was hidden was so.
    pub fn margin(&self) -> Margin {
        self.answers.of.request.margin
    }

    /// Whether something is left out. It was hidden, it is where it was tested, and the eye has not come near to it.
    pub fn hides(&self, found: &Found) -> bool {
        self.answers.contains(found.index)
            && found.since <= self.answers.of.epoch
            && found.distance(self.eye) > self.near
    }
}
