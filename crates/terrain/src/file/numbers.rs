//! Rows of numbers as little-endian bytes.

use super::problem::bad;
use crate::error::TerrainError;

/// A number in a file.
pub(super) trait Number: Copy + Default {
    /// Its size in bytes.
    const BYTES: usize;

    fn from_bytes(bytes: &[u8]) -> Option<Self>;

    fn append(self, bytes: &mut Vec<u8>);
}

macro_rules! number {
    ($($kind:ty),*) => {$(
        impl Number for $kind {
            const BYTES: usize = size_of::<$kind>();

            fn from_bytes(bytes: &[u8]) -> Option<Self> {
                bytes.try_into().ok().map(Self::from_le_bytes)
            }

            fn append(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
        }
    )*};
}

number!(f64, f32, u32);

/// Writes rows of numbers.
#[derive(Default)]
pub(super) struct Writer {
    pub(super) bytes: Vec<u8>,
}

impl Writer {
    pub(super) fn row<T: Number, const N: usize>(&mut self, row: impl IntoIterator<Item = [T; N]>) {
        for number in row.into_iter().flatten() {
            number.append(&mut self.bytes);
        }
    }
}

/// Reads rows of numbers from the bytes that have not been read yet.
pub(super) struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// Reads the next `count` items of `N` numbers. Memory is allocated only for bytes that exist.
    pub(super) fn row<T: Number, const N: usize>(
        &mut self,
        count: usize,
    ) -> Result<Vec<[T; N]>, TerrainError> {
        let each = N * T::BYTES;
        let split = count
            .checked_mul(each)
            .and_then(|bytes| self.0.split_at_checked(bytes));
        let (row, rest) = split.ok_or_else(|| bad("its bytes end before its numbers do"))?;
        self.0 = rest;
        let read = |bytes: &[u8]| {
            let mut all = [T::default(); N];
            for (number, bytes) in all.iter_mut().zip(bytes.chunks_exact(T::BYTES)) {
                *number = T::from_bytes(bytes).unwrap_or_default();
            }
            all
        };
        Ok(row.chunks_exact(each).map(read).collect())
    }
}
