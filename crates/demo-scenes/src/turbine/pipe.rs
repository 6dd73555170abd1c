//! Pipes on the outside. Each leaves the casing, runs along the axis, rises, runs around the engine over a flange,
//! and returns in the same way at another angle. It has bosses at its ends and clamps along it. Routes are random,
//! and no two pipes share one.

use super::assembly::{Assembly, Part, shifted};
use super::casing_surface::{CASING_SURFACES, CasingSurface, standing};
use super::fastener::stud;
use super::materials::MaterialKind;
use super::plan::{Plan, radius_at};
use crate::random::{Random, Stream};
use crate::solid::{Solid, polar};
use crate::tube::{direction, rounded_path};
use antumbra_scene::SceneError;
use glam::{DAffine3, DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// Pipe types: radius in metres, name, material.
const KINDS: [(&str, MaterialKind, f64); 3] = [
    ("fuel pipe", MaterialKind::Steel, 0.007),
    ("oil pipe", MaterialKind::Copper, 0.0095),
    ("harness", MaterialKind::Hose, 0.011),
];
/// Heights above the casing, clear of the flanges. The lower ones are for runs along the axis, the upper ones for
/// runs around it, so that pipes cross without touching. The gap between the two leaves room for bends.
const LEVELS: [f64; 6] = [0.056, 0.08, 0.142, 0.166, 0.19, 0.214];
/// Number of heights for runs along the axis.
const ALONG: usize = 2;
/// Sides of a pipe.
const SIDES: usize = 12;
/// Radius of bends in metres.
const BEND: f64 = 0.045;
/// Minimum length of a run along the axis or around it.
const SHORTEST: f64 = 0.12;

/// Adds the pipes, a third of them on the fan casing, and their clamps.
pub(super) fn add(engine: &mut Assembly, plan: &Plan, seed: u64) -> Result<(), SceneError> {
    let mut random = Random::new(seed, Stream::Pipes);
    let mut clamps = Vec::new();
    for (name, _, radius) in KINDS {
        for height in LEVELS {
            let name = format!("{name}'s clamp");
            clamps.push((name, radius, height, None));
        }
    }
    let mut routes = CASING_SURFACES.map(|surface| Routes::new(surface, &mut random));
    engine.module("pipes")?;
    for pipe in 0..plan.pipes {
        let routes = &mut routes[usize::from(pipe % 3 != 0)];
        let kind = random.pick(KINDS.len());
        let (name, material, radius) = KINDS[kind];
        let way = routes.way(plan.pipe_steps, &mut random);
        let mut solid = Solid::default();
        solid.tube(&way, radius, SIDES);
        boss(&mut solid, &way, radius);
        engine.place_single(&format!("{name} {}", pipe + 1), material, solid)?;
        for i in 1..=plan.clamps {
            let at = i * (way.len() - 1) / (plan.clamps + 1);
            let (at, level) = nearest_level(&routes.surface, &way, at);
            let (name, radius, height, made) = &mut clamps[kind * LEVELS.len() + level];
            let part = match made {
                Some(part) => part,
                None => {
                    let solid = clamp(*radius, *height);
                    made.insert(engine.part(name, MaterialKind::Clamp, solid)?)
                }
            };
            hold(engine, part, &way, at)?;
        }
    }
    Ok(())
}

/// The routes on a casing that are still free.
struct Routes {
    surface: CasingSurface,
    /// Routes around the axis: x and height.
    rounds: Vec<(f64, f64)>,
    /// Routes along the axis: angle and height.
    lanes: Vec<(f64, f64)>,
}

impl Routes {
    fn new(surface: CasingSurface, random: &mut Random) -> Self {
        let (along, around) = LEVELS.split_at(ALONG);
        let with = |places: &[f64], heights: &[f64]| -> Vec<(f64, f64)> {
            let every = places
                .iter()
                .map(|place| heights.iter().map(|h| (*place, *h)));
            every.flatten().collect()
        };
        let mut rounds = with(surface.rounds, around);
        let mut lanes = with(&surface.angles(), along);
        random.shuffle(&mut rounds);
        random.shuffle(&mut lanes);
        Self {
            surface,
            rounds,
            lanes,
        }
    }

    /// A path of `count` points over the casing, from inside its wall and back.
    fn way(&mut self, steps: usize, random: &mut Random) -> Vec<DVec3> {
        let (round, high) = self
            .rounds
            .pop()
            .unwrap_or((self.surface.x[0], LEVELS[ALONG]));
        let mut place = || {
            let x = random.between(self.surface.x[0], self.surface.x[1]);
            let away = (x - round).abs().max(SHORTEST).copysign(x - round);
            // The path reverses where it would leave the casing.
            let ends = self.surface.x[0]..=self.surface.x[1];
            let there = round + away;
            let kept = ends.contains(&there);
            self.surface
                .beside_flanges(if kept { there } else { round - away })
        };
        let ends = [place(), place()];
        let from = self.lanes.pop().unwrap_or((0.0, LEVELS[0]));
        let far = |lane: &(f64, f64)| turn(from.0, lane.0).abs() * self.surface.radius > SHORTEST;
        let far = self.lanes.iter().rposition(far);
        let to = far.map_or((PI, LEVELS[0]), |lane| self.lanes.remove(lane));
        // Bends are rounded in unrolled coordinates: along the axis, around, above.
        let around = turn(from.0, to.0) * self.surface.radius;
        let [start, end] = ends;
        let corners = [
            DVec3::new(start, 0.0, -0.015),
            DVec3::new(start, 0.0, from.1),
            DVec3::new(round, 0.0, from.1),
            DVec3::new(round, 0.0, high),
            DVec3::new(round, around, high),
            DVec3::new(round, around, to.1),
            DVec3::new(end, around, to.1),
            DVec3::new(end, around, -0.015),
        ];
        let flat = rounded_path(&corners, BEND, steps);
        let rolled = flat.iter().map(|place| {
            let radius = radius_at(self.surface.outer, place.x) + place.z;
            polar(place.x, radius, from.0 + place.y / self.surface.radius)
        });
        rolled.collect()
    }
}

/// The shorter rotation from one angle to another.
fn turn(from: f64, to: f64) -> f64 {
    (to - from + PI).rem_euclid(TAU) - PI
}

/// The index nearest to `at` where the path keeps its height, and that height.
fn nearest_level(surface: &CasingSurface, way: &[DVec3], at: usize) -> (usize, usize) {
    let level = |place: &DVec3| {
        let height = away(place) - radius_at(surface.outer, place.x);
        LEVELS
            .iter()
            .position(|level| (height - level).abs() < 1e-6)
    };
    let kept = way.iter().enumerate();
    let kept = kept.filter_map(|(i, place)| Some((i, level(place)?)));
    let nearest = kept.min_by_key(|(i, _)| i.abs_diff(at));
    nearest.unwrap_or((at, 0))
}

/// Distance from the engine's axis.
fn away(place: &DVec3) -> f64 {
    place.y.hypot(place.z)
}

/// The bosses at both ends of a pipe.
fn boss(solid: &mut Solid, way: &[DVec3], radius: f64) {
    let mut boss = Solid::default();
    boss.cylinder(2.2 * radius, [0.0, 0.026], 18);
    boss.prism(1.8 * radius, [0.026, 0.04], 6);
    for end in way.first().into_iter().chain(way.last()) {
        let turn = DAffine3::from_rotation_x(end.z.atan2(end.y));
        solid.add(&boss, turn * shifted(end.x, away(end)) * standing());
    }
}

/// Places a clamp on a pipe.
fn hold(
    engine: &mut Assembly,
    clamp: &mut Part,
    way: &[DVec3],
    at: usize,
) -> Result<(), SceneError> {
    let (place, along) = (way[at], direction(way, at));
    let outwards = DVec3::new(0.0, place.y, place.z).normalize_or(DVec3::Y);
    let up = outwards
        .reject_from_normalized(along)
        .normalize_or(outwards);
    let turned = DMat3::from_cols(along, up, along.cross(up));
    engine.place(clamp, DAffine3::from_mat3_translation(turned, place))
}

/// A band around a pipe along X, on a leg `height` metres long with a foot and a stud.
fn clamp(radius: f64, height: f64) -> Solid {
    let mut solid = Solid::default();
    solid.band([-0.008, 0.008], [radius, radius + 0.004], 16);
    let side = radius + 0.004;
    let low = [-0.008, -height - 0.004, side - 0.003];
    solid.cuboid(low, [0.008, 0.0, side]);
    let low = [-0.012, -height - 0.006, side - 0.003];
    solid.cuboid(low, [0.012, 0.0035 - height, side + 0.03]);
    let foot = DVec3::new(0.0, 0.0035 - height, side + 0.015);
    let foot = DAffine3::from_translation(foot);
    solid.add(&stud(0.007, 0.0), foot * standing());
    solid
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::turbine::plan::PLANS;

    #[test]
    fn there_is_a_place_for_every_pipe() {
        for plan in PLANS {
            let mut random = Random::new(1, Stream::Pipes);
            let on_fan = plan.pipes.div_ceil(3);
            let pipes = [on_fan, plan.pipes - on_fan];
            for (surface, pipes) in CASING_SURFACES.into_iter().zip(pipes) {
                let routes = Routes::new(surface, &mut random);
                assert!(routes.rounds.len() >= pipes, "{}", routes.rounds.len());
                assert!(routes.lanes.len() >= 2 * pipes, "{}", routes.lanes.len());
            }
        }
    }
}
