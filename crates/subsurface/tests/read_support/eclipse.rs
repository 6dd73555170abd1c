//! Corner-point grids as a simulator's files have them, made for tests: a text and a binary one of the same cells.

/// Two by three cells in two layers, 100 m wide; the depth grows eastwards, and a fault of 40 m lies between the columns. One cell is inactive.
pub const SIZE: [usize; 3] = [2, 3, 2];
/// The cell that is inactive: the first of the lower layer.
pub const INACTIVE: usize = 6;

/// Ends of the pillars, tops first.
pub fn coord() -> Vec<f32> {
    let mut coord = Vec::new();
    for j in 0..=SIZE[1] {
        for i in 0..=SIZE[0] {
            let (x, y) = (100.0 * i as f32, 100.0 * j as f32);
            coord.extend([x, y, 1000.0, x, y, 2000.0]);
        }
    }
    coord
}

/// Depths of the corners.
pub fn zcorn() -> Vec<f32> {
    let [nx, ny, nz] = SIZE;
    let mut zcorn = Vec::new();
    for row in 0..2 * nz {
        for _ in 0..2 * ny {
            for column in 0..2 * nx {
                let (layer, below) = (row / 2, row % 2);
                let fault = if column / 2 == 1 { 40.0 } else { 0.0 };
                zcorn.push(1500.0 + fault + 10.0 * (layer + below) as f32);
            }
        }
    }
    zcorn
}

/// A value for each cell, in the files' order.
pub fn porosity() -> Vec<f32> {
    (0..12).map(|cell| 0.1 + 0.01 * cell as f32).collect()
}

fn lines(values: &[f32]) -> String {
    let words: Vec<String> = values.iter().map(f32::to_string).collect();
    words
        .chunks(6)
        .map(|words| words.join(" ") + "\n")
        .collect()
}

/// The text, with the grid's own axes moved on the map, and remarks and repeats where they may stand.
pub fn text(unit: &str) -> String {
    let mut active = [1; 12].map(|v: u32| v.to_string());
    active[INACTIVE] = "0".into();
    format!(
        "-- a grid\nNOECHO\n\nMAPUNITS\n'METRES  ' /\nMAPAXES\n 1000 6000 1000 5000 2000 5000 /\nGRIDUNIT\n'{unit}  ' '        ' /\n\
         SPECGRID\n 2 3 2 1 F / what follows is a remark\nGDORIENT\nINC INC INC DOWN RIGHT /\nCOORD\n{}/\n\nZCORN\n{}/\n\
         ACTNUM\n6*1 {} / \nPORO\n{}/\nNTG\n12*0.5 /\nECHO\n",
        lines(&coord()),
        lines(&zcorn()),
        active[6..].join(" "),
        lines(&porosity()),
    )
}

/// A keyword with its values in records of at most `block` elements.
pub fn keyword(name: &str, kind: &str, elements: &[Vec<u8>], block: usize) -> Vec<u8> {
    let record = |bytes: &[u8]| {
        let length = (bytes.len() as i32).to_be_bytes();
        [&length[..], bytes, &length].concat()
    };
    let count = (elements.len() as i32).to_be_bytes();
    let head = [format!("{name:8}").as_bytes(), &count, kind.as_bytes()].concat();
    let mut bytes = record(&head);
    for block in elements.chunks(block) {
        bytes.extend(record(&block.concat()));
    }
    bytes
}

pub fn reals(values: &[f32]) -> Vec<Vec<u8>> {
    values.iter().map(|v| v.to_be_bytes().to_vec()).collect()
}

fn integers(values: &[i32]) -> Vec<Vec<u8>> {
    values.iter().map(|v| v.to_be_bytes().to_vec()).collect()
}

/// The binary form of the same grid, on the map already.
pub fn binary() -> Vec<u8> {
    let mut head = vec![0; 100];
    head[..4].copy_from_slice(&[1, 2, 3, 2]);
    let mut active = [1; 12];
    active[INACTIVE] = 0;
    let texts = |texts: [&str; 2]| texts.map(|text| format!("{text:8}").into_bytes());
    [
        keyword("FILEHEAD", "INTE", &integers(&[3; 100]), 1000),
        keyword("GRIDUNIT", "CHAR", &texts(["METRES", "MAP"]), 105),
        keyword("GRIDHEAD", "INTE", &integers(&head), 1000),
        keyword("COORD", "REAL", &reals(&coord()), 7),
        keyword("ZCORN", "REAL", &reals(&zcorn()), 1000),
        keyword("ACTNUM", "INTE", &integers(&active), 1000),
        keyword("ENDGRID", "INTE", &[], 1000),
    ]
    .concat()
}

/// Results: a property of the active cells, one of all, and one of something else.
pub fn results() -> Vec<u8> {
    let mut active = porosity();
    active.remove(INACTIVE);
    [
        keyword("INTEHEAD", "INTE", &integers(&[7; 30]), 1000),
        keyword("PORO", "REAL", &reals(&active), 1000),
        keyword("PORV", "REAL", &reals(&porosity()), 1000),
        keyword("DEPTHS", "REAL", &reals(&[1.0; 5]), 1000),
    ]
    .concat()
}
