//! The scene `turbine`: an aero engine, cut open. Fan, compressor, combustor and turbine lie inside casings with
//! openings; pipes and brackets lie around them.
//!
//! Its two sizes have the triangle counts of the engines in Mansa, Amundarain, Garcia-Alonso, Matey, *Occlusion
//! culling for stereoscopic display of complex mechanical sets*, 2007: models that are seen whole from outside and
//! are not densely occluded. The engine is about 4 m long and 3 m wide. Its axis is X with the inlet at -X; its
//! centre is the origin.

mod accessory;
mod airfoil;
mod assembly;
mod blade;
mod bracket;
mod casing;
mod casing_surface;
mod combustor;
mod disc;
mod environment;
mod fastener;
mod liner;
mod materials;
mod pipe;
mod plan;
mod shaft;
mod spinner;
mod vane;

use crate::error::DemoSceneError;
use antumbra_scene::Scene;
use assembly::Assembly;
use plan::PLANS;

/// Size of the engine and seed of its pipes and brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurbineOptions {
    /// 1: 2,000 drawable entities with 1.6 million triangles in all. 2: 4,000 with 2.9 million.
    pub size: u32,
    /// Seed of the routes of the pipes and the places of the brackets. One seed gives the same scene; between
    /// platforms coordinates may differ in the last bits, because sine functions do.
    pub seed: u64,
}

impl Default for TurbineOptions {
    fn default() -> Self {
        Self { size: 1, seed: 1 }
    }
}

/// Builds an aero engine of thousands of parts, with four point lights and a workshop as its environment map.
/// Repeated parts share their mesh; triangle counts are those of all placed parts. Every part is one closed solid or
/// several.
///
/// # Errors
/// [`DemoSceneError::NoSuchSize`] for a size other than 1 and 2.
pub fn turbine(options: TurbineOptions) -> Result<Scene, DemoSceneError> {
    let sizes = 1..=PLANS.len() as u32;
    let plan = (options.size.checked_sub(1)).and_then(|i| PLANS.get(i as usize));
    let Some(plan) = plan else {
        return Err(DemoSceneError::NoSuchSize {
            name: "turbine",
            size: options.size,
            sizes,
        });
    };
    let mut engine = Assembly::new("turbine")?;
    blade::add(&mut engine, plan)?;
    vane::add(&mut engine, plan)?;
    disc::add(&mut engine, plan)?;
    shaft::add(&mut engine, plan)?;
    spinner::add(&mut engine, plan)?;
    combustor::add(&mut engine, plan)?;
    casing::add(&mut engine, plan)?;
    fastener::add(&mut engine, plan)?;
    pipe::add(&mut engine, plan, options.seed)?;
    bracket::add(&mut engine, plan, options.seed)?;
    accessory::add(&mut engine, plan)?;
    liner::add(&mut engine, plan)?;
    Ok(engine.finish())
}
