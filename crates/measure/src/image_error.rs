//! How wrong a frame looks: FLIP against the reference's picture, and pictures that show a person where. Which pixels and entities are
//! wrong is the oracle's to say ([`antumbra_verify::IdBuffer`]).

mod flip;
mod mark;
mod png;

pub use flip::{Flip, flip};
pub use mark::mark_wrong;
pub use png::save_png;
pub(crate) use png::{data_uri, encode};
