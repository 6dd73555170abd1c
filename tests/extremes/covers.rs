//! The limit between covered and visible: exact covers, a hole of one pixel, grains smaller than a pixel, and coplanar twins.

use antumbra::cull::{Verdict, Verdicts};
use antumbra::scene::EntityKey;
use antumbra_testing::{SceneBuilder, gpus, over_pixels, placed};
use glam::DVec3;

use crate::play::{Play, id_of, strategies};

const SIZE: [u32; 2] = [64, 48];

/// The verdicts of one slot in all frames and views of a run.
fn said_of(frames: &[Vec<Verdicts>], slot: u32) -> impl Iterator<Item = Verdict> {
    frames.iter().flatten().map(move |view| view.get(slot))
}

/// The slot of an entity. Slots follow the order of spawning, without lights, and are the same on every backend.
fn slot(play: &Play, entity: EntityKey) -> u32 {
    let [gpu, _] = gpus();
    id_of(&play.seen(gpu).0, Some(entity)) - 1
}

#[test]
fn an_occluder_that_ends_where_the_occludee_ends() {
    let mut set = SceneBuilder::new();
    let size = DVec3::new(20.0, 16.0, 1.0);
    // Aligned with the pixel grid, and off it.
    let mut hidden = Vec::new();
    for place in [DVec3::new(-16.0, 0.0, -20.0), DVec3::new(16.3, 0.4, -20.0)] {
        set.cube(place, size);
        hidden.push(set.cube(place - DVec3::Z * 30.0, size));
    }
    let eye = |x: f64| over_pixels(DVec3::new(x, 0.0, 0.0), SIZE);
    let mut play = Play::new(set.scene, vec![eye(0.0), eye(0.5)]);
    play.apart = 0.25;
    play.agrees_with_the_twin(0.8, 3);
    let runs = play.is_right();
    // A correct image does not forbid drawing the hidden boxes; exact strategies find that no sample of them is visible.
    for entity in hidden {
        let slot = slot(&play, entity);
        for (strategy, frames) in &runs {
            if strategy.contains("three-pass") || strategy.contains("ideal") {
                assert!(
                    said_of(frames, slot).all(|verdict| verdict == Verdict::Occluded),
                    "{strategy}"
                );
            }
        }
    }
}

#[test]
fn what_shows_through_a_hole_of_one_pixel_is_drawn() {
    // Four walls around one pixel: the first to the right of the image's centre and above it.
    let mut set = SceneBuilder::new();
    for (x, y, wide, high) in [
        (-10.0, 0.5, 20.0, 41.0),
        (11.0, 0.5, 20.0, 41.0),
        (0.5, -9.5, 1.0, 19.0),
        (0.5, 10.5, 1.0, 19.0),
    ] {
        set.cube(DVec3::new(x, y, -20.0), DVec3::new(wide, high, 1.0));
    }
    let behind = set.ball(DVec3::new(0.5, 0.5, -50.0), 18.0);
    let hidden = set.ball(DVec3::new(-10.0, 0.5, -50.0), 6.0);
    let mut play = Play::new(set.scene, vec![over_pixels(DVec3::ZERO, SIZE); 2]);
    play.apart = 0.0;
    play.agrees_with_the_twin(0.9, 6);
    let [vulkan, gl] = gpus();
    for gpu in [vulkan, gl] {
        let (scene, images) = play.seen(gpu);
        let id = id_of(&scene, Some(behind));
        let owned = images[0].ids.iter().filter(|one| **one == id).count();
        assert_eq!(owned, 1);
        assert_eq!(images[0].ids[23 * 64 + 32], id);
    }
    let runs = play.is_right();
    let (behind, hidden) = (slot(&play, behind), slot(&play, hidden));
    for (strategy, frames) in &runs {
        assert!(said_of(frames, behind).all(Verdict::draws), "{strategy}");
        if strategy.contains("three-pass") || strategy.ends_with("ideal") {
            assert!(
                said_of(frames, hidden).all(|verdict| !verdict.draws()),
                "{strategy}"
            );
        }
    }
    assert_eq!(runs.len(), 2 * strategies().len());
}

#[test]
fn dust_of_a_hundredth_of_a_pixel_adds_up_to_a_surface() {
    // A sheet of six by six pixels, made of grains a tenth of a pixel wide. Each overlaps the next by a hundredth of a pixel, so that vertex
    // snapping leaves no crack.
    let mut set = SceneBuilder::plain();
    let across = 60;
    for row in 0..across {
        for column in 0..across {
            let at = |i: i32| (f64::from(i) + 0.5) * 0.1 - 3.0;
            let place = DVec3::new(at(column), at(row), -20.0);
            let size = DVec3::new(0.11, 0.11, 1.0);
            set.put(set.square, placed(place, size));
        }
    }
    let hidden = set.ball(DVec3::new(0.0, 0.0, -50.0), 5.0);
    let seen = set.ball(DVec3::new(10.0, 0.0, -50.0), 5.0);
    let mut play = Play::new(set.scene, vec![over_pixels(DVec3::ZERO, SIZE)]);
    play.apart = 0.25;
    let [vulkan, gl] = gpus();
    for gpu in [vulkan, gl] {
        let (scene, images) = play.seen(gpu);
        let grains = 1..=(across * across) as u32;
        let surface = (0..6).flat_map(|y| (0..6).map(move |x| (21 + y) * 64 + 29 + x));
        for pixel in surface {
            assert!(grains.contains(&images[0].ids[pixel]), "pixel {pixel}");
        }
        let owns = |entity| images[0].ids.contains(&id_of(&scene, Some(entity)));
        assert!(!owns(hidden) && owns(seen));
    }
    let runs = play.is_right();
    // Thousands of grains own no pixel: a strategy that tests them at full resolution draws few.
    for (strategy, frames) in &runs {
        if strategy.contains("three-pass") || strategy.contains("ideal") {
            let drawn = frames[0][0].drawn().count();
            assert!((37..200).contains(&drawn), "{strategy}: {drawn}");
        }
    }
}

/// Surfaces at equal depth: two equal cubes in one place, a square on the face of a cube, and two squares that overlap in one plane. One ball
/// is hidden behind them. Returns the play, the entities that tie, and the hidden one.
fn twins(mut set: SceneBuilder) -> (Play, Vec<EntityKey>, EntityKey) {
    let size = DVec3::new(12.0, 12.0, 4.0);
    let place = DVec3::new(-16.0, 0.0, -20.0);
    let mut tied = vec![set.cube(place, size), set.cube(place, size)];
    let plane = DVec3::new(8.0, 0.0, -18.0);
    tied.push(set.cube(plane - DVec3::Z * 2.0, size));
    let flat = placed(plane + DVec3::X, DVec3::new(6.0, 6.0, 1.0));
    tied.push(set.put(set.square, flat));
    let beside = placed(plane + DVec3::X * 9.0, DVec3::new(10.0, 6.0, 1.0));
    tied.push(set.put(set.square, beside));
    let hidden = set.ball(place - DVec3::Z * 30.0, 5.0);
    let frames = [0.0, 0.3].map(|x| over_pixels(DVec3::X * x, SIZE));
    let mut play = Play::new(set.scene, frames.to_vec());
    play.apart = 0.25;
    (play, tied, hidden)
}

#[test]
fn twins_in_one_place_and_at_equal_depth() {
    let (play, tied, hidden) = twins(SceneBuilder::plain());
    let runs = play.is_right();
    let tied: Vec<u32> = tied.into_iter().map(|entity| slot(&play, entity)).collect();
    let hidden = slot(&play, hidden);
    for (strategy, frames) in &runs {
        // All entities at equal depth count as visible; only a strategy that knows the owners of the pixels culls the others.
        let knows = strategy.ends_with("ideal") || strategy.contains("three-pass:latency=same");
        for slot in &tied {
            assert!(
                knows || said_of(frames, *slot).all(Verdict::draws),
                "{strategy}: {slot}"
            );
        }
        if knows || strategy.contains("three-pass") {
            assert!(
                said_of(frames, hidden).all(|verdict| !verdict.draws()),
                "{strategy}"
            );
        }
    }
}

/// The twins have different colours here.
#[test]
fn twins_show_the_same_to_all_that_shade_one_list() {
    let (play, ..) = twins(SceneBuilder::new());
    let one_list = ["none", "frustum", "ideal", "three-pass"];
    let mut strategies = strategies();
    strategies.retain(|text| one_list.iter().any(|name| text.starts_with(name)));
    assert_eq!(strategies.len(), 5);
    play.is_right_by(&strategies);
}
