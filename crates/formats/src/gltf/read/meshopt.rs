//! EXT_meshopt_compression and KHR_meshopt_compression: buffer views compressed by meshoptimizer (Arseny Kapoulkine), decoded by its own
//! decoders, which are made for untrusted bytes.

use super::document::{Document, label};
use crate::budget::Budget;
use crate::error::LoadProblem;
use gltf::json::buffer::View;
use meshopt::{
    decode_filter_color, decode_filter_exp, decode_filter_oct, decode_filter_quat,
    decode_index_buffer, decode_index_sequence, decode_vertex_buffer,
};
use serde::Deserialize;
use std::collections::HashMap;

const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// The extension's object in a buffer view.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: usize,
    mode: String,
    count: usize,
    #[serde(default)]
    filter: Option<String>,
}

/// The bytes of the views that are compressed, by their numbers.
///
/// # Errors
/// A view whose description contradicts itself or its bytes; what exceeds the budget.
pub(super) fn decode_views(
    document: &Document<'_>,
    budget: &mut Budget,
) -> Result<HashMap<usize, Vec<u8>>, LoadProblem> {
    let mut decoded = HashMap::new();
    for (index, view) in document.root.buffer_views.iter().enumerate() {
        let place = label("buffer view", index, view.name.as_deref());
        let Some(compressed) = compressed(view, &place)? else {
            continue;
        };
        let bytes = document.buffer(&place, compressed.buffer)?;
        let end = compressed.byte_offset.checked_add(compressed.byte_length);
        let part = end.and_then(|end| bytes.get(compressed.byte_offset..end));
        let part = part.ok_or_else(|| LoadProblem::Truncated {
            what: format!("the compressed bytes of {place}"),
            needed: (compressed.byte_offset as u64).saturating_add(compressed.byte_length as u64),
            available: bytes.len() as u64,
        })?;
        let size = (compressed.count as u64).saturating_mul(compressed.byte_stride as u64);
        if size < view.byte_length.0 {
            let problem = "it has fewer elements than its view has bytes";
            return Err(bad(&place, problem));
        }
        budget.enter(place.as_str());
        // As elements, and as bytes.
        budget.memory(size.saturating_mul(2))?;
        let bytes = decode(&compressed, part).map_err(|problem| bad(&place, &problem))?;
        decoded.insert(index, bytes);
    }
    Ok(decoded)
}

fn bad(place: &str, problem: &str) -> LoadProblem {
    LoadProblem::BadAccessor {
        accessor: format!("the compressed {place}"),
        problem: format!("{problem}; export the file again"),
    }
}

fn compressed(view: &View, place: &str) -> Result<Option<Compressed>, LoadProblem> {
    let others = view
        .extensions
        .as_ref()
        .map(|extensions| &extensions.others);
    let found = others.and_then(|others| NAMES.iter().find_map(|name| others.get(*name)));
    // A list would be read as the members in their order.
    let Some(found) = found.filter(|found| found.is_object()) else {
        return Ok(None);
    };
    let read = Compressed::deserialize(found).map_err(|error| bad(place, &error.to_string()))?;
    Ok(Some(read))
}

fn decode(compressed: &Compressed, bytes: &[u8]) -> Result<Vec<u8>, String> {
    let Compressed { count, filter, .. } = compressed;
    let broken = |error: meshopt::Error| error.to_string();
    let wide = |indices: Vec<u32>| indices.into_iter().flat_map(u32::to_le_bytes).collect();
    let narrow = |indices: Vec<u16>| indices.into_iter().flat_map(u16::to_le_bytes).collect();
    match (compressed.mode.as_str(), compressed.byte_stride) {
        ("TRIANGLES", _) if !count.is_multiple_of(3) => {
            Err(format!("{count} indices do not divide into triangles"))
        }
        ("TRIANGLES", 2) => decode_index_buffer(bytes, *count)
            .map(narrow)
            .map_err(broken),
        ("TRIANGLES", 4) => decode_index_buffer(bytes, *count).map(wide).map_err(broken),
        ("INDICES", 2) => decode_index_sequence(bytes, *count)
            .map(narrow)
            .map_err(broken),
        ("INDICES", 4) => decode_index_sequence(bytes, *count)
            .map(wide)
            .map_err(broken),
        ("ATTRIBUTES", stride) => {
            let mut bytes = attributes(bytes, *count, stride)?;
            unfilter(filter.as_deref().unwrap_or("NONE"), stride, &mut bytes)?;
            Ok(bytes)
        }
        (mode, stride) => Err(format!("mode {mode} with a stride of {stride} is unknown")),
    }
}

/// An element of `N` words.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct Words<const N: usize>([u32; N]);

impl<const N: usize> Default for Words<N> {
    fn default() -> Self {
        Self([0; N])
    }
}

/// Elements of a stride, which the decoder takes as a type.
fn attributes(bytes: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, String> {
    fn elements<const N: usize>(bytes: &[u8], count: usize) -> Result<Vec<u8>, String> {
        let decoded = decode_vertex_buffer::<Words<N>>(bytes, count);
        let decoded = decoded.map_err(|error| error.to_string())?;
        // The decoder writes bytes in the file's order; words of any machine give them back.
        let words = decoded.into_iter().flat_map(|element| element.0);
        Ok(words.flat_map(u32::to_ne_bytes).collect())
    }
    macro_rules! by_words {
        ($($words:literal)*) => {
            match stride / 4 {
                $($words => elements::<$words>(bytes, count),)*
                _ => Err(format!("a stride of {stride} is not from 4 to 256")),
            }
        };
    }
    if !stride.is_multiple_of(4) {
        return Err(format!("a stride of {stride} is no multiple of 4"));
    }
    by_words!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64)
}

/// Undoes the filter that was applied before compression.
fn unfilter(filter: &str, stride: usize, bytes: &mut Vec<u8>) -> Result<(), String> {
    match (filter, stride) {
        ("NONE", _) => {}
        ("OCTAHEDRAL", 4) => decode_filter_oct(bytes_as_4(bytes)),
        ("OCTAHEDRAL", 8) => in_shorts(bytes, decode_filter_oct),
        ("COLOR", 4) => decode_filter_color(bytes_as_4(bytes)),
        ("COLOR", 8) => in_shorts(bytes, decode_filter_color),
        ("QUATERNION", 8) => in_shorts(bytes, decode_filter_quat),
        ("EXPONENTIAL", _) => {
            let words = bytes.as_chunks::<4>().0.iter().copied();
            let mut words: Vec<[u32; 1]> = words.map(|word| [u32::from_le_bytes(word)]).collect();
            decode_filter_exp(&mut words);
            *bytes = words
                .into_iter()
                .flat_map(|[word]| word.to_le_bytes())
                .collect();
        }
        _ => {
            return Err(format!(
                "the filter {filter} with a stride of {stride} is unknown"
            ));
        }
    }
    Ok(())
}

fn bytes_as_4(bytes: &mut [u8]) -> &mut [[i8; 4]] {
    bytemuck::cast_slice_mut::<u8, i8>(bytes).as_chunks_mut().0
}

fn in_shorts(bytes: &mut Vec<u8>, filter: impl FnOnce(&mut [[i16; 4]])) {
    let shorts = bytes.as_chunks::<2>().0.iter().copied();
    let mut shorts: Vec<i16> = shorts.map(i16::from_le_bytes).collect();
    filter(shorts.as_chunks_mut().0);
    *bytes = shorts.into_iter().flat_map(i16::to_le_bytes).collect();
}
