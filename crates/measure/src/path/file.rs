//! Camera paths as JSON files, read as untrusted input:
//!
//! ```json
//! { "projection": { "perspective": { "fov_y_degrees": 45, "near": 0.1 } },
//!   "poses": [ { "eye": [0, 10, 40], "target": [0, 0, 0] },
//!              { "eye": [5, 10, 40], "target": [0, 0, 0], "up": [0, 1, 0], "cut": true },
//!              { "eye": [6, 10, 40], "rotation": [0, 0, 0, 1] } ] }
//! ```
//!
//! The projection is a `perspective`; one through a window off the axis, `{ "off_axis": { "fov_y_degrees": 45, "near": 0.1,
//! "shift": [0.02, 0] } }` with the tangents (right, up) of the window's middle; `{ "orthographic": { "height": 20,
//! "near": 0, "far": 100 } }`; or any `{ "matrix": { "columns": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1], [0, 0, 0.1, 0]] } }` of reversed depth,
//! which has an aspect of its own.
//!
//! A pose looks at a `target` or has a `rotation` (a unit quaternion x, y, z, w). Paths are saved with rotations, so that they are read back
//! bit by bit.

use std::fmt;

use antumbra_scene::{ClipMatrix, Projection};
use glam::{DMat4, DQuat, DVec2, DVec3};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::{CameraPath, Pose};
use crate::MeasureError;
use crate::files::{read_limited, write_whole};

/// The most bytes of a path file.
pub const MAX_PATH_BYTES: u64 = 32 << 20;
/// The most poses of a path.
pub const MAX_POSES: usize = 100_000;

const KIND: &str = "camera path";

impl CameraPath {
    /// Reads a path file. The path gets the file's name without the folder.
    ///
    /// # Errors
    /// [`MeasureError`] where the file cannot be read, is larger than [`MAX_PATH_BYTES`], is no valid JSON, or holds no valid path. An error of a
    /// pose has the pose's number; the first is 0.
    pub fn load(path: impl AsRef<std::path::Path>) -> Result<Self, MeasureError> {
        let path = path.as_ref();
        let bytes = read_limited(path, KIND, MAX_PATH_BYTES)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Self::from_json(&name, &bytes).map_err(|error| match error {
            MeasureError::Malformed { kind, reason, .. } => MeasureError::Malformed {
                path: path.to_owned(),
                kind,
                reason,
            },
            other => other,
        })
    }

    /// Reads a path from the text of a path file.
    ///
    /// # Errors
    /// As for [`CameraPath::load`], except for those of the file.
    pub fn from_json(name: &str, json: &[u8]) -> Result<Self, MeasureError> {
        let malformed = |reason| MeasureError::Malformed {
            path: name.into(),
            kind: KIND,
            reason,
        };
        let file: FileIn = serde_json::from_slice(json).map_err(|e| malformed(e.to_string()))?;
        let projection = file.projection.read().map_err(malformed)?;
        Self::new(name, projection, file.poses.0)
    }

    /// Writes the path atomically. Reading it gives exactly the same poses.
    ///
    /// # Errors
    /// [`MeasureError::File`] where the file cannot be written.
    pub fn save(&self, path: impl AsRef<std::path::Path>) -> Result<(), MeasureError> {
        let path = path.as_ref();
        let out = FileOut {
            projection: ProjectionFile::write(self.projection),
            poses: self
                .poses
                .iter()
                .map(|pose| PoseOut {
                    eye: pose.position.to_array(),
                    rotation: pose.rotation.to_array(),
                    cut: pose.cut,
                })
                .collect(),
        };
        let text = serde_json::to_vec_pretty(&out).map_err(|e| MeasureError::Malformed {
            path: path.to_owned(),
            kind: KIND,
            reason: e.to_string(),
        })?;
        write_whole(path, &text)
    }
}

#[derive(Deserialize)]
struct FileIn {
    projection: ProjectionFile,
    poses: Poses,
}

#[derive(Serialize)]
struct FileOut {
    projection: ProjectionFile,
    poses: Vec<PoseOut>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum ProjectionFile {
    Perspective {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        fov_y_degrees: Option<f64>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        fov_y_radians: Option<f64>,
        near: f64,
    },
    OffAxis {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        fov_y_degrees: Option<f64>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        fov_y_radians: Option<f64>,
        near: f64,
        shift: [f64; 2],
    },
    Orthographic {
        height: f64,
        near: f64,
        far: f64,
    },
    /// Column by column, of reversed depth.
    Matrix {
        columns: [[f64; 4]; 4],
    },
}

impl ProjectionFile {
    fn read(self) -> Result<Projection, String> {
        match self {
            Self::Perspective {
                fov_y_degrees,
                fov_y_radians,
                near,
            } => Ok(Projection::Perspective {
                fov_y: fov_y(fov_y_degrees, fov_y_radians)?,
                near,
            }),
            Self::OffAxis {
                fov_y_degrees,
                fov_y_radians,
                near,
                shift,
            } => Ok(Projection::OffAxis {
                fov_y: fov_y(fov_y_degrees, fov_y_radians)?,
                near,
                shift: DVec2::from_array(shift),
            }),
            Self::Orthographic { height, near, far } => {
                Ok(Projection::Orthographic { height, near, far })
            }
            Self::Matrix { columns } => {
                let matrix = ClipMatrix::reversed(DMat4::from_cols_array_2d(&columns));
                Ok(Projection::Matrix(
                    matrix.map_err(|error| error.to_string())?,
                ))
            }
        }
    }

    fn write(projection: Projection) -> Self {
        match projection {
            // Radians, since degrees and back would not give the same bits.
            Projection::Perspective { fov_y, near } => Self::Perspective {
                fov_y_degrees: None,
                fov_y_radians: Some(fov_y),
                near,
            },
            Projection::OffAxis { fov_y, near, shift } => Self::OffAxis {
                fov_y_degrees: None,
                fov_y_radians: Some(fov_y),
                near,
                shift: shift.to_array(),
            },
            Projection::Orthographic { height, near, far } => {
                Self::Orthographic { height, near, far }
            }
            Projection::Matrix(matrix) => Self::Matrix {
                columns: matrix.matrix().to_cols_array_2d(),
            },
        }
    }
}

/// The vertical field of view in radians, from degrees or radians.
fn fov_y(degrees: Option<f64>, radians: Option<f64>) -> Result<f64, String> {
    match (degrees, radians) {
        (Some(degrees), None) => Ok(degrees.to_radians()),
        (None, Some(radians)) => Ok(radians),
        _ => Err("a perspective needs fov_y_degrees or fov_y_radians, one of them".to_owned()),
    }
}

#[derive(Serialize)]
struct PoseOut {
    eye: [f64; 3],
    rotation: [f64; 4],
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    cut: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PoseIn {
    eye: [f64; 3],
    target: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    #[serde(default)]
    cut: bool,
}

impl PoseIn {
    fn read(self) -> Result<Pose, String> {
        let eye = DVec3::from_array(self.eye);
        let pose = match (self.target, self.up, self.rotation) {
            (Some(target), up, None) => {
                let (target, up) = (DVec3::from_array(target), up.map(DVec3::from_array));
                Pose::look_at(eye, target, up).map_err(|e| e.to_string())?
            }
            (None, None, Some(rotation)) => Pose {
                position: eye,
                rotation: DQuat::from_array(rotation),
                cut: false,
            },
            _ => return Err("give a target (and perhaps an up), or a rotation".to_owned()),
        };
        Ok(Pose {
            cut: self.cut,
            ..pose
        })
    }
}

/// The poses, read one by one, so that an error has the pose's number, and reading stops at [`MAX_POSES`].
struct Poses(Vec<Pose>);

impl<'de> Deserialize<'de> for Poses {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PosesVisitor)
    }
}

struct PosesVisitor;

impl<'de> Visitor<'de> for PosesVisitor {
    type Value = Poses;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of poses")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Poses, A::Error> {
        let mut poses = Vec::new();
        loop {
            let i = poses.len();
            let next = seq.next_element::<PoseIn>();
            match next.map_err(|e| de::Error::custom(format!("pose {i}: {e}")))? {
                None => return Ok(Poses(poses)),
                Some(_) if i == MAX_POSES => {
                    return Err(de::Error::custom(format!("more than {MAX_POSES} poses")));
                }
                Some(pose) => {
                    poses.push(
                        pose.read()
                            .map_err(|e| de::Error::custom(format!("pose {i}: {e}")))?,
                    );
                }
            }
        }
    }
}
