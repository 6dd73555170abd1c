//! The report's plots as SVG text: speed against error, frame times along the path, and the parts of a frame's time.
//!
//! Each is a complete `<svg>` element for a file or a page. Text and lines take the colour of the surrounding text (`currentColor`). Grids and
//! secondary text follow the CSS variables `--grid` and `--faint` where a page sets them, so one plot fits light and dark pages.

mod axis;
mod canvas;
mod frames;
mod labels;
mod scatter;
mod stages;

pub use canvas::on_paper;
pub use frames::frame_times;
pub use scatter::speed_against_error;
pub use stages::stage_times;
