//! The record that wild points are put into: what is calm of it, and how large its noise is.

use super::Unsuitable;
use super::event::{Kind, Wanted, everything};
use super::excerpt::excerpt;
use super::own::{OfKind, Shown};
use super::placement::Places;
use crate::analysis::{Detection, Input, NoiseAt};
use crate::calibration::HOLDS;
use crate::calibration::repeated::repeated;
use crate::error::Result;
use crate::math::order::median_in_place;
use crate::method::{METHODS, find};
use crate::preparation::Preparation;
use crate::series::Series;
use crate::setup::{Preset, Setup};
use crate::stop::Stop;

/// A sample is calm where it objects by less than this share of its limit.
const CALM: f64 = 0.5;

/// At most this share of the samples is made wild at once.
const CONTAMINATION: f64 = 0.02;

/// A record with fewer calm places cannot be asked.
const FEWEST_CALM: usize = 60;

/// A record of which a smaller share is calm cannot be asked.
const LEAST_CALM: f64 = 0.2;

/// The method that is run where only the calibration is wanted: the cheapest.
const CALIBRATING: &str = "five-point";

/// A record, or an excerpt of a long one.
#[derive(Debug)]
pub(super) struct Ground {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    rate: Option<Series<'static>>,
    companions: Vec<Vec<Vec<f64>>>,
    /// The residual at which noise ends, for each sample; NaN where it is not known.
    pub(super) limits: Vec<f64>,
    pub(super) places: Places,
    /// What can be put in, kind by kind.
    pub(super) wanted: Vec<Wanted>,
    /// Whether each sample objects by its limit or more: it is taken for a wild point of the record's own.
    pub(super) wild: Vec<bool>,
    /// How much each kind weighs.
    pub(super) kinds: Vec<OfKind>,
    /// The value of a dropout.
    pub(super) dropout: Option<f64>,
    /// Step of the record's values; 0 where they are not on a grid.
    pub(super) resolution: f64,
    /// How the record is calibrated.
    pub(super) calibrating: Setup,
}

/// A ground, or why there is none.
pub(super) type Suitable = std::result::Result<Ground, Unsuitable>;

impl Ground {
    /// The ground of a channel that is prepared so.
    ///
    /// # Errors
    /// What [`Detection::of`] gives.
    pub(super) fn of(input: Input<'_>, preparation: &Preparation, stop: &Stop) -> Result<Suitable> {
        let taken = excerpt(input.series.len());
        let part = input.series.seen(taken.as_deref(), None);
        let companions: Vec<Vec<Vec<f64>>> = match &taken {
            None => input.companions.to_vec(),
            Some(taken) => input.companions.iter().map(|check| at(check, taken)).collect(),
        };
        let (t, y) = (part.t.to_vec(), part.y.to_vec());
        let calibrating = Setup::new(find(CALIBRATING).unwrap_or(METHODS[0]), Preset::Default).prepared(preparation);
        let series = Series::new(&t, &y);
        let seen = Input { companions: &companions, ..Input::new(&series, input.rate) };
        let detection = Detection::of(seen, &calibrating, stop)?;
        let limits: Vec<f64> = (0..y.len()).map(|at| limit(&detection, at)).collect();
        let calm: Vec<bool> = (0..y.len()).map(|at| is_calm(&detection, at)).collect();
        let wild: Vec<bool> = (0..y.len()).map(|at| is_wild(&detection, at)).collect();
        let calibration = detection.calibration.as_ref();
        let (held, resolution) = calibration.map_or((0.0, 0.0), |c| (c.held, c.resolution));
        let holds = held >= HOLDS;
        let dropout = repeated(&y).first().map(|far| far.value);
        let mut kinds = Kind::COMMON.to_vec();
        kinds.extend(holds.then_some(Kind::Held));
        kinds.extend(dropout.map(|_| Kind::Dropout));
        let places = Places::new(&calm, &detection.segments, holds.then_some(&y));
        let found = places.calm();
        if let Some(why) = Unsuitable::of(y.len(), calm.iter().filter(|c| **c).count(), found) {
            return Ok(Err(why));
        }
        let wanted = everything(&kinds);
        let kinds = Shown { wild: &wild, y: &y, segments: &detection.segments, dropout }.weights(&kinds);
        drop(series);
        let rate = input.rate.map(|rate| rate.borrowed().into_owned());
        Ok(Ok(Self { t, y, rate, companions, limits, places, wanted, wild, kinds, dropout, resolution, calibrating }))
    }

    /// What a method is given of a copy of the record.
    pub(super) fn input<'b>(&'b self, series: &'b Series<'b>) -> Input<'b> {
        Input { companions: &self.companions, ..Input::new(series, self.rate.as_ref()) }
    }

    /// How many wild points are put in at once: few enough that only a small share of the samples becomes wild.
    pub(super) fn events_at_once(&self) -> usize {
        let samples: usize = self.wanted.iter().map(|w| w.kind.length()).sum();
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "counts of samples are far below 2^53"
        )]
        let events = (CONTAMINATION * (self.y.len() * self.wanted.len()) as f64 / samples as f64) as usize;
        events.max(1)
    }

    /// The median of the limits.
    pub(super) fn typical_limit(&self) -> f64 {
        let mut finite: Vec<f64> = self.limits.iter().copied().filter(|l| l.is_finite()).collect();
        if finite.is_empty() { f64::NAN } else { median_in_place(&mut finite) }
    }
}

impl Unsuitable {
    /// Why `samples` of which `calm` are calm, with calm places around `places` of them, cannot be asked.
    fn of(samples: usize, calm: usize, places: usize) -> Option<Self> {
        #[expect(clippy::cast_precision_loss, reason = "counts of samples are far below 2^53")]
        let share = calm as f64 / samples.max(1) as f64;
        if samples < FEWEST_CALM {
            Some(Self::TooShort { samples })
        } else if share < LEAST_CALM {
            Some(Self::TooContaminated { calm: share })
        } else if places < FEWEST_CALM {
            Some(Self::TooIrregular { places })
        } else {
            None
        }
    }
}

/// The values at `positions` of each channel that a check names.
fn at(channels: &[Vec<f64>], positions: &[u32]) -> Vec<Vec<f64>> {
    let of_channel = |values: &Vec<f64>| positions.iter().filter_map(|p| values.get(*p as usize).copied()).collect();
    channels.iter().map(of_channel).collect()
}

fn limit(detection: &Detection, at: usize) -> f64 {
    detection.noise_at(at).map(|noise| noise.limit).filter(|limit| limit.is_finite()).unwrap_or(f64::NAN)
}

fn is_calm(detection: &Detection, at: usize) -> bool {
    let quiet = |noise: NoiseAt| noise.limit.is_finite() && noise.limit > 0.0 && noise.objection < CALM * noise.limit;
    detection.noise_at(at).is_some_and(quiet)
}

fn is_wild(detection: &Detection, at: usize) -> bool {
    let beyond = |noise: NoiseAt| noise.limit.is_finite() && noise.limit > 0.0 && noise.objection >= noise.limit;
    detection.noise_at(at).is_some_and(beyond)
}
