//! Scenes that the cases are built from: a few meshes, a few materials, and random scenes that follow from a seed.

use antumbra_scene::{
    Aabb, AlphaMode, Camera, CameraError, Drawable, EntityKey, Geometry, Image, Light, Material,
    MaterialKey, Mesh, MeshKey, Projection, ProxyOptions, Sampler, Scene, SceneError, Topology,
    icosphere,
};
use glam::{DAffine3, DQuat, DVec3, Vec3};
use rand::RngExt;
use rand_pcg::Pcg32;

/// Meshes of about a metre, centred at the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meshes {
    pub sphere: MeshKey,
    pub cube: MeshKey,
    /// A triangle two metres long and a centimetre wide.
    pub sliver: MeshKey,
    /// A square of no thickness that faces +Z, with texture coordinates.
    pub square: MeshKey,
    /// A slanted square: from the lower front edge of its box to the upper back edge.
    pub ramp: MeshKey,
    /// The edges of a cube.
    pub lines: MeshKey,
    /// Twenty points on a spiral.
    pub points: MeshKey,
    /// One line of a metre along X.
    pub line: MeshKey,
    /// One point.
    pub point: MeshKey,
    /// A cube whose triangles have no area.
    pub collapsed: MeshKey,
}

/// Materials. There are four opaque colours, so that adjacent entities differ in the image.
#[derive(Debug, Clone, Copy)]
pub(super) struct Materials {
    pub opaque: [MaterialKey; 4],
    pub double_sided: MaterialKey,
    /// Alpha-masked by a texture with holes.
    pub mask: MaterialKey,
    pub blend: MaterialKey,
    /// The same colour from every side. For coplanar surfaces: the image is the same whichever of them is drawn last.
    pub unlit: MaterialKey,
}

/// A scene, with the meshes and materials to build it from.
pub(super) struct TestScene {
    pub scene: Scene,
    pub meshes: Meshes,
    pub materials: Materials,
}

impl TestScene {
    /// A lit scene without a drawable entity.
    pub fn new() -> Result<Self, SceneError> {
        let mut scene = Scene::new();
        let mut mesh = |name: &str, geometry| scene.add_mesh(Mesh::new(name, geometry));
        let cube = Geometry::from_box(&Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.5)));
        let meshes = Meshes {
            sphere: mesh("sphere", icosphere(2, 0.5))?,
            sliver: mesh("sliver", sliver())?,
            square: mesh("square", square())?,
            ramp: mesh("ramp", ramp())?,
            lines: mesh("lines", edges(&cube))?,
            points: mesh("points", points())?,
            line: mesh(
                "line",
                primitives(Topology::Lines, &[[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]]),
            )?,
            point: mesh("point", primitives(Topology::Points, &[[0.0; 3]]))?,
            collapsed: mesh("collapsed", collapsed(&cube))?,
            cube: mesh("cube", cube)?,
        };
        scene.ensure_proxies(&ProxyOptions::default());
        let materials = materials(&mut scene)?;
        let sun = scene.spawn(None, DAffine3::from_rotation_x(-0.9))?;
        let light = Light::Directional {
            colour: [1.0; 3],
            illuminance: 3.0,
        };
        scene.set_light(sun, light)?;
        Ok(Self {
            scene,
            meshes,
            materials,
        })
    }

    /// Adds an entity.
    pub fn add(
        &mut self,
        mesh: MeshKey,
        material: MaterialKey,
        transform: DAffine3,
    ) -> Result<EntityKey, SceneError> {
        add(&mut self.scene, mesh, material, transform)
    }

    /// Adds a box of this size in metres, in the first opaque colour.
    pub fn cube(&mut self, centre: DVec3, size: DVec3) -> Result<EntityKey, SceneError> {
        let [material, ..] = self.materials.opaque;
        self.add(self.meshes.cube, material, placed(centre, size))
    }

    /// Adds a sphere of this diameter in metres, in the second opaque colour.
    pub fn sphere(&mut self, centre: DVec3, diameter: f64) -> Result<EntityKey, SceneError> {
        let [_, material, ..] = self.materials.opaque;
        let place = placed(centre, DVec3::splat(diameter));
        self.add(self.meshes.sphere, material, place)
    }

    /// Adds two walls and `count` entities of various meshes and materials, at random places in a cube of eight metres. Each cube contains
    /// a sphere.
    pub fn scatter(&mut self, random: &mut Pcg32, count: u32) -> Result<(), SceneError> {
        self.cube(DVec3::new(0.3, 0.1, -1.1), DVec3::new(6.0, 5.0, 0.2))?;
        self.cube(DVec3::new(1.3, -0.2, 0.6), DVec3::new(0.15, 4.0, 5.0))?;
        let Meshes {
            sphere,
            cube,
            sliver,
            square,
            lines,
            points,
            ..
        } = self.meshes;
        let Materials {
            opaque,
            double_sided,
            mask,
            blend,
            ..
        } = self.materials;
        for number in 0..count {
            let place = DVec3::from_array(std::array::from_fn(|_| random.random_range(-4.0..4.0)));
            let rotation = random_rotation(random);
            let mut size = DVec3::splat(random.random_range(0.3..1.4));
            // Only solid entities are mirrored: each further kind of pipeline costs the kit time.
            if number % 12 < 7 && random.random_bool(0.3) {
                size.x = -size.x;
            }
            let plain = opaque
                .get(number as usize % opaque.len())
                .copied()
                .unwrap_or(double_sided);
            let (mesh, material) = match number % 12 {
                0..4 => (sphere, plain),
                4..7 => (cube, plain),
                7 => (sliver, double_sided),
                8 => (square, mask),
                9 => (cube, blend),
                10 => (lines, plain),
                _ => (points, plain),
            };
            self.add(
                mesh,
                material,
                DAffine3::from_scale_rotation_translation(size, rotation, place),
            )?;
            if mesh == cube {
                // Nested: visible only if the cube around it is transparent.
                self.add(sphere, plain, placed(place, size * 0.4))?;
            }
        }
        Ok(())
    }
}

/// Adds an entity to a scene, which may be in a run already.
pub(super) fn add(
    scene: &mut Scene,
    mesh: MeshKey,
    material: MaterialKey,
    transform: DAffine3,
) -> Result<EntityKey, SceneError> {
    let entity = scene.spawn(None, transform)?;
    scene.set_drawable(entity, Drawable { mesh, material })?;
    Ok(entity)
}

/// A transform without rotation: scale, then translation.
pub(super) fn placed(centre: DVec3, size: DVec3) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(size, DQuat::IDENTITY, centre)
}

/// A random rotation.
pub(super) fn random_rotation(random: &mut Pcg32) -> DQuat {
    let [x, y, z] = std::array::from_fn(|_| random.random_range(-3.1..3.1));
    DQuat::from_euler(glam::EulerRot::XYZ, x, y, z)
}

/// A camera with its near plane at 0.1 m.
pub(super) fn camera(eye: DVec3, target: DVec3) -> Result<Camera, CameraError> {
    camera_with(eye, target, 0.1)
}

/// A camera with its near plane at `near` metres; its vertical field of view is 1 rad.
pub(super) fn camera_with(eye: DVec3, target: DVec3, near: f64) -> Result<Camera, CameraError> {
    let projection = Projection::Perspective { fov_y: 1.0, near };
    Camera::look_at(eye, target, DVec3::Y, projection)
}

fn materials(scene: &mut Scene) -> Result<Materials, SceneError> {
    let colours = [
        [0.9, 0.2, 0.1, 1.0],
        [0.1, 0.7, 0.3, 1.0],
        [0.2, 0.3, 0.9, 1.0],
        [0.8, 0.8, 0.2, 1.0],
    ];
    let opaque = colours.map(|base_colour| {
        scene.add_material(Material {
            base_colour,
            ..Material::default()
        })
    });
    let holes = scene.add_image(checkers())?;
    Ok(Materials {
        opaque,
        double_sided: scene.add_material(Material {
            base_colour: [0.6, 0.4, 0.8, 1.0],
            double_sided: true,
            ..Material::default()
        }),
        mask: scene.add_material(Material {
            base_colour_image: Some(holes),
            alpha: AlphaMode::Mask { cutoff: 0.5 },
            double_sided: true,
            ..Material::default()
        }),
        blend: scene.add_material(Material {
            base_colour: [0.4, 0.8, 0.9, 0.4],
            alpha: AlphaMode::Blend,
            ..Material::default()
        }),
        unlit: scene.add_material(Material {
            base_colour: [0.9, 0.5, 0.1, 1.0],
            unlit: true,
            ..Material::default()
        }),
    })
}

/// A checkerboard of 8 x 8 pixels; every second one is a hole.
fn checkers() -> Image {
    let pixel = |i: u32| {
        [
            200,
            160,
            90,
            if (i + i / 8).is_multiple_of(2) {
                255
            } else {
                0
            },
        ]
    };
    Image {
        name: "checkers".to_owned(),
        width: 8,
        height: 8,
        rgba: (0..64).flat_map(pixel).collect(),
        sampler: Sampler::default(),
    }
}

fn sliver() -> Geometry {
    Geometry {
        positions: vec![[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.01, 0.0]],
        indices: vec![0, 1, 2],
        ..Geometry::default()
    }
}

fn square() -> Geometry {
    Geometry {
        positions: vec![
            [-0.5, -0.5, 0.0],
            [0.5, -0.5, 0.0],
            [0.5, 0.5, 0.0],
            [-0.5, 0.5, 0.0],
        ],
        uvs: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Geometry::default()
    }
}

fn ramp() -> Geometry {
    let mut geometry = square();
    for [_, y, z] in &mut geometry.positions {
        *z = -*y;
    }
    geometry
}

fn edges(cube: &Geometry) -> Geometry {
    // Corners whose numbers differ in one bit share an edge.
    let ends = (0u32..8).flat_map(|a| [1, 2, 4].map(|bit| (a, a | bit)));
    Geometry {
        topology: Topology::Lines,
        positions: cube.positions.clone(),
        indices: ends
            .filter(|(a, b)| a != b)
            .flat_map(|(a, b)| [a, b])
            .collect(),
        ..Geometry::default()
    }
}

/// Lines or points, their vertices in the order of the primitives.
fn primitives(topology: Topology, positions: &[[f32; 3]]) -> Geometry {
    Geometry {
        topology,
        positions: positions.to_vec(),
        indices: (0..positions.len() as u32).collect(),
        ..Geometry::default()
    }
}

fn points() -> Geometry {
    // A golden-angle spiral: no two points at the same height.
    let at = |i: u32| {
        let (height, angle) = (i as f32 / 20.0 - 0.5, i as f32 * 2.4);
        (Vec3::new(angle.cos(), 0.0, angle.sin()) * 0.4 + Vec3::Y * height).to_array()
    };
    primitives(Topology::Points, &(0..20).map(at).collect::<Vec<_>>())
}

fn collapsed(cube: &Geometry) -> Geometry {
    let mut geometry = cube.clone();
    for triangle in geometry.indices.as_chunks_mut::<3>().0 {
        triangle[2] = triangle[1];
    }
    geometry
}
