//! The JSON part of the extension: its version, how horizons were found, and the number of items in each row of the binary part.

use serde_json::{Map, Value};

use super::problem::bad;
use crate::error::TerrainError;
use crate::horizon::{Method, Sectors};

/// The version that is written. Version 1, which has one reach, is read as well.
pub const VERSION: u64 = 2;

/// What determines the position of each number in the binary part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layout {
    pub(super) method: Method,
    pub(super) sectors: Sectors,
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    pub(super) groups: usize,
    /// Groups without a parent, `tops` in the file.
    pub(super) roots: usize,
    /// Triangles of no group, `always` in the file.
    pub(super) ungrouped: usize,
    /// Nodes that show those, `alwaysNodes` in the file.
    pub(super) ungrouped_nodes: usize,
}

impl Layout {
    /// The JSON part.
    pub(super) fn facts(&self) -> Map<String, Value> {
        let numbers = [
            ("version", VERSION),
            ("sectors", self.sectors.count().into()),
            ("parts", self.sectors.parts().into()),
            ("reaches", self.sectors.reaches().into()),
            ("vertices", self.vertices as u64),
            ("triangles", self.triangles as u64),
            ("groups", self.groups as u64),
            ("tops", self.roots as u64),
            ("always", self.ungrouped as u64),
            ("alwaysNodes", self.ungrouped_nodes as u64),
        ];
        let numbers = numbers.map(|(name, number)| (name, Value::from(number)));
        let method = ("method", Value::from(self.method.to_string()));
        let facts = numbers.into_iter().chain([method]);
        facts.map(|(name, fact)| (name.to_owned(), fact)).collect()
    }

    /// Reads the JSON part.
    pub(super) fn read(facts: &Map<String, Value>) -> Result<Self, TerrainError> {
        let number = |name: &str| {
            let number = facts.get(name).and_then(Value::as_u64);
            number.ok_or_else(|| bad(format!("it has no number \"{name}\"")))
        };
        // The version comes first: another version may have other members.
        let version = number("version")?;
        if !(1..=VERSION).contains(&version) {
            return Err(bad(format!(
                "it has version {version}, and versions 1 to {VERSION} are supported"
            )));
        }
        let count = |name: &str| {
            let count = u32::try_from(number(name)?).ok();
            // The greatest u32 is the index for "none".
            let count = count.filter(|count| *count < u32::MAX);
            let count =
                count.ok_or_else(|| bad(format!("its \"{name}\" is larger than 4294967294")))?;
            Ok::<_, TerrainError>(count)
        };
        let size = |name: &str| Ok::<_, TerrainError>(count(name)? as usize);
        // Version 1 has one reach.
        let reaches = if version == 1 { 1 } else { count("reaches")? };
        let sectors = Sectors::new(count("sectors")?, count("parts")?)
            .and_then(|sectors| sectors.with_reaches(reaches));
        let method = facts.get("method").and_then(Value::as_str);
        let method = method.and_then(|method| method.parse().ok());
        Ok(Self {
            method: method.ok_or_else(|| bad("its \"method\" is not sound, rays or thesis"))?,
            sectors: sectors.map_err(|error| bad(error.to_string()))?,
            vertices: size("vertices")?,
            triangles: size("triangles")?,
            groups: size("groups")?,
            roots: size("tops")?,
            ungrouped: size("always")?,
            ungrouped_nodes: size("alwaysNodes")?,
        })
    }

    /// The number of regions: one for each group, sector and reach.
    pub(super) fn regions(&self) -> usize {
        self.groups * self.sectors.rows()
    }

    /// Checks that the binary part has as many bytes as the counts need.
    pub(super) fn check_size(&self, bytes: usize) -> Result<(), TerrainError> {
        // No count has more than 32 bits, so the sum fits into 64.
        let needed: u64 = [
            (1, 3 * 8),
            (self.groups, 3 * 8 + 2 * 8),
            (self.vertices, 3 * 4),
            (self.regions(), 9 * 4),
            (self.triangles, 3 * 4),
            (self.groups, 2 * 4 + 2 * 4),
            (self.roots, 4),
            (self.triangles, 4),
            (self.ungrouped, 4),
            (self.ungrouped_nodes, 4),
        ]
        .iter()
        .map(|&(count, each)| count as u64 * each)
        .sum();
        if needed == bytes as u64 {
            return Ok(());
        }
        Err(bad(format!(
            "it has {bytes} bytes, but its counts need {needed}"
        )))
    }
}
