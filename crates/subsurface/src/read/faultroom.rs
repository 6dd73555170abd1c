//! Fault surfaces of RMS's FaultRoom: GeoJSON with a polygon per triangle and x, y and depth at each corner.

use std::collections::HashMap;

use glam::DVec3;
use serde::Deserialize;

use super::budget::ReadBudget;
use super::options::ZPositive;
use super::triangles;
use crate::surface::{Surface, SurfaceKind};

/// Bytes that a letter of the text becomes, at most.
const LETTER: u64 = 12;

#[derive(Deserialize)]
struct Collection {
    features: Vec<Feature>,
}

#[derive(Deserialize)]
struct Feature {
    properties: Properties,
    geometry: Shape,
}

#[derive(Deserialize)]
struct Properties {
    #[serde(rename = "FaultID")]
    fault: String,
}

#[derive(Deserialize)]
struct Shape {
    coordinates: Vec<Vec<[f64; 3]>>,
}

/// Reads a surface per fault, in the order in which the file first names them.
pub(super) fn read(
    bytes: &[u8],
    positive: ZPositive,
    kind: SurfaceKind,
    budget: &mut ReadBudget,
) -> Result<Vec<Surface>, String> {
    // An empty list takes two letters, and becomes a vector.
    budget.take(bytes.len() as u64 * LETTER, || "its text")?;
    let file: Collection = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
    let mut faults: Vec<Fault> = Vec::new();
    let mut named: HashMap<String, usize> = HashMap::new();
    for (number, feature) in file.features.into_iter().enumerate() {
        let name = feature.properties.fault;
        let at = *named.entry(name).or_insert_with_key(|name| {
            faults.push(Fault {
                name: name.clone(),
                ..Fault::default()
            });
            faults.len() - 1
        });
        budget.surfaces(u64::from(at + 1 == faults.len()), 0, || {
            format!("the faults up to feature {number}")
        })?;
        let Some(fault) = faults.get_mut(at) else {
            continue;
        };
        for ring in &feature.geometry.coordinates {
            let corners = match ring.as_slice() {
                [a, b, c, end] if a == end => [a, b, c],
                [a, b, c] => [a, b, c],
                _ => {
                    return Err(format!(
                        "feature {number}: a ring of {} corners is no triangle",
                        ring.len()
                    ));
                }
            };
            budget.vertex(|| format!("the triangles up to feature {number}"))?;
            fault.triangle(corners.map(|&[x, y, z]| DVec3::new(x, positive.up(z), -y)))?;
        }
    }
    if faults.is_empty() {
        return Err("it has no feature; there is nothing to show".into());
    }
    let surface = |fault: Fault| triangles::surface(fault.name, kind, &fault.points, &fault.named);
    faults.into_iter().map(surface).collect()
}

#[derive(Default)]
struct Fault {
    name: String,
    points: Vec<DVec3>,
    /// Points by the bits of their coordinates. Corners of neighbouring triangles are equal.
    known: HashMap<[u64; 3], u32>,
    named: Vec<[u32; 3]>,
}

impl Fault {
    fn triangle(&mut self, corners: [DVec3; 3]) -> Result<(), String> {
        let mut triangle = [0; 3];
        for (name, corner) in triangle.iter_mut().zip(corners) {
            let next = u32::try_from(self.points.len())
                .map_err(|_| "more corners than 32 bits can count".to_owned())?;
            let key = corner.to_array().map(f64::to_bits);
            *name = *self.known.entry(key).or_insert(next);
            if *name == next {
                self.points.push(corner);
            }
        }
        self.named.push(triangle);
        Ok(())
    }
}
