//! The command line of the examples.

use antumbra_bevy::{AntumbraCulling, Strategy};
use bevy::prelude::*;

/// A way to cull.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Bevy's frustum culling alone.
    Frustum(Msaa),
    /// Bevy's own occlusion culling, with the depth prepass that it needs.
    Bevy(Msaa),
    /// This plug-in.
    Antumbra(Msaa),
    /// This plug-in, with a depth prepass as Bevy's own culling has one: it is not needed, but no pixel is shaded twice.
    AntumbraAndPrepass(Msaa),
}

impl Way {
    /// All that `--measure` compares where `--ways` names none.
    pub const ALL: [Self; 8] = [
        Self::Frustum(Msaa::Off),
        Self::Bevy(Msaa::Off),
        Self::Antumbra(Msaa::Off),
        Self::AntumbraAndPrepass(Msaa::Off),
        Self::Frustum(Msaa::Sample4),
        Self::Bevy(Msaa::Sample4),
        Self::Antumbra(Msaa::Sample4),
        Self::AntumbraAndPrepass(Msaa::Sample4),
    ];

    /// Its name on the command line and in tables.
    pub fn name(self) -> String {
        let way = match self {
            Self::Frustum(_) => "frustum",
            Self::Bevy(_) => "bevy",
            Self::Antumbra(_) => "antumbra",
            Self::AntumbraAndPrepass(_) => "antumbra-prepass",
        };
        format!("{way}-{}", self.msaa().samples())
    }

    /// The samples a pixel.
    pub fn msaa(self) -> Msaa {
        match self {
            Self::Frustum(msaa)
            | Self::Bevy(msaa)
            | Self::Antumbra(msaa)
            | Self::AntumbraAndPrepass(msaa) => msaa,
        }
    }

    /// Whether Bevy's own occlusion culling is on.
    pub fn is_bevys_own(self) -> bool {
        matches!(self, Self::Bevy(_))
    }

    /// Whether this plug-in culls.
    pub fn is_ours(self) -> bool {
        matches!(self, Self::Antumbra(_) | Self::AntumbraAndPrepass(_))
    }

    /// Whether depth is drawn first.
    pub fn has_prepass(self) -> bool {
        matches!(self, Self::Bevy(_) | Self::AntumbraAndPrepass(_))
    }
}

/// What an example is told.
#[derive(Debug, Clone, PartialEq)]
pub struct Arguments {
    /// Frames to run without a window; 0 opens one.
    pub frames: usize,
    /// Whether ways are compared.
    pub measures: bool,
    /// Whether the camera stays where it starts.
    pub is_still: bool,
    /// Whether surfaces are lit. Bevy's lighting takes seconds a frame on a software driver, and would drown everything else.
    pub is_lit: bool,
    /// Whether the plug-in begins switched off.
    pub is_off: bool,
    /// The scene's size, where it has one.
    pub scene_size: Option<u32>,
    /// Pixels.
    pub size: [u32; 2],
    /// What is compared.
    pub ways: Vec<Way>,
}

impl Arguments {
    /// Those of this process; ends it with words where they cannot be understood.
    pub fn of_process() -> Self {
        match Self::parse(std::env::args().skip(1)) {
            Ok(arguments) => arguments,
            Err(problem) => {
                eprintln!("{problem}\n{USAGE}");
                std::process::exit(2);
            }
        }
    }

    /// The frame of the path that is shown in a frame.
    pub fn path_frame(&self, frame: usize) -> usize {
        if self.is_still { 0 } else { frame }
    }

    /// The settings of the camera.
    pub fn culling(&self) -> AntumbraCulling {
        let strategy = match self.is_off {
            true => Strategy::Off,
            false => Strategy::FrameLate,
        };
        AntumbraCulling {
            strategy,
            ..default()
        }
    }

    fn parse(words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self {
            frames: 0,
            measures: false,
            is_still: false,
            is_lit: false,
            is_off: false,
            scene_size: None,
            size: [640, 480],
            ways: Way::ALL.to_vec(),
        };
        let mut words = words;
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("{word} needs a value"));
            match word.as_str() {
                "--measure" => arguments.measures = true,
                "--still" => arguments.is_still = true,
                "--lit" => arguments.is_lit = true,
                "--off" => arguments.is_off = true,
                "--scene-size" => arguments.scene_size = Some(number(&value()?)? as u32),
                "--frames" => arguments.frames = number(&value()?)?,
                "--size" => {
                    let value = value()?;
                    let (width, height) = value
                        .split_once('x')
                        .ok_or(format!("{value} is no size: write 640x480"))?;
                    arguments.size = [number(width)? as u32, number(height)? as u32];
                }
                "--ways" => {
                    let value = value()?;
                    let ways = value.split(',').map(way);
                    arguments.ways = ways.collect::<Result<_, _>>()?;
                }
                other => return Err(format!("what is {other}?")),
            }
        }
        if arguments.measures && arguments.frames == 0 {
            arguments.frames = 20;
        }
        Ok(arguments)
    }
}

const USAGE: &str = "\
    --frames N      run so many frames without a window
    --measure       compare ways to cull, and print the medians
    --ways A,B,..   which: frustum-1, bevy-1, antumbra-1, antumbra-prepass-1; with -4 for four samples a pixel
    --still         do not move the camera
    --lit           light surfaces
    --off           begin with the plug-in switched off
    --scene-size N  how large the scene is
    --size WxH      pixels, 640x480";

fn number(word: &str) -> Result<usize, String> {
    word.parse().map_err(|_| format!("{word} is no number"))
}

fn way(word: &str) -> Result<Way, String> {
    let found = Way::ALL.into_iter().find(|way| way.name() == word);
    found.ok_or(format!("{word} is no way to cull"))
}
