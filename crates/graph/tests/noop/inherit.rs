//! A plan that goes on from another: what its nodes know on the host, and the number of the next frame.

use antumbra_graph::{BufferDesc, CompileOptions, Graph, Host, Plan};

use crate::declare::noop;

type Gpu = (wgpu::Device, wgpu::Queue);

/// A plan with a buffer of some size, whose nodes count frames in two values: one is updated, the other one is made from last frame's.
struct Counting {
    plan: Plan,
    updated: Host<u32>,
    made: Host<u32>,
}

fn counting(device: &wgpu::Device, bytes: u64, name: &str) -> Counting {
    let mut g = Graph::new("counting");
    let updated = g.host::<u32>(name);
    let made = g.host::<u32>("made");
    let buffer = g.buffer("buffer", BufferDesc::new(bytes));
    let mut node = g.host_node("count");
    let last = made.previous();
    node.read(last);
    let (updated, made) = (node.updates(updated), node.write(made));
    let buffer = node.upload(buffer);
    node.run(move |ctx| {
        *ctx.get_mut(updated)? += 1;
        *ctx.get_mut(made)? = *ctx.get(last)? + 10;
        ctx.upload(buffer, 0, &[0; 16])?;
        Ok(())
    });
    g.output(updated);
    g.output(made);
    g.output(buffer);
    Counting {
        plan: g.compile(&CompileOptions::owned(device)).unwrap(),
        updated,
        made,
    }
}

impl Counting {
    fn frames(&mut self, gpu: &Gpu, frames: u32) -> [u32; 2] {
        let (device, queue) = gpu;
        for _ in 0..frames {
            self.plan.execute(device, queue).unwrap();
        }
        [self.updated, self.made].map(|value| *self.plan.get(value).unwrap())
    }
}

#[test]
fn a_larger_plan_goes_on_where_the_smaller_one_stopped() {
    let gpu = noop();
    // An odd and an even number of frames: values of two versions change places.
    for frames in [3, 4] {
        let mut small = counting(&gpu.0, 64, "updated");
        assert_eq!(small.frames(&gpu, frames), [frames, frames * 10]);
        let mut large = counting(&gpu.0, 4096, "updated");
        large.plan.inherit(&mut small.plan);
        assert_eq!(large.plan.frame(), u64::from(frames));
        assert_eq!(large.frames(&gpu, 1), [frames + 1, frames * 10 + 10]);
        assert_eq!(large.frames(&gpu, 1), [frames + 2, frames * 10 + 20]);
    }
}

#[test]
fn a_value_of_another_name_starts_anew() {
    let gpu = noop();
    let mut one = counting(&gpu.0, 64, "updated");
    one.frames(&gpu, 3);
    let mut other = counting(&gpu.0, 64, "renamed");
    other.plan.inherit(&mut one.plan);
    assert_eq!(other.frames(&gpu, 1), [1, 40]);
}
