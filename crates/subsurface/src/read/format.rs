//! The formats of surfaces and grids, and how they are recognised: by what a file holds, or else by its name, so that the reader can report what is
//! wrong.

use std::path::Path;

use antumbra_files::words;
use antumbra_formats::RasterFormat;

use super::{eclipse, irap, numbered};
use crate::error::SubsurfaceError;

/// A format of surfaces or grids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    IrapBinary,
    IrapAscii,
    Roff,
    Eclipse(eclipse::Encoding),
    Gocad,
    Faultroom,
    Zmap,
    Cps3,
    Raster(RasterFormat),
    Picks,
    /// Numbers without a title: see [`numbered`].
    Numbered(numbered::Columns),
}

impl Format {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::IrapBinary => "Irap binary surface",
            Self::IrapAscii => "Irap ASCII surface",
            Self::Roff => "ROFF grid",
            Self::Eclipse(eclipse::Encoding::Text) => "GRDECL grid",
            Self::Eclipse(eclipse::Encoding::Binary) => "EGRID grid",
            Self::Gocad => "GOCAD TSurf",
            Self::Faultroom => "faultroom file",
            Self::Zmap => "ZMAP+ grid",
            Self::Cps3 => "CPS-3 grid",
            Self::Raster(format) => format.name(),
            Self::Picks => "table of picks",
            Self::Numbered(numbered::Columns::Points) => "list of points",
            Self::Numbered(numbered::Columns::Lines) => "horizon of lines (IJXYZ)",
        }
    }

    pub(super) fn error(self, path: &Path, problem: String) -> SubsurfaceError {
        SubsurfaceError::Format {
            path: path.into(),
            format: self.name(),
            problem: in_words(problem),
        }
    }

    /// The format of a file; `None` if it is none of these.
    pub(super) fn of(path: &Path, bytes: &[u8]) -> Option<Self> {
        let ending = path.extension().map(|ending| ending.to_string_lossy());
        let ending = ending.unwrap_or_default().to_lowercase();
        if let Some(format) = Self::of_contents(bytes) {
            return Some(format);
        }
        Some(match ending.as_str() {
            "gri" | "irapbin" => Self::IrapBinary,
            "irap" => Self::IrapAscii,
            "roff" => Self::Roff,
            "grdecl" => Self::Eclipse(eclipse::Encoding::Text),
            "egrid" => Self::Eclipse(eclipse::Encoding::Binary),
            "ts" => Self::Gocad,
            "json" => Self::Faultroom,
            "zmap" => Self::Zmap,
            "cps3" | "cps" => Self::Cps3,
            "csv" | "tsv" | "txt" | "dat" | "xyz" | "poi" | "map" | "ijxyz" => {
                numbered::columns(bytes).map_or(Self::Picks, Self::Numbered)
            }
            ending => Self::Raster(RasterFormat::from_extension(ending)?),
        })
    }

    fn of_contents(bytes: &[u8]) -> Option<Self> {
        let begin = bytes.trim_ascii_start();
        let begins = |with: &[u8]| {
            let start = begin.get(..with.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(with))
        };
        let magic: [(&[u8], Self); 14] = [
            (b"roff-bin", Self::Roff),
            (b"roff-asc", Self::Roff),
            (b"gocad tsurf", Self::Gocad),
            (b"{", Self::Faultroom),
            (b"-996", Self::IrapAscii),
            (b"fsasci", Self::Cps3),
            (b"ncols", Self::Raster(RasterFormat::Esri)),
            (b"II*\0", Self::Raster(RasterFormat::GeoTiff)),
            (b"II+\0", Self::Raster(RasterFormat::GeoTiff)),
            (b"MM\0*", Self::Raster(RasterFormat::GeoTiff)),
            (b"MM\0+", Self::Raster(RasterFormat::GeoTiff)),
            (b"DSAA", Self::Raster(RasterFormat::Surfer)),
            (b"DSBB", Self::Raster(RasterFormat::Surfer)),
            (b"DSRB", Self::Raster(RasterFormat::Surfer)),
        ];
        if bytes.starts_with(&irap::MAGIC) {
            return Some(Self::IrapBinary);
        }
        if let Some((_, format)) = magic.iter().find(|(with, _)| begins(with)) {
            return Some(*format);
        }
        // A record of 16 bytes, and a keyword.
        let is_record = matches!(bytes.first_chunk(), Some([0, 0, 0, 16] | [16, 0, 0, 0]));
        let is_keyword = |word: &[u8]| word.iter().all(|b| b.is_ascii_uppercase() || *b == b' ');
        if is_record && bytes.get(4..12).is_some_and(is_keyword) {
            return Some(Self::Eclipse(eclipse::Encoding::Binary));
        }
        is_zmap(bytes).then_some(Self::Zmap)
    }
}

/// Whether the first line that is no remark is a ZMAP+ grid's.
fn is_zmap(bytes: &[u8]) -> bool {
    let begin = bytes.get(..16 << 10).unwrap_or(bytes);
    let mut lines = begin.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"!"));
    let Some(fields) = first.and_then(|line| line.strip_prefix(b"@")) else {
        return false;
    };
    let mut fields = fields.split(|byte| *byte == b',').map(<[u8]>::trim_ascii);
    fields.any(|field| field.eq_ignore_ascii_case(b"grid"))
}

/// The error for a file of no known format.
pub(super) fn unknown(path: &Path) -> SubsurfaceError {
    let problem = "it is none of Irap (.gri, .irapbin, .irap), ROFF grid (.roff), Eclipse grid (.grdecl, .egrid), GOCAD TSurf (.ts), faultroom \
                   (.json), ZMAP+ (.zmap), CPS-3 (.cps3), raster (.asc, .grd, .npz, .tif), and picks or points (.csv, .tsv, .txt, .dat, .xyz)";
    SubsurfaceError::Format {
        path: path.into(),
        format: "surface file",
        problem: problem.into(),
    }
}

/// Letters of a problem in a message, since it may quote the file.
const MOST_LETTERS: usize = 400;

/// A problem for a message: what it quotes of the file is clean and not too long.
pub(super) fn in_words(problem: String) -> String {
    words::short(&problem, MOST_LETTERS)
}
