//! The story about unusual projections: telescopes, fish eyes, near planes at a tenth of a millimetre and at a kilometre, orthographic views, and matrices as
//! hosts have them.

use antumbra_scene::{Camera, ClipMatrix, Projection};
use glam::{DMat4, DVec3};

use crate::kit::failure::ViolationKind;
use crate::kit::run::{CaseContext, Run};
use crate::kit::test_scene::TestScene;

pub(super) fn lenses(context: &mut CaseContext<'_>) -> Result<(), ViolationKind> {
    let perspective = |degrees: f64, near: f64| Projection::Perspective {
        fov_y: degrees.to_radians(),
        near,
    };
    // Each with the distance in metres of the eye from the scene, which is about eight metres wide.
    let views = [
        (perspective(0.01, 1.0), 3e4),
        (perspective(179.0, 0.01), 3.0),
        (perspective(60.0, 1e-4), 5.0),
        (perspective(0.4, 1e3), 1.1e3),
        (
            Projection::Orthographic {
                height: 6.0,
                near: -2.0,
                far: 50.0,
            },
            6.0,
        ),
        (
            Projection::Orthographic {
                height: 1e-2,
                near: 0.0,
                far: 1e6,
            },
            4.0,
        ),
    ];
    let mut test = TestScene::new()?;
    test.cube(DVec3::ZERO, DVec3::new(2.0, 1.5, 0.2))?;
    for column in -2..=2 {
        let x = f64::from(column) * 0.8;
        test.sphere(DVec3::new(x, 0.0, -1.0), 0.7)?;
        test.cube(DVec3::new(x * 2.0, 0.6, -3.0), DVec3::splat(0.5))?;
        test.sphere(DVec3::new(x, -0.5, 0.9), 0.2)?;
    }
    let mut run = Run::new(context, test.scene)?;
    for (projection, distance) in views.into_iter().chain(matrices()?) {
        let eye = DVec3::new(0.013, 0.021, 1.0) * distance;
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
        run.cut(&camera)?;
        run.frame(&camera)?;
    }
    Ok(())
}

/// Projections that no other kind of camera has, each with a distance in metres. Rows are those for x, y, z and w.
fn matrices() -> Result<[(Projection, f64); 5], ViolationKind> {
    let rows = |rows: [[f64; 4]; 4]| DMat4::from_cols_array_2d(&rows).transpose();
    let forward = |of| ClipMatrix::forward(rows(of)).map(Projection::Matrix);
    let reversed = |of| ClipMatrix::reversed(rows(of)).map(Projection::Matrix);
    let w = [0.0, 0.0, -1.0, 0.0];
    let x = [1.5, 0.0, 0.25, 0.0];
    let y = [0.0, 2.0, -0.3, 0.0];
    // Planes at 0.5 and 40 m.
    let (near, far) = (0.5, 40.0);
    let depth = far / (near - far);
    // In front of planes across the view: through the middle of the small spheres, and leaning, through the wall and what is behind it.
    let oblique = |plane: [f64; 4]| [0, 1, 2, 3].map(|i| w[i] - plane[i] * 0.6);
    let (through, leaning) = ([0.02, 0.01, -0.5, -3.05], [0.4, 0.06, -0.6, -3.3]);
    Ok([
        // Forward depth, beside the axis, with a far plane.
        (forward([x, y, [0.0, 0.0, depth, depth * near], w])?, 6.0),
        // The same in reversed depth, with a near plane of a millimetre.
        (reversed([x, y, [0.0, 0.0, 1e-6, 1e-3], w])?, 5.0),
        (reversed([x, y, oblique(through), w])?, 7.0),
        (reversed([x, y, oblique(leaning), w])?, 6.0),
        // Parallel rays that slant, forward depth, from ten metres behind the eye on.
        (
            forward([
                [0.3, 0.0, 0.1, 0.0],
                [0.0, 0.35, -0.05, 0.1],
                [0.0, 0.0, -0.02, 0.2],
                [0.0, 0.0, 0.0, 1.0],
            ])?,
            6.0,
        ),
    ])
}
