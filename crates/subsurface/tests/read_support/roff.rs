//! ROFF files, in binary of either byte order and in ASCII.

/// The encoding of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Way {
    Little,
    Big,
    Ascii,
}

pub struct Roff {
    way: Way,
    pub bytes: Vec<u8>,
}

impl Roff {
    pub fn new(way: Way, filetype: &str) -> Self {
        let bytes = match way {
            Way::Ascii => b"roff-asc\n#ROFF file#\n#Creator: a test#\n".to_vec(),
            _ => b"roff-bin\0#ROFF file#\0#Creator: a test#\0".to_vec(),
        };
        let mut roff = Self { way, bytes };
        roff.word("tag").word("filedata");
        roff.int("byteswaptest", 1).text("filetype", filetype);
        roff.word("endtag");
        roff
    }

    pub fn word(&mut self, word: &str) -> &mut Self {
        self.bytes.extend(word.as_bytes());
        self.bytes
            .push(if self.way == Way::Ascii { b' ' } else { 0 });
        self
    }

    pub fn text(&mut self, name: &str, text: &str) -> &mut Self {
        self.word("char").word(name);
        match self.way {
            Way::Ascii => self.word(&format!("\"{text}\"")),
            _ => self.word(text),
        }
    }

    pub fn number(&mut self, kind: &str, value: f64) -> &mut Self {
        let bytes = match kind {
            _ if self.way == Way::Ascii => format!("{value} ").into_bytes(),
            "int" => (value as i32).to_be_bytes().to_vec(),
            "float" => (value as f32).to_be_bytes().to_vec(),
            "double" => value.to_be_bytes().to_vec(),
            _ => vec![value as u8],
        };
        match self.way {
            Way::Little => self.bytes.extend(bytes.iter().rev()),
            _ => self.bytes.extend(bytes),
        }
        self
    }

    pub fn int(&mut self, name: &str, value: i32) -> &mut Self {
        self.word("int").word(name).number("int", f64::from(value))
    }

    pub fn array(&mut self, kind: &str, name: &str, values: &[f64]) -> &mut Self {
        self.word("array").word(kind).word(name);
        if self.way == Way::Ascii {
            self.word(&values.len().to_string());
        } else {
            self.number("int", values.len() as f64);
        }
        for value in values {
            self.number(kind, *value);
        }
        self
    }

    pub fn dimensions(&mut self, [x, y, z]: [i32; 3]) -> &mut Self {
        self.word("tag").word("dimensions");
        self.int("nX", x).int("nY", y).int("nZ", z).word("endtag")
    }

    pub fn end(&mut self) -> Vec<u8> {
        self.word("tag").word("eof").word("endtag");
        std::mem::take(&mut self.bytes)
    }
}

/// A grid of cells 100 m wide and long, whose heights are computed.
pub struct GridFile {
    pub way: Way,
    pub size: [i32; 3],
    /// Number of heights per node: 1, 2, 4 or 8; 0 omits `splitEnz`.
    pub split: i32,
    /// Offset of a pillar's top to the east of its bottom.
    pub slant: f64,
    pub scale_x: f64,
    pub active: Option<fn([i32; 3]) -> bool>,
}

impl GridFile {
    pub fn new(size: [i32; 3]) -> Self {
        Self {
            way: Way::Little,
            size,
            split: 4,
            slant: 0.0,
            scale_x: 1.0,
            active: None,
        }
    }

    /// Height in metres of the node (i, j, k) as the cell has it; pillars extend from -2000 to -1000.
    pub fn write(&self, z: impl Fn([i32; 3], [i32; 3]) -> f64) -> Vec<u8> {
        let mut roff = Roff::new(self.way, "grid");
        let [nx, ny, nz] = self.size;
        roff.dimensions(self.size).word("tag").word("scale");
        roff.word("float")
            .word("xscale")
            .number("float", self.scale_x);
        roff.word("endtag").word("tag").word("cornerLines");
        let lines = (0..=nx).flat_map(|i| (0..=ny).map(move |j| (i, j)));
        let lines = lines.flat_map(|(i, j)| {
            let (x, y) = (
                460_000.0 + 100.0 * f64::from(i),
                5_930_000.0 + 100.0 * f64::from(j),
            );
            [x, y, -2000.0, x + self.slant, y, -1000.0]
        });
        roff.array("float", "data", &lines.collect::<Vec<_>>())
            .word("endtag");
        let nodes =
            (0..=nx).flat_map(|i| (0..=ny).flat_map(move |j| (0..=nz).map(move |k| [i, j, k])));
        let nodes: Vec<_> = nodes.collect();
        let heights = nodes.iter().flat_map(|&[i, j, k]| {
            // South-west, south-east, north-west, north-east; below, then above.
            let cells: &[[i32; 3]] = match self.split {
                0 | 1 => &[[0, 0, 0]],
                2 => &[[0, 0, -1], [0, 0, 0]],
                4 => &[[-1, -1, 0], [0, -1, 0], [-1, 0, 0], [0, 0, 0]],
                _ => &[
                    [-1, -1, -1],
                    [0, -1, -1],
                    [-1, 0, -1],
                    [0, 0, -1],
                    [-1, -1, 0],
                    [0, -1, 0],
                    [-1, 0, 0],
                    [0, 0, 0],
                ],
            };
            let z = &z;
            cells
                .iter()
                .map(move |&[di, dj, dk]| z([i + di, j + dj, k + dk], [i, j, k]))
        });
        roff.word("tag")
            .word("zvalues")
            .array("float", "data", &heights.collect::<Vec<_>>());
        if self.split > 0 {
            roff.array(
                "byte",
                "splitEnz",
                &vec![f64::from(self.split); nodes.len()],
            );
        }
        roff.word("endtag");
        if let Some(active) = self.active {
            let cells =
                (0..nx).flat_map(|i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])));
            let active: Vec<_> = cells
                .map(|cell| f64::from(u8::from(active(cell))))
                .collect();
            roff.word("tag")
                .word("active")
                .array("bool", "data", &active)
                .word("endtag");
        }
        roff.end()
    }
}

/// A parameter with a value for each cell.
pub fn parameter(way: Way, size: [i32; 3], kind: &str, values: &[f64]) -> Vec<u8> {
    let mut roff = Roff::new(way, "parameter");
    roff.dimensions(size)
        .word("tag")
        .word("parameter")
        .text("name", "PORO");
    roff.array(kind, "data", values).word("endtag").end()
}
