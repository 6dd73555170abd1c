//!import judged
// Boxes and ellipsoids as they are seen: bounds of their nearness over any block of pixels. The nearness of a point is its depth, counted towards the eye.

// By how many pixels a rasteriser may move a vertex, with some to spare: `TESTED` of crates/cull/src/subpixel.rs, where it is derived.
const SNAPPING: f32 = 0.0625;

// A box in clip space, and its bounds in normalised device coordinates and nearness.
struct SeenBox {
    centre: vec4<f32>,
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    low: vec2<f32>,
    high: vec2<f32>,
    nearest: f32,
    // The least w of a corner. The rest is of use where it is greater than 0.
    least_w: f32,
}

// How far what lies between two corners may go until the answers are used, relative to what hides it: the least x and y, and the greatest, in normalised device coordinates. What is near moves against the
// eye's way, and what is behind less so; all points of the image move towards or away from one, where the eye goes. Each point goes its own way, and any may go all the pixels: between corners that are
// farther apart, what may happen is the same and more.
fn drift_of(low: vec2<f32>, high: vec2<f32>) -> vec4<f32> {
    let way = vec2<f32>(view.drift_x, view.drift_y);
    let pixels = max(max(abs(way.x), abs(way.y)), abs(view.drift_w));
    if !(pixels > 0.0) {
        return vec4<f32>(0.0);
    }
    let half = 0.5 * vec2<f32>(view.pixels_wide, view.pixels_high);
    let full = pixels / half;
    let one = way - low * view.drift_w;
    let other = way - high * view.drift_w;
    let begin = min(one, other);
    let end = max(one, other);
    // Of the point that goes the least way, in pixels: 0 or less where the eye goes to a point in between.
    let away = max(begin, -end) * half;
    let least = max(away.x, away.y);
    if !(least > 0.0) {
        return vec4<f32>(-full, full);
    }
    let scale = min(pixels / least, 3e38);
    let none = vec2<f32>(0.0);
    return vec4<f32>(clamp(begin * scale, -full, none), clamp(end * scale, none, full));
}

fn corner_of(seen: SeenBox, corner: u32) -> vec4<f32> {
    let side = select(vec3<f32>(-1.0), vec3<f32>(1.0), (vec3<u32>(corner) & vec3<u32>(1u, 2u, 4u)) != vec3<u32>(0u));
    return seen.centre + seen.x * side.x + seen.y * side.y + seen.z * side.z;
}

fn seen_box_of(place: RelativeBox) -> SeenBox {
    var seen: SeenBox;
    seen.centre = view.clip_from_relative * vec4<f32>(place.centre, 1.0);
    seen.x = view.clip_from_relative * vec4<f32>(place.x, 0.0);
    seen.y = view.clip_from_relative * vec4<f32>(place.y, 0.0);
    seen.z = view.clip_from_relative * vec4<f32>(place.z, 0.0);
    seen.low = vec2<f32>(3e38);
    seen.high = vec2<f32>(-3e38);
    seen.nearest = -3e38;
    seen.least_w = 3e38;
    for (var corner = 0u; corner < 8u; corner++) {
        let clip = corner_of(seen, corner);
        let at = clip.xyz / clip.w;
        seen.low = min(seen.low, at.xy);
        seen.high = max(seen.high, at.xy);
        seen.nearest = max(seen.nearest, view.towards * at.z);
        seen.least_w = min(seen.least_w, clip.w);
    }
    return seen;
}

// An ellipsoid as it is seen: on the screen and in depth it is an ellipsoid again, the points p with (p - middle) * inverse(shape) * (p - middle) <= 1. Its middle and
// its shape are those of the dual quadric, which is a product of the matrix and the half axes.
struct SeenEllipsoid {
    // Whether it is all well in front of the eye's plane. Otherwise nothing else is set.
    known: bool,
    // Whether the screen's part of the shape can be inverted, so that `inverse`, `slope` and `thickness` are set.
    by_pixel: bool,
    // In normalised device coordinates and nearness.
    middle: vec3<f32>,
    // Half of what it spans along each of them, widened by what rounding may lose.
    reach: vec3<f32>,
    // Of the screen's part of the shape: xx, xy, yy.
    inverse: vec3<f32>,
    // By how much the middle of what is hit grows nearer along x and y, and half of what a ray through the middle hits.
    slope: vec2<f32>,
    thickness: f32,
}

fn seen_ellipsoid_of(round: f32, centre: vec4<f32>, x: vec4<f32>, y: vec4<f32>, z: vec4<f32>) -> SeenEllipsoid {
    var seen: SeenEllipsoid;
    let square = round * round;
    let w = vec3<f32>(x.w, y.w, z.w);
    let divisor = centre.w * centre.w - square * dot(w, w);
    seen.known = round > 0.0 && centre.w > 0.0 && divisor > 0.25 * centre.w * centre.w;
    if !seen.known {
        return seen;
    }
    // The half axes by coordinate.
    let edges = array<vec3<f32>, 3>(
        vec3<f32>(x.x, y.x, z.x),
        vec3<f32>(x.y, y.y, z.y),
        view.towards * vec3<f32>(x.z, y.z, z.z),
    );
    let at = vec3<f32>(centre.xy, view.towards * centre.z);
    // In this form nothing large cancels.
    let a = centre.w * edges[0] - at.x * w;
    let b = centre.w * edges[1] - at.y * w;
    let c = centre.w * edges[2] - at.z * w;
    let a_slant = round * cross(edges[0], w);
    let b_slant = round * cross(edges[1], w);
    let c_slant = round * cross(edges[2], w);
    let scale = square / (divisor * divisor);
    let xx = scale * max(dot(a, a) - dot(a_slant, a_slant), 0.0);
    let yy = scale * max(dot(b, b) - dot(b_slant, b_slant), 0.0);
    let zz = scale * max(dot(c, c) - dot(c_slant, c_slant), 0.0);
    let xy = scale * (dot(a, b) - dot(a_slant, b_slant));
    let xz = scale * (dot(a, c) - dot(a_slant, c_slant));
    let yz = scale * (dot(b, c) - dot(b_slant, c_slant));
    seen.middle = (at * centre.w - square * vec3<f32>(dot(edges[0], w), dot(edges[1], w), dot(edges[2], w))) / divisor;
    let lengths = vec3<f32>(length(edges[0]), length(edges[1]), length(edges[2]));
    let lost = (2e-3 * round * (centre.w * lengths + abs(at) * length(w)) + 1e-5 * abs(at) * centre.w) / divisor;
    seen.reach = sqrt(vec3<f32>(xx, yy, zz)) + lost;
    let determinant = xx * yy - xy * xy;
    // A thin ellipse on the screen has an inverse that rounding decides.
    seen.by_pixel = determinant > 1e-2 * xx * yy;
    if seen.by_pixel {
        seen.inverse = vec3<f32>(yy, -xy, xx) / determinant;
        seen.slope = vec2<f32>(seen.inverse.x * xz + seen.inverse.y * yz, seen.inverse.y * xz + seen.inverse.z * yz);
        seen.thickness = sqrt(max(zz - seen.slope.x * xz - seen.slope.y * yz, 0.0)) + 2e-3 * sqrt(zz) + lost.z;
    }
    return seen;
}

// Up to this, an ellipsoid is taken to lie within its box.
const ROUND: f32 = 1.03;

// What bounds an instance's nearness: its box by planes, and, where it is round, its ellipsoid.
struct SeenShape {
    // Nowhere is it nearer than this.
    nearest: f32,
    // By how much coordinates and nearness may be wrong.
    margin: vec2<f32>,
    // How far from here the middle of all its places is.
    offset: vec2<f32>,
    lost: f32,
    // Where the box lies along three directions of the screen that its edges are at right angles to: the direction, the least and the greatest.
    slabs: array<vec4<f32>, 3>,
    // Its nearness is at most these linear functions of x and y: one along each pair of faces.
    planes: array<vec3<f32>, 3>,
    ellipsoid: SeenEllipsoid,
    // The ellipsoid lies within the box, so that the box says nothing more.
    is_round: bool,
}

// A linear function over a box is greatest at a corner. So directions and slopes may be chosen with any error: what is greatest at the corners bounds all of the box.
fn shape_of(seen: SeenBox, round: f32, ellipsoid: SeenEllipsoid, nearest: f32, margin: vec2<f32>, lost: f32) -> SeenShape {
    let middle = seen.centre.xyz / seen.centre.w;
    var edges = array<vec4<f32>, 3>(seen.x, seen.y, seen.z);
    var shape: SeenShape;
    shape.nearest = nearest;
    shape.margin = margin;
    shape.lost = lost;
    shape.ellipsoid = ellipsoid;
    shape.is_round = ellipsoid.known && ellipsoid.by_pixel && round <= ROUND;
    if shape.is_round {
        return shape;
    }
    for (var axis = 0u; axis < 3u; axis++) {
        let edge = edges[axis].xyz - middle * edges[axis].w;
        let across = vec2<f32>(-edge.y, edge.x);
        let span = length(across);
        shape.slabs[axis] = vec4<f32>(select(vec2<f32>(1.0, 0.0), across / span, span > 1e-18), 3e38, -3e38);
        // Of the two faces the one that is seen, and how its nearness grows along the screen.
        let one = edges[(axis + 1u) % 3u];
        let other = edges[(axis + 2u) % 3u];
        let through = cross(one.xyz - middle * one.w, other.xyz - middle * other.w);
        let outwards = select(-1.0, 1.0, view.towards * dot(through, edge) * through.z > 0.0);
        let face = seen.centre + edges[axis] * outwards;
        let on_face = face.xyz / face.w;
        let normal = cross(one.xyz - on_face * one.w, other.xyz - on_face * other.w);
        let slope = -view.towards * normal.xy / normal.z;
        // A face that is seen from the side bounds nothing.
        shape.planes[axis] = vec3<f32>(select(vec2<f32>(0.0), slope, all(abs(slope) < vec2<f32>(1e6))), -3e38);
    }
    for (var corner = 0u; corner < 8u; corner++) {
        let clip = corner_of(seen, corner);
        let at = clip.xyz / clip.w;
        for (var axis = 0u; axis < 3u; axis++) {
            let along = dot(shape.slabs[axis].xy, at.xy);
            shape.slabs[axis] = vec4<f32>(shape.slabs[axis].xy, min(shape.slabs[axis].z, along), max(shape.slabs[axis].w, along));
            let above = view.towards * at.z - dot(shape.planes[axis].xy, at.xy);
            shape.planes[axis].z = max(shape.planes[axis].z, above);
        }
    }
    return shape;
}

// The greatest nearness of a shape in a block of pixels, from one pixel to another; far beyond everything where it covers no part of them.
fn nearest_in(shape: SeenShape, first: vec2<u32>, last: vec2<u32>) -> f32 {
    let pixels = vec2<f32>(view.pixels_wide, view.pixels_high);
    // How far from a pixel's middle its samples may be.
    let off_middle = select(0.5, 0.0, (view.flags & AT_MIDDLES) != 0u);
    let middle = (vec2<f32>(first + last + 1u) / pixels - 1.0) * vec2<f32>(1.0, -1.0) - shape.offset;
    let half = (vec2<f32>(last - first) + 2.0 * (off_middle + SNAPPING)) / pixels + shape.margin;
    var nearest = min(shape.nearest, nearest_of_ellipsoid(shape.ellipsoid, middle, half));
    if shape.is_round {
        return nearest + shape.lost;
    }
    for (var axis = 0u; axis < 3u; axis++) {
        let slab = shape.slabs[axis];
        let along = dot(slab.xy, middle);
        let reach = dot(abs(slab.xy), half) + 1e-6;
        if along + reach < slab.z || along - reach > slab.w {
            return -3e38;
        }
        let plane = shape.planes[axis];
        let here = plane.z + dot(plane.xy, middle) + dot(abs(plane.xy), half + 1e-6 * abs(middle)) + 1e-6 * abs(plane.z);
        nearest = min(nearest, here);
    }
    return nearest + shape.lost;
}

// The same of an ellipsoid, for a block with this middle and half of its size.
fn nearest_of_ellipsoid(seen: SeenEllipsoid, middle: vec2<f32>, half: vec2<f32>) -> f32 {
    if !seen.known || !seen.by_pixel {
        return 3e38;
    }
    let off = middle - seen.middle.xy;
    let norm = sqrt(max(quadratic(seen.inverse, off), 0.0));
    // How much less it may be anywhere in the block.
    let less = sqrt(max(quadratic(seen.inverse, half), quadratic(seen.inverse, half * vec2<f32>(1.0, -1.0))));
    let least = max(norm * 0.995 - less * 1.005, 0.0);
    if least > 1.0 {
        return -3e38;
    }
    let tilt = dot(abs(seen.slope), half) + 0.005 * dot(abs(seen.slope), abs(off));
    return seen.middle.z + dot(seen.slope, off) + tilt + seen.thickness * sqrt(1.0 - least * least);
}

fn quadratic(form: vec3<f32>, at: vec2<f32>) -> f32 {
    return form.x * at.x * at.x + 2.0 * form.y * at.x * at.y + form.z * at.y * at.y;
}
