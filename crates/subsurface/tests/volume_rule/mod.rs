//! A volume whose samples are computed from their positions, and that records which bricks are read.
#![allow(dead_code)] // Each test file uses its part.

use std::sync::Mutex;

use antumbra_subsurface::{BrickSource, SubsurfaceError, VolumeLayout};
use glam::DVec3;

pub struct Rule {
    pub layout: VolumeLayout,
    /// Every brick that was read, in order.
    pub asked: Mutex<Vec<[u32; 3]>>,
}

impl Rule {
    pub fn new(size: [u32; 3], brick: u32) -> Self {
        Self {
            layout: layout(size, brick),
            asked: Mutex::default(),
        }
    }

    /// The bricks read since the last call, sorted.
    pub fn take_asked(&self) -> Vec<[u32; 3]> {
        let mut asked = std::mem::take(&mut *self.asked.lock().unwrap());
        asked.sort_unstable();
        asked
    }
}

/// A survey that is rotated in plan; time points down.
pub fn layout(size: [u32; 3], brick: u32) -> VolumeLayout {
    VolumeLayout {
        size,
        brick,
        origin: DVec3::new(431_000.0, -500.0, -6_521_000.0),
        steps: [
            DVec3::new(20.0, 0.0, -15.0),
            DVec3::new(7.5, 0.0, 10.0),
            DVec3::new(0.0, -4.0, 0.0),
        ],
        range: [-2.0, 1.5],
    }
}

/// The sample at a position: neighbours differ, and 0 occurs.
pub fn sample_at([x, y, z]: [u32; 3]) -> u8 {
    let mixed = x
        .wrapping_mul(0x9e37_79b1)
        .wrapping_add(y.wrapping_mul(0x85eb_ca6b))
        .wrapping_add(z.wrapping_mul(0xc2b2_ae35));
    (mixed.wrapping_mul(mixed | 1) >> 24) as u8
}

impl BrickSource for Rule {
    fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        self.asked.lock().unwrap().push(brick);
        let edge = self.layout.brick;
        let at = |axis: usize, within: usize| {
            (brick[axis] * edge + within as u32).min(self.layout.size[axis] - 1)
        };
        let edge = edge as usize;
        for (i, sample) in samples.iter_mut().enumerate() {
            let place = [i % edge, i / edge % edge, i / edge / edge];
            *sample = sample_at([at(0, place[0]), at(1, place[1]), at(2, place[2])]);
        }
        Ok(())
    }
}
