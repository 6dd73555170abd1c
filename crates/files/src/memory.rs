//! The memory that one load may take, with all that is derived from its files. A few bytes of a file become many in memory, so amounts are
//! taken before anything is allocated.

use std::fmt;
use std::fs;

/// The limit where the machine does not say what it has.
const USUAL: u64 = 4 << 30;

/// A budget of memory: amounts are taken from it, and what exceeds it is refused with the part that needs it.
#[derive(Debug, Clone)]
pub struct MemoryBudget {
    limit: u64,
    taken: u64,
}

/// What exceeds a budget.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OverBudget {
    /// The part of the file that needs more.
    pub part: String,
    /// The bytes that all parts so far would take.
    pub needed: u64,
    /// The bytes that they may take.
    pub limit: u64,
}

impl fmt::Display for OverBudget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            part,
            needed,
            limit,
        } = self;
        write!(
            f,
            "with {part} it takes about {} of memory, and {} are allowed: if you trust it, allow more (the option max_memory, or --memory)",
            size(*needed),
            size(*limit)
        )
    }
}

impl std::error::Error for OverBudget {}

impl MemoryBudget {
    /// A budget of so many bytes.
    #[must_use]
    pub fn new(limit: u64) -> Self {
        Self { limit, taken: 0 }
    }

    /// The bytes that are left.
    #[must_use]
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.taken)
    }

    /// Takes an amount for good.
    ///
    /// # Errors
    /// [`OverBudget`], with the part.
    pub fn take<P: fmt::Display>(
        &mut self,
        bytes: u64,
        part: impl FnOnce() -> P,
    ) -> Result<(), OverBudget> {
        self.allow(bytes, part)?;
        self.taken = self.taken.saturating_add(bytes);
        Ok(())
    }

    /// Checks an amount that is given back before the next one is taken.
    ///
    /// # Errors
    /// As for [`take`](Self::take).
    pub fn allow<P: fmt::Display>(
        &self,
        bytes: u64,
        part: impl FnOnce() -> P,
    ) -> Result<(), OverBudget> {
        let needed = self.taken.saturating_add(bytes);
        match needed > self.limit {
            false => Ok(()),
            true => Err(OverBudget {
                part: part().to_string(),
                needed,
                limit: self.limit,
            }),
        }
    }
}

/// The default limit of a load: half of the memory that the machine has free, or that its container may still take.
#[must_use]
pub fn default_memory() -> u64 {
    let text = |path: &str| fs::read_to_string(path).ok();
    let free = text("/proc/meminfo").and_then(|text| {
        let line = text
            .lines()
            .find_map(|line| line.strip_prefix("MemAvailable:"))?;
        let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
        kib.checked_mul(1024)
    });
    let container = || {
        let number = |path: &str| text(path)?.trim().parse::<u64>().ok();
        let most = number("/sys/fs/cgroup/memory.max")?;
        Some(most.saturating_sub(number("/sys/fs/cgroup/memory.current")?))
    };
    free.into_iter()
        .chain(container())
        .min()
        .map_or(USUAL, |free| free / 2)
}

/// A number of bytes in words: `12 MiB`, `3.5 GiB`.
#[must_use]
pub fn size(bytes: u64) -> String {
    let units = [(1_u64 << 40, "TiB"), (1 << 30, "GiB"), (1 << 20, "MiB")];
    let found = units.into_iter().find(|(unit, _)| bytes >= *unit);
    let Some((unit, name)) = found else {
        return format!("{} KiB", bytes.div_ceil(1024));
    };
    let amount = bytes as f64 / unit as f64;
    match amount < 10.0 {
        true => format!("{amount:.1} {name}"),
        false => format!("{amount:.0} {name}"),
    }
}

/// Bytes in words: a whole number, or with one of the units KiB, MiB and GiB (also K, M, G, and KB, MB, GB of a thousand each).
///
/// # Errors
/// How it is written.
pub fn parse_size(text: &str) -> Result<u64, String> {
    let digits = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let scale = match unit.trim().to_ascii_lowercase().as_str() {
        "" | "b" => Some(1),
        "k" | "kib" => Some(1 << 10),
        "m" | "mib" => Some(1 << 20),
        "g" | "gib" => Some(1 << 30),
        "kb" => Some(1_000),
        "mb" => Some(1_000_000),
        "gb" => Some(1_000_000_000),
        _ => None,
    };
    let number = number.parse::<u64>().ok().filter(|number| *number > 0);
    let bytes = number
        .zip(scale)
        .and_then(|(number, scale)| number.checked_mul(scale));
    bytes.ok_or_else(|| "write it as 4GiB, 512MiB, or a number of bytes".to_owned())
}
