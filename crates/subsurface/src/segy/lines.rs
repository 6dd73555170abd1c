//! The lines of a SEG-Y file's survey, and the trace at each of their crossings.

use antumbra_files::MemoryBudget;

use super::gather::Gathered;
use super::numbering::Numbering;
use crate::survey::LineNumbers;

/// The most positions of the grid for each trace.
const SPARSE: u64 = 16;

/// The lines of both directions.
pub(super) struct Lines {
    pub(super) inline: LineNumbers,
    pub(super) crossline: LineNumbers,
}

impl Lines {
    pub(super) fn of(
        gathered: &Gathered,
        memory: &mut MemoryBudget,
        numbering: Numbering,
    ) -> Result<Self, String> {
        // The numbers of traces that are not live are often those of nowhere.
        let live = || {
            let all = gathered.numbers.iter().zip(&gathered.live);
            all.filter_map(|(numbers, is_live)| is_live.then_some(numbers))
        };
        let numbers = |axis: usize| LineNumbers::of(live().map(move |numbers| numbers[axis]));
        let [Some(inline), Some(crossline)] = [numbers(0), numbers(1)] else {
            return Err("it has no live trace: all are dead or dummies".to_owned());
        };
        let cells = inline.count.saturating_mul(crossline.count);
        let traces = live().count() as u64;
        if cells > traces.saturating_mul(SPARSE).saturating_add(1024) {
            return Err(format!(
                "its {traces} live traces lie on a grid of {} inlines and {} crosslines, almost all of it empty: the line numbers are elsewhere than in bytes {} (--trace-bytes)",
                inline.count,
                crossline.count,
                numbering.position_bytes()
            ));
        }
        let grid = || format!("its {} x {} positions", inline.count, crossline.count);
        (memory.take(cells * 4, grid)).map_err(|over| over.to_string())?;
        Ok(Self { inline, crossline })
    }

    /// The trace of each position, counted from 1. Of several, the first live one is taken.
    pub(super) fn traces(&self, gathered: &Gathered, notes: &mut Vec<String>) -> Vec<u32> {
        let cells = (self.inline.count * self.crossline.count) as usize;
        let mut traces = vec![0; cells];
        let (mut dead, mut dead_within, mut further) = (0_u64, 0_u64, 0_u64);
        let all = gathered.numbers.iter().zip(&gathered.live);
        for (trace, (&[inline, crossline], is_live)) in (1..).zip(all) {
            let place = self
                .inline
                .index(inline)
                .zip(self.crossline.index(crossline));
            let slot = place.and_then(|(inline, crossline)| {
                traces.get_mut((crossline * self.inline.count + inline) as usize)
            });
            match slot {
                _ if !is_live => {
                    dead += 1;
                    dead_within += u64::from(slot.is_some());
                }
                Some(slot) if *slot == 0 => *slot = trace,
                _ => further += 1,
            }
        }
        let live = gathered.numbers.len() as u64 - dead - further;
        let missing = (cells as u64).saturating_sub(live + dead_within);
        for (count, what) in [
            (dead, "traces are dead and have no value"),
            (missing, "positions of the grid have no trace and no value"),
            (
                further,
                "traces share their line numbers with another, of which the first is taken",
            ),
        ] {
            if count > 0 {
                notes.push(format!("{count} {what}"));
            }
        }
        traces
    }
}
