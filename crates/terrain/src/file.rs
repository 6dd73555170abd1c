//! Prepared terrains as files: a binary glTF file that every viewer shows, with the extension `ANTUMBRA_horizons`, from which the terrain is
//! read without preparing it again. `docs/horizons-extension.md` describes its fields.
//!
//! A file is treated as hostile. Counts are compared with the bytes that exist before memory is allocated, and everything that can be
//! checked about a field, a hierarchy or a mesh is checked. Regions cannot be checked without finding all horizons again. They are taken as
//! they are, and culling is as correct as the program that wrote them.
//!
//! ```
//! use antumbra_formats::LoadOptions;
//! use antumbra_scene::Scene;
//! use antumbra_terrain::{Field, PreparedScene, RasterDetail, Terrain, TerrainOptions};
//! use antumbra_demo_scenes::terrain::FractalOptions;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let raster = FractalOptions { order: 4, ..FractalOptions::default() }.raster()?;
//! let field = Field::from_raster(&raster, RasterDetail::Vertices(100))?;
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
mod problem;
mod scene_check;

use std::path::Path;
use std::sync::Arc;

use antumbra_formats::{Attachment, LoadOptions, load_with_attachments, save_glb_with_attachments};
use antumbra_scene::{EntityKey, Scene};
use glam::{DVec2, DVec3};

use crate::circle::Circle;
use crate::error::TerrainError;
use crate::field::Field;
use crate::groups::{Group, GroupHierarchy, HierarchyParts};
use crate::region::{CORNERS, Region};
use crate::show::{ShownGroup, ShownTerrain, ShownUngrouped, TerrainInScene};
use crate::terrain::Terrain;
use layout::Layout;
use numbers::{Reader, Writer};
use problem::bad;

pub use layout::VERSION;

/// The name of the extension.
pub const EXTENSION: &str = "ANTUMBRA_horizons";

/// A scene with a prepared terrain.
#[derive(Debug)]
pub struct PreparedScene {
    /// The scene.
    pub scene: Scene,
    /// The terrain.
    pub terrain: Arc<Terrain>,
    /// The entities that show the terrain.
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
        let TerrainInScene { terrain, shown } = Terrain::read(&loaded.scene, &attachment)?;
        Ok(Self {
            scene: loaded.scene,
            terrain,
            shown,
        })
    }

    /// A scene with the given name that shows a terrain and nothing else.
    ///
    /// # Errors
    /// As [`Terrain::show_lit`].
    pub fn from_terrain(terrain: Terrain, name: &str) -> Result<Self, TerrainError> {
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

impl Terrain {
    /// Saves a scene that shows the terrain, with the extension.
    ///
    /// # Errors
    /// [`TerrainError::BadFile`] if the scene does not show the terrain as it was shown, [`TerrainError::Save`].
    pub fn save(
        &self,
        scene: &Scene,
        shown: &ShownTerrain,
        path: &Path,
    ) -> Result<(), TerrainError> {
        scene_check::check_scene(self, scene, shown)?;
        save_glb_with_attachments(scene, &[self.attachment(shown)?], path)?;
        Ok(())
    }

    /// The extension's data, for [`save_glb_with_attachments`].
    ///
    /// # Errors
    /// [`TerrainError::BadFile`] for a tile with a margin: a file has no data of the neighbours that its horizons depend on.
    pub fn attachment(&self, shown: &ShownTerrain) -> Result<Attachment, TerrainError> {
        if !self.margin().is_empty() {
            return Err(bad(
                "the terrain is a tile whose horizons depend on its neighbours: save one that was prepared without a margin",
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
        out.row(groups.roots().iter().map(|&root| [root]));
        out.row(groups.order().iter().map(|&triangle| [triangle]));
        let ungrouped = || shown.ungrouped.iter().map(|shown| &shown.triangles);
        out.row(ungrouped().flatten().map(|&triangle| [triangle]));
        let ends = ungrouped().scan(0, |end, triangles| {
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
            roots: groups.roots().len(),
            ungrouped: groups.ungrouped().len(),
            ungrouped_nodes: shown.ungrouped.len(),
        };
        let mut entities = vec![shown.root];
        entities.extend(shown.groups.iter().map(|shown| shown.entity));
        entities.extend(shown.ungrouped.iter().map(|shown| shown.entity));
        Ok(Attachment {
            name: EXTENSION.to_owned(),
            entities,
            properties: layout.facts(),
            bytes: out.bytes,
        })
    }

    /// Reads the terrain that a scene shows from the extension's data. `scene` must be as it was loaded.
    ///
    /// # Errors
    /// [`TerrainError::BadFile`] for an unsupported version and for invalid data, [`TerrainError::NotAHeightField`] if the data's mesh is no
    /// height field.
    pub fn read(scene: &Scene, attachment: &Attachment) -> Result<TerrainInScene, TerrainError> {
        let layout = Layout::read(&attachment.properties)?;
        layout.check_size(attachment.bytes.len())?;
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
        let roots: Vec<[u32; 1]> = rest.row(layout.roots)?;
        let order: Vec<[u32; 1]> = rest.row(layout.triangles)?;
        let grouped = layout.triangles.checked_sub(layout.ungrouped);
        let grouped =
            grouped.ok_or_else(|| bad("more triangles are in no group than there are"))?;
        let groups = GroupHierarchy::from_parts(HierarchyParts {
            sectors: layout.sectors,
            groups: groups.collect(),
            regions,
            roots: roots.into_flattened(),
            order: order.into_flattened(),
            ungrouped: grouped as u32..layout.triangles as u32,
        });
        check::check_groups(&field, &groups)?;
        let ungrouped: Vec<[u32; 1]> = rest.row(layout.ungrouped)?;
        let ends: Vec<[u32; 1]> = rest.row(layout.ungrouped_nodes)?;
        let ungrouped =
            check::check_ungrouped(&groups, ungrouped.as_flattened(), ends.as_flattened())?;
        let shown = shown_by(&groups, ungrouped, &attachment.entities)?;
        let terrain = Self::from_parts(field, groups, layout.method);
        scene_check::check_scene(&terrain, scene, &shown)?;
        Ok(TerrainInScene {
            terrain: Arc::new(terrain),
            shown,
        })
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
                "the region of group {group}, sector {sector} and reach {reach} is invalid: {row:?}"
            ))
        })
    };
    rows.into_iter().enumerate().map(region).collect()
}

/// Makes the field, and checks that its vertices and triangles are in the order in which it stores them.
fn field(
    origin: DVec3,
    points: &[[f32; 3]],
    triangles: Vec<[u32; 3]>,
) -> Result<Field, TerrainError> {
    if !origin.is_finite() || origin.abs().max_element() > 1e9 {
        let problem =
            format!("its origin {origin} is not finite, or not within 1e9 metres of zero");
        return Err(bad(problem));
    }
    let points = points
        .iter()
        .map(|&point| glam::Vec3::from(point).as_dvec3());
    let points: Vec<DVec3> = points.collect();
    let field = Field::with_origin(origin, points.clone(), triangles.clone())?;
    if field.points() != points || field.triangles() != triangles {
        return Err(bad(
            "its vertices and triangles are not in the order in which a field has them",
        ));
    }
    Ok(field)
}

/// Assigns the entities: the root, then one for each leaf group, then those of the ungrouped triangles.
fn shown_by(
    groups: &GroupHierarchy,
    ungrouped: Vec<Vec<u32>>,
    entities: &[EntityKey],
) -> Result<ShownTerrain, TerrainError> {
    let all = groups.groups().iter().enumerate();
    let leaves = all.filter_map(|(number, group)| group.is_leaf().then_some(number as u32));
    let leaves: Vec<u32> = leaves.collect();
    let needed = 1 + leaves.len() + ungrouped.len();
    let found = entities.len();
    let Some((root, rest)) = entities.split_first().filter(|_| found == needed) else {
        return Err(bad(format!(
            "it names {found} nodes, but its terrain needs {needed}"
        )));
    };
    let (of_groups, rest) = rest.split_at(leaves.len());
    let group = |(&entity, group)| ShownGroup { entity, group };
    let ungrouped = rest.iter().zip(ungrouped);
    Ok(ShownTerrain {
        root: *root,
        groups: of_groups.iter().zip(leaves).map(group).collect(),
        ungrouped: ungrouped
            .map(|(&entity, triangles)| ShownUngrouped { entity, triangles })
            .collect(),
    })
}
