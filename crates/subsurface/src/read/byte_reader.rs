//! A reader of numbers from bytes that may end early.

/// A position in a file's bytes. Every error names the end of the file and the value that should be there.
pub(super) struct ByteReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> ByteReader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let taken = taken.ok_or_else(|| {
            format!(
                "{what} of {count} bytes begins at byte {}, but the file ends at byte {}",
                self.at,
                self.bytes.len()
            )
        })?;
        self.at += count;
        Ok(taken)
    }

    /// The bytes up to a zero byte, which is skipped.
    pub(super) fn until_zero(&mut self, what: &str) -> Result<&'a [u8], String> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let length = rest.iter().position(|&byte| byte == 0).ok_or_else(|| {
            format!(
                "{what} begins at byte {}, but the file ends before its zero byte",
                self.at
            )
        })?;
        self.at += length + 1;
        Ok(rest.get(..length).unwrap_or_default())
    }

    pub(super) fn i32_big(&mut self, what: &str) -> Result<i32, String> {
        let taken = self.take(4, what)?;
        Ok(i32::from_be_bytes(taken.try_into().unwrap_or_default()))
    }

    pub(super) fn f32_big(&mut self, what: &str) -> Result<f32, String> {
        let taken = self.take(4, what)?;
        Ok(f32::from_be_bytes(taken.try_into().unwrap_or_default()))
    }
}
