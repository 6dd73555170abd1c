//! What draws: the contract between a stage, which decides what is drawn, and a renderer, which knows how.
//!
//! A [`Renderer`] adds nodes to the graph that draw a [`DrawSource`] into targets, and returns the targets' next versions. It never chooses. Strategies that draw
//! some, test, and draw the rest ask it in the middle of the frame, through [`FrameGraph`](crate::FrameGraph). `antumbra-draw` has the built-in one.

use antumbra_graph::{Bind, Buffer, Graph, Host, RasterBuilder, Texture};

use crate::draw_source::patches::PatchDraws;
use crate::draw_source::{DrawSource, ListDraws};
use crate::stage::StageOutput;
use crate::stage_scene::{SceneFrame, SceneLayout};
use crate::view::ViewFrame;

/// The format of every depth buffer: reversed, infinite far plane.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// The format of entity-id buffers: the low and the high half of slot + 1; 0 where nothing is drawn. A format of 32-bit integers may not have several samples a pixel.
pub const IDENTITY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg16Uint;

/// Shades what a stage decides to draw.
pub trait Renderer: Send {
    /// Adds nodes that the shading passes of a view share, such as uploads. Called once per view and plan, before any pass of the view.
    fn begin_view(&mut self, _pass: Pass<'_>) {}

    /// Adds a node that shades a source into targets, in the source's order. Opaque and masked entities write depth; blended ones test it. A sample passes where its
    /// reversed depth is greater or equal, so equal depths are visible. Returns the next versions of everything it was given.
    ///
    /// A node with indirect draws must [require](RasterBuilder::requires) [`wgpu::Features::INDIRECT_FIRST_INSTANCE`]: without it such draws draw nothing, and no error is reported.
    fn shade(&mut self, pass: Pass<'_>, source: DrawSource, into: ShadeTargets) -> ShadeTargets;

    /// What draws the geometry of tests: depth, ids, counts and queries.
    fn tests(&mut self) -> &mut dyn TestRenderer;
}

/// Draws the geometry that stands for entities in visibility tests. All its passes and the shading passes use one position function, so that equal geometry has equal
/// depth.
pub trait TestRenderer: Send {
    /// Adds a node that writes the depth of a list.
    fn depth(&mut self, pass: Pass<'_>, source: ListDraws, depth: Texture) -> Texture;

    /// Adds a node that writes the entity ids ([`IDENTITY_FORMAT`]) and the depth of a list.
    fn ids(&mut self, pass: Pass<'_>, source: ListDraws, targets: IdTargets) -> IdTargets;

    /// Adds a node that counts the samples of a source that pass against a finished depth, by slot, a u32 each. Equal depths pass.
    fn count(
        &mut self,
        pass: Pass<'_>,
        source: DrawSource,
        test: DepthTest,
        counts: Buffer,
    ) -> Buffer;

    /// Adds a node that draws a list with one hardware query for each of its [queries](crate::DrawList::query_count), in the list's order, against a depth that it does
    /// not write. The results are u64: zero, or something else.
    fn query(
        &mut self,
        pass: Pass<'_>,
        source: ListDraws,
        depth: Texture,
        results: Buffer,
    ) -> Buffer;

    /// Adds a node that draws kept entries into their patches and marks the pixels in which any of them is in front of a finished depth, equal depths left out. `marks` has
    /// [`PATCH_BYTES`](crate::patches::PATCH_BYTES) for each patch; it is zero before.
    fn mark_patches(
        &mut self,
        pass: Pass<'_>,
        source: PatchDraws,
        test: DepthTest,
        marks: Buffer,
    ) -> Buffer;
}

/// A pass that a renderer is asked to add.
pub struct Pass<'a> {
    /// The graph to add it to.
    pub graph: &'a mut Graph,
    /// The node's name.
    pub name: String,
    /// The label under which its time is summed: `cull`, `draw` or `audit`.
    pub group: &'static str,
    /// The number of the view, from 0.
    pub view: usize,
    /// What the names of this view's nodes and resources begin with: empty for a single view.
    pub prefix: &'a str,
    /// What the view's nodes read.
    pub inputs: ViewInputs,
    /// What the plan depends on.
    pub layout: &'a SceneLayout,
    /// The format of the colour targets.
    pub colour_format: wgpu::TextureFormat,
    /// The samples a pixel of all targets, and of what is tested against them.
    pub samples: u32,
    /// Whether there is an image. With [`StageOutput::Answers`], shading passes leave the colour alone and write depth and ids of opaque entities only.
    pub output: StageOutput,
}

impl Pass<'_> {
    /// A node's or resource's name in this view.
    pub fn named(&self, what: &str) -> String {
        format!("{}{what}", self.prefix)
    }
}

/// What every drawing node of a view reads.
#[derive(Debug, Clone, Copy)]
pub struct ViewInputs {
    /// The scene.
    pub scene: Host<SceneFrame>,
    /// The camera.
    pub view: Host<ViewFrame>,
    /// [`GpuView`](crate::GpuView), uploaded.
    pub uniform: Buffer,
}

/// The image of a view: shading passes draw into these textures and return their next versions.
#[derive(Debug, Clone, Copy)]
pub struct Targets {
    /// Colour.
    pub colour: Texture,
    /// Depth, reversed: 0 is infinitely far.
    pub depth: Texture,
}

/// What a shading pass writes.
#[derive(Debug, Clone, Copy)]
pub struct ShadeTargets {
    /// The image.
    pub targets: Targets,
    /// Entity ids ([`IDENTITY_FORMAT`]) beside the colour, where they are wanted.
    pub ids: Option<Texture>,
    /// One hardware query for each of the list's [queries](crate::DrawList::query_count), where they are wanted: whether any sample passed while it was drawn, a u64
    /// each. Only for [`DrawSource::List`].
    pub queries: Option<Buffer>,
}

impl From<Targets> for ShadeTargets {
    fn from(targets: Targets) -> Self {
        Self {
            targets,
            ids: None,
            queries: None,
        }
    }
}

/// The image of an entity-id pass.
#[derive(Debug, Clone, Copy)]
pub struct IdTargets {
    /// Slot + 1, 0 where nothing is drawn; [`IDENTITY_FORMAT`].
    pub ids: Texture,
    /// Depth, reversed.
    pub depth: Texture,
}

/// How the fragments of a counting pass are held against a finished depth.
#[derive(Debug, Clone, Copy)]
pub enum DepthTest {
    /// By the depth test itself, forced early. Needs [`wgpu::Features::SHADER_EARLY_DEPTH_TEST`].
    Early {
        /// The finished depth.
        depth: Texture,
    },
    /// By a comparison in the shader.
    InShader {
        /// The finished depth.
        depth: Texture,
        /// A depth texture of the same size that is written but never read: a pass needs an attachment, and not every device
        /// lets one texture be attached and sampled at once.
        scratch: Texture,
    },
}

impl DepthTest {
    /// Declares the textures on a node.
    pub fn declare(self, node: &mut RasterBuilder<'_>) {
        match self {
            Self::Early { depth } => {
                node.requires(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
                    .depth_read(depth);
            }
            Self::InShader { depth, scratch } => {
                node.sample(depth).depth(scratch);
            }
        }
    }

    /// The depth as a shader binding, where the shader reads it.
    pub fn bind(self, binding: u32) -> Option<Bind> {
        match self {
            Self::Early { .. } => None,
            Self::InShader { depth, .. } => Some(Bind::Texture(binding, depth)),
        }
    }
}
