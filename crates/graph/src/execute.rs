//! Executes a frame: checks the bindings, records the steps, copies late read-backs, submits, and cleans up, also when a body fails.

use std::cell::RefCell;
use std::time::Duration;

use web_time::Instant;

use crate::access::Access;
use crate::error::ExecuteError;
use crate::frame::{Frame, PassView};
use crate::options::Mode;
use crate::physical::PhysicalTexture;
use crate::plan::Plan;
use crate::read_back::CopyRequest;
use crate::recorder::{Iteration, Recorder, Target};
use crate::report::{FrameReport, LateResult};
use crate::resource::Kind;
use crate::sync::Staging;

impl Plan {
    /// Runs a frame and submits it. Waits only at sync points.
    ///
    /// # Errors
    /// The plan is embedded, an import is missing, a body failed, a loop did not end, or the device was lost.
    pub fn execute(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<FrameReport, ExecuteError> {
        if self.mode != Mode::Owned {
            return Err(ExecuteError::WrongMode {
                compiled: "the encoder of a caller",
                call: "Plan::record",
            });
        }
        let encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
            label: Some(&self.name),
        });
        self.run(device, queue, Target::Own(encoder))
    }

    /// Records a frame into the caller's encoder. Never submits and never waits.
    ///
    /// # Errors
    /// The plan is owned, an import is missing, a body failed, or the device was lost. The encoder must then be dropped.
    pub fn record(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<FrameReport, ExecuteError> {
        if self.mode != Mode::Embedded {
            return Err(ExecuteError::WrongMode {
                compiled: "frames of its own",
                call: "Plan::execute",
            });
        }
        self.run(device, queue, Target::Caller(encoder))
    }

    /// Drops last frame's values: the next frame finds zero and `Default`, and `has_previous` is false. Results of earlier frames that are still on their way are dropped too: they
    /// tell of contents that are gone.
    pub fn reset_history(&mut self, device: &wgpu::Device) {
        self.has_previous = false;
        self.discard_read_backs();
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
        // Runs the callbacks of finished maps. Each read-back then checks its own status. A host's callbacks are not run inside of a recording: its own submits do that.
        if self.mode == Mode::Owned {
            let _ = device.poll(wgpu::PollType::Poll);
        }
        self.check_imports()?;
        let mut lost = false;
        let least_age = u64::from(self.least_age);
        for ring in &mut self.rings {
            lost |= match (least_age, self.frame.checked_sub(least_age)) {
                (0, _) => ring.begin_frame(None).is_err(),
                (_, Some(newest)) => ring.begin_frame(Some(newest)).is_err(),
                (_, None) => false,
            };
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
        let late = self.late_results();
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
                report.late = late;
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

    /// The results of earlier frames that were read in this one.
    fn late_results(&self) -> Vec<LateResult> {
        let decls = self.ring_decls.iter().zip(&self.ring_places);
        let read = decls.filter_map(|(decl, place)| {
            let frame = self.rings.get((*place)?)?.read_frame()?;
            Some(LateResult {
                node: self.passes.get(decl.pass)?.name.clone(),
                age: self.frame.saturating_sub(frame),
            })
        });
        read.collect()
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

    /// Releases textures, as a surface's must be before it is presented, and drops host values, so that shared ones become unique again.
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
                loop_iterations: 0,
                skipped_read_backs: 0,
                late: Vec::new(),
                cpu: Duration::ZERO,
                waited: Duration::ZERO,
            },
        };
        recorder.steps(&self.steps, Iteration::OUTSIDE)?;
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
            Target::Caller(encoder) => {
                self.belt.finish_and_recall_on_submit(encoder);
                self.timing.resolve(encoder);
                self.timing.watch(self.frame, encoder);
            }
        }
        Ok(report)
    }

    /// Copies the buffers that are read back late, after the frame's last write to them.
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
            let slot = placed.slot(self.frame);
            let Some(source) = self.physical.buffer(slot) else {
                continue;
            };
            let pass = &self.passes[decl.pass];
            let view = PassView {
                frame: &frame,
                name: &pass.name,
                uses: &pass.uses,
                index: decl.pass,
                iteration: 0,
                cache: &self.caches[decl.pass],
                fault,
            };
            let used = (pass.uses.iter())
                .position(|used| used.access == Access::Late && used.ring == Some(index as u32));
            let bytes = used.map_or(u64::MAX, |used| pass.wanted_bytes(used, view));
            let recorded = self.rings[place].record(CopyRequest {
                encoder: target.encoder(),
                source,
                bytes: bytes
                    .saturating_add(3)
                    .min(placed.bytes())
                    .min(source.size())
                    & !3,
                frame: self.frame,
                store: &self.store,
                tag_slot: self.layout.placed[decl.tag].slot(self.frame),
            });
            if !recorded {
                report.skipped_read_backs += 1;
            }
        }
        Ok(())
    }
}
