//! Furniture, one file for each group. Prefabs stand on y = 0 and face +Z, in metres.

pub(super) mod bath;
pub(super) mod bed;
pub(super) mod fitting;
pub(super) mod kitchen;
pub(super) mod lamp;
pub(super) mod seat;
pub(super) mod shelf;
pub(super) mod table;
