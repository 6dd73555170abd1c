//! Prepared terrains as files: a binary glTF that every viewer shows, and in it the extension `ANTUMBRA_horizons`, with which nothing is
//! prepared again. What its fields are is told in `docs/horizons-extension.md`.
//!
//! A file is hostile until it is read: what it counts is held against the bytes that are there before memory is taken, and whatever can be
//! found out about a field, a hierarchy or a mesh is found out. What hides a group cannot be, short of finding all horizons again: regions
//! are believed, and culling is as right as whoever wrote them.
//!
//! ```
//! use antumbra_formats::LoadOptions;
//! use antumbra_scene::Scene;
//! use antumbra_terrain::{Detail, Field, PreparedScene, Terrain, TerrainOptions};
//! use antumbra_demo_scenes::terrain::FractalOptions;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let raster = FractalOptions { order: 4, ..FractalOptions::default() }.raster()?;
//! let field = Field::over(&raster, Detail::Vertices(100))?;
//! let terrain = Terrain::prepare(field, &TerrainOptions::default(), &|| ())?;
//! let mut scene = Scene::new();
//! let shown = terrain.show_lit(&mut scene)?;
//! # let folder = tempfile::tempdir()?;
//! # let file = folder.path().join("terrain.glb");
//! terrain.save(&scene, &shown, &file)?;
//!
//! let again = PreparedScene::load(&file, &LoadOptions::default())?;
//! assert_eq!(again.terrain.groups(), terrain.groups());
//! // HorizonStrategy::new(again.terrain, &again.shown) culls it.
//! # Ok(())
//! # }
//! ```

mod check;
mod layout;
mod numbers;
mod shown;

use std::path::Path;
use std::sync::Arc;

use antumbra_formats::{Attachment, LoadOptions, load_with_attachments, save_glb_with_attachments};
use antumbra_scene::{EntityKey, Scene};
use glam::{DVec2, DVec3};

use crate::circle::Circle;
use crate::error::TerrainError;
use crate::field::Field;
use crate::groups::{Group, Groups};
use crate::region::{CORNERS, Region};
use crate::show::ShownTerrain;
use crate::terrain::Terrain;
use layout::Layout;
use numbers::{Reader, Writer};

/// The extension's name.
pub const EXTENSION: &str = "ANTUMBRA_horizons";
/// The version that is written. The first, which has one reach, is read too.
pub const VERSION: u64 = 2;

/// A scene out of a file, and what is known of its terrain.
#[derive(Debug)]
pub struct PreparedScene {
    /// The scene.
    pub scene: Scene,
    /// What is known of its terrain.
    pub terrain: Arc<Terrain>,
    /// Its entities.
    pub shown: ShownTerrain,
}

impl PreparedScene {
    /// Reads a scene that [`Terrain::save`] wrote.
    ///
    /// # Errors
    /// [`TerrainError::Load`], [`TerrainError::NotPrepared`], and as [`Terrain::read`].
    pub fn load(path: &Path, options: &LoadOptions) -> Result<Self, TerrainError> {
        let loaded = load_with_attachments(path, options, &[EXTENSION])?;
        let attachment = loaded.attachments.into_iter().next();
        let attachment = attachment.ok_or(TerrainError::NotPrepared)??;
        let (terrain, shown) = Terrain::read(&loaded.scene, &attachment)?;
        Ok(Self {
            scene: loaded.scene,
            terrain: Arc::new(terrain),
            shown,
        })
    }

    /// A scene that shows a terrain and nothing else.
    ///
    /// # Errors
    /// As [`Terrain::show_lit`].
    pub fn of(terrain: Terrain, name: &str) -> Result<Self, TerrainError> {
        let mut scene = Scene::new();
        scene.set_name(name);
        let shown = terrain.show_lit(&mut scene)?;
        Ok(Self {
            scene,
            terrain: Arc::new(terrain),
            shown,
        })
    }
}

/// An error about a file.
fn bad(problem: impl Into<String>) -> TerrainError {
    TerrainError::BadFile {
        problem: problem.into(),
    }
}

impl Terrain {
    /// Saves a scene that shows the terrain, and with it all that is known of the terrain.
    ///
    /// # Errors
    /// [`TerrainError::BadFile`] where the scene does not show the terrain as it was shown, [`TerrainError::Save`].
    pub fn save(
        &self,
        scene: &Scene,
        shown: &ShownTerrain,
        path: &Path,
    ) -> Result<(), TerrainError> {
        shown::agrees(self, scene, shown)?;
        save_glb_with_attachments(scene, &[self.attachment(shown)?], path)?;
        Ok(())
    }

    /// All that is known of the terrain and of who shows what of it, for [`save_glb_with_attachments`].
    ///
    /// # Errors
    /// [`TerrainError::BadFile`] for a block with a margin: a file holds nothing of the neighbours that it rests on.
    pub fn attachment(&self, shown: &ShownTerrain) -> Result<Attachment, TerrainError> {
        if !self.margin().is_empty() {
            return Err(bad(
                "the terrain is a block whose horizons rest on its neighbours: save one that was prepared without a margin",
            ));
        }
        let (field, groups) = (self.field(), self.groups());
        let mut out = Writer::default();
        out.row([field.origin().to_array()]);
        let circle = |group: &Group| {
            let Circle { middle, radius } = group.circle;
            [middle.x, middle.y, radius]
        };
        out.row(groups.groups().iter().map(circle));
        out.row(groups.groups().iter().map(|group| group.heights));
        let points = field.points().iter();
        out.row(points.map(|point| point.as_vec3().to_array()));
        for group in 0..groups.groups().len() as u32 {
            for region in groups.regions(group) {
                out.row(region.corners().iter().copied());
                out.row([[region.slope()]]);
            }
        }
        out.row(field.triangles().iter().copied());
        let ranges = groups.groups().iter().map(|group| &group.triangles);
        out.row(ranges.map(|range| [range.start, range.end]));
        out.row(groups.groups().iter().map(|group| group.children));
        out.row(groups.tops().iter().map(|&top| [top]));
        out.row(groups.order().iter().map(|&triangle| [triangle]));
        let always = || shown.always.iter().map(|(_, triangles)| triangles);
        out.row(always().flatten().map(|&triangle| [triangle]));
        let ends = always().scan(0, |end, triangles| {
            *end += triangles.len() as u32;
            Some([*end])
        });
        out.row(ends);
        let layout = Layout {
            method: self.method(),
            sectors: *groups.sectors(),
            vertices: field.points().len(),
            triangles: field.triangles().len(),
            groups: groups.groups().len(),
            tops: groups.tops().len(),
            always: groups.always().len(),
            always_nodes: shown.always.len(),
        };
        let mut entities = vec![shown.root];
        entities.extend(shown.groups.iter().map(|(entity, _)| *entity));
        entities.extend(shown.always.iter().map(|(entity, _)| *entity));
        Ok(Attachment {
            name: EXTENSION.to_owned(),
            entities,
            properties: layout.facts(),
            bytes: out.bytes,
        })
    }

    /// The terrain that a scene shows, out of what its file says of it. `scene` is as it was loaded.
    ///
    /// # Errors
    /// [`TerrainError::BadFile`] for another version, and for all that cannot be; [`TerrainError::NotAHeightField`] where the file's field is
    /// none.
    pub fn read(
        scene: &Scene,
        attachment: &Attachment,
    ) -> Result<(Self, ShownTerrain), TerrainError> {
        let layout = Layout::read(&attachment.properties)?;
        layout.fits(attachment.bytes.len())?;
        let mut rest = Reader::new(&attachment.bytes);
        let origin = rest.row(1)?.into_iter().next().unwrap_or_default();
        let circles: Vec<[f64; 3]> = rest.row(layout.groups)?;
        let heights: Vec<[f64; 2]> = rest.row(layout.groups)?;
        let points: Vec<[f32; 3]> = rest.row(layout.vertices)?;
        let regions = regions(&layout, rest.row(layout.regions())?)?;
        let triangles: Vec<[u32; 3]> = rest.row(layout.triangles)?;
        let field = field(DVec3::from(origin), &points, triangles)?;
        let ranges: Vec<[u32; 2]> = rest.row(layout.groups)?;
        let children: Vec<[u32; 2]> = rest.row(layout.groups)?;
        let groups = circles.into_iter().zip(heights).zip(ranges).zip(children);
        let groups = groups.map(|((([x, y, radius], heights), range), children)| Group {
            triangles: range[0]..range[1],
            children,
            circle: Circle {
                middle: DVec2::new(x, y),
                radius,
            },
            heights,
        });
        let tops: Vec<[u32; 1]> = rest.row(layout.tops)?;
        let order: Vec<[u32; 1]> = rest.row(layout.triangles)?;
        let grouped = layout.triangles.checked_sub(layout.always);
        let grouped =
            grouped.ok_or_else(|| bad("more triangles are in no group than there are"))?;
        let groups = Groups::from_parts(
            layout.sectors,
            groups.collect(),
            regions,
            tops.into_flattened(),
            order.into_flattened(),
            grouped as u32..layout.triangles as u32,
        );
        check::groups(&field, &groups)?;
        let always: Vec<[u32; 1]> = rest.row(layout.always)?;
        let ends: Vec<[u32; 1]> = rest.row(layout.always_nodes)?;
        let always = check::always(&groups, always.as_flattened(), ends.as_flattened())?;
        let shown = shown_by(&groups, always, &attachment.entities)?;
        let terrain = Self::from_parts(field, groups, layout.method);
        shown::agrees(&terrain, scene, &shown)?;
        Ok((terrain, shown))
    }
}

fn regions(
    layout: &Layout,
    rows: Vec<[f32; 2 * CORNERS + 1]>,
) -> Result<Vec<Region>, TerrainError> {
    let each = layout.sectors.rows();
    let reaches = layout.sectors.reaches() as usize;
    let region = |(at, row): (usize, [f32; 2 * CORNERS + 1])| {
        let mut corners = [[0.0; 2]; CORNERS];
        corners
            .as_flattened_mut()
            .iter_mut()
            .zip(row)
            .for_each(|(corner, number)| *corner = number);
        let slope = row.last().copied().unwrap_or_default();
        Region::from_parts(corners, slope).ok_or_else(|| {
            let (group, sector, reach) = (at / each, at % each / reaches, at % reaches);
            bad(format!(
                "what hides group {group} in sector {sector} and reach {reach} is no region: {row:?}"
            ))
        })
    };
    rows.into_iter().enumerate().map(region).collect()
}

/// The field, if it is one, and as it was when it was made.
fn field(
    origin: DVec3,
    points: &[[f32; 3]],
    triangles: Vec<[u32; 3]>,
) -> Result<Field, TerrainError> {
    if !origin.is_finite() || origin.abs().max_element() > 1e9 {
        let problem = format!("its origin {origin} is no place within 1e9 metres of zero");
        return Err(bad(problem));
    }
    let points = points
        .iter()
        .map(|&point| glam::Vec3::from(point).as_dvec3());
    let points: Vec<DVec3> = points.collect();
    let field = Field::about(origin, points.clone(), triangles.clone())?;
    if field.points() != points || field.triangles() != triangles {
        return Err(bad(
            "its vertices and triangles are not in the order in which a field has them",
        ));
    }
    Ok(field)
}

/// Who shows what: the root, an entity for each crystal, and those always drawn.
fn shown_by(
    groups: &Groups,
    always: Vec<Vec<u32>>,
    entities: &[EntityKey],
) -> Result<ShownTerrain, TerrainError> {
    let all = groups.groups().iter().enumerate();
    let leaves = all.filter_map(|(number, group)| group.is_leaf().then_some(number as u32));
    let leaves: Vec<u32> = leaves.collect();
    let needed = 1 + leaves.len() + always.len();
    let there = entities.len();
    let Some((root, rest)) = entities.split_first().filter(|_| there == needed) else {
        return Err(bad(format!(
            "it names {there} nodes where its terrain needs {needed}"
        )));
    };
    let (crystals, rest) = rest.split_at(leaves.len());
    Ok(ShownTerrain {
        root: *root,
        groups: crystals.iter().copied().zip(leaves).collect(),
        always: rest.iter().copied().zip(always).collect(),
    })
}
