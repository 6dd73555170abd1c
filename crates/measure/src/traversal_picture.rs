//! Draws a traversal of a hierarchy as SVG, for debugging. On the left are the blocks of the screen that were drawn to before the first query, on
//! the right all visited nodes, coloured by the batch of their query. In a browser, pointing at a node shows its data.

use std::fmt::Write as _;
use std::path::Path;

use antumbra_strategies::{NodeOutcome, Sketch, SketchNode};
use image::{ImageFormat, RgbaImage};

use crate::MeasureError;
use crate::files::write_whole;
use crate::image_error::{data_uri, encode_png};

/// Space above the panels in pixels.
const HEAD: u32 = 30;
/// Space below and between the panels in pixels.
const GAP: u32 = 16;
/// Height of a line of the legend in pixels.
const LINE: u32 = 22;
/// Width of a legend entry in pixels.
const ENTRY: u32 = 240;

/// Writes the picture of a traversal over the image of its frame.
///
/// # Errors
/// [`MeasureError`] where it cannot be encoded or written. No file is left behind then.
pub fn save_traversal(image: &RgbaImage, sketch: &Sketch, path: &Path) -> Result<(), MeasureError> {
    write_whole(path, &encode_traversal(image, sketch, path)?)
}

/// The bytes of the file that [`save_traversal`] writes. `path` is for the error.
///
/// # Errors
/// [`MeasureError::Image`] where the image cannot be encoded.
pub fn encode_traversal(
    image: &RgbaImage,
    sketch: &Sketch,
    path: &Path,
) -> Result<Vec<u8>, MeasureError> {
    let png = data_uri(ImageFormat::Png.to_mime_type(), &encode_png(image, path)?);
    Ok(draw(image.dimensions(), &png, sketch).into_bytes())
}

/// The SVG text. Writing to a string does not fail.
fn draw((width, height): (u32, u32), png: &str, sketch: &Sketch) -> String {
    let batches = sketch
        .nodes()
        .iter()
        .map(|node| node.batch)
        .max()
        .unwrap_or(0);
    let wide = width * 2 + GAP * 3;
    let columns = (wide / ENTRY).max(1);
    let lines = (batches + 1).div_ceil(columns);
    let high = HEAD + height + GAP + lines * LINE + GAP;
    let right = GAP * 2 + width;
    let mut out = String::new();
    let _ = write!(
        out,
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" viewBox="0 0 {wide} {high}" font-family="sans-serif" font-size="14">
<style>rect:hover {{ fill-opacity: 0.6; stroke-width: 3 }}</style>
<rect width="{wide}" height="{high}" fill="#fff" pointer-events="none"/>
<defs><image id="image" width="{width}" height="{height}" href="{png}"/>
<clipPath id="screen"><rect width="{width}" height="{height}"/></clipPath></defs>
"##
    );
    let map = sketch.occupancy();
    let [columns_of_map, rows] = map.size();
    let all = u64::from(columns_of_map) * u64::from(rows);
    let share = u64::from(map.taken()) * 100 / all.max(1);
    panel(
        &mut out,
        GAP,
        &format!(
            "before the first query {share} % of the blocks ({} pixels wide) are taken: blue",
            sketch.block()
        ),
    );
    taken(&mut out, sketch);
    out.push_str("</g>\n");
    panel(
        &mut out,
        right,
        "nodes by batch: solid where a query found them visible, filled and dashed where hidden",
    );
    for node in sketch.nodes() {
        outline(&mut out, node, batches);
    }
    out.push_str("</g>\n");
    for batch in 0..=batches {
        let of = |outcome: NodeOutcome| {
            let alike = |node: &&SketchNode| node.batch == batch && node.outcome == outcome;
            sketch.nodes().iter().filter(alike).count()
        };
        let (x, y) = (
            GAP + batch % columns * ENTRY,
            HEAD + height + GAP + batch / columns * LINE,
        );
        let words = match batch {
            0 => format!(
                "not queried: {}",
                of(NodeOutcome::Free) + of(NodeOutcome::Visible) + of(NodeOutcome::Occluded)
            ),
            _ => format!(
                "batch {batch}: {} seen, {} hidden",
                of(NodeOutcome::Visible),
                of(NodeOutcome::Occluded)
            ),
        };
        let _ = writeln!(
            out,
            r#"<rect x="{x}" y="{y}" width="14" height="14" fill="{}"/><text x="{}" y="{}">{words}</text>"#,
            colour(batch, batches),
            x + 20,
            y + 12,
        );
    }
    out.push_str("</svg>\n");
    out
}

/// Opens a panel: its title, and the image at reduced opacity.
fn panel(out: &mut String, x: u32, words: &str) {
    let _ = writeln!(
        out,
        r##"<text x="{x}" y="20">{words}</text>
<g transform="translate({x} {HEAD})" clip-path="url(#screen)"><use href="#image" opacity="0.6"/>"##
    );
}

/// The occupied blocks, a rectangle for each run in a row.
fn taken(out: &mut String, sketch: &Sketch) {
    let (map, block) = (sketch.occupancy(), sketch.block());
    let [columns, rows] = map.size();
    out.push_str("<path fill=\"#1769e0\" fill-opacity=\"0.45\" d=\"");
    for y in 0..rows {
        let mut x = 0;
        while x < columns {
            let run = (x..columns).take_while(|x| map.is_taken(*x, y)).count() as u32;
            if run > 0 {
                let _ = write!(
                    out,
                    "M{} {}h{}v{block}h-{}z",
                    x * block,
                    y * block,
                    run * block,
                    run * block
                );
            }
            x += run + 1;
        }
    }
    out.push_str("\"/>\n");
}

/// The rectangle of a node.
fn outline(out: &mut String, node: &SketchNode, batches: u32) {
    let (least, greatest) = (node.pixels.least, node.pixels.greatest);
    let size = (greatest - least).max(glam::Vec2::ONE);
    let (style, words) = match node.outcome {
        NodeOutcome::Free => (
            "fill-opacity=\"0\" stroke-opacity=\"0.5\" stroke-width=\"1\"",
            "drawn without a query",
        ),
        NodeOutcome::Visible => ("fill-opacity=\"0\" stroke-width=\"1.5\"", "visible"),
        NodeOutcome::Occluded => (
            "fill-opacity=\"0.04\" stroke-opacity=\"0.6\" stroke-width=\"1\" stroke-dasharray=\"4 3\"",
            "hidden",
        ),
    };
    let colour = colour(node.batch, batches);
    let _ = writeln!(
        out,
        r#"<rect x="{:.1}" y="{:.1}" width="{:.1}" height="{:.1}" fill="{colour}" stroke="{colour}" {style}><title>batch {}: {words}</title></rect>"#,
        least.x, least.y, size.x, size.y, node.batch,
    );
}

/// The colour of a batch: green for nodes without a query, then from blue to red.
fn colour(batch: u32, batches: u32) -> String {
    match batch {
        0 => "#18a058".to_owned(),
        _ => format!(
            "hsl({} 85% 50%)",
            240 - 240 * (batch - 1) / batches.max(2).saturating_sub(1)
        ),
    }
}
