//! What all examples do with a scene: show it in a window, run frames without one, or measure.

use antumbra_bevy::{AntumbraCulling, AntumbraPlugin, CullingGizmos, CullingReport, Strategy};
use bevy::camera::RenderTarget;
use bevy::prelude::*;

use crate::arguments::Arguments;
use crate::headless;
use crate::measure;
use crate::view::View;

/// Does as the arguments say.
pub fn run(view: View, spawn: &dyn Fn(&mut App)) {
    let arguments = Arguments::of_process();
    let is_lit = arguments.is_lit;
    let spawn: &dyn Fn(&mut App) = &move |app| {
        spawn(app);
        let mut materials = app.world_mut().resource_mut::<Assets<StandardMaterial>>();
        for (_, material) in materials.iter_mut() {
            material.unlit |= !is_lit;
        }
    };
    if arguments.measures {
        measure::measure(&arguments, &view, spawn);
    } else if arguments.frames > 0 {
        without_window(&arguments, &view, spawn);
    } else {
        in_window(&arguments, view, spawn);
    }
}

fn without_window(arguments: &Arguments, view: &View, spawn: &dyn Fn(&mut App)) {
    let mut app = headless::app();
    app.add_plugins(AntumbraPlugin);
    spawn(&mut app);
    let target = headless::target(&mut app, arguments.size);
    let camera = view.spawn(&mut app, RenderTarget::from(target));
    app.world_mut()
        .entity_mut(camera)
        .insert(arguments.culling());
    headless::finish(&mut app);
    for frame in 0..arguments.frames {
        let pose = view.pose(arguments.path_frame(frame));
        app.world_mut().entity_mut(camera).insert(pose);
        let time = headless::frame(&mut app);
        if let Some(report) = app.world().get::<CullingReport>(camera) {
            println!(
                "frame {frame:4}: {:8.2} ms, {} drawn, {} culled, wrong pixels {}",
                time.as_secs_f64() * 1e3,
                report.drawn,
                report.culled.len(),
                report
                    .wrong
                    .map_or("-".to_owned(), |wrong| format!("{wrong:.3} %")),
            );
        }
    }
}

/// The way of the camera in the window, and how far it has come.
#[derive(Resource)]
struct Going {
    view: View,
    frame: usize,
    halts: bool,
}

fn in_window(arguments: &Arguments, view: View, spawn: &dyn Fn(&mut App)) {
    let mut app = App::new();
    app.add_plugins((DefaultPlugins, AntumbraPlugin));
    spawn(&mut app);
    let camera = view.spawn(&mut app, RenderTarget::default());
    app.world_mut()
        .entity_mut(camera)
        .insert(arguments.culling());
    app.insert_resource(Going {
        view,
        frame: 0,
        halts: arguments.is_still,
    });
    app.add_systems(Update, (go, keys, tell));
    println!(
        "C: culling on and off. F: freeze it. B: boxes of what is culled. Space: stop and go."
    );
    app.run();
}

fn go(mut going: ResMut<Going>, mut cameras: Query<&mut Transform, With<Camera3d>>) {
    if !going.halts {
        going.frame += 1;
    }
    let pose = going.view.pose(going.frame);
    for mut place in &mut cameras {
        *place = pose;
    }
}

fn keys(
    pressed: Res<ButtonInput<KeyCode>>,
    mut going: ResMut<Going>,
    mut gizmos: ResMut<GizmoConfigStore>,
    mut cameras: Query<&mut AntumbraCulling>,
) {
    for mut culling in &mut cameras {
        if pressed.just_pressed(KeyCode::KeyC) {
            culling.strategy = match culling.strategy {
                Strategy::Off => Strategy::FrameLate,
                Strategy::FrameLate => Strategy::Off,
            };
        }
        if pressed.just_pressed(KeyCode::KeyF) {
            culling.frozen = !culling.frozen;
        }
    }
    if pressed.just_pressed(KeyCode::KeyB) {
        let (config, _) = gizmos.config_mut::<CullingGizmos>();
        config.enabled = !config.enabled;
    }
    if pressed.just_pressed(KeyCode::Space) {
        going.halts = !going.halts;
    }
}

fn tell(mut windows: Query<&mut Window>, cameras: Query<&CullingReport>, time: Res<Time>) {
    for mut window in &mut windows {
        for report in &cameras {
            window.title = format!(
                "{} drawn, {} culled, {:.1} ms",
                report.drawn,
                report.culled.len(),
                time.delta_secs() * 1e3
            );
        }
    }
}
