//! Errors that depend on the device: formats, features, limits.

use antumbra_graph::{BufferDesc, CompileError, CompileOptions, Graph, TextureDesc};

use crate::declare::{bytes, colour, compute, draw, errors};

#[test]
fn a_use_the_format_does_not_have() {
    let mut g = Graph::new("storage");
    let image = g.import_texture(
        "image",
        TextureDesc::new(8, 8, wgpu::TextureFormat::Depth32Float),
    );
    let mut node = g.compute("write");
    let _ = node.storage_texture_write(image);
    node.run(|_| Ok(()));
    let found = errors(g);
    assert!(
        matches!(&found[..], [CompileError::Usage { pass, resource, format: wgpu::TextureFormat::Depth32Float, .. }]
            if pass == "write" && resource == "image"),
        "{found:?}"
    );

    let mut g = Graph::new("depth as colour");
    let image = g.import_texture(
        "image",
        TextureDesc::new(8, 8, wgpu::TextureFormat::Depth32Float),
    );
    draw(&mut g, "draw", image, &[]);
    assert!(matches!(
        &errors(g)[..],
        [CompileError::Usage {
            access: "colour",
            ..
        }]
    ));

    let mut g = Graph::new("colour as depth");
    let image = g.import_texture("image", colour());
    let mut node = g.raster("draw");
    let _ = node.depth(image);
    node.run(|_| Ok(()));
    assert!(matches!(
        &errors(g)[..],
        [CompileError::Usage {
            access: "depth",
            ..
        }]
    ));
}

#[test]
fn features_a_pass_or_a_format_needs() {
    let declare = || {
        let mut g = Graph::new("features");
        let image = g.import_texture("image", colour());
        let mut node = g.raster("draw");
        let _ = node.colour(image);
        node.requires(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
            .run(|_| Ok(()));
        g
    };
    let found = errors(declare());
    assert!(
        matches!(&found[..], [CompileError::MissingFeature { item, feature }]
            if item.contains("draw") && feature == "SHADER_EARLY_DEPTH_TEST"),
        "{found:?}"
    );
    let (device, _) = wgpu::Device::noop(&wgpu::DeviceDescriptor {
        required_features: wgpu::Features::SHADER_EARLY_DEPTH_TEST,
        ..Default::default()
    });
    assert!(declare().compile(&CompileOptions::owned(&device)).is_ok());

    let mut g = Graph::new("format");
    let image = g.import_texture(
        "image",
        TextureDesc::new(8, 8, wgpu::TextureFormat::Depth32FloatStencil8),
    );
    let mut node = g.raster("draw");
    let _ = node.depth(image);
    node.run(|_| Ok(()));
    let found = errors(g);
    assert!(
        matches!(&found[..], [CompileError::MissingFeature { item, .. }] if item.contains("image")),
        "{found:?}"
    );
}

#[test]
fn sizes_and_counts_beyond_the_limits() {
    let limits = wgpu::Limits::default();
    let mut g = Graph::new("texture");
    let image = g.import_texture(
        "image",
        TextureDesc::new(
            limits.max_texture_dimension_2d + 1,
            1,
            wgpu::TextureFormat::Rgba8Unorm,
        ),
    );
    draw(&mut g, "draw", image, &[]);
    assert!(matches!(
        &errors(g)[..],
        [CompileError::Limit {
            what: "texels a side",
            ..
        }]
    ));

    let mut g = Graph::new("buffer");
    let data = g.buffer("data", BufferDesc::new(limits.max_buffer_size + 1));
    let out = g.import_buffer("out", bytes(4));
    let data = compute(&mut g, "write", data, &[]);
    compute(&mut g, "read", out, &[data]);
    let found = errors(g);
    assert!(
        found
            .iter()
            .any(|e| matches!(e, CompileError::Limit { what: "bytes", .. })),
        "{found:?}"
    );
    assert!(
        found.iter().any(|e| matches!(
            e,
            CompileError::Limit {
                what: "bytes of storage",
                ..
            }
        )),
        "{found:?}"
    );

    let mut g = Graph::new("samples");
    let image = g.import_texture("image", colour().samples(7));
    draw(&mut g, "draw", image, &[]);
    assert!(matches!(
        &errors(g)[..],
        [CompileError::SampleCount { samples: 7, .. }]
    ));

    let mut g = Graph::new("attachments");
    let images: Vec<_> = (0..9)
        .map(|n| g.texture(format!("{n}"), colour()))
        .collect();
    let mut node = g.raster("draw nine");
    for image in images {
        let _ = node.colour(image);
    }
    node.side_effect().run(|_| Ok(()));
    let found = errors(g);
    assert!(
        found.iter().any(|e| matches!(
            e,
            CompileError::Limit {
                what: "colour attachments",
                asked: 9,
                ..
            }
        )),
        "{found:?}"
    );
}

#[test]
fn pruned_passes_may_ask_for_anything() {
    let mut g = Graph::new("pruned");
    let image = g.texture("image", colour());
    let mut node = g.raster("draw");
    let _ = node.colour(image);
    node.requires(wgpu::Features::MULTIVIEW).run(|_| Ok(()));
    assert_eq!(errors(g), []);
}
