//! The format of volume files. All numbers are little-endian.
//!
//! | bytes | contents |
//! |---|---|
//! | 0..8 | the signature: `89 41 56 4F 4C 0D 0A 1A`, that is `\x89AVOL\r\n\x1a` |
//! | 8..12 | u32, the version: 1 |
//! | 12..16 | u32, bytes of the name, at most 1024 |
//! | 16..28 | 3 u32, samples along the inline, crossline and time axis, each 1 to 2^20 |
//! | 28..32 | u32, samples along an edge of a brick, 1 to 256 |
//! | 32..56 | 3 f64, the position of sample (0, 0, 0) in the world, metres |
//! | 56..128 | 9 f64, the step to the next sample along the inline, then the crossline, then the time axis, metres |
//! | 128..136 | 2 f32, the values of samples 1 and 255 |
//! | 136..4096 | the name in UTF-8, then zeros |
//! | 4096.. | the bricks, the inline axis fastest, then crossline, then time |
//!
//! The f64 are within 1e12, the steps span space, and the range is ascending. A brick is edge^3 bytes, one per
//! sample, in the same order of axes. The bricks at the volume's far sides are whole as well and repeat its last
//! samples. There are ceil(samples / edge) bricks along an axis, and nothing follows the last one, so the header
//! determines the file's length.

use glam::DVec3;

use super::layout::VolumeLayout;
#[cfg(feature = "read")]
use crate::error::SubsurfaceError;

/// The offset of the bricks, a multiple of the size of a memory page.
pub(super) const HEADER_BYTES: usize = 4096;
/// The greatest length of a name in bytes.
pub(super) const MAX_NAME_BYTES: usize = 1024;
/// The format's name in errors.
pub(super) const FORMAT: &str = "Antumbra volume";

const MARK: [u8; 8] = *b"\x89AVOL\r\n\x1a";
const VERSION: u32 = 1;
const NAME_OFFSET: usize = 136;

/// The header of a volume, or the reason why there is none.
pub(crate) fn encode(layout: &VolumeLayout, name: &str) -> Result<Vec<u8>, String> {
    if name.len() > MAX_NAME_BYTES {
        let length = name.len();
        return Err(format!(
            "a name of {length} bytes: {MAX_NAME_BYTES} are possible"
        ));
    }
    let mut header = Vec::with_capacity(HEADER_BYTES);
    header.extend_from_slice(&MARK);
    let words = [VERSION, name.len() as u32].into_iter();
    for word in words.chain(layout.size).chain([layout.brick]) {
        header.extend_from_slice(&word.to_le_bytes());
    }
    let places = [layout.origin].into_iter().chain(layout.steps);
    for number in places.flat_map(|place| place.to_array()) {
        header.extend_from_slice(&number.to_le_bytes());
    }
    for number in layout.range {
        header.extend_from_slice(&number.to_le_bytes());
    }
    debug_assert_eq!(header.len(), NAME_OFFSET);
    header.extend_from_slice(name.as_bytes());
    header.resize(HEADER_BYTES, 0);
    Ok(header)
}

/// The offset of a brick in the file.
#[cfg(feature = "read")]
pub(crate) fn brick_offset(layout: &VolumeLayout, brick: [u32; 3]) -> Result<u64, SubsurfaceError> {
    let rank = layout.rank(brick)?;
    Ok(HEADER_BYTES as u64 + rank * layout.brick_bytes() as u64)
}

/// The contents of a header.
pub(super) struct Header {
    pub(super) layout: VolumeLayout,
    pub(super) name: String,
}

/// Decodes the header of a file of `length` bytes. The layout's bricks must fill the file exactly. An error names the
/// problem and its place.
pub(super) fn decode(bytes: &[u8], length: u64) -> Result<Header, String> {
    let (header, _) = bytes.split_first_chunk::<HEADER_BYTES>().ok_or_else(|| {
        format!("it is {length} bytes long, but the header alone takes {HEADER_BYTES} bytes")
    })?;
    let mut rest = header.as_slice();
    if take::<8>(&mut rest) != MARK {
        return Err("bytes 0 to 7 are not the mark of such a file".into());
    }
    let version = u32::from_le_bytes(take(&mut rest));
    if version != VERSION {
        return Err(format!(
            "byte 8: version {version}; this program reads version {VERSION}"
        ));
    }
    let name_length = u32::from_le_bytes(take(&mut rest)) as usize;
    if name_length > MAX_NAME_BYTES {
        return Err(format!(
            "byte 12: a name of {name_length} bytes; {MAX_NAME_BYTES} are possible"
        ));
    }
    let size = [(); 3].map(|()| u32::from_le_bytes(take(&mut rest)));
    let brick = u32::from_le_bytes(take(&mut rest));
    let mut place = || DVec3::from([(); 3].map(|()| f64::from_le_bytes(take(&mut rest))));
    let layout = VolumeLayout {
        size,
        brick,
        origin: place(),
        steps: [(); 3].map(|()| place()),
        range: [(); 2].map(|()| f32::from_le_bytes(take(&mut rest))),
    };
    if let Some(problem) = layout.problem() {
        return Err(format!("bytes 16 to 135: {problem}"));
    }
    let name = rest.get(..name_length).unwrap_or_default();
    let name = std::str::from_utf8(name).map_err(|error| {
        let at = NAME_OFFSET + error.valid_up_to();
        format!("byte {at}: the name is not UTF-8")
    })?;
    let expected = (layout.total_bytes()).and_then(|bytes| bytes.checked_add(HEADER_BYTES as u64));
    if expected != Some(length) {
        let expected = expected.unwrap_or(u64::MAX);
        let what = if length < expected {
            "it was cut short"
        } else {
            "something else follows"
        };
        return Err(format!(
            "it is {length} bytes long, but its header says {expected}: {what}; write it again"
        ));
    }
    Ok(Header {
        layout,
        name: name.to_owned(),
    })
}

/// The next bytes of a header; zeros beyond its end.
fn take<const N: usize>(rest: &mut &[u8]) -> [u8; N] {
    let Some((first, others)) = rest.split_first_chunk::<N>() else {
        return [0; N];
    };
    *rest = others;
    *first
}
