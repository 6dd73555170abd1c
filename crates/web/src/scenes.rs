//! The scenes that are drawn, and a camera for each frame. Cameras move along straight lines: angles would be rounded otherwise in a browser than without one.

use antumbra_demo_scenes::by_name;
use antumbra_scene::{
    Aabb, AlphaMode, Camera, Drawable, Environment, Geometry, Image, Light, Material, Mesh,
    Projection, Sampler, Scene, SceneError, Topology, icosphere,
};
use glam::{DAffine3, DVec3};

use crate::WebError;

/// A scene and the cameras that look at it, one a frame.
pub(crate) struct World {
    pub name: &'static str,
    pub scene: Scene,
    pub cameras: Vec<Camera>,
}

/// Frames that are drawn of each world.
const FRAMES: u32 = 4;

/// A scene in which every class of pipelines has an entity: opaque, masked and blended ones, with and without an image, of triangles, lines and points, from one side and from both.
pub(crate) fn classes() -> Result<World, WebError> {
    let (from, by) = (DVec3::new(-0.5, 0.4, 6.0), DVec3::new(0.3, 0.05, 0.0));
    world("classes", still_life(), from, by, DVec3::ZERO)
}

/// The built-in scenes: a cube of balls, and a block of houses seen from above the street.
pub(crate) fn built_in() -> Result<Vec<World>, WebError> {
    let (from, by) = (DVec3::new(9.0, 4.0, 11.0), DVec3::new(-0.5, 0.25, -0.5));
    let grid = world("grid:8", by_name("grid", Some(8)), from, by, DVec3::ZERO)?;
    let (from, by) = (DVec3::new(45.0, 20.0, 52.0), DVec3::new(-1.0, 0.5, -1.0));
    let towards = DVec3::new(0.0, 4.0, 0.0);
    let city = world("city:1", by_name("city", Some(1)), from, by, towards)?;
    Ok(vec![grid, city])
}

fn world<E: std::fmt::Display>(
    name: &'static str,
    scene: Result<Scene, E>,
    from: DVec3,
    by: DVec3,
    towards: DVec3,
) -> Result<World, WebError> {
    let wrong = |reason: String| WebError::Scene {
        scene: name,
        reason,
    };
    let projection = Projection::Perspective {
        fov_y: 0.9,
        near: 0.1,
    };
    let cameras = (0..FRAMES).map(|frame| {
        let eye = from + by * f64::from(frame);
        Camera::look_at(eye, towards, DVec3::Y, projection)
            .map_err(|error| wrong(error.to_string()))
    });
    Ok(World {
        name,
        scene: scene.map_err(|error| wrong(error.to_string()))?,
        cameras: cameras.collect::<Result<_, _>>()?,
    })
}

/// A wall with something of each class before it and balls behind it, between a light that has a place and a sun, in an environment.
fn still_life() -> Result<Scene, SceneError> {
    let mut scene = Scene::new();
    let cube = Geometry::from_box(&Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.5)));
    let ball = Mesh {
        levels: vec![icosphere(2, 0.5), icosphere(1, 0.5), icosphere(0, 0.5)],
        ..Mesh::new("ball", icosphere(2, 0.5))
    };
    let ball = scene.add_mesh(ball)?;
    let lines = scene.add_mesh(Mesh::new("edges", edges(&cube)))?;
    let points = Geometry {
        topology: Topology::Points,
        positions: cube.positions.clone(),
        indices: (0..8).collect(),
        ..Geometry::default()
    };
    let points = scene.add_mesh(Mesh::new("corners", points))?;
    let cube = scene.add_mesh(Mesh::new("cube", cube))?;
    let square = scene.add_mesh(Mesh::new("square", square()))?;
    let image = scene.add_image(holes())?;
    let plain = Material::default();
    let masked = Material {
        base_colour_image: Some(image),
        alpha: AlphaMode::Mask { cutoff: 0.5 },
        double_sided: true,
        ..Material::default()
    };
    let glass = Material {
        base_colour: [0.2, 0.5, 0.9, 0.5],
        alpha: AlphaMode::Blend,
        ..Material::default()
    };
    let pictured_glass = Material {
        base_colour_image: Some(image),
        ..glass.clone()
    };
    let pictured = Material {
        base_colour_image: Some(image),
        unlit: true,
        ..Material::default()
    };
    let thin = Material {
        double_sided: true,
        metallic: 1.0,
        roughness: 0.2,
        ..Material::default()
    };
    let masked_from_one_side = Material {
        double_sided: false,
        ..masked.clone()
    };
    let mut put = |mesh, material: &Material, at: [f64; 3], size: [f64; 3]| {
        let place = DAffine3::from_translation(DVec3::from_array(at))
            * DAffine3::from_scale(DVec3::from_array(size));
        let material = scene.add_material(material.clone());
        let entity = scene.spawn(None, place)?;
        scene.set_drawable(entity, Drawable { mesh, material })
    };
    put(cube, &plain, [0.0, 0.0, 0.0], [4.0, 3.0, 0.2])?;
    for column in -3..=3 {
        let x = f64::from(column);
        // Two rows behind the wall, of which the outer ones look past it.
        put(ball, &plain, [x * 1.1, 0.1, -2.0], [0.9; 3])?;
        put(ball, &plain, [x * 0.7, -0.6, -1.2], [0.5; 3])?;
    }
    put(square, &masked, [-1.2, 0.4, 1.0], [1.0; 3])?;
    put(square, &masked_from_one_side, [1.3, -0.4, 1.1], [0.8; 3])?;
    put(square, &pictured, [-0.4, -0.9, 0.6], [0.7; 3])?;
    put(square, &glass, [0.2, 0.3, 1.5], [1.0; 3])?;
    put(square, &pictured_glass, [0.9, 0.5, 0.8], [0.6; 3])?;
    put(ball, &glass, [0.1, 0.0, -3.0], [0.8; 3])?;
    put(square, &thin, [-2.2, 0.2, 0.5], [0.9; 3])?;
    put(lines, &plain, [1.9, 0.9, 0.7], [0.6; 3])?;
    put(points, &plain, [-1.9, -0.9, 0.7], [0.6; 3])?;
    put(lines, &plain, [0.3, 0.2, -1.6], [0.6; 3])?;
    // Something small, for thresholds and coarser levels.
    put(ball, &plain, [2.3, 1.2, 0.4], [0.08; 3])?;
    let sun = Light::Directional {
        colour: [1.0; 3],
        illuminance: 3.0,
    };
    let lamp = Light::Point {
        colour: [1.0, 0.8, 0.6],
        intensity: 4.0,
        range: Some(10.0),
    };
    for (light, at) in [(sun, DVec3::Y), (lamp, DVec3::new(0.0, 1.0, 2.0))] {
        let entity = scene.spawn(None, DAffine3::from_translation(at))?;
        scene.set_light(entity, light)?;
    }
    scene.set_environment(Some(Environment {
        image,
        intensity: 0.5,
    }))?;
    Ok(scene)
}

/// A square a metre wide that faces +Z, with texture coordinates.
fn square() -> Geometry {
    Geometry {
        positions: vec![
            [-0.5, -0.5, 0.0],
            [0.5, -0.5, 0.0],
            [0.5, 0.5, 0.0],
            [-0.5, 0.5, 0.0],
        ],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        uvs: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Geometry::default()
    }
}

/// The sides of a geometry's triangles.
fn edges(of: &Geometry) -> Geometry {
    let (triangles, _) = of.indices.as_chunks::<3>();
    let sides = triangles
        .iter()
        .flat_map(|[a, b, c]| [*a, *b, *b, *c, *c, *a]);
    Geometry {
        topology: Topology::Lines,
        positions: of.positions.clone(),
        indices: sides.collect(),
        ..Geometry::default()
    }
}

/// An image of 4 x 4 pixels, every other of them without alpha.
fn holes() -> Image {
    let texel = |at: u8| match (at + at / 4).is_multiple_of(2) {
        true => [230, 200 - at * 10, 90, 255],
        false => [40, 60, 200, 0],
    };
    Image {
        name: "holes".to_owned(),
        width: 4,
        height: 4,
        rgba: (0..16).flat_map(texel).collect(),
        sampler: Sampler::default(),
    }
}
