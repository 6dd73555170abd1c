//! Entities that come, go and move while answers are under way.

use antumbra_scene::EntityKey;
use glam::{DAffine3, DVec3};

use super::chance;
use crate::kit::failure::ViolationKind;
use crate::kit::play::{Bench, Play};
use crate::kit::props::{Props, camera, placed, put};

const HIDDEN: DVec3 = DVec3::new(0.0, 0.0, -3.0);
const IN_SIGHT: DVec3 = DVec3::new(0.3, 0.2, 2.0);

/// A wall, some spheres hidden behind it, and one in sight.
fn walled(props: &mut Props) -> Result<Vec<EntityKey>, ViolationKind> {
    props.cube(DVec3::ZERO, DVec3::new(5.0, 4.0, 0.3))?;
    props.sphere(DVec3::new(-1.5, 0.0, 1.0), 0.6)?;
    let hidden = (0..3).map(|i| props.sphere(HIDDEN + DVec3::X * f64::from(i), 0.6));
    Ok(hidden.collect::<Result<_, _>>()?)
}

pub(super) fn slot_reuse(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    let hidden = walled(&mut props)?;
    let (sphere, paint) = (props.shapes.sphere, props.paints.opaque[2]);
    let mut play = Play::new(bench, props.scene)?;
    let camera = camera(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO)?;
    for _ in 0..3 {
        play.frame(&camera)?;
    }
    // Its slot is free and taken again before the same frame, with a frame between, and two for two.
    for (gap, gone) in [
        (false, &hidden[..1]),
        (true, &hidden[1..2]),
        (false, &hidden[2..]),
    ] {
        for entity in gone {
            play.scene.despawn(*entity);
        }
        if gap {
            play.frame(&camera)?;
        }
        for i in 0..gone.len() {
            let place = IN_SIGHT + DVec3::new(i as f64, if gap { -1.0 } else { 0.0 }, 0.0);
            let place = placed(place, DVec3::splat(0.6));
            put(&mut play.scene, sphere, paint, place)?;
        }
        play.frame(&camera)?;
        play.frame(&camera)?;
    }
    Ok(())
}

pub(super) fn motion(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    let hidden = walled(&mut props)?;
    let mut play = Play::new(bench, props.scene)?;
    let camera = camera(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO)?;
    play.frame(&camera)?;
    for step in 0..5 {
        let t = f64::from(step);
        // Out to the side; through the wall; and into its mirror image, hidden still.
        let to = [
            placed(HIDDEN + DVec3::X * (t * 1.2), DVec3::splat(0.6)),
            placed(HIDDEN + DVec3::Z * (t * 1.2), DVec3::splat(0.6)),
            placed(
                HIDDEN,
                DVec3::new(if step % 2 == 0 { 0.6 } else { -0.6 }, 0.6, 0.6),
            ),
        ];
        for (entity, to) in hidden.iter().zip(to) {
            play.scene.set_local(*entity, to)?;
        }
        play.frame(&camera)?;
    }
    Ok(())
}

pub(super) fn empty(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let props = Props::new()?;
    let (sphere, paint) = (props.shapes.sphere, props.paints.opaque[0]);
    let mut play = Play::new(bench, props.scene)?;
    let camera = camera(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO)?;
    play.frame(&camera)?;
    play.frame(&camera)?;
    let only = put(&mut play.scene, sphere, paint, DAffine3::IDENTITY)?;
    play.frame(&camera)?;
    play.frame(&camera)?;
    play.scene.despawn(only);
    play.frame(&camera)?;
    play.frame(&camera)
}

pub(super) fn outgrow(bench: &mut Bench<'_>) -> Result<(), ViolationKind> {
    let mut props = Props::new()?;
    props.cube(DVec3::ZERO, DVec3::new(3.0, 3.0, 0.3))?;
    let mut random = chance(bench, 400);
    let mut more = Props::new()?;
    more.strew(&mut random, 48)?;
    // The same shapes in the same order: what one scene's keys name, the other's name too.
    let waiting: Vec<_> = more
        .scene
        .drawables()
        .filter_map(|(entity, drawable)| Some((drawable, more.scene.local(entity)?)))
        .collect();
    let mut play = Play::new(bench, props.scene)?;
    let camera = camera(DVec3::new(1.0, 2.0, 7.0), DVec3::ZERO)?;
    play.frame(&camera)?;
    for some in waiting.chunks(24) {
        for (drawable, place) in some {
            put(&mut play.scene, drawable.mesh, drawable.material, *place)?;
        }
        play.frame(&camera)?;
        play.frame(&camera)?;
    }
    Ok(())
}
