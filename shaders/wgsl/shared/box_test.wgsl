//!import judged
//!import pyramid
// Tests boxes against a depth pyramid: an instance is hidden if the nearest point of its box is behind the farthest sample of all pixels that the
// box may touch. Equal depths are visible. (Greene, Kass, Miller, Hierarchical Z-Buffer Visibility, 1993.)

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read> texels: array<f32>;

// By how many pixels a rasteriser may move a vertex, with some to spare.
const SNAPPING: f32 = 0.0625;

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
    // Half of a pixel, with what rounding and snapping may lose, and what rounding may lose of a nearness.
    around: vec2<f32>,
    lost: f32,
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

// The greatest nearness of an ellipsoid in a pixel with this middle; far beyond everything where it covers no part of the pixel.
fn nearest_at(seen: SeenEllipsoid, pixel: vec2<f32>) -> f32 {
    if !seen.known || !seen.by_pixel {
        return 3e38;
    }
    let from_middle = (pixel / vec2<f32>(view.pixels_wide, view.pixels_high) * 2.0 - 1.0) * vec2<f32>(1.0, -1.0) - seen.middle.xy;
    let norm = sqrt(max(quadratic(seen.inverse, from_middle), 0.0));
    // How much less it may be anywhere in the pixel.
    let less = sqrt(max(quadratic(seen.inverse, seen.around), quadratic(seen.inverse, seen.around * vec2<f32>(1.0, -1.0))));
    let least = max(norm * 0.995 - less * 1.005, 0.0);
    if least > 1.0 {
        return -3e38;
    }
    let tilt = dot(abs(seen.slope), seen.around) + 0.005 * dot(abs(seen.slope), abs(from_middle));
    return seen.middle.z + dot(seen.slope, from_middle) + tilt + seen.thickness * sqrt(1.0 - least * least) + seen.lost;
}

fn quadratic(form: vec3<f32>, at: vec2<f32>) -> f32 {
    return form.x * at.x * at.x + 2.0 * form.y * at.x * at.y + form.z * at.y * at.y;
}

// Whether a box that is wholly in front of the near plane may show anywhere.
fn shows(place: RelativeBox) -> bool {
    let rows = array<vec4<f32>, 4>(clip_row(0u), clip_row(1u), clip_row(2u), clip_row(3u));
    let scale = vec2<f32>(0.5 * view.pixels_wide, -0.5 * view.pixels_high);
    let centre = view.clip_from_relative * vec4<f32>(place.centre, 1.0);
    let x = view.clip_from_relative * vec4<f32>(place.x, 0.0);
    let y = view.clip_from_relative * vec4<f32>(place.y, 0.0);
    let z = view.clip_from_relative * vec4<f32>(place.z, 0.0);
    var low = vec2<f32>(3e38);
    var high = vec2<f32>(-3e38);
    var nearest = -3e38;
    var least_w = 3e38;
    for (var corner = 0u; corner < 8u; corner++) {
        let side = select(vec3<f32>(-1.0), vec3<f32>(1.0), (vec3<u32>(corner) & vec3<u32>(1u, 2u, 4u)) != vec3<u32>(0u));
        let clip = centre + x * side.x + y * side.y + z * side.z;
        let seen = clip.xyz / clip.w;
        low = min(low, seen.xy);
        high = max(high, seen.xy);
        nearest = max(nearest, view.towards * seen.z);
        least_w = min(least_w, clip.w);
    }
    if !(least_w > 0.0) {
        return true;
    }
    var seen_ellipsoid = seen_ellipsoid_of(place.round, centre, x, y, z);
    if seen_ellipsoid.known {
        low = max(low, seen_ellipsoid.middle.xy - seen_ellipsoid.reach.xy);
        high = min(high, seen_ellipsoid.middle.xy + seen_ellipsoid.reach.xy);
        nearest = min(nearest, seen_ellipsoid.middle.z + seen_ellipsoid.reach.z);
    }
    // The rounding errors of the clip coordinates, as parts of w.
    let error = ROUNDING / least_w * vec4<f32>(
        dot(abs(rows[0].xyz), place.reach) + abs(rows[0].w),
        dot(abs(rows[1].xyz), place.reach) + abs(rows[1].w),
        dot(abs(rows[2].xyz), place.reach) + abs(rows[2].w),
        dot(abs(rows[3].xyz), place.reach) + abs(rows[3].w),
    );
    let lost = error.z + abs(nearest) * error.w + view.depth_step;
    nearest += lost;
    let margin = error.xy + max(abs(low), abs(high)) * error.w;
    // How far from a pixel's middle its samples may be.
    let off_middle = select(0.5, 0.0, (view.flags & AT_MIDDLES) != 0u);
    seen_ellipsoid.around = margin + (off_middle + SNAPPING) / abs(scale);
    seen_ellipsoid.lost = lost;
    let one = (low - margin) * scale;
    let other = (high + margin) * scale;
    let upper = min(one, other);
    let lower = max(one, other);
    // What is not a number, or too large for one, shows.
    if !all(upper <= lower) || !all(max(abs(upper), abs(lower)) < vec2<f32>(3e38)) {
        return true;
    }
    let middle = vec2<f32>(0.5 * view.pixels_wide, 0.5 * view.pixels_high);
    let last = vec2<f32>(view.pixels_wide, view.pixels_high) - 1.0;
    // The pixels that the box touches: wherever samples lie in a pixel, those that it covers are in these.
    let begin = ceil(middle + upper - SNAPPING - (0.5 + off_middle));
    let end = floor(middle + lower + SNAPPING - (0.5 - off_middle));
    if any(begin > end) {
        // Between the samples.
        return false;
    }
    let least = vec2<u32>(clamp(begin, vec2<f32>(0.0), last));
    let greatest = vec2<u32>(clamp(end, vec2<f32>(0.0), last));
    return any_behind(nearest, least, greatest, seen_ellipsoid);
}

// Pixels a side up to which a rectangle that the pyramid lets through is looked at again, pixel by pixel, where an ellipsoid with its own depth at each.
const LARGEST_SECOND_LOOK: u32 = 16u;

// Whether any sample in a rectangle of pixels is at or behind a nearness; in a large rectangle, or close to it. Comparisons are written so that what is not a number is behind.
fn any_behind(nearest: f32, least: vec2<u32>, greatest: vec2<u32>, ellipsoid: SeenEllipsoid) -> bool {
    let extent = max(greatest.x - least.x, greatest.y - least.y);
    if extent >= 4u {
        if nearest < farthest(least, greatest, extent) {
            return false;
        }
        if extent >= LARGEST_SECOND_LOOK {
            return true;
        }
    }
    for (var y = least.y; y <= greatest.y; y++) {
        for (var x = least.x; x <= greatest.x; x++) {
            let at_pixel = min(nearest, nearest_at(ellipsoid, vec2<f32>(f32(x), f32(y)) + 0.5));
            if !(at_pixel < nearness(vec2<u32>(x, y))) {
                return true;
            }
        }
    }
    return false;
}

// By the pyramid: the nearness of the farthest sample in a rectangle of pixels and close to it. At most four texels a side are read.
fn farthest(least: vec2<u32>, greatest: vec2<u32>, extent: u32) -> f32 {
    var level = max(firstLeadingBit(extent) - 1u, 2u);
    let texels_wide = (greatest >> vec2<u32>(level)) - (least >> vec2<u32>(level));
    level += select(0u, 1u, max(texels_wide.x, texels_wide.y) > 3u);
    let first = least >> vec2<u32>(level);
    let last = greatest >> vec2<u32>(level);
    let row = pyramid.levels[level];
    var found = NEAREST;
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            found = min(found, texels[row.x + y * row.y + x]);
        }
    }
    return found;
}
