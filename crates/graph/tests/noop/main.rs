//! Tests without a GPU.
#[test]
fn nothing() {}
