//!import judged
//!import pyramid
// Tests boxes against a depth pyramid: an instance is hidden if the nearest point of its box is behind the farthest sample of all pixels that the
// box may touch. Equal depths are visible. (Greene, Kass, Miller, Hierarchical Z-Buffer Visibility, 1993.)

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read> texels: array<f32>;

// By how many pixels a rasteriser may move a vertex, with some to spare.
const SNAPPING: f32 = 0.0625;

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
    // The rounding errors of the clip coordinates, as parts of w.
    let error = ROUNDING / least_w * vec4<f32>(
        dot(abs(rows[0].xyz), place.reach) + abs(rows[0].w),
        dot(abs(rows[1].xyz), place.reach) + abs(rows[1].w),
        dot(abs(rows[2].xyz), place.reach) + abs(rows[2].w),
        dot(abs(rows[3].xyz), place.reach) + abs(rows[3].w),
    );
    nearest += error.z + abs(nearest) * error.w + view.depth_step;
    let margin = error.xy + max(abs(low), abs(high)) * error.w;
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
    let least = vec2<u32>(clamp(floor(middle + upper - SNAPPING), vec2<f32>(0.0), last));
    let greatest = vec2<u32>(clamp(floor(middle + lower + SNAPPING), vec2<f32>(0.0), last));
    return any_behind(nearest, least, greatest);
}

// Pixels a side up to which a rectangle that the pyramid lets through is looked at again, pixel by pixel.
const LARGEST_SECOND_LOOK: u32 = 16u;

// Whether any sample in a rectangle of pixels is at or behind a nearness; in a large rectangle, or close to it. Comparisons are written so that what is not a number is behind.
fn any_behind(nearest: f32, least: vec2<u32>, greatest: vec2<u32>) -> bool {
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
            if !(nearest < nearness(vec2<u32>(x, y))) {
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
