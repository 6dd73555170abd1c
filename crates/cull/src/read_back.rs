//! Reads buffers and textures back to the host and waits for them: for oracles, images and tests, never within a frame.

use crate::device::{DeviceError, Gpu};

/// All bytes of a buffer, which must be a copy source.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile.
pub fn buffer(gpu: &Gpu, source: &wgpu::Buffer) -> Result<Vec<u8>, DeviceError> {
    let staging = staging(gpu, source.size());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(source, 0, &staging, 0, source.size());
    gpu.queue.submit([encoder.finish()]);
    mapped(gpu, &staging)
}

/// The texels of a texture's first mip and layer, row after row without padding. The texture must be a copy source, and its format must not
/// be a block format.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile.
pub fn texture(gpu: &Gpu, source: &wgpu::Texture) -> Result<Vec<u8>, DeviceError> {
    let texel = source.format().block_copy_size(None).unwrap_or(4);
    let row = source.width() * texel;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let staging = staging(gpu, u64::from(padded) * u64::from(source.height()));
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_texture_to_buffer(
        source.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded),
                rows_per_image: None,
            },
        },
        wgpu::Extent3d {
            width: source.width(),
            height: source.height(),
            depth_or_array_layers: 1,
        },
    );
    gpu.queue.submit([encoder.finish()]);
    let bytes = mapped(gpu, &staging)?;
    Ok(bytes
        .chunks(padded as usize)
        .flat_map(|line| line.get(..row as usize).unwrap_or_default())
        .copied()
        .collect())
}

fn staging(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("staging"),
        size,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}

/// The bytes of a buffer that is mapped for reading, once all submitted work is done.
pub(crate) fn mapped(gpu: &Gpu, staging: &wgpu::Buffer) -> Result<Vec<u8>, DeviceError> {
    staging.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait()?;
    let bytes = staging
        .slice(..)
        .get_mapped_range()
        .map_err(|error| DeviceError::Lost(error.to_string()))?
        .to_vec();
    staging.unmap();
    Ok(bytes)
}
