//! The scene `city`: streets, blocks and houses, with rooms and furniture behind the windows and vehicles in the
//! streets.
//!
//! It resembles the artificial city of Staneker, Bartz, Straßer, *Efficient multiple occlusion queries for scene
//! graph systems*, 2004: the same number of triangles, a high depth complexity, and racing cars among the houses. At
//! its default size it is 666 m wide and long around the origin; the roads lie at y = 0.

mod block;
mod city_builder;
mod facade;
mod furnish;
mod furniture;
mod house;
mod materials;
mod plan;
mod roof;
mod shapes;
mod storey;
mod street;
mod street_furniture;
mod vegetation;
mod vehicle;
mod window;

use crate::error::DemoSceneError;
use crate::random::{Random, Stream};
use antumbra_scene::Scene;
use city_builder::CityBuilder;
use plan::{Plan, SIZES};

/// Size and seed of the city.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CityOptions {
    /// Blocks along an edge, 1 to 16. The default, 7, has 64.9 million triangles.
    pub size: u32,
    /// Seed of all differences between houses and between streets; one seed gives one scene. The number of triangles
    /// differs by less than 1 % between seeds.
    pub seed: u64,
}

impl Default for CityOptions {
    fn default() -> Self {
        Self { size: 7, seed: 1 }
    }
}

/// Builds a city with the hierarchy of an architect's model: quarters, blocks, lots, houses, storeys, rooms,
/// furniture; streets, vehicles, their assemblies and parts. Inner nodes are entities without a drawable; every leaf
/// except the sun is drawable. Repeated parts share their mesh; triangle counts are those of all placed parts. The
/// scene has one directional light and fifteen opaque materials.
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
    let random = |what| Random::new(options.seed, what);
    let mut city = CityBuilder::new("city")?;
    let mut lots = block::Lots::new(
        &plan,
        &mut random(Stream::Blocks),
        &mut random(Stream::Houses),
    );
    let mut rooms = random(Stream::Rooms);
    let mut gardens = random(Stream::Gardens);
    let mut streets = street::Traffic::new(&plan, random(Stream::Streets));
    for quarter in plan.quarters() {
        let name = format!("quarter {}", quarter.number);
        let node = city.node(city.city(), &name, plan.quarter_place(&quarter))?;
        for place in plan.blocks(&quarter) {
            block::add(&mut city, node, &place, &mut lots, &mut rooms, &mut gardens)?;
        }
        for street in plan.streets(&quarter) {
            street::add(&mut city, node, &street, &mut streets)?;
        }
    }
    Ok(city.finish())
}
