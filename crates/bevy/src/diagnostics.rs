//! Numbers for Bevy's diagnostics: the sums over all cameras that cull.

use bevy::diagnostic::{Diagnostic, DiagnosticPath, Diagnostics, RegisterDiagnostic};
use bevy::prelude::*;

use crate::culler::Culler;
use crate::settings::CullingReport;

/// Meshes that are drawn.
pub const DRAWN: DiagnosticPath = DiagnosticPath::const_new("antumbra/drawn");
/// Meshes in the frustum that are left out.
pub const CULLED: DiagnosticPath = DiagnosticPath::const_new("antumbra/culled");
/// Wrong pixels in percent of the image, of each camera's last frame that was audited; the greatest.
pub const WRONG_PIXELS: DiagnosticPath = DiagnosticPath::const_new("antumbra/wrong_pixels");
/// Microseconds of the CPU that this plug-in took in a frame: in the main world, lights included, and where both worlds are in step.
pub const MICROSECONDS: DiagnosticPath = DiagnosticPath::const_new("antumbra/microseconds");

pub(crate) fn register(app: &mut App) {
    app.register_diagnostic(Diagnostic::new(DRAWN))
        .register_diagnostic(Diagnostic::new(CULLED))
        .register_diagnostic(Diagnostic::new(WRONG_PIXELS).with_suffix("%"))
        .register_diagnostic(Diagnostic::new(MICROSECONDS).with_suffix("us"));
}

pub(crate) fn measure(
    mut culler: ResMut<Culler>,
    cameras: Query<&CullingReport>,
    mut diagnostics: Diagnostics,
) {
    let drawn: u32 = cameras.iter().map(|report| report.drawn).sum();
    let culled: usize = cameras.iter().map(|report| report.culled.len()).sum();
    let wrong = cameras.iter().filter_map(|report| report.wrong);
    if let Some(wrong) = wrong.reduce(f32::max) {
        diagnostics.add_measurement(&WRONG_PIXELS, || f64::from(wrong));
    }
    diagnostics.add_measurement(&DRAWN, || f64::from(drawn));
    diagnostics.add_measurement(&CULLED, || culled as f64);
    let spent = culler.spent.take();
    diagnostics.add_measurement(&MICROSECONDS, || spent.as_secs_f64() * 1e6);
}
