//! Stories about entities that are added, removed and moved while answers are on their way.

use antumbra_scene::EntityKey;
use glam::{DAffine3, DVec3};

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::{TestScene, add, camera, placed};

/// Centre of the first hidden sphere.
const HIDDEN: DVec3 = DVec3::new(0.0, 0.0, -3.0);
/// A place in front of the wall.
const VISIBLE: DVec3 = DVec3::new(0.3, 0.2, 2.0);

/// When the slot of a removed entity is used again.
enum Reuse {
    BeforeNextFrame,
    /// After one frame in which it is free.
    AfterFreeFrame,
}

/// Adds a wall, a visible sphere, and three spheres that the wall hides. Returns the hidden ones.
fn add_wall_and_spheres(test: &mut TestScene) -> Result<Vec<EntityKey>, ViolationKind> {
    test.cube(DVec3::ZERO, DVec3::new(5.0, 4.0, 0.3))?;
    test.sphere(DVec3::new(-1.5, 0.0, 1.0), 0.6)?;
    let hidden = (0..3).map(|i| test.sphere(HIDDEN + DVec3::X * f64::from(i), 0.6));
    Ok(hidden.collect::<Result<_, _>>()?)
}

pub(super) fn slot_reuse(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    let hidden = add_wall_and_spheres(&mut test)?;
    let (sphere, material) = (test.meshes.sphere, test.materials.opaque[2]);
    let mut run = Run::new(context, test.scene)?;
    let camera = camera(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO)?;
    for _ in 0..3 {
        run.frame(&camera)?;
    }
    let reuses = [
        Reuse::BeforeNextFrame,
        Reuse::AfterFreeFrame,
        Reuse::BeforeNextFrame,
    ];
    for (entity, reuse) in hidden.iter().zip(reuses) {
        run.scene.despawn(*entity);
        let centre = match reuse {
            Reuse::BeforeNextFrame => VISIBLE,
            Reuse::AfterFreeFrame => {
                run.frame(&camera)?;
                VISIBLE + DVec3::NEG_Y
            }
        };
        let transform = placed(centre, DVec3::splat(0.6));
        add(&mut run.scene, sphere, material, transform)?;
        run.frame(&camera)?;
        run.frame(&camera)?;
    }
    Ok(())
}

pub(super) fn motion(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    let hidden = add_wall_and_spheres(&mut test)?;
    // A mirror image that is half in the wall: of its box, the far faces are hidden and the near ones show.
    let mirrored = placed(DVec3::new(1.2, 0.9, 0.15), DVec3::new(-0.6, 0.6, 0.6));
    test.add(test.meshes.sphere, test.materials.opaque[1], mirrored)?;
    let mut run = Run::new(context, test.scene)?;
    let camera = camera(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO)?;
    run.frame(&camera)?;
    for step in 0..5 {
        let t = f64::from(step);
        // One moves out to the side, one through the wall; one becomes its mirror image and back, and stays hidden.
        let to = [
            placed(HIDDEN + DVec3::X * (t * 1.2), DVec3::splat(0.6)),
            placed(HIDDEN + DVec3::Z * (t * 1.2), DVec3::splat(0.6)),
            placed(
                HIDDEN,
                DVec3::new(if step % 2 == 0 { 0.6 } else { -0.6 }, 0.6, 0.6),
            ),
        ];
        for (entity, to) in hidden.iter().zip(to) {
            run.scene.set_local(*entity, to)?;
        }
        run.frame(&camera)?;
    }
    Ok(())
}

pub(super) fn empty(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let test = TestScene::new()?;
    let (sphere, material) = (test.meshes.sphere, test.materials.opaque[0]);
    let mut run = Run::new(context, test.scene)?;
    let camera = camera(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO)?;
    run.frame(&camera)?;
    run.frame(&camera)?;
    let only = add(&mut run.scene, sphere, material, DAffine3::IDENTITY)?;
    run.frame(&camera)?;
    run.frame(&camera)?;
    run.scene.despawn(only);
    run.frame(&camera)?;
    run.frame(&camera)
}

pub(super) fn outgrow(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let mut test = TestScene::new()?;
    test.cube(DVec3::ZERO, DVec3::new(3.0, 3.0, 0.3))?;
    let mut random = context.random(400);
    let mut source = TestScene::new()?;
    source.scatter(&mut random, 48)?;
    // Both scenes get the same meshes and materials in the same order, so the keys of one are valid in the other.
    let pending: Vec<_> = source
        .scene
        .drawables()
        .filter_map(|(entity, drawable)| Some((drawable, source.scene.local(entity)?)))
        .collect();
    let mut run = Run::new(context, test.scene)?;
    let camera = camera(DVec3::new(1.0, 2.0, 7.0), DVec3::ZERO)?;
    run.frame(&camera)?;
    for batch in pending.chunks(24) {
        for (drawable, place) in batch {
            add(&mut run.scene, drawable.mesh, drawable.material, *place)?;
        }
        run.frame(&camera)?;
        run.frame(&camera)?;
    }
    Ok(())
}
