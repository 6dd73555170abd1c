//! The elements of a PLY that are read, as the crate `ply-rs-bw` fills them.

use glam::DVec3;
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

/// The names of a face's list of corners.
pub(super) const CORNERS: &str = "vertex_indices";
pub(super) const CORNERS_TOO: &str = "vertex_index";

/// The attributes of a vertex that are read.
#[derive(Default)]
pub(super) struct Vertex {
    pub(super) position: DVec3,
    pub(super) normal: [f32; 3],
    pub(super) uv: [f32; 2],
    pub(super) colour: [u8; 4],
}

/// A face.
#[derive(Default)]
pub(super) struct Face {
    pub(super) corners: Vec<u32>,
}

/// Triangle strips, one after another. A negative number ends a strip.
#[derive(Default)]
pub(super) struct Strips {
    pub(super) corners: Vec<i64>,
}

/// An element that is skipped.
pub(super) struct Skipped;

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let [nx, ny, nz] = &mut self.normal;
        let [u, v] = &mut self.uv;
        let number = match name {
            "x" | "y" | "z" => return self.set_position(name, &property),
            "nx" => nx,
            "ny" => ny,
            "nz" => nz,
            "u" | "s" | "texture_u" => u,
            "v" | "t" | "texture_v" => v,
            _ => return self.set_colour(name, &property),
        };
        match property.to_f32_lossy() {
            Some(value) => *number = value,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl Vertex {
    fn set_position(&mut self, axis: &str, property: &Property) -> PropertyAccessResult {
        let value = match property {
            Property::Double(value) => Some(*value),
            Property::Int(value) => Some(f64::from(*value)),
            Property::UInt(value) => Some(f64::from(*value)),
            other => other.to_f32_lossy().map(f64::from),
        };
        let Some(value) = value else {
            return PropertyAccessResult::UnsupportedType;
        };
        match axis {
            "x" => self.position.x = value,
            "y" => self.position.y = value,
            _ => self.position.z = value,
        }
        PropertyAccessResult::Set
    }

    fn set_colour(&mut self, name: &str, property: &Property) -> PropertyAccessResult {
        let [r, g, b, a] = &mut self.colour;
        let channel = match name {
            "red" | "r" | "diffuse_red" => r,
            "green" | "g" | "diffuse_green" => g,
            "blue" | "b" | "diffuse_blue" => b,
            "alpha" | "a" => a,
            _ => return PropertyAccessResult::Ignored,
        };
        match property.to_u8_color_lossy() {
            Some(value) => *channel = value,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if name != CORNERS && name != CORNERS_TOO {
            return PropertyAccessResult::Ignored;
        }
        match property.to_u32_list() {
            Some(corners) => self.corners = corners,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Strips {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if name != CORNERS && name != CORNERS_TOO {
            return PropertyAccessResult::Ignored;
        }
        let wide = |corners: &[u32]| corners.iter().copied().map(i64::from).collect();
        self.corners = match &property {
            Property::ListChar(corners) => corners.iter().copied().map(i64::from).collect(),
            Property::ListShort(corners) => corners.iter().copied().map(i64::from).collect(),
            Property::ListInt(corners) => corners.iter().copied().map(i64::from).collect(),
            other => match other.to_u32_list() {
                Some(corners) => wide(&corners),
                None => return PropertyAccessResult::UnsupportedType,
            },
        };
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}
