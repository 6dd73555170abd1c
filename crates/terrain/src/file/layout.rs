//! The extension's facts: its version, how horizons were found, and how many there are of everything.

use serde_json::{Map, Value};

use super::{VERSION, bad};
use crate::error::TerrainError;
use crate::horizon::{Method, Sectors};

/// What decides where each number lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layout {
    pub(super) method: Method,
    pub(super) sectors: Sectors,
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    pub(super) groups: usize,
    pub(super) tops: usize,
    /// Triangles of no group.
    pub(super) always: usize,
    /// Nodes that show those.
    pub(super) always_nodes: usize,
}

impl Layout {
    pub(super) fn facts(&self) -> Map<String, Value> {
        let numbers = [
            ("version", VERSION),
            ("sectors", self.sectors.count().into()),
            ("parts", self.sectors.parts().into()),
            ("reaches", self.sectors.reaches().into()),
            ("vertices", self.vertices as u64),
            ("triangles", self.triangles as u64),
            ("groups", self.groups as u64),
            ("tops", self.tops as u64),
            ("always", self.always as u64),
            ("alwaysNodes", self.always_nodes as u64),
        ];
        let numbers = numbers.map(|(name, number)| (name, Value::from(number)));
        let method = ("method", Value::from(self.method.to_string()));
        let facts = numbers.into_iter().chain([method]);
        facts.map(|(name, fact)| (name.to_owned(), fact)).collect()
    }

    pub(super) fn read(facts: &Map<String, Value>) -> Result<Self, TerrainError> {
        let number = |name: &str| {
            let number = facts.get(name).and_then(Value::as_u64);
            number.ok_or_else(|| bad(format!("it has no number \"{name}\"")))
        };
        // Before all else: what other versions have is theirs to say.
        let version = number("version")?;
        if !(1..=VERSION).contains(&version) {
            return Err(bad(format!(
                "it is of version {version}, and 1 to {VERSION} are known here"
            )));
        }
        let count = |name: &str| {
            let count = u32::try_from(number(name)?).ok();
            // The greatest number stands for none.
            let count = count.filter(|count| *count < u32::MAX);
            let count = count.ok_or_else(|| bad(format!("its \"{name}\" cannot be counted")))?;
            Ok::<_, TerrainError>(count)
        };
        let size = |name: &str| Ok::<_, TerrainError>(count(name)? as usize);
        // The first version knows of one alone.
        let reaches = if version == 1 { 1 } else { count("reaches")? };
        let sectors = Sectors::new(count("sectors")?, count("parts")?)
            .and_then(|sectors| sectors.with_reaches(reaches));
        let method = facts.get("method").and_then(Value::as_str);
        let method = method.and_then(|method| method.parse().ok());
        Ok(Self {
            method: method
                .ok_or_else(|| bad("its \"method\" is none of sound, rays and thesis"))?,
            sectors: sectors.map_err(|error| bad(error.to_string()))?,
            vertices: size("vertices")?,
            triangles: size("triangles")?,
            groups: size("groups")?,
            tops: size("tops")?,
            always: size("always")?,
            always_nodes: size("alwaysNodes")?,
        })
    }

    /// A region for each group, sector and reach.
    pub(super) fn regions(&self) -> usize {
        self.groups * self.sectors.rows()
    }

    /// Whether so many bytes are what it counts.
    pub(super) fn fits(&self, bytes: usize) -> Result<(), TerrainError> {
        // No count is beyond 32 bits, and so no sum beyond 64.
        let needed: u64 = [
            (1, 3 * 8),
            (self.groups, 3 * 8 + 2 * 8),
            (self.vertices, 3 * 4),
            (self.regions(), 9 * 4),
            (self.triangles, 3 * 4),
            (self.groups, 2 * 4 + 2 * 4),
            (self.tops, 4),
            (self.triangles, 4),
            (self.always, 4),
            (self.always_nodes, 4),
        ]
        .iter()
        .map(|&(count, each)| count as u64 * each)
        .sum();
        if needed == bytes as u64 {
            return Ok(());
        }
        Err(bad(format!(
            "it has {bytes} bytes where it counts {needed}"
        )))
    }
}
