//! Clears and loads: the first writer of a frame clears a target and later ones keep its content; an import is cleared only on request.

use antumbra_graph::{Bind, Clear, CompileError, CompileOptions, Graph, Texture, TextureDesc};

use crate::device::{Gpu, gpu, vulkan};

const RED: &str = "vec4f(1.0, 0.0, 0.0, 1.0)";

fn target() -> TextureDesc {
    TextureDesc::new(64, 64, wgpu::TextureFormat::Rgba8Unorm)
}

#[test]
fn the_first_writer_clears_and_the_next_one_loads() {
    let gpu = vulkan();
    let mut g = Graph::new("clear");
    let blue = wgpu::Color {
        r: 0.0,
        g: 0.0,
        b: 1.0,
        a: 1.0,
    };
    let image = g.texture("image", target().cleared(Clear::Colour(blue)));
    let mut node = g.raster("left half");
    let image = node.colour(image);
    node.viewport(0.0, 0.0, 16.0, 64.0);
    let fill = gpu.fill(Some(RED), None);
    node.run(move |ctx| {
        ctx.pass().set_pipeline(&fill);
        ctx.pass().draw(0..3, 0..1);
        Ok(())
    });
    let mut node = g.raster("nothing more");
    let image = node.colour(image);
    node.run(|_| Ok(()));
    g.output(image);
    let mut plan = gpu.compile(g);
    for _ in 0..2 {
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(gpu.middle(plan.texture(image).unwrap()), [0, 0, 255, 255]);
    }
}

#[test]
fn a_later_writer_keeps_the_earlier_ones_work() {
    let gpu = vulkan();
    let mut g = Graph::new("load");
    let image = g.texture("image", target().cleared(Clear::Colour(wgpu::Color::BLACK)));
    let mut node = g.raster("all red");
    let image = node.colour(image);
    let fill = gpu.fill(Some(RED), None);
    node.run(move |ctx| {
        ctx.pass().set_pipeline(&fill);
        ctx.pass().draw(0..3, 0..1);
        Ok(())
    });
    let mut node = g.raster("nothing more");
    let image = node.colour(image);
    node.run(|_| Ok(()));
    g.output(image);
    let mut plan = gpu.compile(g);
    plan.execute(&gpu.device, &gpu.queue).unwrap();
    assert_eq!(gpu.middle(plan.texture(image).unwrap()), [255, 0, 0, 255]);
}

#[test]
fn a_pass_with_nothing_to_do_is_left_out_but_for_its_clear() {
    let gpu = vulkan();
    let mut g = Graph::new("only if");
    let wanted = g.import_host::<[bool; 2]>("wanted");
    let black = Clear::Colour(wgpu::Color::BLACK);
    let mut image = g.texture("image", target().cleared(black));
    for (at, colour) in [RED, "vec4f(0.0, 1.0, 0.0, 1.0)"].into_iter().enumerate() {
        let mut node = g.raster(format!("fill {at}"));
        node.read(wanted)
            .only_if(move |host| host.get(wanted).is_ok_and(|wanted| wanted[at]));
        image = node.colour(image);
        let fill = gpu.fill(Some(colour), None);
        node.run(move |ctx| {
            ctx.pass().set_pipeline(&fill);
            ctx.pass().draw(0..3, 0..1);
            Ok(())
        });
    }
    g.output(image);
    let mut plan = gpu.compile(g);
    let cases = [
        ([false, false], [0, 0, 0, 255]),
        ([true, false], [255, 0, 0, 255]),
        ([false, true], [0, 255, 0, 255]),
        ([false, false], [0, 0, 0, 255]),
    ];
    for (wants, seen) in cases {
        plan.set(wanted, wants).unwrap();
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(gpu.middle(plan.texture(image).unwrap()), seen, "{wants:?}");
    }
}

#[test]
fn a_compute_pass_with_nothing_to_do_is_left_out_but_its_zeros_are_not() {
    let gpu = vulkan();
    let mut g = Graph::new("only if");
    let wanted = g.import_host::<bool>("wanted");
    let counted = g.buffer("counted", antumbra_graph::BufferDesc::new(4));
    let zeroed = g.buffer("zeroed", antumbra_graph::BufferDesc::new(4).zeroed());
    let mut node = g.compute("count frames");
    node.read(wanted);
    node.only_if(move |host| host.get(wanted).is_ok_and(|wanted| *wanted));
    let counted = node.updates(counted);
    crate::sync::run_over(&mut node, gpu.compute("data[0] += 1u;"), counted);
    let mut node = g.compute("count from nothing");
    node.read(wanted);
    node.only_if(move |host| host.get(wanted).is_ok_and(|wanted| *wanted));
    let zeroed = node.storage_write(zeroed);
    crate::sync::run_over(&mut node, gpu.compute("data[0] += 1u;"), zeroed);
    g.output(counted);
    g.output(zeroed);
    let mut plan = gpu.compile(g);
    let cases = [(true, 1, 1), (false, 1, 0), (false, 1, 0), (true, 2, 1)];
    for (wants, frames, one) in cases {
        plan.set(wanted, wants).unwrap();
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        let read = |buffer| gpu.read_u32(plan.buffer(buffer).unwrap(), 1)[0];
        assert_eq!((read(counted), read(zeroed)), (frames, one), "{wants}");
    }
}

/// Draws a plate at depth 1/2, then green in front of it and red behind it. `sampled`: a shader reads the depth while it is attached.
fn hidden(gpu: &Gpu, sampled: bool) -> (Graph, Texture) {
    let mut g = Graph::new("depth");
    let depth = g.texture(
        "depth",
        TextureDesc::new(64, 64, wgpu::TextureFormat::Depth32Float).cleared(Clear::Depth(0.0)),
    );
    let image = g.texture("image", target().cleared(Clear::Colour(wgpu::Color::BLACK)));
    let mut node = g.raster("near plate");
    let depth = node.depth(depth);
    let prepass = gpu.fill(None, Some(true));
    node.run(move |ctx| {
        ctx.pass().set_pipeline(&prepass);
        ctx.pass().draw(0..3, 4096..4097);
        Ok(())
    });
    let mut node = g.raster("before it, then behind it");
    let image = node.colour(image);
    node.depth_read(depth);
    if sampled {
        node.sample(depth);
    }
    let green = gpu.fill(Some("vec4f(0.0, 1.0, 0.0, 1.0)"), Some(false));
    let red = gpu.fill(Some(RED), Some(false));
    node.run(move |ctx| {
        ctx.pass().set_pipeline(&green);
        ctx.pass().draw(0..3, 5000..5001);
        ctx.pass().set_pipeline(&red);
        ctx.pass().draw(0..3, 4000..4001);
        Ok(())
    });
    g.output(image);
    (g, image)
}

#[test]
fn depth_of_one_pass_hides_what_a_later_one_draws() {
    for backends in [wgpu::Backends::VULKAN, wgpu::Backends::GL] {
        let gpu = gpu(backends);
        let (g, image) = hidden(&gpu, false);
        let mut plan = gpu.compile(g);
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(gpu.middle(plan.texture(image).unwrap()), [0, 255, 0, 255]);
    }
}

#[test]
fn depth_is_sampled_while_attached_only_where_that_is_possible() {
    for (backends, guess) in [
        (wgpu::Backends::VULKAN, false),
        (wgpu::Backends::GL, false),
        (wgpu::Backends::GL, true),
    ] {
        let gpu = gpu(backends);
        let possible = gpu
            .adapter
            .get_downlevel_capabilities()
            .flags
            .contains(wgpu::DownlevelFlags::READ_ONLY_DEPTH_STENCIL);
        let mut options = CompileOptions::owned(&gpu.device);
        if !guess {
            options = options.adapter(&gpu.adapter);
        }
        match hidden(&gpu, true).0.compile(&options) {
            Ok(mut plan) => {
                assert!(possible);
                plan.execute(&gpu.device, &gpu.queue).unwrap();
            }
            Err(refused) => {
                assert!(!possible || guess, "{refused}");
                assert!(matches!(
                    &refused.errors[..],
                    [CompileError::MissingCapability { pass, .. }] if pass == "before it, then behind it"
                ));
            }
        }
    }
}

#[test]
fn an_import_is_loaded_unless_it_asks_to_be_cleared() {
    let gpu = vulkan();
    let object = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 64,
            height: 64,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = object.create_view(&Default::default());
    let green = Clear::Colour(wgpu::Color::GREEN);
    for (desc, draws, expected) in [
        (target(), true, [255, 0, 0, 255]),
        (target(), false, [255, 0, 0, 255]),
        (target().cleared(green), false, [0, 255, 0, 255]),
    ] {
        let mut g = Graph::new("import");
        let image = g.import_texture("image", desc);
        let mut node = g.raster("draw");
        let _ = node.colour(image);
        let fill = gpu.fill(Some(RED), None);
        node.run(move |ctx| {
            if draws {
                ctx.pass().set_pipeline(&fill);
                ctx.pass().draw(0..3, 0..1);
            }
            Ok(())
        });
        let mut plan = gpu.compile(g);
        plan.bind_texture(image, &view, &object).unwrap();
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(gpu.middle(&object), expected);
        assert!(
            plan.execute(&gpu.device, &gpu.queue).is_err(),
            "the frame let go of the import"
        );
    }
}

#[test]
fn a_storage_writer_finds_the_cleared_mips_it_does_not_write() {
    let gpu = vulkan();
    let mut g = Graph::new("mips");
    let half = Clear::Colour(wgpu::Color {
        r: 1.0,
        g: 1.0,
        b: 1.0,
        a: 1.0,
    });
    let image = g.texture("image", target().mips(2).cleared(half));
    let mut node = g.raster("mip 0");
    let image = node.colour(image);
    let fill = gpu.fill(Some(RED), None);
    node.run(move |ctx| {
        ctx.pass().set_pipeline(&fill);
        ctx.pass().draw(0..3, 0..1);
        Ok(())
    });
    let mut node = g.compute("nothing");
    let image = node.storage_texture_write(image);
    node.run(move |ctx| {
        ctx.mip_view(image, 1, 0)?;
        assert!(ctx.mip_view(image, 2, 0).is_err());
        Ok(())
    });
    let small = g.texture(
        "small",
        TextureDesc::new(64, 1, wgpu::TextureFormat::Rgba8Unorm),
    );
    let mut node = g.copy("take both mips");
    node.copy_src(image);
    let small = node.copy_dst(small);
    node.run(move |ctx| {
        let (from, to) = (ctx.texture(image)?, ctx.texture(small)?);
        for mip in 0..2 {
            ctx.encoder().copy_texture_to_texture(
                wgpu::TexelCopyTextureInfo {
                    mip_level: mip,
                    ..from.as_image_copy()
                },
                wgpu::TexelCopyTextureInfo {
                    origin: wgpu::Origin3d {
                        x: 32 * mip,
                        y: 0,
                        z: 0,
                    },
                    ..to.as_image_copy()
                },
                wgpu::Extent3d {
                    width: 32,
                    height: 1,
                    depth_or_array_layers: 1,
                },
            );
        }
        Ok(())
    });
    g.output(small);
    g.output(image);
    let mut plan = gpu.compile(g);
    plan.execute(&gpu.device, &gpu.queue).unwrap();
    assert_eq!(
        gpu.middle(plan.texture(small).unwrap()),
        [255; 4],
        "mip 1 was cleared"
    );
    assert_eq!(plan.texture(image).unwrap().mip_level_count(), 2);
}

#[test]
fn bind_groups_follow_the_objects_behind_them() {
    let gpu = vulkan();
    let mut g = Graph::new("binds");
    let data = g.import_buffer("data", antumbra_graph::BufferDesc::new(4));
    let pipeline = gpu.compute("data[0] += 1u;");
    let mut node = g.compute("add");
    let _ = node.storage_write(data);
    node.run(move |ctx| {
        let group = ctx.bind_group(
            0,
            &pipeline.get_bind_group_layout(0),
            &[Bind::Buffer(0, data)],
        )?;
        ctx.pass().set_pipeline(&pipeline);
        ctx.pass().set_bind_group(0, &group, &[]);
        ctx.pass().dispatch_workgroups(1, 1, 1);
        Ok(())
    });
    let mut plan = gpu.compile(g);
    let make = || {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    };
    let (one, two) = (make(), make());
    for buffer in [&one, &one, &two, &one] {
        plan.bind_buffer(data, buffer).unwrap();
        plan.execute(&gpu.device, &gpu.queue).unwrap();
    }
    assert_eq!(
        (gpu.read_u32(&one, 1), gpu.read_u32(&two, 1)),
        (vec![3], vec![1])
    );
}
