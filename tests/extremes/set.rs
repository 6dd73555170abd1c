//! What the scenes are made of: boxes and balls in plain colours, under one light.

use antumbra::scene::{
    Aabb, Camera, Drawable, EntityKey, Geometry, Light, Material, MaterialKey, Mesh, MeshKey,
    Projection, Scene, icosphere,
};
use glam::{DAffine3, DQuat, DVec3};

/// A scene under construction.
pub struct Set {
    pub scene: Scene,
    pub cube: MeshKey,
    pub ball: MeshKey,
    /// A square a metre wide that faces +Z.
    pub square: MeshKey,
    paints: [MaterialKey; 3],
    next: usize,
}

impl Set {
    /// A lit scene without anything to see.
    pub fn new() -> Self {
        Self::painted(false)
    }

    /// The same where all that is put has one colour from all sides: for surfaces at equal depth, which strategies that shade more than one list
    /// may draw in another order than the reference. All that own a pixel must be drawn; who of those at equal depth shows is not seen.
    pub fn plain() -> Self {
        Self::painted(true)
    }

    fn painted(unlit: bool) -> Self {
        let mut scene = Scene::new();
        let unit = Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.5));
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
            add("cube", Geometry::from_box(&unit)),
            add("ball", icosphere(1, 0.5)),
            add("square", square),
        ];
        let colours = [[0.9, 0.3, 0.1], [0.2, 0.7, 0.3], [0.3, 0.4, 0.9]];
        let paints = colours.map(|[r, g, b]| {
            let base_colour = if unlit { [1.0; 4] } else { [r, g, b, 1.0] };
            scene.add_material(Material {
                base_colour,
                unlit,
                ..Material::default()
            })
        });
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

    /// Puts a mesh somewhere, in the next colour.
    pub fn put(&mut self, mesh: MeshKey, place: DAffine3) -> EntityKey {
        let material = self.paints[self.next % self.paints.len()];
        self.next += 1;
        let entity = self.scene.spawn(None, place).unwrap();
        let drawable = Drawable { mesh, material };
        self.scene.set_drawable(entity, drawable).unwrap();
        entity
    }

    pub fn cube(&mut self, centre: DVec3, size: DVec3) -> EntityKey {
        self.put(self.cube, placed(centre, size))
    }

    pub fn ball(&mut self, centre: DVec3, diameter: f64) -> EntityKey {
        self.put(self.ball, placed(centre, DVec3::splat(diameter)))
    }

    /// A wall five metres wide with balls and boxes before it, behind it and beside it, some turned, around a point; a metre is `metre` metres.
    pub fn still_life(metre: f64, origin: DVec3) -> Self {
        Self::new().with_still_life(metre, origin)
    }

    /// The same in this set's colours.
    pub fn with_still_life(self, metre: f64, origin: DVec3) -> Self {
        let mut set = self;
        let at = |x: f64, y: f64, z: f64| origin + DVec3::new(x, y, z) * metre;
        set.cube(at(0.0, 0.0, 0.0), DVec3::new(5.0, 4.0, 0.25) * metre);
        for column in -2..=2 {
            let x = f64::from(column);
            set.ball(at(x, 0.125, -1.5), 0.75 * metre);
            set.ball(at(x * 1.5, 0.25, 1.25), 0.5 * metre);
            let turned = DAffine3::from_scale_rotation_translation(
                DVec3::new(1.0, 0.5, 0.75) * metre,
                DQuat::from_rotation_z(x * 0.4),
                at(x * 2.0, 1.25, -4.0),
            );
            set.put(set.cube, turned);
        }
        set
    }
}

/// Upright, of some size.
pub fn placed(centre: DVec3, size: DVec3) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(size, DQuat::IDENTITY, centre)
}

pub fn perspective(degrees: f64, near: f64) -> Projection {
    Projection::Perspective {
        fov_y: degrees.to_radians(),
        near,
    }
}

pub fn look(eye: DVec3, target: DVec3, projection: Projection) -> Camera {
    Camera::look_at(eye, target, DVec3::Y, projection).unwrap()
}

/// A camera over pixels a metre wide, looking down -Z from some place: what lies at (x, y) is `x` pixels right of the middle and `y` above it.
pub fn over_pixels(eye: DVec3, size: [u32; 2]) -> Camera {
    let projection = Projection::Orthographic {
        height: f64::from(size[1]),
        near: 0.0,
        far: 100.0,
    };
    look(eye, eye - DVec3::Z, projection)
}
