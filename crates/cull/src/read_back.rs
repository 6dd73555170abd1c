//! Reads buffers and textures back to the host and waits for them: for oracles, images and tests, never within a frame.
//!
//! Each function has a form that blocks and one to be awaited. Browsers have the second alone; elsewhere it blocks as well, and is ready when it returns.

use crate::arrival::arrival;
use crate::device::{DeviceError, Gpu};

/// All bytes of a buffer, which must be a copy source.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile; [`DeviceError::CannotWait`] in a browser.
pub fn buffer(gpu: &Gpu, source: &wgpu::Buffer) -> Result<Vec<u8>, DeviceError> {
    gpu.block_on(
        "read_back::buffer",
        "read_back::buffer_async",
        buffer_async(gpu, source),
    )
}

/// [`buffer`], to be awaited.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile.
pub async fn buffer_async(gpu: &Gpu, source: &wgpu::Buffer) -> Result<Vec<u8>, DeviceError> {
    slices_async(gpu, &[source.slice(..)]).await
}

/// The bytes of parts of buffers, one after the other, in one go. The buffers must be copy sources, and offsets and sizes multiples of four.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile.
pub async fn slices_async(
    gpu: &Gpu,
    sources: &[wgpu::BufferSlice<'_>],
) -> Result<Vec<u8>, DeviceError> {
    let sizes = sources.iter().map(|source| source.size());
    let staging = staging(gpu, sizes.sum());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut at = 0;
    for source in sources {
        let size = source.size();
        encoder.copy_buffer_to_buffer(source.buffer(), source.offset(), &staging, at, size);
        at += size;
    }
    gpu.queue.submit([encoder.finish()]);
    mapped(gpu, &staging).await
}

/// The texels of a texture's first mip and layer, row after row without padding. The texture must be a copy source, and its format must not
/// be a block format.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile; [`DeviceError::CannotWait`] in a browser.
pub fn texture(gpu: &Gpu, source: &wgpu::Texture) -> Result<Vec<u8>, DeviceError> {
    gpu.block_on(
        "read_back::texture",
        "read_back::texture_async",
        texture_async(gpu, source),
    )
}

/// [`texture`], to be awaited.
///
/// # Errors
/// [`DeviceError::Lost`] where the device is lost meanwhile.
pub async fn texture_async(gpu: &Gpu, source: &wgpu::Texture) -> Result<Vec<u8>, DeviceError> {
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
    let bytes = mapped(gpu, &staging).await?;
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
pub(crate) async fn mapped(gpu: &Gpu, staging: &wgpu::Buffer) -> Result<Vec<u8>, DeviceError> {
    let (bringer, answer) = arrival();
    staging.map_async(wgpu::MapMode::Read, .., move |result| bringer.bring(result));
    if gpu.can_wait() {
        gpu.wait()?;
    }
    match answer.await {
        Some(Ok(())) => {}
        Some(Err(error)) => return Err(DeviceError::Lost(error.to_string())),
        None => return Err(DeviceError::Lost("a buffer was not mapped".to_owned())),
    }
    let bytes = staging
        .slice(..)
        .get_mapped_range()
        .map_err(|error| DeviceError::Lost(error.to_string()))?
        .to_vec();
    staging.unmap();
    gpu.check()?;
    Ok(bytes)
}
