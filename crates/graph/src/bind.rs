//! Bind groups of graph resources, cached by pass and slot.

use std::cell::RefCell;
use std::ops::Range;

use crate::handle::{Buffer, Texture};

/// One entry of a bind group: the binding's number and what is bound.
#[derive(Clone, Debug)]
pub enum Bind {
    /// A whole buffer, as declared; of an import, all of the bound buffer.
    Buffer(u32, Buffer),
    /// A range of a buffer, in bytes.
    BufferRange(u32, Buffer, Range<u64>),
    /// All mips and layers of a texture.
    Texture(u32, Texture),
    /// One mip of layer 0 of a texture.
    Mip(u32, Texture, u32),
    /// An object that is not part of the graph.
    External(u32, External),
}

impl Bind {
    /// An object that is not part of the graph.
    pub fn external(binding: u32, object: impl Into<External>) -> Self {
        Self::External(binding, object.into())
    }
}

/// A wgpu object from outside of the graph. Clones are cheap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum External {
    /// A whole buffer.
    Buffer(wgpu::Buffer),
    /// A range of a buffer, in bytes.
    BufferRange(wgpu::Buffer, Range<u64>),
    /// A texture view.
    View(wgpu::TextureView),
    /// A sampler.
    Sampler(wgpu::Sampler),
}

impl From<wgpu::Buffer> for External {
    fn from(buffer: wgpu::Buffer) -> Self {
        Self::Buffer(buffer)
    }
}

impl From<wgpu::TextureView> for External {
    fn from(view: wgpu::TextureView) -> Self {
        Self::View(view)
    }
}

impl From<wgpu::Sampler> for External {
    fn from(sampler: wgpu::Sampler) -> Self {
        Self::Sampler(sampler)
    }
}

/// A [`Bind`] resolved to its wgpu object.
#[derive(Clone, Copy)]
pub(crate) enum Bound<'a> {
    /// A buffer with offset and size in bytes.
    Buffer(&'a wgpu::Buffer, u64, u64),
    View(&'a wgpu::TextureView),
    Sampler(&'a wgpu::Sampler),
}

/// A [`Bound`] as a cached bind group holds it.
enum Kept {
    Buffer(wgpu::Buffer, u64, u64),
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Kept {
    fn new(bound: Bound<'_>) -> Self {
        match bound {
            Bound::Buffer(buffer, offset, size) => Self::Buffer(buffer.clone(), offset, size),
            Bound::View(view) => Self::View(view.clone()),
            Bound::Sampler(sampler) => Self::Sampler(sampler.clone()),
        }
    }

    fn is(&self, bound: Bound<'_>) -> bool {
        match (self, bound) {
            (Self::Buffer(a, offset, size), Bound::Buffer(b, o, s)) => {
                (*offset, *size) == (o, s) && a == b
            }
            (Self::View(a), Bound::View(b)) => a == b,
            (Self::Sampler(a), Bound::Sampler(b)) => a == b,
            _ => false,
        }
    }

    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer, offset, size) => {
                wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: *offset,
                    size: wgpu::BufferSize::new(*size),
                })
            }
            Self::View(view) => wgpu::BindingResource::TextureView(view),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

struct Entry {
    layout: wgpu::BindGroupLayout,
    kept: Vec<(u32, Kept)>,
    group: wgpu::BindGroup,
}

/// By pass: its bind groups.
pub(crate) type Caches = [RefCell<BindCache>];

/// The bind groups of one pass.
#[derive(Default)]
pub(crate) struct BindCache {
    entries: Vec<(u64, Entry)>,
}

impl BindCache {
    /// The group at `slot`, made anew if any bound object has changed. `resolve` returns the binding and the object of the n-th bind.
    pub fn group<'a, E>(
        &mut self,
        device: &wgpu::Device,
        slot: u64,
        layout: &wgpu::BindGroupLayout,
        count: usize,
        mut resolve: impl FnMut(usize) -> Result<(u32, Bound<'a>), E>,
    ) -> Result<wgpu::BindGroup, E> {
        let found = self.entries.iter().position(|(key, _)| *key == slot);
        if let Some((_, entry)) = found.and_then(|at| self.entries.get(at))
            && entry.layout == *layout
            && entry.kept.len() == count
        {
            let mut same = true;
            for (n, (binding, kept)) in entry.kept.iter().enumerate() {
                let (wanted, bound) = resolve(n)?;
                same &= *binding == wanted && kept.is(bound);
            }
            if same {
                return Ok(entry.group.clone());
            }
        }
        let kept = (0..count)
            .map(|n| resolve(n).map(|(binding, bound)| (binding, Kept::new(bound))))
            .collect::<Result<Vec<_>, E>>()?;
        let entries: Vec<_> = kept
            .iter()
            .map(|(binding, kept)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: kept.resource(),
            })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        });
        let entry = Entry {
            layout: layout.clone(),
            kept,
            group: group.clone(),
        };
        match found {
            Some(at) => self.entries[at].1 = entry,
            None => self.entries.push((slot, entry)),
        }
        Ok(group)
    }
}
