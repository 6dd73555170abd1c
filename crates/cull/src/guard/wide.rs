//! A view that is wider than another by an angle on each side.

use antumbra_scene::{Camera, Projection};
use glam::DVec3;

use crate::view::{ViewAxes, ViewFrame};

/// The image of a guard.
#[derive(Debug)]
pub(super) struct WideView {
    /// The view.
    pub frame: ViewFrame,
    /// How far from the eye the near plane of the view itself may cut, in metres, at its corners.
    pub near_reach: f64,
    axes: ViewAxes,
    near: f64,
    /// Tangents of the half angles, horizontally and vertically.
    tangents: [f64; 2],
}

/// The widest tangent of a half angle: about 170 degrees in all.
const WIDEST: f64 = 11.0;
/// What is beside the image's edge by less than this part of it counts as outside.
const EDGE: f64 = 1e-4;

impl WideView {
    /// The view of the same eye, wider by `degrees` on each side; `None` for projections other than [`Projection::Perspective`].
    pub fn of(view: &ViewFrame, degrees: f64) -> Option<Self> {
        let Projection::Perspective { fov_y, near } = view.camera.projection else {
            return None;
        };
        let aspect = view.aspect();
        let high = (fov_y / 2.0).tan();
        let own = [high * aspect, high];
        let turned = |tangent: f64| {
            let angle = tangent.atan() + degrees.max(0.0).to_radians();
            match angle < WIDEST.atan() {
                true => angle.tan(),
                false => WIDEST,
            }
        };
        let wider = own.map(|tangent| turned(tangent).max(tangent) / tangent);
        let factor = wider[0].max(wider[1]);
        let tangents = own.map(|tangent| tangent * factor);
        let projection = Projection::Perspective {
            fov_y: 2.0 * tangents[1].atan(),
            near,
        };
        let camera = Camera {
            projection,
            ..view.camera
        };
        let corner = (1.0 + own[0] * own[0] + own[1] * own[1]).sqrt();
        let frame = ViewFrame::new(camera, view.size, view.cuts);
        Some(Self {
            near_reach: near * corner * (1.0 + 1e-3),
            axes: frame.axes(),
            frame,
            near,
            tangents,
        })
    }

    /// The length of so many pixels, in metres, at most `reach` metres from the eye.
    pub fn metres(&self, pixels: f64, reach: f64) -> f64 {
        let [wide, high] = self.frame.size.map(|side| f64::from(side.max(1)));
        let pixel = (2.0 * self.tangents[0] / wide).max(2.0 * self.tangents[1] / high);
        pixels * pixel * reach
    }

    /// Whether a point, relative to the eye, is in the image and in front of the near plane.
    pub fn shows(&self, point: DVec3) -> bool {
        let ViewAxes { right, up, forward } = self.axes;
        let depth = point.dot(forward) * (1.0 - EDGE);
        let [wide, high] = self.tangents;
        depth > self.near
            && point.dot(right).abs() < depth * wide
            && point.dot(up).abs() < depth * high
    }
}
