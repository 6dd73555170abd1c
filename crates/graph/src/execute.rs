//! A frame: checks what is bound, walks the steps, reads back late, submits, and tidies up, also when a body fails.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use crate::access::Access;
use crate::bind::BindCache;
use crate::compile::Mode;
use crate::error::ExecuteError;
use crate::frame::{Frame, PassView};
use crate::host::HostReader;
use crate::physical::PhysicalTexture;
use crate::plan::Plan;
use crate::read_back::Shot;
use crate::recorder::{Recorder, Target};
use crate::resource::Kind;
use crate::sync::Staging;

/// What a frame came to.
#[derive(Clone, Debug)]
pub struct FrameReport {
    /// Its number.
    pub frame: u64,
    /// Its last submission; `None` in an embedded plan.
    pub submission: Option<wgpu::SubmissionIndex>,
    /// Sync points taken, those of loop turns included.
    pub sync_points: u32,
    /// Turns taken by all host loops.
    pub loop_turns: u32,
    /// Frame-late read-backs that found no free slot.
    pub skipped_read_backs: u32,
    /// Host time of the frame, waiting included.
    pub cpu: Duration,
    /// Of that, time spent waiting at sync points.
    pub waited: Duration,
}

impl Plan {
    /// Runs a frame and submits it; waits only at sync points.
    ///
    /// # Errors
    /// The plan is an embedded one, an import is missing, a body failed, a loop did not end, or the device is gone.
    pub fn execute(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<FrameReport, ExecuteError> {
        if self.mode != Mode::Owned {
            return Err(ExecuteError::WrongMode {
                compiled: "somebody else's frame",
                call: "Plan::record",
            });
        }
        let encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
            label: Some(&self.name),
        });
        self.run(device, queue, Target::Own(encoder))
    }

    /// Records a frame into somebody else's encoder; never submits, never waits.
    ///
    /// # Errors
    /// The plan is an owned one, an import is missing, a body failed, or the device is gone. The encoder must then be dropped.
    pub fn record(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<FrameReport, ExecuteError> {
        if self.mode != Mode::Embedded {
            return Err(ExecuteError::WrongMode {
                compiled: "a frame of its own",
                call: "Plan::execute",
            });
        }
        self.run(device, queue, Target::Foreign(encoder))
    }

    /// Forgets last frame's values: the next frame finds zero and `Default`, and `has_previous` is false.
    pub fn reset_history(&mut self, device: &wgpu::Device) {
        self.has_previous = false;
        for placed in &self.layout.placed {
            if !placed.history {
                continue;
            }
            for slot in placed.slots {
                let place = slot as usize;
                match placed.resource.kind {
                    Kind::Texture(_) => {
                        if let Some(Some(plan)) = self.layout.textures.get(place) {
                            self.physical.textures[place] = Some(PhysicalTexture::create(
                                device,
                                &plan.label,
                                plan.desc,
                                plan.usages,
                            ));
                        }
                    }
                    Kind::Buffer(_) => {
                        if let Some(Some(plan)) = self.layout.buffers.get(place) {
                            self.physical.buffers[place] = Some(plan.create(device));
                        }
                    }
                    Kind::Host(_) => self.store.reset(slot),
                }
            }
        }
    }

    fn run(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        target: Target<'_>,
    ) -> Result<FrameReport, ExecuteError> {
        let started = Instant::now();
        // Delivers what has arrived; whether anything has is asked of each read-back itself.
        let _ = device.poll(wgpu::PollType::Poll);
        self.check_imports()?;
        let mut lost = false;
        for ring in &mut self.rings {
            lost |= ring.begin_frame().is_err();
        }
        if lost {
            return Err(ExecuteError::DeviceLost {
                what: String::from("reading back an earlier frame"),
            });
        }
        self.timing.begin_frame(device, queue, self.passes.len());
        self.store.begin_frame();
        let result = self.frame_commands(device, queue, target);
        self.store.end_frame();
        for ring in &mut self.rings {
            ring.end_frame();
        }
        self.staging.iter_mut().for_each(Staging::close);
        self.release_imports();
        match result {
            Ok(mut report) => {
                self.timing.end_frame(self.frame, self.mode);
                self.frame += 1;
                self.has_previous = true;
                report.cpu = started.elapsed();
                Ok(report)
            }
            Err(error) => {
                self.timing.abandon();
                self.belt.finish();
                self.belt.recall();
                self.reset_history(device);
                Err(error)
            }
        }
    }

    fn check_imports(&self) -> Result<(), ExecuteError> {
        for placed in &self.layout.placed {
            if !placed.resource.import || !placed.used {
                continue;
            }
            let slot = placed.slots[0];
            let resource = || placed.resource.name.clone();
            match placed.resource.kind {
                Kind::Texture(_) if self.physical.texture(slot).is_none() => {
                    return Err(ExecuteError::Unbound {
                        resource: resource(),
                    });
                }
                Kind::Buffer(_) if self.physical.buffer(slot).is_none() => {
                    return Err(ExecuteError::Unbound {
                        resource: resource(),
                    });
                }
                Kind::Host(_) if !self.store.is_set(slot) => {
                    return Err(ExecuteError::Unset {
                        resource: resource(),
                    });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Textures go back (a surface's must, before it is presented), host values are dropped so that shared ones become unique again.
    fn release_imports(&mut self) {
        for placed in &self.layout.placed {
            if !placed.resource.import {
                continue;
            }
            let slot = placed.slots[0];
            match placed.resource.kind {
                Kind::Texture(_) => {
                    if let Some(texture) = self.physical.textures.get_mut(slot as usize) {
                        *texture = None;
                    }
                }
                Kind::Host(_) => self.store.empty(slot),
                Kind::Buffer(_) => {}
            }
        }
    }

    fn frame_commands(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        target: Target<'_>,
    ) -> Result<FrameReport, ExecuteError> {
        let fault = RefCell::new(None);
        let frame = Frame {
            graph: self.graph,
            device,
            queue,
            number: self.frame,
            has_previous: self.has_previous,
            resources: &self.layout.placed,
            physical: &self.physical,
            store: &self.store,
            rings: &self.rings,
            ring_places: &self.ring_places,
            ring_decls: &self.ring_decls,
        };
        let mut recorder = Recorder {
            frame: &frame,
            passes: &self.passes,
            prepared: &self.prepared,
            caches: &self.caches,
            bodies: &mut self.bodies,
            staging: &mut self.staging,
            query_sets: &mut self.query_sets,
            belt: &mut self.belt,
            timing: &mut self.timing,
            target,
            read_only_depth: self.read_only_depth,
            fault: &fault,
            report: FrameReport {
                frame: self.frame,
                submission: None,
                sync_points: 0,
                loop_turns: 0,
                skipped_read_backs: 0,
                cpu: Duration::ZERO,
                waited: Duration::ZERO,
            },
        };
        recorder.steps(&self.steps, true, 0)?;
        let Recorder {
            mut target,
            mut report,
            ..
        } = recorder;

        self.read_back_late(device, queue, &fault, &mut target, &mut report)?;
        match target {
            Target::Own(mut encoder) => {
                self.belt.finish_and_recall_on_submit(&encoder);
                self.timing.resolve(&mut encoder);
                report.submission = Some(queue.submit([encoder.finish()]));
            }
            Target::Foreign(encoder) => {
                self.belt.finish_and_recall_on_submit(encoder);
                self.timing.resolve(encoder);
                self.timing.watch(self.frame, encoder);
            }
        }
        Ok(report)
    }

    /// Copies what is read back late, once nothing will write it any more this frame.
    fn read_back_late(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        fault: &RefCell<Option<crate::AccessError>>,
        target: &mut Target<'_>,
        report: &mut FrameReport,
    ) -> Result<(), ExecuteError> {
        let frame = Frame {
            graph: self.graph,
            device,
            queue,
            number: self.frame,
            has_previous: self.has_previous,
            resources: &self.layout.placed,
            physical: &self.physical,
            store: &self.store,
            rings: &[],
            ring_places: &[],
            ring_decls: &[],
        };
        for (index, decl) in self.ring_decls.iter().enumerate() {
            let Some(place) = self.ring_places[index] else {
                continue;
            };
            let placed = &self.layout.placed[decl.buffer];
            let slot = placed.slot(self.frame, false);
            let Some(source) = self.physical.buffer(slot) else {
                continue;
            };
            let view = PassView {
                frame: &frame,
                pass: &self.passes[decl.pass],
                index: decl.pass,
                turn: 0,
                cache: &self.caches[decl.pass],
                fault,
            };
            let limit = view
                .pass
                .uses
                .iter()
                .find(|used| used.access == Access::Late && used.ring == Some(index as u32))
                .and_then(|used| used.bytes.as_ref());
            let bytes = limit.map_or(u64::MAX, |limit| limit(&HostReader { view }));
            let taken = self.rings[place].record(Shot {
                encoder: target.encoder(),
                source,
                bytes: bytes
                    .saturating_add(3)
                    .min(placed.bytes())
                    .min(source.size())
                    & !3,
                frame: self.frame,
                store: &self.store,
                tag_slot: self.layout.placed[decl.tag].slot(self.frame, false),
            });
            if !taken {
                report.skipped_read_backs += 1;
            }
        }
        Ok(())
    }
}

/// By pass: the caches of its bind groups.
pub(crate) type Caches = [RefCell<BindCache>];
