//! How stages are run while the kit plays: who submits, what comes out, how many samples a pixel has, and who shades.

use std::fmt;

use antumbra_cull::{
    Counting, DeclareError, DeviceError, DistrustOptions, FrustumOnly, Gpu, Stage, StageError,
    StageOptions, StageOutput, Strategy, ViewSpec,
};
use antumbra_draw::GpuScene;
use antumbra_graph::{CompileError, Mode};

use super::failure::ViolationKind;
use super::test_scene::TestScene;

/// A way to run stages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Setup {
    /// Whether they submit on their own, or record into a host's encoder and draw into a host's textures, whose depth shaders may read.
    pub mode: Mode,
    /// An image, or answers alone: then what the kit draws is what the answers say.
    pub output: StageOutput,
    /// Samples a pixel.
    pub samples: u32,
    /// Who shades.
    pub shading: Shading,
}

/// Who shades.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Shading {
    /// The built-in renderer.
    Builtin,
    /// Another one, as a host has it: it needs nodes of its own after each pass, so that only the versions it returns are finished.
    Host,
}

impl Setup {
    /// A stage on its own, with an image of one sample a pixel, shaded by the built-in renderer.
    pub const PLAIN: Self = Self {
        mode: Mode::Owned,
        output: StageOutput::Image,
        samples: 1,
        shading: Shading::Builtin,
    };

    /// The setups that [other setups](super::OtherSetups) are: each of a host's ways with each of the others.
    pub const OTHERS: [Self; 4] = [
        Self {
            samples: 4,
            shading: Shading::Host,
            ..Self::PLAIN
        },
        Self {
            output: StageOutput::Answers,
            ..Self::PLAIN
        },
        Self {
            mode: Mode::Embedded,
            shading: Shading::Host,
            ..Self::PLAIN
        },
        Self {
            mode: Mode::Embedded,
            output: StageOutput::Answers,
            samples: 4,
            ..Self::PLAIN
        },
    ];

    /// How a stage is built.
    pub(super) fn options(self) -> StageOptions {
        StageOptions {
            mode: self.mode,
            output: self.output,
            samples: self.samples,
            // What is tested is the strategy, not what replaces it.
            distrust: DistrustOptions::OFF,
            ..StageOptions::default()
        }
    }

    /// Why this strategy cannot be run so; `None` where it can, and where it fails in a way that is a fault.
    ///
    /// A plan that waits cannot be recorded into a host's encoder, a strategy that draws step by step has no answers, and a device may lack what several samples need.
    pub(super) fn refusal(
        self,
        gpu: &Gpu,
        strategy: Box<dyn Strategy>,
    ) -> Result<Option<String>, ViolationKind> {
        if self.samples > 1
            && let Some(lacking) =
                Counting::by_fragments(gpu, self.samples).lacking(gpu, self.samples)
        {
            return Ok(Some(format!("the oracle lacks {lacking}")));
        }
        let mut scene = TestScene::new()?.scene;
        let scene = GpuScene::new(gpu, &mut scene)?;
        let stage = |strategy| {
            let views = vec![ViewSpec::main(16, 16)];
            Stage::new(&scene, strategy, views, self.options())
        };
        let refused = |error: StageError| lacks(&error).then(|| error.to_string());
        // What no strategy can do on this device, then what this one cannot.
        let by_device = stage(Box::new(FrustumOnly)).err().and_then(refused);
        Ok(by_device.or_else(|| stage(strategy).err().and_then(refused)))
    }
}

/// Whether an error says that something cannot be had.
fn lacks(error: &StageError) -> bool {
    match error {
        StageError::NoAnswers { .. }
        | StageError::Device(DeviceError::Samples { .. })
        | StageError::Declare(DeclareError::Device { .. }) => true,
        StageError::Compile { errors, .. } => errors.errors.iter().all(|error| {
            matches!(
                error,
                CompileError::SyncInEmbedded { .. } | CompileError::LoopInEmbedded { .. }
            )
        }),
        _ => false,
    }
}

impl fmt::Display for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.mode {
            Mode::Owned => "on its own",
            Mode::Embedded => "in a host's frame",
        })?;
        if self.output == StageOutput::Answers {
            f.write_str(", answers alone")?;
        }
        if self.samples != 1 {
            write!(f, ", {} samples a pixel", self.samples)?;
        }
        if self.shading == Shading::Host {
            f.write_str(", a host's renderer")?;
        }
        Ok(())
    }
}
