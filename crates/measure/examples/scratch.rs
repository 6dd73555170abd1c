#![allow(clippy::unwrap_used, missing_docs)]
#[path = "../tests/common/pictures.rs"]
mod pictures;
#[path = "../tests/common/synthetic.rs"]
mod synthetic;
fn main() {
    let dir = std::path::PathBuf::from("/tmp/measure-out");
    std::fs::create_dir_all(&dir).unwrap();
    let r = synthetic::report();
    pictures::draw(&r, &dir);
    antumbra_measure::html::write_html(&r, &dir).unwrap();
    let reference = image::open(dir.join("images/three-pass-reference.png"))
        .unwrap()
        .into_rgba8();
    let marked = image::open(dir.join("images/three-pass-marked.png"))
        .unwrap()
        .into_rgba8();
    use antumbra_measure::image_error::*;
    side_by_side(&[
        Panel {
            caption: "reference: everything in the frustum",
            image: &reference,
        },
        Panel {
            caption: "three-pass, frame 4: 0.072 % wrong",
            image: &marked,
        },
    ])
    .save("/tmp/side.png")
    .unwrap();
    let frame = image::open(dir.join("images/three-pass-frame.png"))
        .unwrap()
        .into_rgba8();
    let t = std::time::Instant::now();
    let f = flip(&reference, &frame).unwrap();
    println!("flip {f:?} {:?}", t.elapsed());
    let ids: Vec<u32> = (0..960 * 540u32).map(|i| i / 7 % 500).collect();
    let t = std::time::Instant::now();
    println!("{} owners {:?}", owners(&ids, 9999).len(), t.elapsed());
    let t = std::time::Instant::now();
    antumbra_measure::html::page(&r, &dir).unwrap();
    println!("page {:?}", t.elapsed());
}
