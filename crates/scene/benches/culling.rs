//! Frustum culling of a million boxes: blocks of 64 with SIMD on all cores, against a plain loop over `Vec<Aabb>`
//! that stops at the first plane that rejects a box. Measured in spatial order and shuffled.
#![allow(clippy::unwrap_used, missing_docs)]

use antumbra_scene::{Aabb, BoxArray, Camera, Frustum, Projection};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;

const SIDE: usize = 100;

fn boxes(shuffled: bool) -> Vec<Aabb> {
    let mut boxes: Vec<Aabb> = (0..SIDE * SIDE * SIDE)
        .map(|i| {
            let place = [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE].map(|c| c as f64 - 50.0);
            Aabb::from_centre(DVec3::from_array(place), DVec3::splat(0.45))
        })
        .collect();
    if shuffled {
        let mut state = 1_u64;
        for i in (1..boxes.len()).rev() {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            boxes.swap(i, (state >> 33) as usize % (i + 1));
        }
    }
    boxes
}

/// The plain version: tests the farthest corner along each plane's normal, and stops at the first plane it is behind.
fn plain(frustum: &Frustum, boxes: &[Aabb], out: &mut Vec<u32>) {
    'boxes: for (i, bounds) in boxes.iter().enumerate() {
        for plane in frustum.planes() {
            let n = plane.normal;
            let corner = DVec3::new(
                if n.x >= 0.0 {
                    bounds.max.x
                } else {
                    bounds.min.x
                },
                if n.y >= 0.0 {
                    bounds.max.y
                } else {
                    bounds.min.y
                },
                if n.z >= 0.0 {
                    bounds.max.z
                } else {
                    bounds.min.z
                },
            );
            if plane.distance(corner) < 0.0 {
                continue 'boxes;
            }
        }
        out.push(i as u32);
    }
}

fn culling(c: &mut Criterion) {
    let projection = Projection::Perspective {
        fov_y: 1.0,
        near: 0.1,
    };
    let views = [
        ("from within", DVec3::ZERO),
        ("from outside", DVec3::splat(90.0)),
    ];
    for shuffled in [false, true] {
        let boxes = boxes(shuffled);
        let mut array = BoxArray::new();
        boxes.iter().for_each(|bounds| array.push(*bounds));
        let order = if shuffled { "shuffled" } else { "in order" };
        for (view, eye) in views {
            let target = DVec3::new(10.0, 3.0, -20.0);
            let camera = Camera::look_at(eye, target, DVec3::Y, projection).unwrap();
            let frustum = camera.frustum(16.0 / 9.0);
            let mut group = c.benchmark_group(format!("culling 1 M boxes {order} {view}"));
            group.throughput(Throughput::Elements(boxes.len() as u64));
            group.sample_size(30);
            let mut out = Vec::new();
            group.bench_function("plain loop", |b| {
                b.iter(|| {
                    out.clear();
                    plain(&frustum, &boxes, &mut out);
                    out.len()
                });
            });
            group.bench_function("indices", |b| {
                b.iter(|| {
                    out.clear();
                    frustum.cull(&array, &mut out);
                    out.len()
                });
            });
            let mut bits = Vec::new();
            group.bench_function("bits", |b| {
                b.iter(|| {
                    frustum.cull_into_bits(&array, &mut bits);
                    bits.len()
                });
            });
            group.finish();
        }
    }
}

criterion_group!(benches, culling);
criterion_main!(benches);
