//! Channels of animations that move something other than a node (`KHR_animation_pointer`). The crate `gltf` does not parse a file that has any, so they are taken out.

use super::document::label;
use crate::left_out::{LeftOut, LostPart};
use gltf::json::{Root, Value};

/// The file without such channels, which are noted; `None` if it has none, or is not valid without them.
pub(super) fn without(json: &[u8], left_out: &mut LeftOut) -> Option<Root> {
    let mut value: Value = serde_json::from_slice(json).ok()?;
    let mut lost = Vec::new();
    let animations = value.get_mut("animations")?.as_array_mut()?;
    for (index, animation) in animations.iter_mut().enumerate() {
        let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) else {
            continue;
        };
        let before = channels.len();
        channels.retain(|channel| {
            let target = channel.get("target").and_then(Value::as_object);
            target.is_none_or(|target| target.contains_key("node"))
        });
        let gone = (before - channels.len()) as u64;
        if gone > 0 {
            let name = animation.get("name").and_then(Value::as_str);
            lost.push((gone, label("animation", index, name)));
        }
    }
    if lost.is_empty() {
        return None;
    }
    let root = serde_json::from_value(value).ok()?;
    for (count, place) in lost {
        let reason = "it moves something other than a node";
        left_out.add_many(LostPart::Channel, reason, count, &place);
    }
    Some(root)
}
