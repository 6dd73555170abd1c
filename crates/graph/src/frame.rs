//! A frame while it is recorded, and the part of it that one pass may see: the resources that the pass declared.

use std::cell::{Ref, RefCell, RefMut};

use crate::access::{Access, Use};
use crate::bind::{BindCache, Bound, External};
use crate::error::AccessError;
use crate::handle::{Host, Raw};
use crate::physical::{Physical, PhysicalTexture, Placed};
use crate::read_back::{AnyRing, Late, ReadBackRing, RingDecl};
use crate::resource::Kind;
use crate::store::{Store, StoreError};
use crate::{Bind, Buffer, ReadBack, Texture};

/// A borrowed host value.
pub type HostRef<'a, T> = Ref<'a, T>;
/// A host value borrowed for writing.
pub type HostMut<'a, T> = RefMut<'a, T>;

/// One frame while it is recorded.
#[derive(Clone, Copy)]
pub(crate) struct Frame<'a> {
    pub graph: u32,
    pub device: &'a wgpu::Device,
    pub queue: &'a wgpu::Queue,
    pub number: u64,
    pub has_previous: bool,
    pub resources: &'a [Placed],
    pub physical: &'a Physical,
    pub store: &'a Store,
    pub rings: &'a [Box<dyn AnyRing>],
    pub ring_places: &'a [Option<usize>],
    pub ring_decls: &'a [RingDecl],
}

impl<'a> Frame<'a> {
    /// The object of a resource's value of this frame, or of last frame's for a previous handle.
    pub fn slot(&self, raw: Raw) -> u32 {
        let placed = &self.resources[raw.resource()];
        match raw.is_previous() {
            true => placed.previous_slot(self.number),
            false => placed.slot(self.number),
        }
    }

    pub fn buffer(&self, raw: Raw) -> Option<&'a wgpu::Buffer> {
        self.physical.buffer(self.slot(raw))
    }

    pub fn texture(&self, raw: Raw) -> Option<&'a PhysicalTexture> {
        self.physical.texture(self.slot(raw))
    }

    /// Bytes of a buffer: as declared, or for an import all of the bound buffer.
    pub fn buffer_size(&self, raw: Raw) -> u64 {
        let placed = &self.resources[raw.resource()];
        match placed.resource.kind {
            Kind::Buffer(desc) if !placed.resource.import => desc.rounded(),
            _ => self.buffer(raw).map_or(0, |buffer| buffer.size() & !3),
        }
    }
}

/// The frame as one pass may see it.
#[derive(Clone, Copy)]
pub(crate) struct PassView<'a> {
    pub frame: &'a Frame<'a>,
    /// The pass's name.
    pub name: &'a str,
    /// What the pass declared.
    pub uses: &'a [Use],
    /// The pass's index.
    pub index: usize,
    /// The iteration of the innermost host loop.
    pub iteration: u32,
    pub cache: &'a RefCell<BindCache>,
    /// A misuse by a call that returns no error; it fails the frame after the body.
    pub fault: &'a RefCell<Option<AccessError>>,
}

/// Reads the host values that a node declares, for functions that the executor calls before the node's body.
pub struct HostReader<'a> {
    pub(crate) view: PassView<'a>,
}

impl<'a> HostReader<'a> {
    /// A declared host value.
    ///
    /// # Errors
    /// It was not declared by the node, or holds nothing.
    pub fn get<T: 'static>(&self, value: Host<T>) -> Result<HostRef<'a, T>, AccessError> {
        self.view.get(value)
    }

    /// The frame's number, from 0.
    #[must_use]
    pub fn frame(&self) -> u64 {
        self.view.frame.number
    }
}

impl<'a> PassView<'a> {
    /// Checks that the pass declared a use of the resource for which `allows` is true. `verb` is what the body tried, for the error.
    pub fn check(
        &self,
        raw: Raw,
        verb: &'static str,
        allows: impl Fn(Access) -> bool,
    ) -> Result<(), AccessError> {
        if raw.graph != self.frame.graph {
            return Err(AccessError::Foreign {
                pass: self.name.to_owned(),
            });
        }
        let declared = self.uses.iter().any(|used| {
            used.raw.index == raw.index
                && used.raw.is_previous() == raw.is_previous()
                && allows(used.access)
        });
        if declared {
            Ok(())
        } else {
            Err(AccessError::Undeclared {
                pass: self.name.to_owned(),
                resource: self.resource_name(raw),
                verb,
            })
        }
    }

    pub fn get<T: 'static>(&self, value: Host<T>) -> Result<Ref<'a, T>, AccessError> {
        self.check(value.raw, "reads", |access| !access.is_late())?;
        let frame = self.frame;
        frame
            .store
            .get(frame.slot(value.raw))
            .map_err(|error| self.store_error(value.raw, &error))
    }

    pub fn get_mut<T: 'static>(&self, value: Host<T>) -> Result<RefMut<'a, T>, AccessError> {
        self.check(value.raw, "writes", Access::writes)?;
        let frame = self.frame;
        frame
            .store
            .get_mut(frame.slot(value.raw))
            .map_err(|error| self.store_error(value.raw, &error))
    }

    pub fn buffer(&self, buffer: Buffer) -> Result<&'a wgpu::Buffer, AccessError> {
        self.check(buffer.0, "uses", |access| !access.is_late())?;
        self.frame
            .buffer(buffer.0)
            .ok_or_else(|| self.empty(buffer.0))
    }

    pub fn size(&self, buffer: Buffer) -> Result<u64, AccessError> {
        self.check(buffer.0, "uses", |_| true)?;
        Ok(self.frame.buffer_size(buffer.0))
    }

    pub fn upload_target(&self, buffer: Buffer) -> Result<(&'a wgpu::Buffer, u64), AccessError> {
        self.check(buffer.0, "uploads to", |access| {
            matches!(access, Access::Upload | Access::UploadUpdate)
        })?;
        let target = self
            .frame
            .buffer(buffer.0)
            .ok_or_else(|| self.empty(buffer.0))?;
        Ok((target, self.frame.buffer_size(buffer.0)))
    }

    pub fn texture(&self, texture: Texture) -> Result<&'a wgpu::Texture, AccessError> {
        Ok(&self.physical_texture(texture)?.texture)
    }

    pub fn sample_view(&self, texture: Texture) -> Result<&'a wgpu::TextureView, AccessError> {
        Ok(&self.physical_texture(texture)?.sampled)
    }

    pub fn mip_view(
        &self,
        texture: Texture,
        mip: u32,
        layer: u32,
    ) -> Result<&'a wgpu::TextureView, AccessError> {
        let physical = self.physical_texture(texture)?;
        physical
            .sampled_part(mip, layer)
            .ok_or_else(|| AccessError::Mip {
                pass: self.name.to_owned(),
                resource: self.resource_name(texture.0),
                mip,
                mips: physical.desc.mips,
            })
    }

    pub fn bind_group(
        &self,
        slot: u32,
        layout: &wgpu::BindGroupLayout,
        binds: &[Bind],
    ) -> Result<wgpu::BindGroup, AccessError> {
        // Histories alternate between two objects. One entry for each parity of the frame keeps both bind groups.
        let key = u64::from(slot) * 2 + self.frame.number % 2;
        let mut cache = self.cache.borrow_mut();
        cache.group(self.frame.device, key, layout, binds.len(), |n| {
            self.resolve(&binds[n])
        })
    }

    pub fn late<Tag: Clone + Send + 'static>(
        &self,
        read_back: ReadBack<Tag>,
    ) -> Option<Late<'a, Tag>> {
        let ring = read_back.ring as usize;
        let frame = self.frame;
        if read_back.graph != frame.graph {
            self.fault.replace(Some(AccessError::Foreign {
                pass: self.name.to_owned(),
            }));
            return None;
        }
        if frame.ring_decls.get(ring).map(|decl| decl.pass) != Some(self.index) {
            self.fault.replace(Some(AccessError::Undeclared {
                pass: self.name.to_owned(),
                resource: format!("read-back {ring}"),
                verb: "asks for",
            }));
            return None;
        }
        let place = frame.ring_places.get(ring).copied().flatten()?;
        frame
            .rings
            .get(place)?
            .as_any()
            .downcast_ref::<ReadBackRing<Tag>>()?
            .offered()
    }

    pub fn range_error(&self, buffer: Buffer, offset: u64, end: u64, size: u64) -> AccessError {
        AccessError::Range {
            pass: self.name.to_owned(),
            resource: self.resource_name(buffer.0),
            offset,
            end,
            size,
        }
    }

    fn resolve<'b>(&self, bind: &'b Bind) -> Result<(u32, Bound<'b>), AccessError>
    where
        'a: 'b,
    {
        Ok(match bind {
            Bind::Buffer(binding, buffer) => {
                let bound = self.buffer(*buffer)?;
                let size = self.frame.buffer_size(buffer.0);
                (*binding, Bound::Buffer(bound, 0, size))
            }
            Bind::BufferRange(binding, buffer, range) => {
                let bound = self.buffer(*buffer)?;
                let size = self.frame.buffer_size(buffer.0);
                if range.start >= range.end || range.end > size {
                    return Err(self.range_error(*buffer, range.start, range.end, size));
                }
                (
                    *binding,
                    Bound::Buffer(bound, range.start, range.end - range.start),
                )
            }
            Bind::Texture(binding, texture) => (*binding, Bound::View(self.sample_view(*texture)?)),
            Bind::Mip(binding, texture, mip) => {
                (*binding, Bound::View(self.mip_view(*texture, *mip, 0)?))
            }
            Bind::External(binding, external) => (
                *binding,
                match external {
                    External::Buffer(buffer) => Bound::Buffer(buffer, 0, buffer.size()),
                    External::BufferRange(buffer, range) => {
                        Bound::Buffer(buffer, range.start, range.end.saturating_sub(range.start))
                    }
                    External::View(view) => Bound::View(view),
                    External::Sampler(sampler) => Bound::Sampler(sampler),
                },
            ),
        })
    }

    fn physical_texture(&self, texture: Texture) -> Result<&'a PhysicalTexture, AccessError> {
        self.check(texture.0, "uses", |_| true)?;
        self.frame
            .texture(texture.0)
            .ok_or_else(|| self.empty(texture.0))
    }

    fn resource_name(&self, raw: Raw) -> String {
        self.frame
            .resources
            .get(raw.resource())
            .map_or_else(String::new, |placed| placed.resource.name.clone())
    }

    fn empty(&self, raw: Raw) -> AccessError {
        AccessError::Empty {
            pass: self.name.to_owned(),
            resource: self.resource_name(raw),
        }
    }

    fn store_error(&self, raw: Raw, error: &StoreError) -> AccessError {
        match error {
            StoreError::Empty => self.empty(raw),
            StoreError::Borrowed => AccessError::Borrowed {
                pass: self.name.to_owned(),
                resource: self.resource_name(raw),
            },
        }
    }
}
