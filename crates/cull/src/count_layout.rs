//! How counts of visible samples lie in a buffer.

use crate::candidates::{Queried, Query};

/// How a buffer of counts is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CountLayout {
    /// A u32 a slot.
    BySlot,
    /// A u64 a query, in the order of [`Queried::slots`]: zero, or any other value for "at least one sample".
    ByQuery,
}

impl CountLayout {
    /// Each tested slot, its query, and whether any sample was visible. Slots beyond the end of `bytes` are left out.
    pub fn answers<'a>(
        self,
        queried: &'a Queried,
        bytes: &'a [u8],
    ) -> impl Iterator<Item = (u32, Query, bool)> + 'a {
        let slots = queried.by_query();
        slots.filter_map(move |(slot, query)| {
            Some((slot, query, self.count(bytes, slot, query.number)? > 0))
        })
    }

    /// The count of a slot that the query of this number tested.
    pub(crate) fn count(self, bytes: &[u8], slot: u32, query: u32) -> Option<u32> {
        match self {
            Self::BySlot => word(bytes, slot as usize * 4),
            // Boolean by contract, although some drivers count.
            Self::ByQuery => word(bytes, query as usize * 8).map(|low| {
                let high = word(bytes, query as usize * 8 + 4).unwrap_or(0);
                u32::from(low != 0 || high != 0)
            }),
        }
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    four.try_into().ok().map(u32::from_le_bytes)
}
