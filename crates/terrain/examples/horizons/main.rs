//! Measures what horizons cost and what they find, over any raster or the built-in landscape. It prints the tables and draws the pictures of
//! `docs/strategies/horizon.md`.
//!
//!     cargo run --release -p antumbra-terrain --example horizons -- SOURCE VERTICES WHAT...
//!
//! SOURCE is a raster (.npz, .tif, .asc) or `fractal`. WHAT is `tables`, `rays`, `pairs`, `views`, or `pictures` and a folder.
#![allow(clippy::print_stdout)]

mod canvas;
mod clock;
mod pairs;
mod pictures;
mod rays;
mod tables;
mod views;

use std::error::Error;
use std::path::Path;

use antumbra_demo_scenes::terrain::FractalOptions;
use antumbra_formats::load_raster;
use antumbra_terrain::{Field, RasterDetail};

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let [Some(source), Some(vertices)] = [words.next(), words.next()] else {
        return Err("give SOURCE VERTICES WHAT..., such as: fractal 100000 tables".into());
    };
    let raster = match source.as_str() {
        "fractal" => FractalOptions::default().raster()?,
        file => load_raster(Path::new(file))?,
    };
    let field =
        Field::from_raster(&raster, RasterDetail::Vertices(vertices.parse()?))?.rounded()?;
    let (points, triangles) = (field.points().len(), field.triangles().len());
    println!("{source}: {points} vertices, {triangles} triangles\n");
    while let Some(what) = words.next() {
        match what.as_str() {
            "tables" => tables::print(&field)?,
            "rays" => rays::print(&field)?,
            "pairs" => pairs::print(&field)?,
            "views" => views::print(&field)?,
            "pictures" => {
                let folder = words
                    .next()
                    .ok_or("give the folder, such as: pictures out")?;
                pictures::draw(&field, Path::new(&folder))?;
            }
            other => {
                return Err(format!(
                    "'{other}' is unknown; give tables, rays, pairs, views or pictures"
                )
                .into());
            }
        }
    }
    Ok(())
}
