//! A drawn box covers every sample of what it holds, at its depth or nearer: on a rasteriser of four bits and on one of eight, whichever way it breaks ties.

use antumbra_scene::Aabb;
use glam::{Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::rasteriser::{Faces, Rasteriser};
use super::world::{BITS, clip_position, mesh_in, place_box, rasteriser, view};
use crate::boxes::{BoxContents, GpuBox, Widening};
use crate::entities::OrientedBox;
use crate::query_detail::is_wide_enough;
use crate::view::ViewFrame;

/// Views that are tried: more of them with the variable `SNAPPING_TRIALS`.
fn trials() -> u64 {
    std::env::var("SNAPPING_TRIALS").map_or(15_000, |text| text.parse().unwrap())
}

/// `FAR_ENDS` of `boxes.wgsl`.
const FAR_ENDS: [u32; 3] = [0x287a, 0x02af, 0x31e3];

/// The triangles of a box as the pass of queries draws it: a strip, of which each second triangle turns the other way.
fn strip(view: &ViewFrame, boxed: &GpuBox) -> Vec<[Vec4; 3]> {
    let [centre, x, y, z]: [Vec3; 4] = bytemuck::cast(*boxed);
    let corner = |number: u32| {
        let [i, j, k] = FAR_ENDS.map(|ends| if ends >> number & 1 == 0 { -1.0 } else { 1.0 });
        clip_position(view, centre + x * i + y * j + z * k)
    };
    let corners: Vec<Vec4> = (0..14).map(corner).collect();
    let triangles = corners.windows(3).zip(0u32..);
    triangles
        .map(|(three, number)| match number % 2 {
            0 => [three[0], three[1], three[2]],
            _ => [three[1], three[0], three[2]],
        })
        .collect()
}

/// The nearest depth of each pixel, where anything is.
struct Image {
    width: u32,
    depths: Vec<Option<f64>>,
}

impl Image {
    fn draw(rasteriser: &Rasteriser, triangles: &[[Vec4; 3]], faces: Faces) -> Self {
        let [width, height] = rasteriser.size;
        let mut depths = vec![None; (width * height) as usize];
        for triangle in triangles {
            rasteriser.triangle(*triangle, faces, |fragment| {
                let [x, y] = fragment.pixel;
                let place: &mut Option<f64> = &mut depths[(y * width + x) as usize];
                *place = Some(place.map_or(fragment.depth, |depth| depth.max(fragment.depth)));
            });
        }
        Self { width, depths }
    }
}

/// Asserts that a drawn box covers what it holds. Returns the number of samples.
fn covers(rasteriser: &Rasteriser, mesh: &[[Vec4; 3]], boxed: &[[Vec4; 3]], what: &str) -> usize {
    let mesh = Image::draw(rasteriser, mesh, Faces::Both);
    let boxed = Image::draw(rasteriser, boxed, Faces::Front);
    let mut samples = 0;
    for (at, (inner, outer)) in mesh.depths.iter().zip(&boxed.depths).enumerate() {
        let Some(inner) = inner else { continue };
        samples += 1;
        let pixel = [at as u32 % mesh.width, at as u32 / mesh.width];
        assert!(
            outer.is_some_and(|outer| outer >= *inner),
            "{what}, pixel {pixel:?}: {outer:?} does not cover {inner}; {rasteriser:?}"
        );
    }
    samples
}

/// Plays a trial for each seed, and returns the samples that were compared.
fn play(
    trial: impl Fn(&mut Pcg32, &ViewFrame, &OrientedBox, &[[Vec4; 3]]) -> Option<GpuBox>,
) -> usize {
    let mut samples = 0;
    for seed in 0..trials() {
        let mut random = Pcg32::seed_from_u64(seed);
        let view = view(&mut random);
        for number in 0..8 {
            let Some(place) = place_box(&mut random, &view) else {
                continue;
            };
            let mesh: Vec<_> = mesh_in(&mut random, &view, &place)
                .into_iter()
                .map(|corners| corners.map(|corner| clip_position(&view, corner)))
                .collect();
            let Some(boxed) = trial(&mut random, &view, &place, &mesh) else {
                continue;
            };
            let boxed = strip(&view, &boxed);
            for bits in BITS {
                let rasteriser = rasteriser(&view, bits, &mut random);
                let what = format!("seed {seed}, box {number}");
                samples += covers(&rasteriser, &mesh, &boxed, &what);
            }
        }
    }
    samples
}

#[test]
fn boxes_of_queries_cover_what_they_hold() {
    let samples =
        play(|_, view, place, _| Widening::new(view, BoxContents::Triangles).oriented(place));
    assert!(samples > 100_000, "only {samples} samples");
}

#[test]
fn boxes_of_meshes_cover_them_where_they_are_drawn_instead() {
    let samples = play(|random, view, place, _| {
        // A margin that may be too narrow for the view, and then the mesh itself is drawn.
        let reach = (place.centre - view.camera.position).length();
        let margin = reach * 10f64.powf(random.random_range(-4.5..-1.5));
        let bounds: Aabb = place.bounds();
        if !is_wide_enough(margin, view, &bounds) {
            return None;
        }
        let wider = OrientedBox {
            half: place.half + Vec3::splat(margin as f32),
            ..*place
        };
        Some(unwidened(view, &wider))
    });
    assert!(samples > 20_000, "only {samples} samples");
}

/// A box relative to the eye as it is.
fn unwidened(view: &ViewFrame, place: &OrientedBox) -> GpuBox {
    let [x, y, z] = [0, 1, 2].map(|axis| place.axes[axis] * place.half[axis]);
    let z = if x.cross(y).dot(z) < 0.0 { -z } else { z };
    let centre = (place.centre - view.camera.position).as_vec3();
    GpuBox::new(centre.to_array(), [x, y, z].map(|axis| axis.to_array()))
}

#[test]
fn a_box_without_a_margin_leaves_samples_out() {
    let mut random = Pcg32::seed_from_u64(5);
    let mut left_out = 0;
    for _ in 0..2_000 {
        let view = view(&mut random);
        let Some(place) = place_box(&mut random, &view) else {
            continue;
        };
        let mesh: Vec<_> = mesh_in(&mut random, &view, &place)
            .into_iter()
            .map(|corners| corners.map(|corner| clip_position(&view, corner)))
            .collect();
        let rasteriser = rasteriser(&view, 4, &mut random);
        let boxed = Image::draw(
            &rasteriser,
            &strip(&view, &unwidened(&view, &place)),
            Faces::Front,
        );
        let mesh = Image::draw(&rasteriser, &mesh, Faces::Both);
        let pairs = mesh.depths.iter().zip(&boxed.depths);
        left_out += pairs
            .filter(|(inner, outer)| {
                inner.is_some_and(|inner| outer.is_none_or(|outer| outer < inner))
            })
            .count();
    }
    assert!(
        left_out > 200,
        "only {left_out} samples: the trials try nothing"
    );
}
