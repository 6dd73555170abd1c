//! A small world in an app without a window, whose frames are looked at one by one.

use std::f32::consts::FRAC_PI_4;

use antumbra_bevy::{AntumbraCulling, AntumbraPlugin, CullingReport};
use bevy::camera::RenderTarget;
use bevy::prelude::*;

use crate::headless;

/// An app with boxes and a camera.
pub struct Play {
    pub app: App,
    pub camera: Entity,
    pub image: Handle<Image>,
    pub size: [u32; 2],
    cube: Handle<Mesh>,
}

/// The colours that tests look for. Boxes have no light, so that these are a pixel's bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Paint {
    Grey,
    Red,
    Blue,
}

impl Paint {
    fn material(self) -> StandardMaterial {
        let [red, green, blue] = self.bytes();
        StandardMaterial {
            base_color: Color::srgb_u8(red, green, blue),
            unlit: true,
            ..default()
        }
    }

    fn bytes(self) -> [u8; 3] {
        match self {
            Self::Grey => [128, 128, 128],
            Self::Red => [255, 0, 0],
            Self::Blue => [0, 0, 255],
        }
    }
}

/// Where a camera stands that looks at the origin.
pub fn from(eye: [f32; 3]) -> Transform {
    Transform::from_translation(Vec3::from_array(eye)).looking_at(Vec3::ZERO, Vec3::Y)
}

/// A box's place: its centre and its size along each axis.
pub fn boxed(centre: [f32; 3], size: [f32; 3]) -> Transform {
    Transform::from_translation(Vec3::from_array(centre)).with_scale(Vec3::from_array(size))
}

impl Play {
    /// An app with a camera 20 m before the origin, that culls.
    pub fn new() -> Self {
        Self::with([160, 120], (AntumbraCulling::default(), Msaa::default()))
    }

    /// An app with a camera that has these components besides.
    pub fn with(size: [u32; 2], bundle: impl Bundle) -> Self {
        let mut app = headless::app();
        app.add_plugins(AntumbraPlugin);
        let image = headless::target(&mut app, size);
        let cube = Mesh::from(Cuboid::from_length(1.0));
        let cube = app.world_mut().resource_mut::<Assets<Mesh>>().add(cube);
        headless::finish(&mut app);
        let mut play = Self {
            app,
            camera: Entity::PLACEHOLDER,
            image: image.clone(),
            size,
            cube,
        };
        play.camera = play.add_camera(image, from([0.0, 0.0, 20.0]), bundle);
        play
    }

    pub fn add_camera(
        &mut self,
        image: Handle<Image>,
        place: Transform,
        bundle: impl Bundle,
    ) -> Entity {
        let projection = Projection::Perspective(PerspectiveProjection {
            fov: FRAC_PI_4,
            ..default()
        });
        let camera = (
            Camera3d::default(),
            bevy::core_pipeline::tonemapping::Tonemapping::None,
            projection,
            RenderTarget::from(image),
            place,
        );
        self.app.world_mut().spawn((camera, bundle)).id()
    }

    pub fn add(&mut self, paint: Paint, place: Transform) -> Entity {
        self.add_shape(paint, self.cube.clone(), place)
    }

    pub fn add_mesh(&mut self, paint: Paint, mesh: Mesh, place: Transform) -> Entity {
        let mesh = self
            .app
            .world_mut()
            .resource_mut::<Assets<Mesh>>()
            .add(mesh);
        self.add_shape(paint, mesh, place)
    }

    fn add_shape(&mut self, paint: Paint, mesh: Handle<Mesh>, place: Transform) -> Entity {
        let mut materials = self
            .app
            .world_mut()
            .resource_mut::<Assets<StandardMaterial>>();
        let material = MeshMaterial3d(materials.add(paint.material()));
        let bundle = (Mesh3d(mesh), material, place);
        self.app.world_mut().spawn(bundle).id()
    }

    /// A wall through the origin that hides all that is behind its middle.
    pub fn add_wall(&mut self) -> Entity {
        self.add(Paint::Grey, boxed([0.0; 3], [8.0, 8.0, 0.5]))
    }

    pub fn set<T: Bundle>(&mut self, entity: Entity, component: T) {
        self.app.world_mut().entity_mut(entity).insert(component);
    }

    pub fn frame(&mut self) {
        headless::frame(&mut self.app);
    }

    /// Frames until everything that can be known is known.
    pub fn settle(&mut self) {
        for _ in 0..4 {
            self.frame();
        }
    }

    pub fn report(&self) -> &CullingReport {
        self.report_of(self.camera)
    }

    pub fn report_of(&self, camera: Entity) -> &CullingReport {
        match self.app.world().get::<CullingReport>(camera) {
            Some(report) => report,
            None => panic!("a camera without a report"),
        }
    }

    /// Whether the camera has left something out in the last frame.
    pub fn culls(&self, entity: Entity) -> bool {
        self.report().culled.contains(&entity)
    }

    pub fn pixels(&self) -> Vec<u8> {
        headless::picture(&self.app, &self.image, self.size)
    }

    /// How many pixels have a colour in the last frame.
    pub fn seen(&self, paint: Paint) -> usize {
        let pixels = self.pixels();
        let same = |pixel: &&[u8]| pixel[..3] == paint.bytes();
        pixels.chunks(4).filter(same).count()
    }
}

/// The pixels in which two pictures differ.
pub fn differences(one: &[u8], other: &[u8]) -> usize {
    assert_eq!(one.len(), other.len());
    let pairs = one.chunks(4).zip(other.chunks(4));
    pairs.filter(|(one, other)| one != other).count()
}
