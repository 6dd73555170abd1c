//! The worst frame of each strategy, embedded into the page: the reference, the frame, and the marked wrong pixels.

use std::borrow::Cow;
use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageFormat, ImageReader, Limits};

use super::{Pictures, escape};
use crate::MeasureError;
use crate::files::read_limited;
use crate::format;
use crate::image_error::data_uri;
use crate::report::{Report, StrategyReport, WorstFrame};

/// The most bytes of a picture's file.
const MAX_BYTES: u64 = 64 << 20;
/// The most pixels along a side of a picture.
const MAX_SIDE: u32 = 16_384;
/// The most bytes of memory for decoding a picture.
const MAX_DECODED: u64 = 1 << 30;
/// Wider pictures are scaled down to this width, since three of them share a row.
const EMBEDDED_WIDTH: u32 = 1000;

/// A row of three pictures for each strategy with wrong pixels, and a line for those without.
pub(super) fn worst_frames(report: &Report, from: Pictures<'_>) -> String {
    let shown: Vec<(&StrategyReport, &WorstFrame)> = report
        .strategies
        .iter()
        .filter(|s| s.error.wrong_pixels_percent.max > 0.0)
        .filter_map(|s| Some((s, s.worst.as_ref()?)))
        .collect();
    let right: Vec<String> = report
        .strategies
        .iter()
        .filter(|s| !s.is_yardstick() && s.error.wrong_pixels_percent.max == 0.0)
        .map(|s| format!("<b>{}</b>", escape(s.title())))
        .collect();
    if shown.is_empty() && right.is_empty() {
        return String::new();
    }
    let mut html = "<section>\n<h2>Worst frames</h2>\n".to_owned();
    if !shown.is_empty() {
        html += "<p class=\"meaning\">For each strategy the frame with the most wrong pixels, which are magenta in the picture on the right.</p>\n";
    }
    if !right.is_empty() {
        html += &format!(
            "<p>No wrong pixel in any frame: {}.</p>\n",
            right.join(", ")
        );
    }
    for (strategy, worst) in shown {
        html += &row(report, strategy, worst, from);
    }
    html + "</section>\n"
}

fn row(
    report: &Report,
    strategy: &StrategyReport,
    worst: &WorstFrame,
    from: Pictures<'_>,
) -> String {
    let view = match (report.scene.views, worst.view) {
        (0 | 1, _) => String::new(),
        (_, 0) => ", left eye".to_owned(),
        (_, 1) => ", right eye".to_owned(),
        (_, other) => format!(", view {other}"),
    };
    let seen = usize::try_from(worst.view).ok();
    let error = seen
        .and_then(|view| strategy.views.get(view))
        .unwrap_or(&strategy.error);
    // The pose with the most wrong pixels may not be that with the largest share of owned ones.
    let frame = usize::try_from(worst.frame).ok();
    let series = &strategy.frames.wrong_of_owned_percent;
    let owned = frame.filter(|_| report.scene.views < 2);
    let owned = owned.and_then(|frame| series.get(frame));
    let owned = owned.map_or_else(String::new, |percent| {
        format!(
            ", {} % of those that entities own",
            format::percent(*percent)
        )
    });
    let mut html = format!(
        "<h3>{}: frame {}{view}, {} % wrong pixels{owned}</h3>\n<div class=\"three\">\n",
        escape(strategy.title()),
        worst.frame,
        format::percent(error.wrong_pixels_percent.max),
    );
    let images = &worst.images;
    for (file, caption) in [
        (
            &images.reference,
            "reference: everything in the frustum".to_owned(),
        ),
        (&images.strategy, strategy.title().to_owned()),
        (&images.marked, "wrong pixels".to_owned()),
    ] {
        let caption = escape(&caption);
        html += &match read(from, file).and_then(|bytes| embed(Path::new(file), &bytes)) {
            Ok(uri) => format!(
                "<figure><img src=\"{uri}\" alt=\"{caption}\"><figcaption>{caption}</figcaption></figure>\n"
            ),
            Err(error) => format!(
                "<figure><p class=\"missing\">{}</p><figcaption>{caption}</figcaption></figure>\n",
                escape(&format!("No picture: {error}"))
            ),
        };
    }
    html + "</div>\n"
}

/// The bytes of a picture's file.
fn read<'a>(from: Pictures<'a>, name: &str) -> Result<Cow<'a, [u8]>, MeasureError> {
    match from {
        Pictures::Folder(dir) => {
            read_limited(&dir.join(name), "picture", MAX_BYTES).map(Cow::Owned)
        }
        Pictures::Memory(pictures) => match pictures.get(name) {
            Some(bytes) => Ok(Cow::Borrowed(bytes)),
            None => Err(MeasureError::Report {
                field: name.to_owned(),
                problem: "is a picture that was not drawn".to_owned(),
            }),
        },
    }
}

/// The picture as a data URI, scaled down if it is large. Only PNG and JPEG are accepted, by content, not by name.
fn embed(path: &Path, bytes: &[u8]) -> Result<String, MeasureError> {
    let fail = |source| MeasureError::Image {
        path: path.to_owned(),
        source,
    };
    let format = image::guess_format(bytes).map_err(fail)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED);
    reader.limits(limits);
    let picture = reader.decode().map_err(fail)?;
    if picture.width() <= EMBEDDED_WIDTH {
        return Ok(data_uri(format.to_mime_type(), bytes));
    }
    let height =
        u64::from(picture.height()) * u64::from(EMBEDDED_WIDTH) / u64::from(picture.width());
    let small =
        image::imageops::thumbnail(&picture.into_rgb8(), EMBEDDED_WIDTH, (height as u32).max(1));
    let mut png = Vec::new();
    DynamicImage::from(small)
        .write_to(&mut Cursor::new(&mut png), ImageFormat::Png)
        .map_err(fail)?;
    Ok(data_uri(ImageFormat::Png.to_mime_type(), &png))
}
