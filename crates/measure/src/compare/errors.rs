//! The error block of an image: of one view, or of all views of a frame taken as one.

use super::accuracy::{Record, ViewRecord};
use crate::report::{ErrorReport, FalseCulls, MeanMax, Ties};
use crate::{MeasureError, stats};

/// The errors of an image, with one value for each pose.
#[derive(Debug, Default)]
pub struct ImageErrors {
    pub wrong_percent: Vec<f64>,
    /// Wrong pixels, and the pixels that entities own.
    wrong: Vec<u64>,
    owned: Vec<u64>,
    false_culls: Vec<u64>,
    tie_percent: Vec<f64>,
    tied_culls: u64,
    shown: MeanMax,
    flip: MeanMax,
}

impl ImageErrors {
    /// The errors of each view. `owned` has the pixels that entities own, by pose and by view.
    pub fn of_views(record: &Record, owned: &[Vec<u64>]) -> Vec<Self> {
        let views = record.views.iter().enumerate();
        let of_view = |(at, view): (usize, &ViewRecord)| Self {
            wrong_percent: view.wrong_percent.clone(),
            wrong: view.wrong.clone(),
            owned: (owned.iter())
                .map(|views| views.get(at).copied().unwrap_or(0))
                .collect(),
            false_culls: view.false_culls.clone(),
            tie_percent: view.tie_percent.clone(),
            tied_culls: view.tied_culls,
            shown: view.shown,
            flip: view.flip,
        };
        views.map(of_view).collect()
    }

    /// The errors of all views as of one image: shares among the pixels of all views, false culls summed.
    pub fn together(views: &[Self], poses: usize) -> Self {
        let count = views.len().max(1) as f64;
        let sum = |series: fn(&Self) -> &Vec<u64>| {
            let at = |pose: usize| views.iter().filter_map(move |view| series(view).get(pose));
            (0..poses).map(|pose| at(pose).sum()).collect()
        };
        let mean = |series: fn(&Self) -> &Vec<f64>| {
            let at = |pose: usize| views.iter().filter_map(move |view| series(view).get(pose));
            (0..poses)
                .map(|pose| at(pose).sum::<f64>() / count)
                .collect()
        };
        let mean_max = |value: fn(&Self) -> MeanMax| MeanMax {
            mean: views.iter().map(|view| value(view).mean).sum::<f64>() / count,
            max: views.iter().map(|view| value(view).max).fold(0.0, f64::max),
        };
        Self {
            wrong_percent: mean(|view| &view.wrong_percent),
            wrong: sum(|view| &view.wrong),
            owned: sum(|view| &view.owned),
            false_culls: sum(|view| &view.false_culls),
            tie_percent: mean(|view| &view.tie_percent),
            tied_culls: views.iter().map(|view| view.tied_culls).sum(),
            shown: mean_max(|view| view.shown),
            flip: mean_max(|view| view.flip),
        }
    }

    /// By pose: wrong pixels in percent of the pixels that entities own.
    pub fn wrong_of_owned_percent(&self) -> Vec<f64> {
        let pairs = self.wrong.iter().zip(&self.owned);
        pairs.map(|(wrong, owned)| share(*wrong, *owned)).collect()
    }

    /// The error block.
    pub fn report(&self) -> Result<ErrorReport, MeasureError> {
        let series = |values: &[f64]| -> Result<MeanMax, MeasureError> {
            Ok(MeanMax {
                mean: stats::mean(values)?,
                max: values.iter().copied().fold(0.0, f64::max),
            })
        };
        let of_owned = self.wrong_of_owned_percent();
        let culls = &self.false_culls;
        let most = culls
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.cmp(b.1).then(b.0.cmp(&a.0)));
        Ok(ErrorReport {
            wrong_pixels_percent: series(&self.wrong_percent)?,
            wrong_of_owned_percent: Some(MeanMax {
                // Of all poses together: a pose that shows little weighs little, and one that shows nothing hides nothing.
                mean: share(self.wrong.iter().sum(), self.owned.iter().sum()),
                max: of_owned.into_iter().fold(0.0, f64::max),
            }),
            false_culls: FalseCulls {
                entities: culls.iter().sum(),
                worst_frame: most
                    .filter(|(_, culls)| **culls > 0)
                    .map(|(frame, _)| frame as u64),
                longest_run_frames: stats::longest_run(culls.iter().map(|culls| *culls > 0)),
            },
            ties: Some(Ties {
                culled_percent: series(&self.tie_percent)?,
                culled_entities: self.tied_culls,
                shown_percent: self.shown,
            }),
            flip: self.flip,
        })
    }
}

/// Wrong pixels in percent of owned ones, at most 100: a coarser silhouette may be wrong where the reference shows nothing.
fn share(wrong: u64, owned: u64) -> f64 {
    match wrong {
        0 => 0.0,
        wrong => (100.0 * wrong as f64 / owned.max(1) as f64).min(100.0),
    }
}
