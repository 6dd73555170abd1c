//!import judged
// How large a box is on the screen.

// About its width and height in pixels, for a box in front of the eye.
fn screen_size(place: RelativeBox) -> vec2<f32> {
    let centre = view.clip_from_relative * vec4<f32>(place.centre, 1.0);
    let x = view.clip_from_relative * vec4<f32>(place.x, 0.0);
    let y = view.clip_from_relative * vec4<f32>(place.y, 0.0);
    let z = view.clip_from_relative * vec4<f32>(place.z, 0.0);
    return (abs(x.xy) + abs(y.xy) + abs(z.xy)) * vec2<f32>(view.pixels_wide, view.pixels_high) / centre.w;
}
