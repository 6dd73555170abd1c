//! The report's plots as SVG text: speed against error, frame times along the path, and what a
//! frame's time is spent on.
//!
//! Each is a whole `<svg>` element, fit for a file or for a page. What is ink takes the colour of
//! the text around it (`currentColor`), and grids and faint words follow the CSS variables `--grid`
//! and `--faint` where a page sets them, so that one plot serves light and dark.

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
