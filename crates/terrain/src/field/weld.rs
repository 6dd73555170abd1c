//! Corners at one place made one: files repeat them where normals or textures change.

use glam::DVec3;

use super::fault::Fault;

/// Which corner stands for each, and the faults: places with two heights.
pub(super) fn weld(points: &[DVec3], used: &[bool]) -> (Vec<u32>, Vec<Fault>) {
    let mut names: Vec<u32> = (0..points.len() as u32).collect();
    let mut order: Vec<u32> = names.clone();
    order.retain(|&corner| used[corner as usize]);
    // Zero has two signs, and they are one place.
    let place = |corner: u32| points[corner as usize] + DVec3::ZERO;
    order.sort_unstable_by(|&a, &b| {
        let (p, q) = (place(a), place(b));
        p.x.total_cmp(&q.x)
            .then(p.y.total_cmp(&q.y))
            .then(p.z.total_cmp(&q.z))
            .then(a.cmp(&b))
    });
    let mut faults = Vec::new();
    for pair in order.windows(2) {
        let [first, second] = [pair[0], pair[1]];
        let (p, q) = (place(first), place(second));
        if p == q {
            names[second as usize] = names[first as usize];
        } else if p.truncate() == q.truncate() {
            faults.push(Fault::TwoHeights { at: p, other: q.z });
        }
    }
    (names, faults)
}
