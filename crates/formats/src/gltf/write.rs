//! Writing of binary glTF 2.0, the inverse of [`load`](crate::load). The file is written beside its place and
//! renamed. Geometry goes from the scene's arrays into the file without a copy in memory.
//!
//! Layout of a GLB: 12 bytes of header, a chunk of JSON, a chunk of binary data. Each chunk follows 8 bytes with its
//! length and type.

mod binary;
mod build;
mod convert;
mod error;
mod json;
mod materials;

pub use error::{SaveError, SaveProblem};

use super::attachment::Attachment;
use antumbra_files::WholeFile;
use antumbra_scene::Scene;
use binary::Binary;
use build::{Glb, build};
use json::Root;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

/// Saves a scene as a binary glTF. [`load`](crate::load) reads back:
///
/// - every entity with its name, its place in the tree and its transform. Transforms are written as f64, though most
///   readers keep f32. A transform that is no translation, rotation and scale is written as a matrix;
/// - the meshes of entities, once per material: level 0, then the further levels, and last the proxy, as nodes of
///   MSFT_lod. If there are levels but no proxy, the full geometry is listed again as the last one, since a reader
///   takes the last one for the proxy;
/// - the materials and images they use, images as PNG; KHR_texture_transform, KHR_materials_unlit;
/// - lights (KHR_lights_punctual) and cameras. A camera that is not at its entity's origin, and an orthographic one
///   whose near plane is behind it, becomes a child node of its entity;
/// - whether a test may cull an entity, as `"tested": false` in the node's extras.
///
/// The environment is not written, since glTF has none. Geometry without indices is not written either; an entity
/// without other geometry is written without a mesh.
///
/// # Errors
/// [`SaveProblem::TooLarge`] beyond 4 GiB, a number of a material that is not finite, a uv transform that shears, an
/// off-axis camera (glTF has none, and a camera on the axis would show something else), and errors of the system.
pub fn save_glb(scene: &Scene, path: &Path) -> Result<(), SaveError> {
    save_glb_with_attachments(scene, &[], path)
}

/// As [`save_glb`], with attachments.
///
/// # Errors
/// As for [`save_glb`]; [`SaveProblem::BadAttachment`] for an attachment whose name is in use, that refers to an
/// entity outside the scene, or that has properties with reserved names.
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
    let Glb { root, binary } = build(scene, attachments)?;
    let mut file = WholeFile::create(path)?;
    write(file.file(), &root, &binary)?;
    file.finish()?;
    Ok(())
}

/// Writes the header and the chunks. The lengths at the beginning are known last and filled in then.
fn write(
    file: &mut (impl Write + Seek),
    root: &Root<'_>,
    binary: &Binary<'_>,
) -> Result<(), SaveProblem> {
    const HEADER: u64 = 12;
    const CHUNK_HEADER: u64 = 8;
    // Checked before anything is written.
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
        let Glb { root, mut binary } = build(&scene, &[]).unwrap();
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
