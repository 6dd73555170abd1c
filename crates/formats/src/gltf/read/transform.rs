//! A node's transform with the file's full precision. The crate `gltf` keeps f32, which is half a metre for
//! coordinates of millions of metres, so the transform is parsed from the node's JSON.

use antumbra_scene::animation::NodeTransform;
use glam::{DAffine3, DMat4, DQuat, DVec3, DVec4};
use gltf::json::extras::RawValue;
use gltf::json::scene::Node;
use serde::{Deserialize, Deserializer};

/// The part of a node with its transform.
#[derive(Deserialize)]
struct Numbers {
    translation: Option<[Number; 3]>,
    rotation: Option<[Number; 4]>,
    scale: Option<[Number; 3]>,
    matrix: Option<[Number; 16]>,
}

/// A number parsed to the nearest f64. The number parser of serde_json may be off by one bit.
#[derive(Clone, Copy)]
struct Number(f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let digits = <&RawValue>::deserialize(deserializer)?.get();
        let number = digits.parse().map_err(serde::de::Error::custom)?;
        Ok(Self(number))
    }
}

/// A node's transform relative to its parent, or the reason why it is invalid.
pub(super) fn local(node: &Node, json: &RawValue) -> Result<DAffine3, String> {
    Ok(parts(node, json)?.affine)
}

/// The same with its parts.
pub(super) fn parts(node: &Node, json: &RawValue) -> Result<NodeTransform, String> {
    let vectors = node.translation.is_some() || node.scale.is_some();
    if !vectors && node.rotation.is_none() && node.matrix.is_none() {
        return Ok(NodeTransform::IDENTITY);
    }
    // Serde would read an array as the members in their order, which differs from that of the crate `gltf`.
    if !json.get().starts_with('{') {
        return Err("it is no JSON object".to_owned());
    }
    let numbers: Numbers = serde_json::from_str(json.get()).map_err(|e| e.to_string())?;
    let local = match numbers.matrix {
        Some(matrix) => NodeTransform::from_affine(affine(finite(matrix)?)?),
        None => composed(&numbers)?,
    };
    if local.affine.is_finite() {
        Ok(local)
    } else {
        Err(NOT_FINITE.to_owned())
    }
}

const NOT_FINITE: &str = "its transform is not finite";

/// The numbers, if they are within the range of f32. Later computations use f32.
fn finite<const N: usize>(numbers: [Number; N]) -> Result<[f64; N], &'static str> {
    let numbers = numbers.map(|number| number.0);
    if numbers.iter().all(|number| (*number as f32).is_finite()) {
        Ok(numbers)
    } else {
        Err(NOT_FINITE)
    }
}

fn affine(matrix: [f64; 16]) -> Result<DAffine3, &'static str> {
    let matrix = DMat4::from_cols_array(&matrix);
    let off = (matrix.row(3) - DVec4::W).abs();
    if off.cmplt(DVec4::splat(1e-4)).all() {
        Ok(DAffine3::from_mat4(matrix))
    } else {
        Err("the last row of its matrix is not 0 0 0 1; only affine matrices can be placed")
    }
}

fn composed(numbers: &Numbers) -> Result<NodeTransform, &'static str> {
    let vector = |given: Option<[Number; 3]>, or: DVec3| match given {
        Some(numbers) => finite(numbers).map(DVec3::from),
        None => Ok(or),
    };
    let rotation = match numbers.rotation {
        Some(numbers) => DQuat::from_array(finite(numbers)?),
        None => DQuat::IDENTITY,
    };
    let length = rotation.length();
    // A length that is zero in f32 is too small to divide by.
    if length as f32 == 0.0 {
        return Err("its rotation has no length; use 0 0 0 1 for none");
    }
    let scale = vector(numbers.scale, DVec3::ONE)?;
    let translation = vector(numbers.translation, DVec3::ZERO)?;
    Ok(NodeTransform::from_parts(
        translation,
        rotation / length,
        scale,
    ))
}
