//!import judged
//!import pyramid
//!import seen_shape
// Tests boxes against a depth pyramid: an instance is hidden if in every pixel that it may touch its nearest point there is behind the farthest sample. The pyramid decides as
// large blocks of pixels as it can, and the depth itself what it cannot. Equal depths are visible. (Greene, Kass, Miller, Hierarchical Z-Buffer Visibility, 1993.)

@group(0) @binding(5) var<storage, read> pyramid: Pyramid;
@group(0) @binding(6) var<storage, read> texels: array<f32>;

// What a look finds. What is open is for a closer look.
const LOOK_HIDDEN: u32 = 0u;
const LOOK_SHOWS: u32 = 1u;
const LOOK_OPEN: u32 = 2u;

// Whether a box that is wholly in front of the near plane may show anywhere, by a few texels of the pyramid.
fn look(place: RelativeBox) -> u32 {
    return look_at(place, FIRST_LOOK);
}

// The same of a box that `look` has left open, down to the pixel: it is no longer open.
fn look_closely(place: RelativeBox) -> u32 {
    return look_at(place, CLOSE_LOOK);
}

// The same of a box that nothing has looked at before.
fn look_once(place: RelativeBox) -> u32 {
    return look_at(place, FIRST_LOOK | CLOSE_LOOK);
}

// Which looks are taken, as bits.
const FIRST_LOOK: u32 = 1u;
const CLOSE_LOOK: u32 = 2u;

fn look_at(place: RelativeBox, looks: u32) -> u32 {
    let seen = seen_box_of(place);
    if !(seen.least_w > 0.0) {
        return LOOK_SHOWS;
    }
    let round = select(place.round, 0.0, (view.flags & BOXES_ALONE) != 0u);
    let ellipsoid = seen_ellipsoid_of(round, seen.centre, seen.x, seen.y, seen.z);
    var low = seen.low;
    var high = seen.high;
    var nearest = seen.nearest;
    if ellipsoid.known {
        low = max(low, ellipsoid.middle.xy - ellipsoid.reach.xy);
        high = min(high, ellipsoid.middle.xy + ellipsoid.reach.xy);
        nearest = min(nearest, ellipsoid.middle.z + ellipsoid.reach.z);
    }
    // The rounding errors of the clip coordinates, as parts of w.
    let rows = array<vec4<f32>, 4>(clip_row(0u), clip_row(1u), clip_row(2u), clip_row(3u));
    let error = ROUNDING / seen.least_w * vec4<f32>(
        dot(abs(rows[0].xyz), place.reach) + abs(rows[0].w),
        dot(abs(rows[1].xyz), place.reach) + abs(rows[1].w),
        dot(abs(rows[2].xyz), place.reach) + abs(rows[2].w),
        dot(abs(rows[3].xyz), place.reach) + abs(rows[3].w),
    );
    let lost = error.z + abs(nearest) * error.w + view.depth_step;
    let shift = 2.0 * view.shift / vec2<f32>(view.pixels_wide, view.pixels_high);
    let margin = error.xy + max(abs(low), abs(high)) * error.w + shift;
    let drift = drift_of(low, high);
    let scale = vec2<f32>(0.5 * view.pixels_wide, -0.5 * view.pixels_high);
    let one = (low - margin + drift.xy) * scale;
    let other = (high + margin + drift.zw) * scale;
    let upper = min(one, other);
    let lower = max(one, other);
    // What is not a number, or too large for one, shows.
    if !all(upper <= lower) || !all(max(abs(upper), abs(lower)) < vec2<f32>(3e38)) {
        return LOOK_SHOWS;
    }
    // How far from a pixel's middle its samples may be.
    let off_middle = select(0.5, 0.0, (view.flags & AT_MIDDLES) != 0u);
    let middle = vec2<f32>(0.5 * view.pixels_wide, 0.5 * view.pixels_high);
    let last = vec2<f32>(view.pixels_wide, view.pixels_high) - 1.0;
    // The pixels that the box touches: wherever samples lie in a pixel, those that it covers are in these.
    let begin = ceil(middle + upper - SNAPPING - (0.5 + off_middle));
    let end = floor(middle + lower + SNAPPING - (0.5 - off_middle));
    if any(begin > end) {
        // Between the samples.
        return LOOK_HIDDEN;
    }
    // What the image's edge cuts off may come in, by a drift on the side that it goes to. The screen counts y downwards.
    let shifts = view.shift > 0.0;
    let from_least = vec2<bool>(shifts || drift.x < 0.0, shifts || drift.w > 0.0);
    let from_greatest = vec2<bool>(shifts || drift.z > 0.0, shifts || drift.y < 0.0);
    if any(from_least & (begin < vec2<f32>(0.0))) || any(from_greatest & (end > last)) {
        return LOOK_SHOWS;
    }
    let least = vec2<u32>(clamp(begin, vec2<f32>(0.0), last));
    let greatest = vec2<u32>(clamp(end, vec2<f32>(0.0), last));
    let extent = max(greatest.x - least.x, greatest.y - least.y);
    let is_small = extent < 4u;
    if is_small && (looks & FIRST_LOOK) != 0u && nearest + lost < farthest_pixel(least, greatest) {
        return LOOK_HIDDEN;
    }
    if (looks & CLOSE_LOOK) != 0u {
        var shape = shape_of(seen, round, ellipsoid, nearest, margin, lost);
        // A shape that is swept meets a block where the shape meets the block swept the other way.
        shape.offset = 0.5 * (drift.xy + drift.zw);
        shape.margin += 0.5 * (drift.zw - drift.xy);
        return select(LOOK_HIDDEN, LOOK_SHOWS, any_behind(shape, least, greatest, extent));
    }
    if is_small {
        return LOOK_OPEN;
    }
    if nearest + lost < farthest(least, greatest, extent) {
        return LOOK_HIDDEN;
    }
    return select(LOOK_OPEN, LOOK_SHOWS, (view.flags & ONE_LOOK) != 0u);
}

// Blocks and pixels that are looked at before an instance that is still undecided counts as visible.
const MOST_LOOKS: u32 = 256u;

// Whether in any pixel of a rectangle a shape's nearest point is at or in front of the farthest sample. Blocks of the pyramid are visited from the largest on, each followed by the four within it, and left
// where the shape is behind all of a block, or beside it. Comparisons are written so that what is not a number is behind.
fn any_behind(shape: SeenShape, least: vec2<u32>, greatest: vec2<u32>, extent: u32) -> bool {
    // The rectangle touches at most 3 x 3 blocks of this size.
    let largest = min(max(firstLeadingBit(max(extent, 1u)), 2u), pyramid.count - 1u);
    let first = least >> vec2<u32>(largest);
    let last = greatest >> vec2<u32>(largest);
    var at = first;
    var level = largest;
    for (var looks = 0u; looks < MOST_LOOKS; looks++) {
        // The part of the block that lies in the rectangle.
        let corner = max(at << vec2<u32>(level), least);
        let opposite = min(((at + 1u) << vec2<u32>(level)) - 1u, greatest);
        var is_open = false;
        if all(corner <= opposite) {
            let nearest = nearest_in(shape, corner, opposite);
            if level == 0u {
                if !(nearest < nearness(at)) {
                    return true;
                }
            } else if level >= 2u {
                let row = pyramid.levels[level];
                is_open = !(nearest < texels[row.x + at.y * row.y + at.x]);
            } else {
                is_open = !(nearest < -3e37);
            }
        }
        if is_open {
            // Below the kept levels there are only pixels.
            level -= 1u;
            at = at * 2u;
            continue;
        }
        // The next block: the neighbour in the same parent, or the parent's.
        while level < largest && all((at & vec2<u32>(1u)) == vec2<u32>(1u)) {
            at = at >> vec2<u32>(1u);
            level += 1u;
        }
        if level < largest {
            at = select(vec2<u32>(at.x - 1u, at.y + 1u), vec2<u32>(at.x + 1u, at.y), (at.x & 1u) == 0u);
        } else if at.x < last.x {
            at.x += 1u;
        } else if at.y < last.y {
            at = vec2<u32>(first.x, at.y + 1u);
        } else {
            return false;
        }
    }
    return true;
}

// The nearness of the farthest sample in a rectangle of few pixels.
fn farthest_pixel(least: vec2<u32>, greatest: vec2<u32>) -> f32 {
    var found = NEAREST;
    for (var y = least.y; y <= greatest.y; y++) {
        for (var x = least.x; x <= greatest.x; x++) {
            found = min(found, nearness(vec2<u32>(x, y)));
        }
    }
    return found;
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
