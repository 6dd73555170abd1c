//! The JSON of a written glTF. Numbers of transforms are f64, all others are f32 in the shortest exact notation.

use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Root<'a> {
    pub(super) asset: Asset,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) extensions_used: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scene: Option<u32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) scenes: Vec<SceneNodes<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) nodes: Vec<Node<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) meshes: Vec<Mesh>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) materials: Vec<Material<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) textures: Vec<Texture>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) images: Vec<Image<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) samplers: Vec<Sampler>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) cameras: Vec<Camera>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) buffers: Vec<Buffer>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<RootExtensions<'a>>,
}

#[derive(Serialize)]
pub(super) struct Asset {
    pub(super) version: &'static str,
    pub(super) generator: &'static str,
}

#[derive(Serialize)]
pub(super) struct SceneNodes<'a> {
    pub(super) name: &'a str,
    pub(super) nodes: Vec<u32>,
}

#[derive(Default, Serialize)]
pub(super) struct Node<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    #[serde(flatten)]
    pub(super) transform: Transform,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) children: Vec<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) camera: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<NodeExtensions>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extras: Option<NodeExtras>,
}

#[derive(Clone, Default, PartialEq, Debug, Serialize)]
pub(super) struct Transform {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) translation: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) rotation: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scale: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) matrix: Option<Box<[f64; 16]>>,
}

#[derive(Default, Serialize)]
pub(super) struct NodeExtensions {
    #[serde(
        rename = "KHR_lights_punctual",
        skip_serializing_if = "Option::is_none"
    )]
    pub(super) light: Option<LightIndex>,
    #[serde(rename = "MSFT_lod", skip_serializing_if = "Option::is_none")]
    pub(super) lod: Option<Lod>,
}

#[derive(Serialize)]
pub(super) struct LightIndex {
    pub(super) light: u32,
}

#[derive(Serialize)]
pub(super) struct Lod {
    pub(super) ids: Vec<u32>,
}

#[derive(Serialize)]
pub(super) struct NodeExtras {
    pub(super) tested: bool,
}

#[derive(Serialize)]
pub(super) struct Mesh {
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(super) name: String,
    pub(super) primitives: [Primitive; 1],
}

#[derive(Serialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: u32,
    pub(super) mode: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) material: Option<u32>,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) positions: u32,
    #[serde(rename = "NORMAL", skip_serializing_if = "Option::is_none")]
    pub(super) normals: Option<u32>,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    pub(super) uvs: Option<u32>,
    #[serde(rename = "COLOR_0", skip_serializing_if = "Option::is_none")]
    pub(super) colours: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Material<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    pub(super) pbr_metallic_roughness: Pbr,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) emissive_factor: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) alpha_mode: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) alpha_cutoff: Option<f32>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) double_sided: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<MaterialExtensions>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Pbr {
    pub(super) base_color_factor: [f32; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_color_texture: Option<TextureInfo>,
    pub(super) metallic_factor: f32,
    pub(super) roughness_factor: f32,
}

#[derive(Serialize)]
pub(super) struct TextureInfo {
    pub(super) index: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<TextureExtensions>,
}

#[derive(Serialize)]
pub(super) struct TextureExtensions {
    #[serde(rename = "KHR_texture_transform")]
    pub(super) transform: TextureTransform,
}

#[derive(Serialize)]
pub(super) struct TextureTransform {
    pub(super) offset: [f32; 2],
    pub(super) rotation: f32,
    pub(super) scale: [f32; 2],
}

#[derive(Serialize)]
pub(super) struct MaterialExtensions {
    #[serde(
        rename = "KHR_materials_emissive_strength",
        skip_serializing_if = "Option::is_none"
    )]
    pub(super) strength: Option<EmissiveStrength>,
    #[serde(
        rename = "KHR_materials_unlit",
        skip_serializing_if = "Option::is_none"
    )]
    pub(super) unlit: Option<Empty>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct EmissiveStrength {
    pub(super) emissive_strength: f32,
}

#[derive(Serialize)]
pub(super) struct Empty {}

#[derive(Serialize)]
pub(super) struct Texture {
    pub(super) sampler: u32,
    pub(super) source: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Image<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    pub(super) mime_type: &'static str,
    pub(super) buffer_view: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Sampler {
    pub(super) mag_filter: u32,
    pub(super) min_filter: u32,
    pub(super) wrap_s: u32,
    pub(super) wrap_t: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase", tag = "type")]
pub(super) enum Camera {
    Perspective { perspective: Perspective },
    Orthographic { orthographic: Orthographic },
}

#[derive(Serialize)]
pub(super) struct Perspective {
    pub(super) yfov: f64,
    pub(super) znear: f64,
}

#[derive(Serialize)]
pub(super) struct Orthographic {
    pub(super) xmag: f64,
    pub(super) ymag: f64,
    pub(super) znear: f64,
    pub(super) zfar: f64,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: u32,
    pub(super) component_type: u32,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) shape: &'static str,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) normalized: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max: Option<[f32; 3]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: u32,
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) target: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) byte_length: u64,
}

#[derive(Default, Serialize)]
pub(super) struct RootExtensions<'a> {
    #[serde(
        rename = "KHR_lights_punctual",
        skip_serializing_if = "Option::is_none"
    )]
    pub(super) lights: Option<Lights>,
    #[serde(flatten)]
    pub(super) attachments: BTreeMap<&'a str, Attachment<'a>>,
}

/// An extension of the whole file that other code defines.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Attachment<'a> {
    #[serde(flatten)]
    pub(super) properties: &'a Map<String, Value>,
    pub(super) nodes: Vec<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) buffer_view: Option<u32>,
}

#[derive(Serialize)]
pub(super) struct Lights {
    pub(super) lights: Vec<Light>,
}

#[derive(Serialize)]
pub(super) struct Light {
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) color: [f32; 3],
    pub(super) intensity: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) range: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spot: Option<Cone>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Cone {
    pub(super) inner_cone_angle: f32,
    pub(super) outer_cone_angle: f32,
}
