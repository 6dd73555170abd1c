//! A camera with a judge: its jumps, its budget and its audits.

use bevy::prelude::*;

use crate::audit::{Audited, Auditing};
use crate::dial::Dial;
use crate::occludees::{Kind, Occludees};
use crate::settings::{AntumbraCulling, CullingReport, Occluders};
use crate::view::{Pose, Request, Verdicts, View};

/// A camera that culls.
pub(crate) struct CameraView {
    pub view: View,
    pub occluders: Occluders,
    /// Where the camera was in the last frame, and how far it had come since the one before.
    last: Option<Place>,
    /// The distance of what was nearest to the camera in the last frame.
    nearest: f32,
    /// The settings' cuts in the last frame.
    cuts: u32,
    was_frozen: bool,
    dial: Dial,
    auditing: Auditing,
    /// Which way the camera goes, and for how many frames it has been where it is.
    way: Vec3,
    at_rest: u32,
}

#[derive(Debug, Clone, Copy)]
struct Place {
    at: Vec3,
    step: f32,
}

/// A step of the camera that is so many times longer than the one before may be a jump.
const JUMP: f32 = 4.0;
/// A camera that has stood still for so many frames is at rest.
const FRAMES_TO_REST: u32 = 8;
/// The pixels that a camera at rest needs on all sides, where its samples are not those of the depth: jitter moves the image, and tagged occluders are drawn with one sample a pixel.
const LEAST_SIDES: f32 = 1.0;

impl CameraView {
    pub fn new(view: View, settings: &AntumbraCulling) -> Self {
        Self {
            view,
            occluders: settings.occluders,
            last: None,
            nearest: f32::INFINITY,
            cuts: settings.cuts,
            was_frozen: false,
            dial: Dial::default(),
            auditing: Auditing::default(),
            way: Vec3::ZERO,
            at_rest: FRAMES_TO_REST,
        }
    }

    /// Takes over what has come back. Never waits.
    pub fn collect(
        &mut self,
        settings: &AntumbraCulling,
        occludees: &Occludees,
        report: &mut CullingReport,
    ) {
        let counted = match &mut self.view.judging.lock().counter {
            Some(counter) => counter.take(),
            None => None,
        };
        if let Some(pixels) = counted
            && let Some(margin) = self.auditing.end()
        {
            let image = self.view.image.size.as_vec2();
            let wrong = 100.0 * pixels as f32 / (image.x * image.y);
            report.wrong = Some(wrong);
            report.audits += 1;
            // Answers of other pixels say nothing about these.
            if margin == Some(self.dial.margin(settings.budget, false, 0.0)) {
                self.dial.note_wrong(settings.budget, wrong);
            }
        }
        if let Some(frame) = self.view.collect()
            && let Some(answers) = self.view.answers()
        {
            self.auditing.note_answers(frame, |entity| {
                let found = occludees.find(Kind::Mesh, entity);
                found.is_none_or(|found| answers.contains(found.index))
            });
        }
    }

    /// Forgets what was known if the camera has jumped, or was frozen in the frame before: because its owner says so, or because it has come farther than to what was nearest to it, and much farther
    /// than in the frame before.
    pub fn follow(&mut self, settings: &AntumbraCulling, eye: Vec3) {
        let was_frozen = std::mem::replace(&mut self.was_frozen, settings.frozen);
        if settings.frozen {
            return;
        }
        let moved = self.last.map_or(Vec3::ZERO, |last| eye - last.at);
        if moved != Vec3::ZERO {
            self.way = moved;
        }
        let step = moved.length();
        let before = self.last.map_or(0.0, |last| last.step);
        let has_jumped = step > self.nearest && step > before * JUMP;
        let is_cut = std::mem::replace(&mut self.cuts, settings.cuts) != settings.cuts;
        if was_frozen || is_cut || has_jumped {
            self.view.forget();
        }
        self.last = Some(Place { at: eye, step });
    }

    /// Notes how near to the camera something is that is drawn.
    pub fn note_nearest(&mut self, nearest: f32) {
        self.nearest = nearest;
    }

    /// What is known for the camera as it is now. Nothing where the budget cannot be kept.
    pub fn verdicts(&self, settings: &AntumbraCulling, pose: Pose) -> Option<Verdicts<'_>> {
        let answers = self.view.answers()?;
        let then = answers.of.request.pose;
        if settings.frozen {
            // What was hidden from where it was frozen stays so wherever the camera is taken.
            return Some(answers.verdicts(then));
        }
        let has_moved = then.clip_from_world != pose.clip_from_world;
        if has_moved && self.dial.is_past_its_end(settings.budget) {
            return None;
        }
        Some(answers.verdicts(pose))
    }

    /// What the test of this frame is asked with.
    pub fn request(
        &mut self,
        settings: &AntumbraCulling,
        pose: Pose,
        is_jittered: bool,
    ) -> Request {
        let before = self.view.newest().map(|asked| asked.request.pose);
        match before.is_some_and(|before| before.clip_from_world != pose.clip_from_world) {
            true => self.at_rest = 0,
            false => self.at_rest = self.at_rest.saturating_add(1),
        }
        let is_at_rest = self.at_rest >= FRAMES_TO_REST;
        let is_sampled_elsewhere = is_jittered || settings.occluders == Occluders::Tagged;
        let least = if is_sampled_elsewhere {
            LEAST_SIDES
        } else {
            0.0
        };
        Request {
            pose,
            margin: self.dial.margin(settings.budget, is_at_rest, least),
            way: self.way,
            is_moving: !is_at_rest,
            occluders: 0,
        }
    }

    /// Whether the depth of the frame that was asked about last is to be copied, for it is audited.
    pub fn begin_audit(&mut self, settings: &AntumbraCulling, culled: &[Entity]) -> bool {
        if !self.auditing.is_due(settings.audit) {
            return false;
        }
        let Some(asked) = self.view.newest() else {
            return false;
        };
        if culled.is_empty() {
            if asked.request.is_moving && self.dial.is_past_its_end(settings.budget) {
                self.auditing.pass();
                self.dial.note_wrong(settings.budget, 0.0);
            }
            return false;
        }
        // Wrong pixels in motion are those of the answers that were asked for in motion.
        let pose = asked.request.pose;
        let used = self.view.answers().map(|answers| answers.of.request);
        let used =
            used.filter(|used| used.is_moving && used.pose.clip_from_world != pose.clip_from_world);
        self.auditing.begin(Audited {
            frame: asked.frame(),
            clip_from_world: pose.clip_from_world,
            margin: used.map(|used| used.margin),
            culled: culled.to_vec(),
        });
        true
    }

    /// What an audit has found not to be hidden, to be counted.
    pub fn take_suspects(&mut self) -> Option<Audited> {
        self.auditing.take_suspects()
    }
}
