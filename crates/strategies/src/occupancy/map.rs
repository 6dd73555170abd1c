//! The map itself (Staneker, Bartz, Meissner 2003): a bit a block of pixels, in words of 64 blocks of a row.

/// A bit a block of the screen: taken or free.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct OccupancyMap {
    words: Vec<u64>,
    /// Words a row.
    row: usize,
    wide: u32,
    high: u32,
}

/// A rectangle of blocks. Its last column and row belong to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BlockRect {
    /// Leftmost column.
    pub left: u32,
    /// Uppermost row.
    pub top: u32,
    /// Rightmost column.
    pub right: u32,
    /// Lowest row.
    pub bottom: u32,
}

/// The words that hold a row of a rectangle.
struct Span {
    words: std::ops::RangeInclusive<usize>,
    /// The rectangle's bits in the first word.
    head: u64,
    /// The rectangle's bits in the last word.
    tail: u64,
}

impl BlockRect {
    /// The number of blocks in it.
    pub fn count(&self) -> u64 {
        let side = |from: u32, to: u32| (u64::from(to) + 1).saturating_sub(u64::from(from));
        side(self.left, self.right) * side(self.top, self.bottom)
    }
}

impl OccupancyMap {
    /// A free map of `wide` x `high` blocks.
    pub fn new(wide: u32, high: u32) -> Self {
        let mut map = Self::default();
        map.reset(wide, high);
        map
    }

    /// Frees all blocks and makes the map `wide` x `high` blocks large.
    pub fn reset(&mut self, wide: u32, high: u32) {
        (self.wide, self.high) = (wide, high);
        self.row = wide.div_ceil(64) as usize;
        self.words.clear();
        self.words.resize(self.row * high as usize, 0);
    }

    /// Frees all blocks.
    pub fn clear(&mut self) {
        self.words.fill(0);
    }

    /// Blocks along x and along y.
    pub fn size(&self) -> [u32; 2] {
        [self.wide, self.high]
    }

    /// Whether a block is taken. A block beyond the edge counts as taken.
    pub fn is_taken(&self, x: u32, y: u32) -> bool {
        let word = self.words.get(y as usize * self.row + x as usize / 64);
        x >= self.wide || word.is_none_or(|word| word >> (x % 64) & 1 != 0)
    }

    /// The number of taken blocks.
    pub fn taken(&self) -> u32 {
        self.words.iter().map(|word| word.count_ones()).sum()
    }

    /// Takes all blocks of a rectangle.
    pub fn take(&mut self, rect: BlockRect) {
        for y in self.rows(rect) {
            let span = self.span(rect, y);
            let Some(words) = self.words.get_mut(span.words) else {
                continue;
            };
            match words {
                [one] => *one |= span.head & span.tail,
                [head, middle @ .., tail] => {
                    *head |= span.head;
                    middle.fill(u64::MAX);
                    *tail |= span.tail;
                }
                [] => {}
            }
        }
    }

    /// Whether any block of a rectangle is free.
    pub fn has_free(&self, rect: BlockRect) -> bool {
        self.rows(rect).any(|y| {
            let span = self.span(rect, y);
            match self.words.get(span.words) {
                Some([one]) => !one & span.head & span.tail != 0,
                Some([head, middle @ .., tail]) => {
                    !head & span.head != 0
                        || !tail & span.tail != 0
                        || middle.iter().any(|word| *word != u64::MAX)
                }
                _ => false,
            }
        })
    }

    /// The rows of a rectangle that lie in the map; none where it begins beyond the edge.
    fn rows(&self, rect: BlockRect) -> std::ops::Range<u32> {
        if rect.left >= self.wide || rect.left > rect.right {
            return 0..0;
        }
        rect.top..rect.bottom.saturating_add(1).min(self.high)
    }

    /// The words under one row of a rectangle.
    fn span(&self, rect: BlockRect, y: u32) -> Span {
        let right = rect.right.min(self.wide - 1);
        let row = y as usize * self.row;
        let head = u64::MAX << (rect.left % 64);
        let tail = u64::MAX >> (63 - right % 64);
        let (first, last) = (rect.left as usize / 64, right as usize / 64);
        Span {
            words: row + first..=row + last,
            head,
            tail,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn it_says_what_a_plain_grid_would(
            wide in 1..200u32,
            high in 1..20u32,
            rects in prop::collection::vec((0..220u32, 0..220u32, 0..24u32, 0..24u32), 1..12),
        ) {
            let mut map = OccupancyMap::new(wide, high);
            let mut plain = vec![false; (wide * high) as usize];
            for (left, across, top, down) in rects {
                let rect = BlockRect { left, top, right: left + across % 130, bottom: top + down };
                let inside = |at: usize| {
                    let (x, y) = (at as u32 % wide, at as u32 / wide);
                    (rect.left..=rect.right).contains(&x) && (rect.top..=rect.bottom).contains(&y)
                };
                let free = plain.iter().enumerate().any(|(at, taken)| inside(at) && !taken);
                prop_assert_eq!(map.has_free(rect), free);
                map.take(rect);
                for (at, taken) in plain.iter_mut().enumerate() {
                    *taken |= inside(at);
                    prop_assert_eq!(map.is_taken(at as u32 % wide, at as u32 / wide), *taken);
                }
                prop_assert!(!map.has_free(rect));
                prop_assert_eq!(map.taken() as usize, plain.iter().filter(|taken| **taken).count());
            }
            map.clear();
            prop_assert_eq!(map.taken(), 0);
            prop_assert!(map.is_taken(wide, 0) && map.is_taken(0, high));
        }
    }
}
