//! Numbers of entities: none, one, exactly as many as a query set has queries, one more, and a hundred thousand.

use antumbra_testing::{SceneBuilder, look_at, perspective_degrees, placed};
use glam::DVec3;

use crate::play::{Play, strategies};

/// `count` squares that face the camera. The first is a wall that covers the left half and hides most of the others there.
fn crowd(count: u32) -> Play {
    let mut set = SceneBuilder::new();
    let wide = f64::from(count).sqrt().ceil() as u32;
    for number in 0..count {
        let along = |i: u32| (f64::from(i) + 0.5) / f64::from(wide.max(1)) - 0.5;
        let place = DVec3::new(along(number % wide), along(number / wide), -1.0) * 40.0;
        let size = 30.0 / f64::from(wide);
        let place = if number == 0 {
            // The wall.
            placed(DVec3::new(-5.0, 0.0, -20.0), DVec3::new(10.0, 30.0, 1.0))
        } else {
            placed(place, DVec3::splat(size))
        };
        set.put(set.square, place);
    }
    let camera = look_at(DVec3::ZERO, DVec3::NEG_Z, perspective_degrees(60.0, 0.1));
    let mut play = Play::new(set.scene, vec![camera; 2]);
    play.apart = 0.0;
    play
}

#[test]
fn no_entity_and_one() {
    for count in [0, 1] {
        let play = crowd(count);
        play.agrees_with_the_twin(0.9, 1 + count as usize);
        for (strategy, frames) in play.is_right() {
            let drawn = frames[1][0].drawn().count();
            assert_eq!(drawn, count as usize, "{strategy}");
        }
    }
}

/// The strategies that use hardware queries, with as many as possible in one batch.
fn asking() -> Vec<String> {
    let exact = "threshold=0:scale=1:coarser=0:occluders=full:occludees=full";
    let mut asking = vec![
        "stop-and-wait:batch=4096".to_owned(),
        format!("three-pass:latency=same-frame:counting=queries:{exact}"),
    ];
    let strategies = strategies();
    asking.extend(
        strategies
            .into_iter()
            .filter(|text| text.contains("same-frame") && !text.starts_with("three-pass")),
    );
    asking
}

#[test]
fn as_many_entities_as_a_set_has_queries_and_one_more() {
    for count in [4096, 4097] {
        let play = crowd(count);
        let runs = play.is_right_by(&asking());
        for (strategy, frames) in &runs {
            let verdicts = &frames[1][0];
            if strategy.contains("three-pass") {
                // Each entity has a query, also the last one, and the hidden ones are culled.
                assert_eq!(verdicts.tested(), count, "{strategy}");
                let drawn = verdicts.drawn().count();
                assert!(drawn * 4 < count as usize * 3, "{strategy}: {drawn}");
            }
        }
        assert_eq!(runs.len(), 2 * asking().len());
    }
}

#[test]
fn a_hundred_thousand_entities() {
    let mut play = crowd(100_000);
    play.frames.truncate(1);
    let few: Vec<String> = strategies()
        .into_iter()
        .filter(|text| text == "frustum" || text.starts_with("three-pass:latency=same-frame"))
        .collect();
    assert_eq!(few.len(), 2);
    for (strategy, frames) in play.is_right_by(&few) {
        let inside = frames[0][0].drawn().count();
        assert!(inside > 500, "{strategy}: {inside}");
    }
}
