//! Handles: small, copyable names of resources, each at one version.
//! A write returns the next version, so the order of passes follows from the data, as in Filament's `FrameGraph`.

use std::fmt;
use std::marker::PhantomData;

/// The version that means "last frame's final value".
pub(crate) const PREVIOUS: u32 = u32::MAX;

/// The contents of every handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Raw {
    pub graph: u32,
    pub index: u32,
    pub version: u32,
}

impl Raw {
    pub fn is_previous(self) -> bool {
        self.version == PREVIOUS
    }

    pub fn previous(self) -> Self {
        Self {
            version: PREVIOUS,
            ..self
        }
    }

    /// The handle that a write of this one returns. `compile` refuses writes of a previous value; its version must not wrap.
    pub fn next(self) -> Self {
        Self {
            version: self.version.saturating_add(1).min(PREVIOUS - 1),
            ..self
        }
    }

    pub fn resource(self) -> usize {
        self.index as usize
    }
}

/// A texture at one version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Texture(pub(crate) Raw);

/// A buffer at one version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Buffer(pub(crate) Raw);

/// A host value of type `T` at one version.
pub struct Host<T> {
    pub(crate) raw: Raw,
    marker: PhantomData<fn() -> T>,
}

impl Texture {
    /// Last frame's final contents of the same texture. Reading it does not order passes of this frame.
    #[must_use]
    pub fn previous(self) -> Self {
        Self(self.0.previous())
    }
}

impl Buffer {
    /// Last frame's final contents of the same buffer. Reading it does not order passes of this frame.
    #[must_use]
    pub fn previous(self) -> Self {
        Self(self.0.previous())
    }
}

impl<T> Host<T> {
    pub(crate) fn from_raw(raw: Raw) -> Self {
        Self {
            raw,
            marker: PhantomData,
        }
    }

    /// Last frame's final value. Reading it does not order passes of this frame.
    #[must_use]
    pub fn previous(self) -> Self {
        Self::from_raw(self.raw.previous())
    }
}

impl<T> Clone for Host<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Host<T> {}

impl<T> PartialEq for Host<T> {
    fn eq(&self, other: &Self) -> bool {
        self.raw == other.raw
    }
}

impl<T> Eq for Host<T> {}

impl<T> fmt::Debug for Host<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Host").field(&self.raw).finish()
    }
}

/// A frame-late read-back, declared by [`HostBuilder::read_previous`](crate::HostBuilder::read_previous). The body of the same node passes
/// it to [`HostContext::late`](crate::HostContext::late) to get the newest result.
pub struct ReadBack<Tag> {
    pub(crate) graph: u32,
    pub(crate) ring: u32,
    marker: PhantomData<fn() -> Tag>,
}

impl<Tag> ReadBack<Tag> {
    pub(crate) fn new(graph: u32, ring: u32) -> Self {
        Self {
            graph,
            ring,
            marker: PhantomData,
        }
    }
}

impl<Tag> Clone for ReadBack<Tag> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Tag> Copy for ReadBack<Tag> {}

impl<Tag> fmt::Debug for ReadBack<Tag> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ReadBack")
            .field("ring", &self.ring)
            .finish()
    }
}

/// The id of a pass, for [`after`](crate::RasterBuilder::after).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PassId {
    pub(crate) graph: u32,
    pub(crate) index: u32,
}

/// Any handle: [`Texture`], [`Buffer`] or [`Host`]. Sealed.
pub trait Handle: Copy + sealed::Sealed {}

impl Handle for Texture {}
impl Handle for Buffer {}
impl<T> Handle for Host<T> {}

pub(crate) mod sealed {
    use super::{Buffer, Host, Raw, Texture};

    /// Gives this crate access to a handle's contents and keeps other crates from implementing `Handle`.
    pub trait Sealed {
        #[doc(hidden)]
        #[allow(private_interfaces, reason = "the trait cannot be named outside")]
        fn raw(&self) -> Raw;

        #[doc(hidden)]
        #[allow(private_interfaces, reason = "the trait cannot be named outside")]
        fn with_raw(raw: Raw) -> Self;
    }

    #[allow(private_interfaces, reason = "the trait cannot be named outside")]
    impl Sealed for Texture {
        fn raw(&self) -> Raw {
            self.0
        }

        fn with_raw(raw: Raw) -> Self {
            Self(raw)
        }
    }

    #[allow(private_interfaces, reason = "the trait cannot be named outside")]
    impl Sealed for Buffer {
        fn raw(&self) -> Raw {
            self.0
        }

        fn with_raw(raw: Raw) -> Self {
            Self(raw)
        }
    }

    #[allow(private_interfaces, reason = "the trait cannot be named outside")]
    impl<T> Sealed for Host<T> {
        fn raw(&self) -> Raw {
            self.raw
        }

        fn with_raw(raw: Raw) -> Self {
            Self::from_raw(raw)
        }
    }
}
