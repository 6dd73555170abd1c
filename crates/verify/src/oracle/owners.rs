//! The owners of an image's samples, drawn by the built-in renderer and copied to where the host reads them.
//!
//! With one sample a pixel, one pass draws entity ids. With several, each sample has a pass that draws it alone and resolves the image: the other
//! samples stay 0, so that each byte of an id comes out divided by the number of samples. All of these passes share a depth.

use antumbra_cull::{DEPTH_FORMAT, IDENTITY_FORMAT, IdTargets, ListDraws, ViewInputs};
use antumbra_draw::passes::{self, PassSpec};
use antumbra_draw::{PipelineKind, SAMPLE_IDENTITY_FORMAT};
use antumbra_graph::{Buffer, BufferDesc, Clear, Graph, Texture, TextureDesc};

use super::Image;
use super::id_buffer::IdBuffer;
use super::padded_rows::PaddedRows;

/// The drawn owners.
pub(super) struct Owners {
    /// The depth of the solid entities.
    pub depth: Texture,
    pub image: Image,
    /// One for each sample of a pixel.
    copies: Vec<Buffer>,
}

/// Bytes of a texel of a whole id, and of one with a half for each of its bytes.
const ID_BYTES: usize = 4;
const HALVES_BYTES: usize = 8;

impl Owners {
    /// Draws the entities of lists, one list after the other. `spec` makes a pass of pipelines of a kind.
    pub fn draw(
        g: &mut Graph,
        image: Image,
        inputs: ViewInputs,
        lists: &[ListDraws],
        spec: impl Fn(PipelineKind) -> PassSpec,
    ) -> Self {
        let [width, height] = image.size;
        let texture = |format| TextureDesc::new(width, height, format);
        let drawn = |format| texture(format).samples(image.samples);
        let blank = Clear::Colour(wgpu::Color::TRANSPARENT);
        let depth = drawn(DEPTH_FORMAT).cleared(Clear::Depth(0.0));
        let mut depth = g.texture("depth", depth);
        if image.samples == 1 {
            let ids = g.texture("entity ids", drawn(IDENTITY_FORMAT).cleared(blank));
            let spec = spec(PipelineKind::Identity);
            let mut targets = IdTargets { ids, depth };
            for list in lists {
                targets = passes::identity_pass(g, &spec, inputs, *list, targets);
            }
            let IdTargets { ids, depth } = targets;
            return Self {
                depth,
                image,
                copies: vec![copy(g, ids, PaddedRows::new(image.size, ID_BYTES))],
            };
        }
        let copies = (0..image.samples).map(|sample| {
            let halves = drawn(SAMPLE_IDENTITY_FORMAT).cleared(blank);
            let ids = g.texture(format!("ids of sample {sample}"), halves);
            let resolved = texture(SAMPLE_IDENTITY_FORMAT);
            let resolved = g.texture(format!("resolved ids of sample {sample}"), resolved);
            let spec = spec(PipelineKind::SampleIdentity { sample });
            let mut targets = IdTargets { ids, depth };
            let mut resolved = resolved;
            for (at, list) in lists.iter().enumerate() {
                if at + 1 < lists.len() {
                    targets = passes::identity_pass(g, &spec, inputs, *list, targets);
                    continue;
                }
                let drawn =
                    passes::sample_identity_pass(g, &spec, inputs, *list, targets, resolved);
                (resolved, depth) = (drawn.ids, drawn.depth);
            }
            copy(g, resolved, PaddedRows::new(image.size, HALVES_BYTES))
        });
        Self {
            copies: copies.collect(),
            depth,
            image,
        }
    }

    /// Makes the copies outputs of the graph.
    pub fn output(&self, g: &mut Graph) {
        for copy in &self.copies {
            g.output(*copy);
        }
    }

    /// The copies, each with its bytes.
    pub fn copies(&self) -> impl Iterator<Item = (Buffer, u64)> {
        let bytes = self.rows().bytes();
        self.copies.iter().map(move |copy| (*copy, bytes))
    }

    /// How the rows of a copy lie.
    fn rows(&self) -> PaddedRows {
        let texel = match self.copies.as_slice() {
            [_] => ID_BYTES,
            _ => HALVES_BYTES,
        };
        PaddedRows::new(self.image.size, texel)
    }

    /// Takes the owners out of the copies, which lie one after the other, and returns what lies behind them.
    pub fn read<'a>(&self, bytes: &'a [u8], image: &mut IdBuffer) -> &'a [u8] {
        let rows = self.rows();
        let all = (rows.bytes() as usize).saturating_mul(self.copies.len());
        let (copies, rest) = bytes.split_at_checked(all).unwrap_or((bytes, &[]));
        image.size = self.image.size;
        image.ids.clear();
        if self.copies.len() == 1 {
            let ids = rows.texels::<ID_BYTES>(copies);
            image
                .ids
                .extend(ids.map(|texel| u32::from_le_bytes(*texel)));
            return rest;
        }
        let samples = self.copies.len();
        let pixels = image
            .size
            .map(|side| side as usize)
            .iter()
            .product::<usize>();
        image.ids.resize(pixels * samples, 0);
        let copies = copies.chunks_exact(rows.bytes().max(1) as usize);
        for (sample, copy) in copies.enumerate() {
            let ids = rows.texels::<HALVES_BYTES>(copy);
            let places = image.ids.iter_mut().skip(sample).step_by(samples);
            for (place, texel) in places.zip(ids) {
                *place = id_of_halves(texel, samples);
            }
        }
        rest
    }
}

/// Copies a texture into a buffer.
fn copy(g: &mut Graph, texture: Texture, rows: PaddedRows) -> Buffer {
    let buffer = g.buffer("copied ids", BufferDesc::new(rows.bytes()));
    let mut node = g.copy("copy ids");
    node.copy_src(texture);
    let buffer = node.copy_dst(buffer);
    node.run(move |ctx| {
        let (from, to) = (ctx.texture(texture)?.clone(), ctx.buffer(buffer)?.clone());
        ctx.encoder().copy_texture_to_buffer(
            from.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &to,
                layout: rows.layout(),
            },
            rows.extent(),
        );
        Ok(())
    });
    buffer
}

/// The id whose bytes are these halves, each divided by the number of samples.
fn id_of_halves(texel: &[u8; HALVES_BYTES], samples: usize) -> u32 {
    let (halves, _) = texel.as_chunks::<2>();
    halves.iter().rev().fold(0, |id, half| {
        let byte = half_to_f32(u16::from_le_bytes(*half)) * samples as f32;
        id << 8 | byte as u32
    })
}

/// A half that is 0 or a normal positive number, as ids over samples are.
fn half_to_f32(half: u16) -> f32 {
    match half >> 10 {
        0 => 0.0,
        exponent => {
            f32::from_bits((u32::from(exponent) + 127 - 15) << 23 | u32::from(half & 0x3ff) << 13)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_give_back_every_byte_at_every_number_of_samples() {
        // The halves of 1, 255, 255 / 4 and 1 / 16, from the format's definition.
        let known = [
            (0x3c00, 1.0),
            (0x5bf8, 255.0),
            (0x53f8, 63.75),
            (0x2c00, 0.0625),
        ];
        for (half, value) in known {
            assert_eq!(half_to_f32(half), value);
        }
        assert_eq!(half_to_f32(0), 0.0);
        let texel = [0xf8, 0x53, 0, 0, 0x00, 0x34, 0xf8, 0x53];
        assert_eq!(id_of_halves(&texel, 4), 0xff01_00ff);
    }
}
