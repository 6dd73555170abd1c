//! A solid while it is read. The corners of its triangles are welded by position.

use crate::budget::Budget;
use crate::left_out::LostPart;
use glam::DVec3;
use std::collections::HashMap;

/// Bytes of memory of a triangle's corners while they are welded.
pub(super) const TRIANGLE_MEMORY: u64 = 160;

/// A solid while it is read.
pub(super) struct Solid {
    pub(super) name: String,
    pub(super) corners: Vec<DVec3>,
    pub(super) indices: Vec<u32>,
    known: HashMap<[u64; 3], u32>,
}

impl Solid {
    pub(super) fn named(name: &str) -> Self {
        Self {
            name: if name.is_empty() { "stl" } else { name }.to_owned(),
            corners: Vec::new(),
            indices: Vec::new(),
            known: HashMap::new(),
        }
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    pub(super) fn add(&mut self, corners: [DVec3; 3], budget: &mut Budget) {
        if corners.iter().any(|corner| !corner.as_vec3().is_finite()) {
            let example = format!(
                "after triangle {} of \"{}\"",
                self.triangle_count(),
                self.name
            );
            let reason = "a corner is not finite";
            budget.left_out.add(LostPart::Face, reason, &example);
            return;
        }
        for corner in corners {
            let next = self.corners.len() as u32;
            let key = corner.to_array().map(f64::to_bits);
            let index = *self.known.entry(key).or_insert(next);
            if index == next {
                self.corners.push(corner);
            }
            self.indices.push(index);
        }
    }
}
