//! Image differences: FLIP against the reference, and pictures that mark wrong pixels. The oracle finds which pixels and entities are wrong
//! ([`antumbra_verify::IdBuffer`]).

mod flip;
mod mark;
mod png;

pub use flip::{Flip, flip};
pub use mark::mark_wrong;
pub(crate) use png::data_uri;
pub use png::{encode_png, save_png};
