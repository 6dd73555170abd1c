//! SEG-Y files made for tests: small, with every option that a reader must know.

/// A file to be.
#[derive(Clone)]
pub struct Segy {
    /// Code of the sample format.
    pub format: i16,
    pub samples: u16,
    /// Major revision.
    pub revision: u8,
    pub is_little: bool,
    /// First bytes of the line numbers, counted from 1.
    pub numbers: [usize; 2],
    /// First inline and crossline, and their steps.
    pub inlines: [i32; 3],
    pub crosslines: [i32; 3],
    /// Identification code of a trace: 1 live, 2 dead; `None` leaves it out.
    pub code: fn(i32, i32) -> Option<i16>,
    pub value: fn(i32, i32, usize) -> f32,
    /// Code of the unit of positions: 1 lengths, 3 degrees.
    pub unit: i16,
    /// Further text headers.
    pub texts: i16,
    /// Whether bytes 5 to 8 count the traces.
    pub counts: bool,
}

impl Segy {
    /// 3 inlines from 1100, 4 crosslines from 1200 in steps of 2, five samples.
    pub fn new(format: i16) -> Self {
        Self {
            format,
            samples: 5,
            revision: 1,
            is_little: false,
            numbers: [189, 193],
            inlines: [1100, 3, 1],
            crosslines: [1200, 4, 2],
            code: |_, _| Some(1),
            value: |inline, crossline, sample| {
                ((inline - 1100) * 20 + (crossline - 1200) * 4 + sample as i32 - 40) as f32
            },
            unit: 1,
            texts: 0,
            counts: false,
        }
    }

    fn put(&self, bytes: &mut [u8], from: usize, value: &[u8]) {
        let mut value = value.to_vec();
        if self.is_little {
            value.reverse();
        }
        bytes[from..from + value.len()].copy_from_slice(&value);
    }

    fn sample(&self, value: f32) -> Vec<u8> {
        let mut bytes = match self.format {
            1 => ibm(value).to_be_bytes().to_vec(),
            2 => (value as i32).to_be_bytes().to_vec(),
            3 => (value as i16).to_be_bytes().to_vec(),
            5 => value.to_be_bytes().to_vec(),
            6 => f64::from(value).to_be_bytes().to_vec(),
            8 => (value as i8).to_be_bytes().to_vec(),
            other => panic!("no format {other}"),
        };
        if self.is_little {
            bytes.reverse();
        }
        bytes
    }

    /// The bytes of the file.
    pub fn write(&self) -> Vec<u8> {
        let mut file = vec![0x40; 3200];
        let mut binary = vec![0; 400];
        self.put(&mut binary, 16, &4000_u16.to_be_bytes());
        self.put(&mut binary, 20, &self.samples.to_be_bytes());
        self.put(&mut binary, 24, &self.format.to_be_bytes());
        self.put(&mut binary, 54, &1_i16.to_be_bytes());
        binary[300] = self.revision;
        self.put(&mut binary, 304, &self.texts.to_be_bytes());
        if self.revision >= 2 {
            self.put(&mut binary, 96, &0x0102_0304_u32.to_be_bytes());
        }
        file.extend(binary);
        file.resize(file.len() + 3200 * self.texts.max(0) as usize, 0x40);
        let mut number = 0_i32;
        for i in 0..self.inlines[1] {
            for c in 0..self.crosslines[1] {
                let inline = self.inlines[0] + i * self.inlines[2];
                let crossline = self.crosslines[0] + c * self.crosslines[2];
                let Some(code) = (self.code)(inline, crossline) else {
                    continue;
                };
                let mut header = vec![0; 240];
                number += 1;
                self.put(&mut header, 0, &number.to_be_bytes());
                if self.counts {
                    self.put(&mut header, 4, &number.to_be_bytes());
                }
                self.put(&mut header, 28, &code.to_be_bytes());
                self.put(&mut header, 70, &(-10_i16).to_be_bytes());
                self.put(&mut header, 88, &self.unit.to_be_bytes());
                self.put(&mut header, 108, &1000_i16.to_be_bytes());
                self.put(&mut header, 114, &self.samples.to_be_bytes());
                let [at_inline, at_crossline] = self.numbers;
                self.put(&mut header, at_inline - 1, &inline.to_be_bytes());
                self.put(&mut header, at_crossline - 1, &crossline.to_be_bytes());
                // 25 m between inlines northwards, 12.5 m between crossline numbers eastwards, in decimetres.
                let (x, y) = (
                    5_000_000 + 125 * (crossline - 1200),
                    60_000_000 + 250 * (inline - 1100),
                );
                self.put(&mut header, 180, &x.to_be_bytes());
                self.put(&mut header, 184, &y.to_be_bytes());
                file.extend(header);
                for sample in 0..usize::from(self.samples) {
                    file.extend(self.sample((self.value)(inline, crossline, sample)));
                }
            }
        }
        file
    }
}

/// IBM's float for a value: a fraction of 24 bits below 1, at least a 16th, times a power of 16.
fn ibm(value: f32) -> u32 {
    if value == 0.0 {
        return 0;
    }
    let (mut fraction, mut power) = (f64::from(value.abs()), 64_u32);
    while fraction >= 1.0 {
        fraction /= 16.0;
        power += 1;
    }
    while fraction < 1.0 / 16.0 {
        fraction *= 16.0;
        power -= 1;
    }
    let sign = u32::from(value < 0.0) << 31;
    sign | power << 24 | (fraction * f64::from(1_u32 << 24)) as u32
}
