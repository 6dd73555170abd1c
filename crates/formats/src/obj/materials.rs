//! Material libraries (MTL): colours, opacity, emission and the image of the colour.

use super::lines::{keyword, statements};
use crate::budget::Budget;
use crate::emission::{Emitter, MAPS_OF_EMISSION};
use crate::error::{LoadProblem, shorten};
use crate::file_resolver::{FileResolver, Found};
use crate::image::{self, ImageSource};
use crate::left_out::LostPart;
use crate::text::legible;
use antumbra_scene::{AlphaMode, ImageKey, Material, Sampler, Scene, Wrap};
use std::collections::{HashMap, HashSet};

/// Bytes of a material of a library in memory, without its name.
const LIBRARY_MATERIAL: u64 = 512;
/// Bytes of an entry of a table of names, without the name.
const ENTRY: u64 = 96;

/// The images that materials use, by their files and how they are sampled; `None` for one that was left out.
type ImageTable = HashMap<(String, Sampler), Option<ImageKey>>;

/// The materials of all libraries, by name. The first of a name counts.
#[derive(Default)]
pub(super) struct Libraries {
    materials: HashMap<String, LibraryMaterial>,
    /// The names of libraries so far. One that is named again adds nothing.
    named: HashSet<String>,
    images: ImageTable,
    /// Whether any library was read.
    pub(super) is_read: bool,
}

/// A material as its library describes it.
#[derive(Default)]
struct LibraryMaterial {
    colour: Option<[f32; 3]>,
    opacity: Option<f32>,
    emission: Option<[f32; 3]>,
    map: Option<Map>,
    emission_map: Option<Map>,
}

/// An image and how it is placed.
#[derive(Clone)]
struct Map {
    file: String,
    scale: [f32; 2],
    offset: [f32; 2],
    wrap: Wrap,
}

impl Libraries {
    /// Reads the libraries that a line names: one whose name may have spaces, or else several.
    ///
    /// # Errors
    /// What exceeds the budget. A library that is missing costs the colours alone.
    pub(super) fn read(
        &mut self,
        names: &str,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<(), LoadProblem> {
        let is_one = names.split_whitespace().nth(1).is_none();
        if is_one {
            return self.read_one(names, files, budget);
        }
        if !self.is_new(names, budget)? {
            return Ok(());
        }
        let whole = files.cosmetic("the material library", names, budget)?;
        if let Found::Bytes(bytes) = whole {
            return self.add(names, &bytes, budget);
        }
        for name in names.split_whitespace() {
            self.read_one(name, files, budget)?;
        }
        Ok(())
    }

    /// Whether any library is named.
    pub(super) fn is_named(&self) -> bool {
        !self.named.is_empty()
    }

    /// Reads the library of this name, unless it was named before.
    fn read_one(
        &mut self,
        name: &str,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<(), LoadProblem> {
        if !self.is_new(name, budget)? {
            return Ok(());
        }
        match files.cosmetic("the material library", name, budget)? {
            Found::Bytes(bytes) => self.add(name, &bytes, budget)?,
            Found::Missing(reason) => {
                let example = format!("the library \"{}\"", shorten(name));
                budget.left_out.add(LostPart::Material, reason, &example);
            }
        }
        Ok(())
    }

    /// Whether a name is named for the first time. It is kept.
    fn is_new(&mut self, name: &str, budget: &mut Budget) -> Result<bool, LoadProblem> {
        if self.named.contains(name) {
            return Ok(false);
        }
        budget.memory(ENTRY + name.len() as u64)?;
        Ok(self.named.insert(name.to_owned()))
    }

    fn add(&mut self, name: &str, bytes: &[u8], budget: &mut Budget) -> Result<(), LoadProblem> {
        budget.enter(format!("the material library \"{}\"", shorten(name)));
        self.is_read = true;
        let text = legible(bytes, budget)?;
        budget.memory(text.len() as u64)?;
        let mut present: Option<(String, LibraryMaterial)> = None;
        for statement in statements(&text) {
            let (word, rest) = keyword(&statement.text);
            if word == "newmtl" && !rest.is_empty() {
                budget.memory(LIBRARY_MATERIAL + rest.len() as u64)?;
                let ended = present.replace((rest.to_owned(), LibraryMaterial::default()));
                self.keep(ended);
            } else if let Some((name, material)) = &mut present {
                let place = || format!("material \"{}\"", shorten(name));
                material.statement(word, rest, &place, budget);
            }
        }
        self.keep(present);
        Ok(())
    }

    fn keep(&mut self, ended: Option<(String, LibraryMaterial)>) {
        if let Some((name, material)) = ended {
            self.materials.entry(name).or_insert(material);
        }
    }

    /// The scene's material of this name; `None` if no library has it.
    ///
    /// # Errors
    /// What exceeds the budget. An image that cannot be had costs the image alone.
    pub(super) fn material(
        &mut self,
        name: &str,
        scene: &mut Scene,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<Option<Material>, LoadProblem> {
        let Some(source) = self.materials.get(name) else {
            return Ok(None);
        };
        let [r, g, b] = source.colour.unwrap_or([1.0; 3]);
        let alpha = source.opacity.unwrap_or(1.0);
        // In most exporters an image replaces the colour, and Kd is then black.
        let is_replaced = source.map.is_some() && [r, g, b] == [0.0; 3];
        let colour = if is_replaced { [1.0; 3] } else { [r, g, b] };
        let [cr, cg, cb] = colour;
        let factor = match source.emission_map {
            Some(_) => [1.0; 3],
            None => [0.0; 3],
        };
        let shown = Emitter {
            base_colour: [cr, cg, cb, alpha],
            image: source.map.as_ref(),
            emission: source.emission.unwrap_or(factor),
            emission_image: source.emission_map.as_ref(),
            is_unlit: false,
        }
        .shown();
        let mut material = Material {
            name: name.to_owned(),
            base_colour: shown.base_colour,
            emission: shown.emission,
            unlit: shown.is_light,
            double_sided: true,
            ..Material::default()
        };
        if alpha < 1.0 {
            material.alpha = AlphaMode::Blend;
        }
        if shown.loses_image {
            let place = format!("material \"{}\"", shorten(name));
            (budget.left_out).add(LostPart::Shading, MAPS_OF_EMISSION, &place);
        }
        let Some(map) = shown.image else {
            return Ok(Some(material));
        };
        material.uv_transform = map.uv_transform();
        let place = format!("the image of material \"{}\"", shorten(name));
        material.base_colour_image = map.image(&place, &mut self.images, scene, files, budget)?;
        if material.base_colour_image.is_none() && is_replaced {
            material.base_colour = [r, g, b, alpha];
        }
        Ok(Some(material))
    }
}

impl LibraryMaterial {
    fn statement(
        &mut self,
        word: &str,
        rest: &str,
        place: &dyn Fn() -> String,
        budget: &mut Budget,
    ) {
        match word {
            "Kd" => self.colour = colour(rest).or(self.colour),
            "Ke" => self.emission = colour(rest).or(self.emission),
            "d" => {
                let opacity = rest.split_whitespace().last();
                let opacity = opacity.and_then(|word| word.parse::<f32>().ok());
                self.opacity = opacity.filter(|o| o.is_finite()).or(self.opacity);
            }
            "map_Kd" | "map_kd" => self.map = Map::read(rest).or(self.map.take()),
            "map_Ke" | "map_ke" => {
                self.emission_map = Map::read(rest).or(self.emission_map.take());
            }
            "map_d" | "map_D" => {
                let left_out = &mut budget.left_out;
                left_out.add(LostPart::Image, "a map of opacity", &place());
            }
            "refl" | "bump" | "norm" | "disp" | "decal" => self.shading(word, place, budget),
            word if word.starts_with("map_") => self.shading(word, place, budget),
            _ => {}
        }
    }

    fn shading(&self, word: &str, place: &dyn Fn() -> String, budget: &mut Budget) {
        budget.left_out.add(LostPart::Shading, word, &place());
    }
}

/// A colour; with one number it is grey.
fn colour(rest: &str) -> Option<[f32; 3]> {
    let number = |word: &str| word.parse::<f32>().ok().filter(|number| number.is_finite());
    let mut words = rest.split_whitespace().map(number);
    let first = words.next()??;
    match (words.next().flatten(), words.next().flatten()) {
        (Some(green), Some(blue)) => Some([first, green, blue]),
        _ => Some([first; 3]),
    }
}

impl Map {
    /// Reads options and the file's name, which may have spaces; `None` without a name.
    fn read(text: &str) -> Option<Self> {
        let mut map = Self {
            file: String::new(),
            scale: [1.0; 2],
            offset: [0.0; 2],
            wrap: Wrap::Repeat,
        };
        let mut rest = text;
        while rest.starts_with('-') {
            let (option, after) = keyword(rest);
            let is_vector = matches!(option, "-o" | "-s" | "-t");
            let words = match option {
                "-o" | "-s" | "-t" => 3,
                "-mm" => 2,
                "-blendu" | "-blendv" | "-bm" | "-boost" | "-cc" | "-clamp" | "-imfchan"
                | "-texres" | "-type" => 1,
                // A name that begins with a dash.
                _ => break,
            };
            rest = after;
            let mut values = [None; 3];
            for value in values.iter_mut().take(words) {
                let (word, after) = keyword(rest);
                let number = word.parse::<f32>().ok().filter(|number| number.is_finite());
                // One to three numbers; the file's name ends them.
                if is_vector && number.is_none() {
                    break;
                }
                if option == "-clamp" && word == "on" {
                    map.wrap = Wrap::Clamp;
                }
                *value = number;
                rest = after;
            }
            let [u, v, _] = values;
            match option {
                "-s" => map.scale = [u.unwrap_or(1.0), v.unwrap_or(1.0)],
                "-o" => map.offset = [u.unwrap_or(0.0), v.unwrap_or(0.0)],
                _ => {}
            }
        }
        map.file = rest.trim().trim_matches('"').to_owned();
        (!map.file.is_empty()).then_some(map)
    }

    /// The scene's image, which is read once for each way of sampling it.
    ///
    /// # Errors
    /// What exceeds the budget. An image that cannot be had is left out.
    fn image(
        &self,
        place: &str,
        known: &mut ImageTable,
        scene: &mut Scene,
        files: &FileResolver<'_>,
        budget: &mut Budget,
    ) -> Result<Option<ImageKey>, LoadProblem> {
        if budget.options.skip_images {
            return Ok(None);
        }
        let sampler = Sampler {
            wrap_u: self.wrap,
            wrap_v: self.wrap,
            ..Sampler::default()
        };
        let name = (self.file.clone(), sampler);
        if let Some(key) = known.get(&name) {
            return Ok(*key);
        }
        budget.memory(ENTRY + self.file.len() as u64)?;
        let source = ImageSource {
            place,
            name: &self.file,
            file: &self.file,
            sampler,
        };
        let found = files.cosmetic(place, &self.file, budget)?;
        let key = image::add_found(scene, found, &source, budget)?;
        known.insert(name, key);
        Ok(key)
    }

    /// The options for v that counts from the top: v is 1 less what the file calls v.
    fn uv_transform(&self) -> [[f32; 3]; 2] {
        let ([su, sv], [ou, ov]) = (self.scale, self.offset);
        [[su, 0.0, ou], [0.0, sv, 1.0 - sv - ov]]
    }
}
