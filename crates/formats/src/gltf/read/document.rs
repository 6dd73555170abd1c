//! A glTF with its buffers. A lookup of a missing index gives an error that names the place of the reference.

use super::container::Json;
use crate::budget::Budget;
use crate::error::{LoadProblem, shorten};
use crate::file_resolver::FileResolver;
use gltf::json::extras::RawValue;
use gltf::json::{Index, Root};
use std::borrow::Cow;
use std::collections::HashMap;

/// The JSON and the buffers it refers to.
pub(super) struct Document<'a> {
    pub(super) root: Root,
    /// The text of each node.
    pub(super) nodes: Vec<&'a RawValue>,
    buffers: Vec<Option<Cow<'a, [u8]>>>,
    /// The bytes of views that are compressed, by their numbers.
    decoded: HashMap<usize, Vec<u8>>,
}

/// The bytes of a buffer view.
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    /// Bytes from an element to the next, if the view has a stride.
    pub(super) stride: Option<usize>,
}

impl<'a> Document<'a> {
    /// Reads every buffer and checks its length.
    pub(super) fn open(
        json: Json<'a>,
        binary: Option<&'a [u8]>,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let Json { root, nodes } = json;
        let mut buffers = Vec::new();
        for (i, buffer) in root.buffers.iter().enumerate() {
            let place = label("buffer", i, buffer.name.as_deref());
            budget.enter(place.as_str());
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
            decoded: HashMap::new(),
        })
    }

    /// Takes the bytes of views that are compressed.
    #[cfg(feature = "meshopt")]
    pub(super) fn with_decoded(self, decoded: HashMap<usize, Vec<u8>>) -> Self {
        Self { decoded, ..self }
    }

    /// The bytes of a buffer; none for a fallback of compressed views.
    #[cfg(feature = "meshopt")]
    pub(super) fn buffer(&self, place: &str, index: usize) -> Result<&[u8], LoadProblem> {
        let buffer = item(&self.buffers, index, "buffer", place)?;
        Ok(buffer.as_deref().unwrap_or_default())
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, place: &str, index: usize) -> Result<View<'_>, LoadProblem> {
        let view = item(&self.root.buffer_views, index, "buffer view", place)?;
        let stride = view.byte_stride.map(|stride| stride.0);
        if let Some(bytes) = self.decoded.get(&index) {
            return Ok(View { bytes, stride });
        }
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
        Ok(View {
            bytes: view_bytes,
            stride,
        })
    }

    /// The name of a node for messages.
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
        Some(name) if !name.is_empty() => format!("{kind} {index} \"{}\"", shorten(name)),
        _ => format!("{kind} {index}"),
    }
}

/// A reference as a plain index.
pub(super) fn at<T>(index: Option<&Index<T>>) -> Option<usize> {
    index.map(Index::value)
}
