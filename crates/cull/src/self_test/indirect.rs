//! Indirect draws that begin at other instances than the first: each draws its own instances, and none is left out.

use super::bench::Bench;
use super::picture::Rect;
use super::raster::{Attachments, QUAD_INDICES, RasterDesc, RasterPipeline, Sheets, pass};
use super::scene::Scene;
use super::trial::{Answer, Expected, Trial};
use crate::draw_source::INDIRECT_DRAW_BYTES;
use crate::renderer::{DEPTH_FORMAT, IDENTITY_FORMAT};

/// A row of this image is 256 bytes, as copies to buffers need it.
const SIZE: [u32; 2] = [64, 4];
/// Pixels a side of a tile.
const TILE: u32 = 4;
/// Slots, in the order in which they are drawn.
const SLOTS: [u32; 16] = [3, 0, 14, 7, 1, 9, 12, 5, 2, 11, 15, 4, 8, 6, 13, 10];
/// The first instance and the number of instances of each draw. The second draws nothing; places 6 and 12 belong to no draw.
const DRAWS: [[u32; 2]; 5] = [[0, 3], [3, 0], [3, 3], [7, 5], [13, 3]];

/// Records the trial. Its image has one sample a pixel.
pub(super) fn record(bench: &mut Bench<'_>, scene: &Scene) -> Trial {
    let tiles: Vec<Rect> = (0..SLOTS.len() as u32)
        .map(|slot| Rect::new(slot * TILE..(slot + 1) * TILE, 0..TILE, 0.5))
        .collect();
    let sheets = Sheets::new(bench, SIZE, tiles.iter());
    let ids = bench.texture(SIZE, IDENTITY_FORMAT, 1);
    let depth = bench.texture(SIZE, DEPTH_FORMAT, 1);
    let [ids_view, depth] = [&ids, &depth].map(|texture| texture.create_view(&Default::default()));
    let own = (bench.samples > 1).then(|| RasterPipeline::new(bench.gpu, &RasterDesc::ids(1)));
    let pipeline = own.as_ref().unwrap_or_else(|| scene.ids(bench));
    let slots = bench.buffer(&SLOTS, wgpu::BufferUsages::VERTEX);
    let draws: Vec<u32> = DRAWS
        .iter()
        .flat_map(|[first, count]| [QUAD_INDICES, *count, 0, 0, *first])
        .collect();
    debug_assert_eq!(
        draws.len() as u64 * 4,
        DRAWS.len() as u64 * INDIRECT_DRAW_BYTES
    );
    let draws = bench.buffer(&draws, wgpu::BufferUsages::INDIRECT);
    let into = Attachments {
        depth: &depth,
        clears: true,
        ids: Some(&ids_view),
        queries: None,
    };
    let mut pass = pass(&mut bench.encoder, &into);
    sheets.begin(bench.gpu, &mut pass, pipeline, Some(&slots));
    pass.multi_draw_indexed_indirect(&draws, 0, DRAWS.len() as u32);
    drop(pass);
    let [width, height] = SIZE;
    let bytes_per_row = width * 4;
    let pixels = bench.gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("self-test"),
        size: u64::from(bytes_per_row * height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    bench.encoder.copy_texture_to_buffer(
        ids.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &pixels,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(bytes_per_row),
                rows_per_image: None,
            },
        },
        wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
    );
    let drawn = |place: u32| {
        DRAWS
            .iter()
            .any(|[first, count]| (*first..first + count).contains(&place))
    };
    let id_of = |slot: u32| {
        let place = (0u32..).zip(SLOTS).find(|(_, drawn)| *drawn == slot);
        place
            .filter(|(place, _)| drawn(*place))
            .map_or(0, |_| slot + 1)
    };
    let expected = (0..width * height).map(|pixel| {
        let slot = pixel % width / TILE;
        Expected {
            // The low and the high half of an id are those of a word.
            answer: Answer::Number(id_of(slot)),
            place: format!(
                "the id in tile {slot}, pixel {} of row {}",
                pixel % width,
                pixel / width
            ),
        }
    });
    Trial {
        expected: expected.collect(),
        bytes: bench.reads(pixels),
    }
}
