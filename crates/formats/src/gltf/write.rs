//! Scenes into files: binary glTF 2.0, the inverse of [`load`](crate::load). The file is written beside its place and renamed into it;
//! geometry goes from the scene's arrays into the file without a copy of it in memory.
//!
//! Layout of a GLB: 12 bytes of header, a chunk of JSON, a chunk of binary data, each chunk after 8 bytes of its own length and kind.

mod binary;
mod gather;
mod json;
mod looks;
mod nodes;

use crate::attachment::Attachment;
use antumbra_scene::Scene;
use binary::Binary;
use gather::gather;
use json::Root;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;
use thiserror::Error;

/// Why a scene gave no file. Nothing is left of it then, and what stood in its place before still does.
#[derive(Debug, Error)]
#[error("{}: {problem}", file.display())]
pub struct SaveError {
    /// The file that was to be written.
    pub file: PathBuf,
    /// What went wrong.
    pub problem: SaveProblem,
}

/// One thing that can keep a scene from being saved.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SaveProblem {
    /// The operating system refused.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// A GLB tells its length in 32 bits.
    #[error("the scene takes {bytes} bytes and a .glb holds at most {limit}: save it in parts")]
    TooLarge {
        /// Bytes of the whole file, or as many as are known.
        bytes: u64,
        /// The most there can be.
        limit: u64,
    },
    /// A material that glTF has no way to say.
    #[error("material \"{material}\": {problem}")]
    BadMaterial {
        /// Its name.
        material: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// A camera that glTF has no way to say.
    #[error("the camera of entity \"{entity}\": {problem}")]
    BadCamera {
        /// The entity's name.
        entity: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// An attachment that the file cannot hold.
    #[error("the attachment \"{attachment}\": {problem}")]
    BadAttachment {
        /// Its name.
        attachment: String,
        /// What is wrong, and what to do.
        problem: &'static str,
    },
    /// An image that cannot be encoded.
    #[error("image \"{image}\": {problem}")]
    BadImage {
        /// Its name.
        image: String,
        /// Why.
        problem: String,
    },
}

/// Saves a scene as a binary glTF, which [`load`](crate::load) reads back as it was:
///
/// - every entity with its name, its place in the tree and its transform, written as f64, though most readers keep f32 of it. A transform
///   that is no translation, rotation and scale is written as a matrix;
/// - the meshes that entities have, each once a material: level 0, then the further levels and last the proxy as nodes of MSFT_lod. Where
///   there are levels but no proxy, the full geometry is named once more as the last, since a reader takes the last one for the proxy;
/// - the materials and images they use, images as PNG; KHR_texture_transform, KHR_materials_unlit;
/// - lights (KHR_lights_punctual) and cameras. A camera that does not stand at its entity's origin, and an orthographic one whose near plane
///   lies behind it, becomes a node of its own below its entity;
/// - whether an entity may be culled by a test, as `"tested": false` in the node's extras.
///
/// The environment is not written: glTF has no word for it. Geometry without an index is not written either, and an entity that has no other becomes one without a mesh.
///
/// # Errors
/// [`SaveProblem::TooLarge`] beyond 4 GiB, a number of a material that is not finite, a uv transform that shears,
/// an off-axis camera (glTF has none, and a camera on the axis would see something else), and what the system says.
pub fn save_glb(scene: &Scene, path: &Path) -> Result<(), SaveError> {
    save_glb_with_attachments(scene, &[], path)
}

/// As [`save_glb`], with what others have to say of the scene.
///
/// # Errors
/// As [`save_glb`]; [`SaveProblem::BadAttachment`] for one whose name is taken, that speaks of an entity which is not in the scene, or has facts
/// of names that are not theirs.
pub fn save_glb_with_attachments(
    scene: &Scene,
    attachments: &[Attachment],
    path: &Path,
) -> Result<(), SaveError> {
    save(scene, attachments, path).map_err(|problem| SaveError {
        file: path.to_owned(),
        problem,
    })
}

fn save(scene: &Scene, attachments: &[Attachment], path: &Path) -> Result<(), SaveProblem> {
    let (root, binary) = gather(scene, attachments)?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut beside = beside(folder)?;
    write(beside.as_file_mut(), &root, &binary)?;
    beside.as_file().sync_all()?;
    beside.persist(path).map_err(|refused| refused.error)?;
    Ok(())
}

/// Header and chunks. The lengths that come first are known last, and filled in then.
fn write(
    file: &mut (impl Write + Seek),
    root: &Root<'_>,
    binary: &Binary<'_>,
) -> Result<(), SaveProblem> {
    const HEADER: u64 = 12;
    const CHUNK_HEADER: u64 = 8;
    // Before the work is done for nothing.
    within_limit(binary.length())?;
    let mut out = BufWriter::with_capacity(1 << 20, &mut *file);
    out.write_all(&[0; (HEADER + CHUNK_HEADER) as usize])?;
    serde_json::to_writer(&mut out, root).map_err(io::Error::from)?;
    let end = out.stream_position()?;
    let json = end.next_multiple_of(4) - HEADER - CHUNK_HEADER;
    for _ in end..end.next_multiple_of(4) {
        out.write_all(b" ")?;
    }
    let mut total = HEADER + CHUNK_HEADER + json;
    if binary.length() > 0 {
        total += CHUNK_HEADER + binary.length();
        out.write_all(&within_limit(binary.length())?.to_le_bytes())?;
        out.write_all(b"BIN\0")?;
        within_limit(total)?;
        binary.write(&mut out)?;
    }
    out.flush()?;
    drop(out);
    file.seek(SeekFrom::Start(0))?;
    file.write_all(b"glTF")?;
    for number in [2, within_limit(total)?, within_limit(json)?] {
        file.write_all(&number.to_le_bytes())?;
    }
    file.write_all(b"JSON")?;
    Ok(())
}

fn within_limit(bytes: u64) -> Result<u32, SaveProblem> {
    let limit = u64::from(u32::MAX);
    u32::try_from(bytes).map_err(|_| SaveProblem::TooLarge { bytes, limit })
}

/// A new file that goes away unless it is renamed, with the rights of any other new file.
fn beside(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".scene-").suffix(".partial");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_scene::Geometry;

    #[test]
    fn what_no_glb_can_hold_is_refused_before_it_is_written() {
        let geometry = Geometry {
            uvs: vec![[0.0; 2]; 1 << 20],
            ..Geometry::default()
        };
        let scene = Scene::new();
        let (root, mut binary) = gather(&scene, &[]).unwrap();
        for _ in 0..512 {
            binary.floats(&geometry.uvs, "VEC2");
        }
        let mut file = io::Cursor::new(Vec::new());
        let problem = write(&mut file, &root, &binary).unwrap_err();
        assert!(matches!(problem, SaveProblem::TooLarge { bytes, .. } if bytes == 1 << 32));
        assert!(file.into_inner().is_empty());
        let text = problem.to_string();
        assert!(
            text.contains("4294967296") && text.contains("4294967295"),
            "{text}"
        );
    }
}
