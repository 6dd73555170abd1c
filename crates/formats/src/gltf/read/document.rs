//! A glTF with its buffers, and look-ups that answer a missing index with an error that says who asked.

use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::files::Files;
use gltf::json::extras::RawValue;
use gltf::json::{Index, Root};
use std::borrow::Cow;

/// The JSON and the bytes it refers to.
pub(super) struct Document<'a> {
    pub(super) root: Root,
    /// The root's nodes as the file has them.
    pub(super) nodes: Vec<&'a RawValue>,
    buffers: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Document<'a> {
    /// Fetches every buffer and checks that it is as long as it says.
    pub(super) fn open(
        (root, nodes): (Root, Vec<&'a RawValue>),
        binary: Option<&'a [u8]>,
        files: &Files<'_>,
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let mut buffers = Vec::new();
        for (i, buffer) in root.buffers.iter().enumerate() {
            let place = label("buffer", i, buffer.name.as_deref());
            let bytes = match &buffer.uri {
                Some(uri) => Some(Cow::Owned(files.fetch(&place, uri, budget)?)),
                // Only the first buffer may be the binary chunk.
                None => binary.filter(|_| i == 0).map(Cow::Borrowed),
            };
            let needed = buffer.byte_length.0;
            if let Some(bytes) = &bytes
                && needed > bytes.len() as u64
            {
                return Err(LoadProblem::Truncated {
                    what: place,
                    needed,
                    available: bytes.len() as u64,
                });
            }
            buffers.push(bytes);
        }
        Ok(Self {
            root,
            nodes,
            buffers,
        })
    }

    /// The bytes of a buffer view, and its stride if it has one.
    pub(super) fn view(
        &self,
        place: &str,
        index: usize,
    ) -> Result<(&[u8], Option<usize>), LoadProblem> {
        let view = item(&self.root.buffer_views, index, "buffer view", place)?;
        let at = view.buffer.value();
        let buffer = item(&self.buffers, at, "buffer", place)?;
        let bytes = buffer.as_deref().ok_or_else(|| LoadProblem::MissingData {
            place: format!("buffer {at}"),
            problem:
                "it has no uri, and the file has no binary chunk for it; export the file again"
                    .into(),
        })?;
        let start = view.byte_offset.unwrap_or_default().0;
        let needed = start.saturating_add(view.byte_length.0);
        let range = usize::try_from(start)
            .ok()
            .zip(usize::try_from(needed).ok());
        let view_bytes = range.and_then(|(start, end)| bytes.get(start..end));
        let view_bytes = view_bytes.ok_or_else(|| LoadProblem::Truncated {
            what: format!("buffer view {index} in buffer {at}"),
            needed,
            available: bytes.len() as u64,
        })?;
        Ok((view_bytes, view.byte_stride.map(|stride| stride.0)))
    }

    /// A node for messages.
    pub(super) fn node_label(&self, index: usize) -> String {
        let node = self.root.nodes.get(index);
        label("node", index, node.and_then(|node| node.name.as_deref()))
    }
}

/// An element of one of the file's arrays.
pub(super) fn item<'s, T>(
    all: &'s [T],
    index: usize,
    what: &'static str,
    place: &str,
) -> Result<&'s T, LoadProblem> {
    all.get(index).ok_or_else(|| LoadProblem::MissingReference {
        place: place.to_owned(),
        what,
        index: index as u64,
        count: all.len(),
    })
}

/// A kind, an index and a name, for messages.
pub(super) fn label(kind: &str, index: usize, name: Option<&str>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} {index} \"{name}\""),
        _ => format!("{kind} {index}"),
    }
}

/// A reference as a plain index.
pub(super) fn at<T>(index: Option<&Index<T>>) -> Option<usize> {
    index.map(Index::value)
}
