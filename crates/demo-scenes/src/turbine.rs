//! An aero engine, cut open: fan, compressor, combustor and turbine inside casings with openings, pipes and brackets around them.
//!
//! Its two sizes have as many triangles as the engines of Mansa, Amundarain, Garcia-Alonso, Matey, *Occlusion culling for stereoscopic
//! display of complex mechanical sets*, 2007: sets that are seen whole from outside and are not densely occluded. The engine is
//! about 4 m long and 3 m wide, its axis lies along X with the inlet at -X, and its middle is the origin.

mod accessory;
mod airfoil;
mod assembly;
mod blade;
mod bracket;
mod casing;
mod combustor;
mod disc;
mod fastener;
mod liner;
mod look;
mod pipe;
mod plan;
mod shaft;
mod skin;
mod spinner;
mod vane;
mod workshop;

use super::DemoSceneError;
use antumbra_scene::Scene;
use assembly::Assembly;
use plan::PLANS;

/// How large the engine is and how its chance falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurbineOptions {
    /// 1: 2,000 drawable entities of 1.6 million triangles together. 2: 4,000 of 2.9 million.
    pub size: u32,
    /// Seed of the pipes' ways and the brackets' places; the same seed gives the same scene, and on other platforms one that differs at
    /// most in the last bits, as their sines do.
    pub seed: u64,
}

impl Default for TurbineOptions {
    fn default() -> Self {
        Self { size: 1, seed: 1 }
    }
}

/// An aero engine of thousands of parts, four positional lights and a workshop around it that its metal reflects. Parts that repeat share their mesh; triangles are counted
/// as they are placed. Every part is a closed solid of its own, or several in one.
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
