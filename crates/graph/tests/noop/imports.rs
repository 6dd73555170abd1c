//! Imports: what is bound and set before a frame, and what is refused.

use std::sync::Arc;

use antumbra_graph::{CompileOptions, ExecuteError, Graph};

use crate::declare::{bytes, colour, compute, draw, noop};

#[test]
fn an_unset_host_value_is_named_and_a_set_one_is_dropped_after_the_frame() {
    let (device, queue) = noop();
    let mut g = Graph::new("host");
    let scene = g.import_host::<Arc<str>>("scene");
    let mut node = g.host_node("look");
    node.read(scene).side_effect();
    node.run(move |ctx| {
        assert_eq!(&**ctx.get(scene)?, "town");
        Ok(())
    });
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    let town: Arc<str> = Arc::from("town");
    for _ in 0..2 {
        assert!(matches!(
            plan.execute(&device, &queue),
            Err(ExecuteError::Unset { resource }) if resource == "scene"
        ));
        plan.set(scene, Arc::clone(&town)).unwrap();
        assert_eq!(Arc::strong_count(&town), 2);
        plan.execute(&device, &queue).unwrap();
        assert_eq!(Arc::strong_count(&town), 1, "unique again");
    }
    assert_eq!(plan.frame(), 2);
}

#[test]
fn bindings_must_be_there_and_fit() {
    let (device, queue) = noop();
    let mut g = Graph::new("bind");
    let image = g.import_texture("image", colour());
    let data = g.import_buffer("data", bytes(64));
    let own = g.buffer("own", bytes(4));
    draw(&mut g, "draw", image, &[]);
    compute(&mut g, "write", data, &[]);
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    assert!(matches!(
        plan.execute(&device, &queue),
        Err(ExecuteError::Unbound { resource }) if resource == "image"
    ));
    let texture = |width, usage| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width,
                height: 64,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage,
            view_formats: &[],
        })
    };
    let target = wgpu::TextureUsages::RENDER_ATTACHMENT;
    for wrong in [
        texture(32, target),
        texture(64, wgpu::TextureUsages::COPY_DST),
    ] {
        let view = wrong.create_view(&Default::default());
        let refused = plan.bind_texture(image, &view, &wrong);
        assert!(
            matches!(&refused, Err(ExecuteError::BadBinding { resource, .. }) if resource == "image"),
            "{refused:?}"
        );
    }
    let buffer = |size, usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let storage = wgpu::BufferUsages::STORAGE;
    for wrong in [
        buffer(32, storage),
        buffer(64, wgpu::BufferUsages::COPY_DST),
    ] {
        assert!(matches!(
            plan.bind_buffer(data, &wrong),
            Err(ExecuteError::BadBinding { .. })
        ));
    }
    assert!(matches!(
        plan.bind_buffer(own, &buffer(64, storage)),
        Err(ExecuteError::NoImport { .. })
    ));
    let right = texture(64, target);
    plan.bind_texture(image, &right.create_view(&Default::default()), &right)
        .unwrap();
    plan.bind_buffer(data, &buffer(64, storage)).unwrap();
    plan.execute(&device, &queue).unwrap();
    assert!(matches!(
        plan.execute(&device, &queue),
        Err(ExecuteError::Unbound { resource }) if resource == "image"
    ));
}

#[test]
fn an_import_nobody_uses_need_not_be_bound() {
    let (device, queue) = noop();
    let mut g = Graph::new("unused");
    let unused = g.import_host::<u32>("unused");
    let _ = g.import_buffer("unused too", bytes(4));
    g.host_node("nothing").side_effect().run(|_| Ok(()));
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    plan.execute(&device, &queue).unwrap();
    plan.set(unused, 1).unwrap();
    plan.execute(&device, &queue).unwrap();
}
