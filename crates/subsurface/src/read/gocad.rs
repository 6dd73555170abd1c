//! GOCAD TSurf: triangulated surfaces as lines of text, several per file.

use std::collections::HashMap;

use antumbra_formats::raster::text::{decode, parse_number};
use antumbra_formats::{PlanUnit, SaidUnits, Units};
use glam::DVec3;

use super::budget::ReadBudget;
use super::options::ZPositive;
use super::triangles;
use crate::surface::{Surface, SurfaceKind};

/// The objects of a file.
pub(super) struct Objects {
    pub(super) surfaces: Vec<Surface>,
    /// What the file says of its units.
    pub(super) said: SaidUnits,
}

pub(super) fn read(
    bytes: &[u8],
    stem: &str,
    positive: Option<ZPositive>,
    kind: SurfaceKind,
    budget: &mut ReadBudget,
) -> Result<Objects, String> {
    let text = decode(bytes);
    let mut said: Option<SaidUnits> = None;
    let mut surfaces = Vec::new();
    let mut open: Option<Object> = None;
    for (line, words) in text.lines().enumerate() {
        if let Some(units) = units_in(words) {
            if (said.as_ref()).is_some_and(|said| said.units != units.units) {
                return Err(format!(
                    "line {}: its objects have different units; write each to a file of its own",
                    line + 1
                ));
            }
            said.get_or_insert(units);
        }
        let at = |problem: String| format!("line {}: {problem}", line + 1);
        let words = words.trim();
        let mut begin = words.split_whitespace();
        if (begin.next()).is_some_and(|word| word.eq_ignore_ascii_case("GOCAD")) {
            // Some writers leave out the last object's END.
            surfaces.extend(open.take().map(|it| it.finish(stem, kind)).transpose()?);
            let is_surface = (begin.next()).is_some_and(|word| word.eq_ignore_ascii_case("TSurf"));
            if !is_surface {
                return Err(at(format!(
                    "`{words}` is no TSurf; write the surfaces to a file of their own"
                )));
            }
            budget.surfaces(1, 0, || format!("its {} surfaces", surfaces.len() + 1))?;
            open = Some(Object::new(positive));
        } else if let Some(object) = &mut open {
            if words.eq_ignore_ascii_case("END") {
                surfaces.extend(open.take().map(|it| it.finish(stem, kind)).transpose()?);
            } else {
                let (vertices, triangles) = (object.points.len(), object.triangles.len());
                object.line(words).map_err(at)?;
                if object.points.len() > vertices {
                    budget.vertex(|| format!("the vertices up to line {}", line + 1))?;
                }
                // Two triangles are paid for with each vertex.
                if object.triangles.len() > triangles && triangles >= 2 * vertices {
                    budget.triangle(|| format!("the triangles up to line {}", line + 1))?;
                }
            }
        }
    }
    surfaces.extend(open.take().map(|it| it.finish(stem, kind)).transpose()?);
    if surfaces.is_empty() {
        return Err("no line `GOCAD TSurf 1` begins an object".into());
    }
    Ok(Objects {
        surfaces,
        said: said.unwrap_or_default(),
    })
}

/// The units in a line `AXIS_UNIT "m" "m" "ft"`. A unit that is no length, such as a time, counts as none.
fn units_in(line: &str) -> Option<SaidUnits> {
    let line = line.trim();
    let (keyword, rest) = line.split_once(char::is_whitespace)?;
    if !keyword.eq_ignore_ascii_case("AXIS_UNIT") {
        return None;
    }
    let quoted: Vec<&str> = rest.split('"').skip(1).step_by(2).collect();
    let words = match quoted.is_empty() {
        true => rest.split_whitespace().collect(),
        false => quoted,
    };
    let mut said = SaidUnits::default();
    let mut unit = |what, at: usize| said.length(what, words.get(at)?);
    let is_degrees = words
        .first()
        .is_some_and(|word| word.trim().to_ascii_lowercase().starts_with("deg"));
    let plan = match is_degrees {
        true => Some(PlanUnit::DEGREES),
        false => unit("places", 0).map(PlanUnit::Length),
    };
    let height = unit("heights", 2);
    said.units = Units { plan, height };
    Some(said)
}

struct Object {
    name: Option<String>,
    /// The direction of z in the read options, which overrides the file's.
    told: Option<ZPositive>,
    said: ZPositive,
    /// The points with the file's coordinates.
    points: Vec<DVec3>,
    /// The index of each vertex's point, by the vertex's number in the file.
    numbers: HashMap<u64, u32>,
    triangles: Vec<[u32; 3]>,
}

impl Object {
    fn new(told: Option<ZPositive>) -> Self {
        Self {
            name: None,
            told,
            said: ZPositive::Up,
            points: Vec::new(),
            numbers: HashMap::new(),
            triangles: Vec::new(),
        }
    }

    fn line(&mut self, line: &str) -> Result<(), String> {
        if self.points.is_empty() && self.name.is_none() {
            self.name = name_in(line);
        }
        let mut words = line.split_whitespace();
        let keyword = words.next().unwrap_or_default().to_ascii_uppercase();
        match keyword.as_str() {
            "ZPOSITIVE" => {
                let which = words.next().unwrap_or_default();
                self.said = match which.to_ascii_lowercase().as_str() {
                    "depth" => ZPositive::Down,
                    "elevation" => ZPositive::Up,
                    _ => return Err(format!("ZPOSITIVE is `{which}`, not Depth or Elevation")),
                };
            }
            "VRTX" | "PVRTX" => {
                let id = id(words.next())?;
                let mut coordinate = |axis: &str| {
                    let word = words.next().unwrap_or_default();
                    let value = parse_number(word).filter(|value| value.is_finite());
                    value.ok_or_else(|| format!("vertex {id}: {axis} is `{word}`, no number"))
                };
                let point = DVec3::new(coordinate("x")?, coordinate("y")?, coordinate("z")?);
                self.vertex(id, point)?;
            }
            "ATOM" | "PATOM" => {
                let (id, of) = (id(words.next())?, self.point(id(words.next())?)?);
                let point = self.points.get(of as usize).copied();
                self.vertex(id, point.unwrap_or_default())?;
            }
            "TRGL" => {
                let mut corner = || self.point(id(words.next())?);
                let triangle = [corner()?, corner()?, corner()?];
                self.triangles.push(triangle);
            }
            _ => {}
        }
        Ok(())
    }

    fn vertex(&mut self, id: u64, point: DVec3) -> Result<(), String> {
        let index = u32::try_from(self.points.len())
            .map_err(|_| "more vertices than 32 bits can count".to_owned())?;
        if self.numbers.insert(id, index).is_some() {
            return Err(format!("vertex {id} is there twice"));
        }
        self.points.push(point);
        Ok(())
    }

    fn point(&self, id: u64) -> Result<u32, String> {
        let index = self.numbers.get(&id).copied();
        index.ok_or_else(|| format!("there is no vertex {id} before this line"))
    }

    fn finish(self, stem: &str, kind: SurfaceKind) -> Result<Surface, String> {
        let positive = self.told.unwrap_or(self.said);
        let world = |point: &DVec3| DVec3::new(point.x, positive.up(point.z), -point.y);
        let points: Vec<_> = self.points.iter().map(world).collect();
        let name = self.name.unwrap_or_else(|| stem.to_owned());
        triangles::surface(name, kind, &points, &self.triangles)
    }
}

fn id(word: Option<&str>) -> Result<u64, String> {
    let word = word.unwrap_or_default();
    word.parse()
        .map_err(|_| format!("`{word}` is no vertex's number"))
}

/// The name in `name:F5`, on a line of its own or within `HEADER { name:F5 }`.
fn name_in(line: &str) -> Option<String> {
    let line = line
        .rsplit('{')
        .next()?
        .trim_start()
        .trim_start_matches('*');
    let (key, name) = line.split_once(':')?;
    let name = name.trim_end_matches('}').trim().trim_matches('"');
    (key.trim().eq_ignore_ascii_case("name") && !name.is_empty()).then(|| name.to_owned())
}
