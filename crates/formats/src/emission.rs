//! What is shown of a material that emits light. A material has one image: where the emission has an image too, that of the base colour is kept.

/// The reason of a loss: images of emission that are not shown.
pub(crate) const MAPS_OF_EMISSION: &str = "maps of emission";

/// A material's base colour and emission, each with its image, as a file has them.
pub(crate) struct Emitter<I> {
    /// Linear RGBA.
    pub(crate) base_colour: [f32; 4],
    pub(crate) image: Option<I>,
    /// Linear RGB, a factor on its image.
    pub(crate) emission: [f32; 3],
    pub(crate) emission_image: Option<I>,
    /// Whether the material shows its base colour alone.
    pub(crate) is_unlit: bool,
}

/// What is shown of an [`Emitter`].
pub(crate) struct Shown<I> {
    pub(crate) base_colour: [f32; 4],
    pub(crate) image: Option<I>,
    pub(crate) emission: [f32; 3],
    /// Whether it is shown by its emission alone, which is then the base colour of an unlit material.
    pub(crate) is_light: bool,
    /// Whether its emission has an image that is not shown.
    pub(crate) loses_image: bool,
    /// Whether its emission was infinite. It is then the largest number there is.
    pub(crate) was_infinite: bool,
}

/// A part of an emission that a number of the GPU can hold; 0 for one that is no number, such as black times an infinite strength.
fn finite(part: f32) -> f32 {
    match part {
        _ if part.is_finite() => part,
        _ if part.is_nan() => 0.0,
        _ => part.clamp(0.0, f32::MAX),
    }
}

impl<I> Emitter<I> {
    pub(crate) fn shown(self) -> Shown<I> {
        let was_infinite = self.emission.iter().any(|part| !part.is_finite());
        let emission = self.emission.map(finite);
        let map = self.emission_image.filter(|_| emission != [0.0; 3]);
        let [r, g, b, alpha] = self.base_colour;
        let has_map = map.is_some();
        // A surface that reflects nothing shows its emission alone, and has room for its image.
        let is_light = has_map && !self.is_unlit && [r, g, b] == [0.0; 3];
        let [er, eg, eb] = emission;
        Shown {
            base_colour: match is_light {
                true => [er, eg, eb, alpha],
                false => self.base_colour,
            },
            image: if is_light { map } else { self.image },
            emission: if has_map { [0.0; 3] } else { emission },
            is_light,
            loses_image: has_map && !is_light && !self.is_unlit,
            was_infinite: was_infinite && !self.is_unlit,
        }
    }
}
