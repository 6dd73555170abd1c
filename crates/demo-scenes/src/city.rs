//! A city of streets, blocks and houses, with rooms and furniture behind the windows and vehicles in the streets.
//!
//! It stands in for the artificial city of Staneker, Bartz, Straßer, *Efficient multiple occlusion queries for scene graph
//! systems*, 2004: as many triangles, a high depth complexity, and racing cars among the houses. At its default size it is
//! 666 m wide and long around the origin; the roads lie at y = 0.

mod block;
mod facade;
mod form;
mod furnish;
mod green;
mod house;
mod kit;
mod look;
mod outdoor;
mod piece;
mod plan;
mod roof;
mod storey;
mod street;
mod vehicle;
mod window;

use super::DemoSceneError;
use super::chance::{Chance, For};
use antumbra_scene::Scene;
use kit::Kit;
use plan::{Plan, SIZES};

/// How large the city is and how its chance falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CityOptions {
    /// Blocks along an edge, 1 to 16. The default, 7, has 64.9 million triangles.
    pub size: u32,
    /// Seed of everything that differs from house to house and from street to street; the same seed gives the same scene. Triangles
    /// differ by less than 1 % from seed to seed.
    pub seed: u64,
}

impl Default for CityOptions {
    fn default() -> Self {
        Self { size: 7, seed: 1 }
    }
}

/// A city as an architect's file has it: quarters, blocks, lots, houses, storeys, rooms and what stands in them; streets, vehicles, their
/// assemblies and parts. Inner nodes are entities without a drawable, and every leaf but the sun is drawable. What repeats shares its mesh;
/// triangles are counted as they are placed. One directional light, fifteen opaque materials.
///
/// # Errors
/// [`DemoSceneError::NoSuchSize`] for a size other than 1 to 16.
pub fn city(options: CityOptions) -> Result<Scene, DemoSceneError> {
    if !SIZES.contains(&options.size) {
        return Err(DemoSceneError::NoSuchSize {
            name: "city",
            size: options.size,
            sizes: SIZES,
        });
    }
    let plan = Plan::new(options.size as usize);
    let chance = |what| Chance::new(options.seed, what);
    let mut kit = Kit::new("city")?;
    let mut lots = block::Lots::dealt(&plan, &mut chance(For::Blocks), &mut chance(For::Houses));
    let mut rooms = chance(For::Rooms);
    let mut gardens = chance(For::Gardens);
    let mut streets = street::Traffic::dealt(&plan, chance(For::Streets));
    for quarter in plan.quarters() {
        let name = format!("quarter {}", quarter.number);
        let node = kit.node(kit.city(), &name, plan.quarter_place(&quarter))?;
        for place in plan.blocks(&quarter) {
            block::add(&mut kit, node, &place, &mut lots, &mut rooms, &mut gardens)?;
        }
        for street in plan.streets(&quarter) {
            street::add(&mut kit, node, &street, &mut streets)?;
        }
    }
    Ok(kit.finish())
}
