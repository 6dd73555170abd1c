//! Small scenes, and what larger ones are built of.

use antumbra_demo_scenes::{GridOptions, grid};
use antumbra_scene::{
    Aabb, AlphaMode, Drawable, EntityKey, Geometry, Image, Light, Material, MaterialKey, Mesh,
    MeshKey, Sampler, Scene, icosphere,
};
use glam::{DAffine3, DQuat, DVec3};

/// The built-in grid of `per_side`³ spheres around the origin, a metre apart.
pub fn balls(per_side: u32) -> Scene {
    let options = GridOptions {
        per_side,
        ..GridOptions::default()
    };
    grid(options).unwrap()
}

/// [`balls`] whose mesh has a simplified proxy.
pub fn balls_with_proxies(per_side: u32) -> Scene {
    let mut scene = balls(per_side);
    scene.ensure_proxies(&Default::default());
    scene
}

/// A mesh of its own in a material of its own.
pub fn drawable(scene: &mut Scene, name: &str, geometry: Geometry, material: Material) -> Drawable {
    Drawable {
        mesh: scene.add_mesh(Mesh::new(name, geometry)).unwrap(),
        material: scene.add_material(material),
    }
}

/// Adds an entity without a parent that shows a drawable.
pub fn add(scene: &mut Scene, place: DAffine3, drawable: Drawable) -> EntityKey {
    let entity = scene.spawn(None, place).unwrap();
    scene.set_drawable(entity, drawable).unwrap();
    entity
}

/// An upright transform: the centre, and the scale in each axis.
pub fn placed(centre: DVec3, size: DVec3) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(size, DQuat::IDENTITY, centre)
}

/// A box around the origin, `size` metres in each axis.
pub fn cuboid(size: DVec3) -> Geometry {
    Geometry::from_box(&Aabb::from_centre(DVec3::ZERO, size * 0.5))
}

/// A blended material of this colour.
pub fn glass(base_colour: [f32; 4]) -> Material {
    Material {
        alpha: AlphaMode::Blend,
        base_colour,
        ..Material::default()
    }
}

/// A white image of 4 x 4 pixels, half of them transparent.
pub fn holes() -> Image {
    let alpha = |i: u8| {
        if (i + i / 4).is_multiple_of(2) {
            255
        } else {
            0
        }
    };
    Image {
        name: "holes".to_owned(),
        width: 4,
        height: 4,
        rgba: (0..16).flat_map(|i| [255, 255, 255, alpha(i)]).collect(),
        sampler: Sampler::default(),
    }
}

/// A scene under construction, of boxes, balls and squares in three plain colours under one light.
pub struct SceneBuilder {
    /// The scene so far.
    pub scene: Scene,
    /// A box a metre wide around the origin.
    pub cube: MeshKey,
    /// A ball a metre wide around the origin.
    pub ball: MeshKey,
    /// A square a metre wide that faces +Z.
    pub square: MeshKey,
    paints: [MaterialKey; 3],
    next: usize,
}

impl Default for SceneBuilder {
    fn default() -> Self {
        Self::new()
    }
}

impl SceneBuilder {
    /// A lit scene without any surface.
    pub fn new() -> Self {
        let colours = [[0.9, 0.3, 0.1], [0.2, 0.7, 0.3], [0.3, 0.4, 0.9]];
        Self::painted(colours.map(|[r, g, b]| Material {
            base_colour: [r, g, b, 1.0],
            ..Material::default()
        }))
    }

    /// The same where every surface is white from all sides: for surfaces at equal depth. Strategies that shade more than one list may draw
    /// those in another order than the reference, and the picture does not show which of them is in front.
    pub fn plain() -> Self {
        let white = Material {
            unlit: true,
            ..Material::default()
        };
        Self::painted([white.clone(), white.clone(), white])
    }

    fn painted(paints: [Material; 3]) -> Self {
        let mut scene = Scene::new();
        let square = Geometry {
            positions: vec![
                [-0.5, -0.5, 0.0],
                [0.5, -0.5, 0.0],
                [0.5, 0.5, 0.0],
                [-0.5, 0.5, 0.0],
            ],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Geometry::default()
        };
        let mut add = |name: &str, geometry| scene.add_mesh(Mesh::new(name, geometry)).unwrap();
        let [cube, ball, square] = [
            add("cube", cuboid(DVec3::ONE)),
            add("ball", icosphere(1, 0.5)),
            add("square", square),
        ];
        let paints = paints.map(|paint| scene.add_material(paint));
        let sun = scene.spawn(None, DAffine3::from_rotation_x(-0.9)).unwrap();
        let light = Light::Directional {
            colour: [1.0; 3],
            illuminance: 3.0,
        };
        scene.set_light(sun, light).unwrap();
        Self {
            scene,
            cube,
            ball,
            square,
            paints,
            next: 0,
        }
    }

    /// Adds a mesh in the next colour.
    pub fn put(&mut self, mesh: MeshKey, place: DAffine3) -> EntityKey {
        let material = self.paints[self.next % self.paints.len()];
        self.next += 1;
        add(&mut self.scene, place, Drawable { mesh, material })
    }

    /// Adds an upright box.
    pub fn cube(&mut self, centre: DVec3, size: DVec3) -> EntityKey {
        self.put(self.cube, placed(centre, size))
    }

    /// Adds a ball.
    pub fn ball(&mut self, centre: DVec3, diameter: f64) -> EntityKey {
        self.put(self.ball, placed(centre, DVec3::splat(diameter)))
    }

    /// A scene with [`SceneBuilder::with_still_life`] in it.
    pub fn still_life(metre: f64, origin: DVec3) -> Self {
        Self::new().with_still_life(metre, origin)
    }

    /// Adds a wall five metres wide with balls and boxes before it, behind it and beside it, some rotated, around `origin`. All lengths are
    /// multiplied by `metre`.
    pub fn with_still_life(mut self, metre: f64, origin: DVec3) -> Self {
        let at = |x: f64, y: f64, z: f64| origin + DVec3::new(x, y, z) * metre;
        self.cube(at(0.0, 0.0, 0.0), DVec3::new(5.0, 4.0, 0.25) * metre);
        for column in -2..=2 {
            let x = f64::from(column);
            self.ball(at(x, 0.125, -1.5), 0.75 * metre);
            self.ball(at(x * 1.5, 0.25, 1.25), 0.5 * metre);
            let rotated = DAffine3::from_scale_rotation_translation(
                DVec3::new(1.0, 0.5, 0.75) * metre,
                DQuat::from_rotation_z(x * 0.4),
                at(x * 2.0, 1.25, -4.0),
            );
            self.put(self.cube, rotated);
        }
        self
    }
}
