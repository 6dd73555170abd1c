//! More occlusion queries than one query set holds, on Vulkan and on OpenGL. Tests only whether an answer is zero.

use antumbra_graph::{BufferDesc, Clear, ExecuteError, Graph, TextureDesc};

use crate::device::{Gpu, gpu};

/// Answers of `asked` queries in one node, in a buffer with room for `room`. Query *i* draws at depth *i* / 8192 against a plate at 1/4, with
/// reversed depth; only the first `issue` draw.
fn many(gpu: &Gpu, asked: u32, issue: u32, room: u64) -> Result<Vec<u64>, ExecuteError> {
    let mut g = Graph::new("queries");
    let depth = g.texture(
        "depth",
        TextureDesc::new(16, 16, wgpu::TextureFormat::Depth32Float).cleared(Clear::Depth(0.0)),
    );
    let answers = g.buffer("answers", BufferDesc::new(room * 8).zeroed());
    let mut node = g.raster("ask");
    let _ = node.depth(depth);
    let answers = node.queries(answers, move |_| asked);
    let (plate, test) = (gpu.fill(None, Some(true)), gpu.fill(None, Some(false)));
    node.run(move |ctx| {
        let range = ctx.query_range();
        if range.start == 0 {
            // Only the first batch of queries clears: the plate must still be there for later batches.
            ctx.pass().set_pipeline(&plate);
            ctx.pass().draw(0..3, 2048..2049);
        }
        ctx.pass().set_pipeline(&test);
        for query in range.start..range.end.min(issue) {
            ctx.query(query, |pass| pass.draw(0..3, query..query + 1))?;
        }
        Ok(())
    });
    g.output(answers);
    let mut plan = gpu.compile(g);
    for _ in 0..2 {
        plan.execute(&gpu.device, &gpu.queue)?;
    }
    Ok(gpu.read_u64(plan.buffer(answers).unwrap(), room))
}

fn check(gpu: &Gpu) {
    let answers = many(gpu, 5_000, 5_000, 5_000).unwrap();
    for (query, answer) in answers.iter().enumerate() {
        assert_eq!(*answer != 0, query > 2048, "query {query} says {answer}");
    }
}

#[test]
fn five_thousand_in_one_node_on_vulkan() {
    check(&gpu(wgpu::Backends::VULKAN));
}

#[test]
fn five_thousand_in_one_node_on_gl() {
    check(&gpu(wgpu::Backends::GL));
}

#[test]
fn what_is_not_issued_is_left_as_it_was() {
    let gpu = gpu(wgpu::Backends::VULKAN);
    let answers = many(&gpu, 4_100, 4_098, 4_200).unwrap();
    assert!(answers[2049..4098].iter().all(|answer| *answer != 0));
    assert!(answers[4098..].iter().all(|answer| *answer == 0));
    assert!(
        many(&gpu, 0, 0, 8)
            .unwrap()
            .iter()
            .all(|answer| *answer == 0)
    );
}

#[test]
fn more_than_the_buffer_holds_fails_the_frame() {
    let gpu = gpu(wgpu::Backends::VULKAN);
    let error = many(&gpu, 9, 9, 8).unwrap_err();
    assert!(
        matches!(
            &error,
            ExecuteError::TooManyQueries {
                count: 9,
                capacity: 8,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn queries_out_of_order_fail_the_frame() {
    let gpu = gpu(wgpu::Backends::VULKAN);
    for wrong in [1_u32, 7] {
        let mut g = Graph::new("order");
        let depth = g.texture(
            "depth",
            TextureDesc::new(16, 16, wgpu::TextureFormat::Depth32Float),
        );
        let answers = g.buffer("answers", BufferDesc::new(32));
        let mut node = g.raster("ask");
        let _ = node.depth(depth);
        let answers = node.queries(answers, |_| 4);
        node.run(move |ctx| {
            ctx.query(wrong, |_| {})?;
            Ok(())
        });
        g.output(answers);
        let mut plan = gpu.compile(g);
        let error = plan.execute(&gpu.device, &gpu.queue).unwrap_err();
        assert!(
            matches!(&error, ExecuteError::Body { pass, .. } if pass == "ask"),
            "{error}"
        );
    }
}
