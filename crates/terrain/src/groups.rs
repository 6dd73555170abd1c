//! A hierarchy of groups of triangles that are hidden together (Edmondson, sections 4.6 and 5.2.3). Each group is a range of one sorted list
//! of triangles, and has the regions that it is hidden from.

use std::ops::Range;

use crate::circle::Circle;
use crate::field::NONE;
use crate::horizon::Sectors;
use crate::horizon::sector_lookup::SectorLookup;
use crate::region::Region;
use crate::sector_bound::SectorBound;

/// A group of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Its triangles, as a range of [`GroupHierarchy::order`].
    pub triangles: Range<u32>,
    /// The two groups that it consists of; [`NONE`] twice for a leaf.
    pub children: [u32; 2],
    /// A circle around it in the plan, metres from the field's origin.
    pub circle: Circle,
    /// Its lowest and its highest point, metres up.
    pub heights: [f64; 2],
}

impl Group {
    /// Whether it has no children. The leaves are the crystals: see [`Crystals`](crate::Crystals).
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.children == [NONE; 2]
    }
}

/// The groups of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupHierarchy {
    sectors: Sectors,
    groups: Vec<Group>,
    /// For each group a row of sectors, and for each sector one region for each reach.
    regions: Vec<Region>,
    roots: Vec<u32>,
    order: Vec<u32>,
    ungrouped: Range<u32>,
    lookup: SectorLookup,
    /// For each group a row of sectors.
    bounds: Vec<SectorBound>,
    /// Where a traversal starts: the roots, or the children of those that are hidden from nowhere.
    start: Vec<u32>,
}

/// The parts of a hierarchy that are stored; the others are computed from them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HierarchyParts {
    pub sectors: Sectors,
    pub groups: Vec<Group>,
    /// For each group a row of sectors, and for each sector one region for each reach.
    pub regions: Vec<Region>,
    pub roots: Vec<u32>,
    pub order: Vec<u32>,
    pub ungrouped: Range<u32>,
}

impl GroupHierarchy {
    /// The sectors of the regions.
    #[must_use]
    pub fn sectors(&self) -> &Sectors {
        &self.sectors
    }

    /// All groups, each before its children.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The groups that are part of no other group.
    #[must_use]
    pub fn roots(&self) -> &[u32] {
        &self.roots
    }

    /// The field's triangles, group after group, and the ungrouped ones at the end.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The triangles of no group, as a range of [`Self::order`]. They are always drawn.
    #[must_use]
    pub fn ungrouped(&self) -> Range<u32> {
        self.ungrouped.clone()
    }

    /// The triangles of no group.
    pub(crate) fn ungrouped_triangles(&self) -> &[u32] {
        let range = self.ungrouped.start as usize..self.ungrouped.end as usize;
        self.order.get(range).unwrap_or_default()
    }

    /// The triangles of a group.
    #[must_use]
    pub fn triangles(&self, group: &Group) -> &[u32] {
        let range = group.triangles.start as usize..group.triangles.end as usize;
        self.order.get(range).unwrap_or_default()
    }

    /// A hierarchy from parts that are known to fit together.
    pub(crate) fn from_parts(parts: HierarchyParts) -> Self {
        let HierarchyParts {
            sectors,
            groups,
            regions,
            roots,
            order,
            ungrouped,
        } = parts;
        Self {
            lookup: SectorLookup::new(&sectors),
            bounds: SectorBound::each(&regions, sectors.reaches()),
            start: start(&groups, &regions, sectors.rows(), &roots),
            sectors,
            groups,
            regions,
            roots,
            order,
            ungrouped,
        }
    }

    /// The sectors by direction.
    pub(crate) fn sector_lookup(&self) -> &SectorLookup {
        &self.lookup
    }

    /// The bounds of a group's regions, one for each sector.
    pub(crate) fn bounds(&self, group: u32) -> &[SectorBound] {
        let count = self.sectors.count() as usize;
        let first = group as usize * count;
        self.bounds.get(first..first + count).unwrap_or_default()
    }

    /// The groups that a traversal starts with, in order. Those above them are hidden from nowhere.
    pub(crate) fn start(&self) -> &[u32] {
        &self.start
    }

    /// The regions that a group is hidden from: for each sector, one for each reach. In a sector it is hidden from the union of its regions.
    #[must_use]
    pub fn regions(&self, group: u32) -> &[Region] {
        let rows = self.sectors.rows();
        let first = group as usize * rows;
        self.regions.get(first..first + rows).unwrap_or_default()
    }
}

/// The groups that a traversal starts with. Each group comes before its children, and has `rows` regions.
fn start(groups: &[Group], regions: &[Region], rows: usize, roots: &[u32]) -> Vec<u32> {
    let mut reached = vec![false; groups.len()];
    let reach = |reached: &mut [bool], group: u32| {
        if let Some(reached) = reached.get_mut(group as usize) {
            *reached = true;
        }
    };
    roots.iter().for_each(|root| reach(&mut reached, *root));
    let mut found = Vec::new();
    for ((number, group), row) in groups.iter().enumerate().zip(regions.chunks(rows)) {
        if !reached[number] {
            continue;
        }
        if group.is_leaf() || row.iter().any(|region| !region.is_empty()) {
            found.push(number as u32);
        } else {
            group
                .children
                .iter()
                .for_each(|child| reach(&mut reached, *child));
        }
    }
    found
}
