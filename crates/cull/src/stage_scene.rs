//! What a stage needs of a scene: a table of its entities, a layout that plans depend on, and a renderer that draws it.

use std::any::Any;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::device::Gpu;
use crate::entities::{PipelineClass, SceneTable};
use crate::renderer::Renderer;

/// A scene that a [`Stage`](crate::Stage) can cull. The built-in renderer's `GpuScene` is one.
pub trait StageScene {
    /// The device that it is on.
    fn gpu(&self) -> &Gpu;

    /// An id, unique in this process ([`next_scene_number`]). Slots and epochs are meaningful only together with it, and a stage keeps the renderer that it took for it.
    fn number(&self) -> u64;

    /// The entities as they are now.
    fn table(&self) -> &Arc<SceneTable>;

    /// What plans for this scene depend on.
    fn layout(&self) -> SceneLayout;

    /// The entities as they are now, with what the renderer needs to draw them.
    fn frame(&self) -> SceneFrame;

    /// A new renderer that draws this scene's frames.
    fn renderer(&self) -> Box<dyn Renderer>;
}

/// A number for a new scene: no other scene of this process has it.
pub fn next_scene_number() -> u64 {
    static SCENES: AtomicU64 = AtomicU64::new(0);
    SCENES.fetch_add(1, Ordering::Relaxed)
}

/// Makes a renderer for a scene.
type MakeRenderer<S> = dyn Fn(&S) -> Box<dyn Renderer> + Send + Sync;

/// A scene that is drawn by another renderer than its own.
///
/// ```no_run
/// # use antumbra_cull::*;
/// # fn wrapped<S: StageScene + 'static>(scene: S, ours: fn(&S) -> Box<dyn Renderer>) -> WithRenderer<S> {
/// let scene = WithRenderer::new(scene, ours);
/// // Each frame: `scene.scene_mut().sync(..)`, then `stage.frame(&scene, ..)`.
/// # scene
/// # }
/// ```
pub struct WithRenderer<S> {
    scene: S,
    number: u64,
    renderer: Box<MakeRenderer<S>>,
}

impl<S: StageScene> WithRenderer<S> {
    /// The scene, with what makes a renderer for it. `renderer` is called once a stage.
    pub fn new(
        scene: S,
        renderer: impl Fn(&S) -> Box<dyn Renderer> + Send + Sync + 'static,
    ) -> Self {
        Self {
            scene,
            // Its own: a stage that knows the scene by another renderer must not take this one for the same.
            number: next_scene_number(),
            renderer: Box::new(renderer),
        }
    }

    /// The scene.
    pub fn scene(&self) -> &S {
        &self.scene
    }

    /// The scene, to change it between frames.
    pub fn scene_mut(&mut self) -> &mut S {
        &mut self.scene
    }
}

impl<S: StageScene> StageScene for WithRenderer<S> {
    fn gpu(&self) -> &Gpu {
        self.scene.gpu()
    }

    fn number(&self) -> u64 {
        self.number
    }

    fn table(&self) -> &Arc<SceneTable> {
        self.scene.table()
    }

    fn layout(&self) -> SceneLayout {
        self.scene.layout()
    }

    fn frame(&self) -> SceneFrame {
        self.scene.frame()
    }

    fn renderer(&self) -> Box<dyn Renderer> {
        (self.renderer)(&self.scene)
    }
}

impl<S: fmt::Debug> fmt::Debug for WithRenderer<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("WithRenderer")
            .field("scene", &self.scene)
            .finish_non_exhaustive()
    }
}

/// What the nodes of a frame need of a scene: shared handles, cheap to clone.
#[derive(Clone)]
pub struct SceneFrame {
    /// All drawable entities, by slot.
    pub table: Arc<SceneTable>,
    data: Arc<dyn Any + Send + Sync>,
}

impl SceneFrame {
    /// A frame of a scene, with the data that its renderer draws from.
    pub fn new(table: Arc<SceneTable>, data: Arc<dyn Any + Send + Sync>) -> Self {
        Self { table, data }
    }

    /// The renderer's data; `None` if it is of another type.
    pub fn data<T: 'static>(&self) -> Option<&T> {
        self.data.downcast_ref()
    }
}

impl fmt::Debug for SceneFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SceneFrame")
            .field("table", &self.table)
            .finish_non_exhaustive()
    }
}

/// What a compiled plan depends on. When it changes, plans must be compiled again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneLayout {
    /// Capacity in slots: the size of buffers of counts by slot.
    pub slots: u32,
    /// Capacity in batches: the number of indirect draws.
    pub batches: u32,
    /// Capacity in boxes of parts of meshes ([`SceneTable::part_boxes`]).
    pub part_boxes: u32,
    /// Classes in use, as a bit mask by [`PipelineClass::index`].
    pub classes: u128,
    /// Whether any entity is blended.
    pub transparent: bool,
    /// Whether any light is a point or a spot light. Without one, lighting needs no distances.
    pub positional_lights: bool,
    /// Whether the scene has an environment to reflect.
    pub environment: bool,
}

impl SceneLayout {
    /// The classes in use, in drawing order.
    pub fn classes(&self) -> impl Iterator<Item = PipelineClass> + '_ {
        PipelineClass::all().filter(|class| self.classes >> class.index() & 1 != 0)
    }
}
