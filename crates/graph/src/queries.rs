//! Occlusion queries in any number: sets of at most 4,096, created when a pass first needs them. The body runs once for each set.

use std::ops::Range;

/// The query sets of a plan.
pub(crate) struct QuerySets {
    /// By pass and chunk: a set and the number of its queries.
    sets: Vec<Vec<(u32, wgpu::QuerySet)>>,
}

/// One run of a body with queries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Chunk {
    pub number: usize,
    pub range: Range<u32>,
    pub last: bool,
}

/// Bytes of a query's result.
pub(crate) const RESULT_BYTES: u64 = wgpu::QUERY_SIZE as u64;

/// Splits `count` queries into chunks. There is always at least one chunk, since a body without queries runs once.
pub(crate) fn chunks(count: u32) -> impl Iterator<Item = Chunk> {
    let size = wgpu::QUERY_SET_MAX_QUERIES;
    let runs = count.div_ceil(size).max(1);
    (0..runs).map(move |n| Chunk {
        number: n as usize,
        range: n * size..count.min((n + 1).saturating_mul(size)),
        last: n + 1 == runs,
    })
}

impl QuerySets {
    pub fn new(passes: usize) -> Self {
        Self {
            sets: vec![Vec::new(); passes],
        }
    }

    /// The set of a chunk of a pass whose buffer holds `capacity` results.
    pub fn get(
        &mut self,
        device: &wgpu::Device,
        label: &str,
        pass: usize,
        chunk: &Chunk,
        capacity: u32,
    ) -> wgpu::QuerySet {
        let sets = &mut self.sets[pass];
        let count = capacity
            .saturating_sub(chunk.range.start)
            .clamp(1, wgpu::QUERY_SET_MAX_QUERIES);
        let made = sets.get(chunk.number).map_or(0, |(count, _)| *count);
        // A pass asks for its chunks in order, so a missing set is the next one. A set may be too small where an import has grown.
        if made < count {
            let set = device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some(label),
                ty: wgpu::QueryType::Occlusion,
                count,
            });
            sets.truncate(chunk.number);
            sets.push((count, set));
        }
        sets[chunk.number].1.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::chunks;

    #[test]
    fn chunks_cover_the_count_once_in_order() {
        for count in [0, 1, 4_095, 4_096, 4_097, 8_192, 10_000] {
            let mut next = 0;
            let all: Vec<_> = chunks(count).collect();
            for chunk in &all {
                assert_eq!(chunk.range.start, next);
                assert!(chunk.range.len() <= 4_096);
                next = chunk.range.end;
            }
            assert_eq!(next, count);
            assert_eq!(all.iter().filter(|chunk| chunk.last).count(), 1);
            assert!(all.last().is_some_and(|chunk| chunk.last));
        }
    }
}
