//! Closed meshes made of sheets. A sheet is a grid of vertices with smooth normals; edges between sheets stay sharp.

use antumbra_scene::{Geometry, Mesh};
use glam::{DAffine3, DVec3, Vec3};

/// Position from cylindrical coordinates: along the axis X (rearwards in an engine), distance from the axis, and
/// angle, in metres and radians. Angle 0 is +Y; angles grow towards +Z. The three directions are right-handed in this
/// order.
pub(super) fn polar(x: f64, radius: f64, angle: f64) -> DVec3 {
    let (sin, cos) = angle.sin_cos();
    DVec3::new(x, radius * cos, radius * sin)
}

/// The grid of a sheet. `rows_wrap` joins the last row to the first, `columns_wrap` the last column to the first. The
/// front of a sheet points along (direction of increasing row) x (direction of increasing column).
#[derive(Clone, Copy)]
pub(super) struct Sheet {
    pub rows: usize,
    pub columns: usize,
    pub rows_wrap: bool,
    pub columns_wrap: bool,
}

impl Sheet {
    /// A sheet with four borders.
    pub fn open(rows: usize, columns: usize) -> Self {
        Self {
            rows,
            columns,
            rows_wrap: false,
            columns_wrap: false,
        }
    }

    /// A sheet whose last column joins its first.
    pub fn round(rows: usize, columns: usize) -> Self {
        Self {
            columns_wrap: true,
            ..Self::open(rows, columns)
        }
    }
}

/// A triangle mesh with normals; triangles are counter-clockwise seen from outside.
#[derive(Clone, Default)]
pub(super) struct Solid {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    indices: Vec<u32>,
}

struct Corner {
    at: Vec3,
    /// Sum of the normals of its triangles, weighted by area.
    normal: DVec3,
    /// Index of its vertex, if a triangle uses it.
    vertex: Option<u32>,
}

impl From<Geometry> for Solid {
    fn from(geometry: Geometry) -> Self {
        Self {
            positions: geometry.positions,
            normals: geometry.normals,
            indices: geometry.indices,
        }
    }
}

impl Solid {
    /// Adds a sheet; `at(row, column)` gives the position of a vertex.
    pub fn sheet(&mut self, sheet: Sheet, at: impl Fn(usize, usize) -> DVec3) {
        self.sheet_where(sheet, at, |_, _| true);
    }

    /// Adds a sheet without the cells for which `keep(row, column)` is false; a cell is named by its lowest row and
    /// column.
    pub fn sheet_where(
        &mut self,
        sheet: Sheet,
        at: impl Fn(usize, usize) -> DVec3,
        keep: impl Fn(usize, usize) -> bool,
    ) {
        let (rows, columns) = (sheet.rows, sheet.columns);
        let mut corners = Vec::with_capacity(rows * columns);
        for row in 0..rows {
            corners.extend((0..columns).map(|column| Corner {
                at: at(row, column).as_vec3(),
                normal: DVec3::ZERO,
                vertex: None,
            }));
        }
        for row in 0..rows - usize::from(!sheet.rows_wrap) {
            for column in 0..columns - usize::from(!sheet.columns_wrap) {
                if !keep(row, column) {
                    continue;
                }
                let (below, beside) = ((row + 1) % rows, (column + 1) % columns);
                let [a, b, c, d] = [
                    (row, column),
                    (below, column),
                    (below, beside),
                    (row, beside),
                ]
                .map(|(row, column)| row * columns + column);
                self.facet(&mut corners, [a, b, c]);
                self.facet(&mut corners, [a, c, d]);
            }
        }
        for corner in corners {
            if let Some(vertex) = corner.vertex {
                let unit = corner.normal.try_normalize().unwrap_or(DVec3::Y);
                self.normals[vertex as usize] = unit.as_vec3().to_array();
            }
        }
    }

    /// Adds a triangle between corners, unless two of them coincide.
    fn facet(&mut self, corners: &mut [Corner], triangle: [usize; 3]) {
        let [a, b, c] = triangle.map(|corner| corners[corner].at);
        if a == b || b == c || c == a {
            return;
        }
        let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a);
        for corner in triangle {
            let corner = &mut corners[corner];
            corner.normal += normal;
            let vertex = *corner.vertex.get_or_insert_with(|| {
                self.positions.push(corner.at.to_array());
                self.normals.push([0.0; 3]);
                self.positions.len() as u32 - 1
            });
            self.indices.push(vertex);
        }
    }

    /// Adds a flat polygon as a fan around its centre; its corners run counter-clockwise seen from the front.
    pub fn fan(&mut self, corners: &[DVec3]) {
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        self.sheet(Sheet::round(2, corners.len()), |row, column| {
            if row == 0 { middle } else { corners[column] }
        });
    }

    /// Adds a deformed unit cube. `at(u, v, w)` maps the cube to positions and keeps its handedness; `steps` is the
    /// number of cells along each axis.
    pub fn block(&mut self, steps: [usize; 3], at: impl Fn(f64, f64, f64) -> DVec3) {
        let [u, v, w] = steps;
        let cells = |a: usize, b: usize| Sheet::open(a + 1, b + 1);
        let part = |i: usize, of: usize| i as f64 / of as f64;
        self.sheet(cells(u, v), |i, j| at(part(i, u), part(j, v), 1.0));
        self.sheet(cells(v, u), |i, j| at(part(j, u), part(i, v), 0.0));
        self.sheet(cells(v, w), |i, j| at(1.0, part(i, v), part(j, w)));
        self.sheet(cells(w, v), |i, j| at(0.0, part(j, v), part(i, w)));
        self.sheet(cells(w, u), |i, j| at(part(j, u), 1.0, part(i, w)));
        self.sheet(cells(u, w), |i, j| at(part(i, u), 0.0, part(j, w)));
    }

    /// Adds an axis-aligned box between its minimum and its maximum.
    pub fn cuboid(&mut self, low: [f64; 3], high: [f64; 3]) {
        let (low, high) = (DVec3::from(low), DVec3::from(high));
        self.block([1; 3], |u, v, w| low + (high - low) * DVec3::new(u, v, w));
    }

    /// Adds triangles between corners, each given as [position, normal].
    pub fn patch(&mut self, corners: &[[DVec3; 2]], triangles: &[[u32; 3]]) {
        let first = self.positions.len() as u32;
        for [place, normal] in corners {
            self.positions.push(place.as_vec3().to_array());
            self.normals.push(normal.as_vec3().to_array());
        }
        let indices = triangles.as_flattened().iter();
        self.indices.extend(indices.map(|index| first + index));
    }

    /// Adds another solid under a rigid transform.
    pub fn add(&mut self, other: &Solid, at: DAffine3) {
        let first = self.positions.len() as u32;
        let moved = |p: &[f32; 3]| at.transform_point3(Vec3::from(*p).as_dvec3());
        let turned = |n: &[f32; 3]| at.transform_vector3(Vec3::from(*n).as_dvec3());
        let narrow = |v: DVec3| v.as_vec3().to_array();
        self.positions
            .extend(other.positions.iter().map(moved).map(narrow));
        self.normals
            .extend(other.normals.iter().map(turned).map(narrow));
        self.indices
            .extend(other.indices.iter().map(|index| first + index));
    }

    /// Converts the solid to a mesh.
    pub fn mesh(self, name: &str) -> Mesh {
        let geometry = Geometry {
            positions: self.positions,
            normals: self.normals,
            indices: self.indices,
            ..Geometry::default()
        };
        Mesh::new(name, geometry)
    }
}
