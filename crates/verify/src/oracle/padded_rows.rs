//! The buffer that an id texture is copied into: wgpu pads each row to a multiple of 256 bytes.

/// The layout of an image in such a buffer.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaddedRows {
    size: [u32; 2],
    row_bytes: u32,
}

impl PaddedRows {
    /// The layout of an image of `size` pixels (width, height) with so many bytes each.
    pub fn new(size: [u32; 2], texel_bytes: usize) -> Self {
        let row_bytes = size[0].saturating_mul(texel_bytes as u32);
        let align = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;
        Self {
            size,
            row_bytes: row_bytes
                .checked_next_multiple_of(align)
                .unwrap_or(u32::MAX - u32::MAX % align),
        }
    }

    /// Size of the buffer in bytes.
    pub fn bytes(self) -> u64 {
        u64::from(self.row_bytes) * u64::from(self.size[1])
    }

    pub fn layout(self) -> wgpu::TexelCopyBufferLayout {
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(self.row_bytes),
            rows_per_image: None,
        }
    }

    pub fn extent(self) -> wgpu::Extent3d {
        wgpu::Extent3d {
            width: self.size[0],
            height: self.size[1],
            depth_or_array_layers: 1,
        }
    }

    /// The texels in the buffer's bytes, row by row, without the padding. `N`: the bytes of each.
    pub fn texels<const N: usize>(self, bytes: &[u8]) -> impl Iterator<Item = &[u8; N]> {
        let rows = bytes.chunks(self.row_bytes.max(1) as usize);
        rows.flat_map(move |row| row.as_chunks::<N>().0.iter().take(self.size[0] as usize))
    }
}
