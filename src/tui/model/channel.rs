//! What the workbench keeps for each channel.

use std::collections::HashMap;
use std::sync::Arc;

use super::super::advice::{Advice, Steps};
use super::super::chart_data::Pictures;
use super::super::consensus::{Consensus, Question};
use super::super::detectability::{MeasuredSetting, Studied};
use super::super::plot::{Axis, Flags, Layers, View};
use super::super::smoothing::Smoothed;
use super::super::survey::ChannelSummary;
use super::Group;
use crate::param::Settings;
use crate::plot::{Drawn, Sides};
use crate::session::detectability::SEED;
use crate::session::measurement::Detectability;
use crate::session::{Measurement, Plan, Setup};
use crate::track::{Samples, Track};

/// What the workbench keeps for a channel, shown or not.
#[derive(Debug)]
pub struct ChannelState {
    /// Index of the channel in the track.
    pub channel: usize,
    /// Its present samples.
    pub samples: Arc<Samples>,
    /// The latest result, if there is one yet.
    pub drawn: Option<Arc<Drawn>>,
    /// Its flags, for drawing.
    pub flags: Flags,
    /// Positions of the flags in the order of the queue; of the first of each run, where runs are reviewed.
    pub queue: Vec<u32>,
    /// The runs that the flags form, by time.
    pub groups: Vec<Group>,
    /// Position of the flag in the first row of the queue's panel.
    pub top: u32,
    /// Flags that a parameter has taken away and that keep their rows there, ascending.
    pub gone: Vec<u32>,
    /// The position of the cursor when they went.
    pub gone_at: usize,
    /// The ratio at the upper edge of the residual's picture, where it has been drawn.
    pub residual_top: f64,
    /// The counts along the multiplier, for the setup they were found for.
    pub advice: Option<Advice>,
    /// True when they were asked for, however long they take.
    pub sweep_asked: bool,
    /// What one step of the active parameter changes, for the setup it was found for.
    pub steps: Option<Steps>,
    /// True when the result is not that of the session as it is now.
    pub stale: bool,
    /// Why there is no result.
    pub error: Option<String>,
    /// True when somebody worked on it: it goes into the saved session.
    pub touched: bool,
    /// The part of the x axis in view.
    pub view: View,
    /// Views before it.
    pub views: Vec<View>,
    /// How the y range is chosen.
    pub y_fit: YMode,
    /// Which layers are drawn.
    pub layers: Layers,
    /// True when the record is shown as it will be after repair.
    pub after: bool,
    /// A: the result that B, the one on the screen, is compared with.
    pub pinned: Option<Box<Pinned>>,
    /// What all methods say, when they were asked.
    pub consensus: Option<Arc<Consensus>>,
    /// How much each method finds of known wild points, as far as that was measured.
    pub studied: Option<Arc<Studied>>,
    /// The same of the settings that were in force then.
    pub measured: Option<Arc<MeasuredSetting>>,
    /// The latest result that was smoothed.
    pub smoothed: Option<Smoothed>,
    /// Why no known wild points can be tried on this channel.
    pub unmeasurable: Option<String>,
    /// What the overview tells of it, as of the last time it was judged there; or why it could not be.
    pub summary: Option<Result<Arc<ChannelSummary>, String>>,
    /// True when the summary is not that of the session as it is now.
    pub summary_stale: bool,
    /// Counts the results that were shown.
    pub results: u64,
    /// What was reduced for the last frame.
    pub pictures: Pictures,
    /// Position of the sample under the cursor.
    pub cursor: usize,
    /// Index of the active parameter.
    pub knob: usize,
    /// Settings of methods that were tuned and left, by id.
    pub tuned: HashMap<&'static str, Settings>,
}

/// A result that was pinned.
#[derive(Debug)]
pub struct Pinned {
    /// What it was made with.
    pub setup: Setup,
    /// Positions that its method flags, ascending.
    pub flagged: Vec<u32>,
    /// Against those that the method now flags; none while there is no result.
    pub sides: Option<Sides>,
}

/// How the y range is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum YMode {
    /// From the samples that are kept: outliers do not squash the curve.
    #[default]
    Kept,
    /// From all samples.
    All,
    /// From the middle 99.8 % of the samples.
    Robust,
    /// This range, whatever is in view.
    Fixed(f64, f64),
}

impl ChannelState {
    /// What was measured of the channel of `plan`: here, or before the session was opened.
    pub(super) fn measurement(&self, plan: &Plan, unit: &str) -> Measurement {
        let mut known = plan.measured.clone();
        let studied = self.studied.as_deref().filter(|s| s.advice.is_over() && s.question == Question::of(&plan.setup));
        if let Some(studied) = studied {
            let here = Measurement::of(&studied.advice, SEED, unit, &plan.setup);
            known = Measurement { detectability: here.detectability.or(known.detectability), ..here };
        }
        let own = self.measured.as_deref().filter(|m| m.is_over && m.setup.same_detection(&plan.setup));
        if let Some(own) = own {
            known.detectability = Some(Box::new(Detectability::of(&own.measured, SEED)));
        }
        known
    }

    pub(super) fn new(track: &Track, plan: &Plan, touched: bool) -> Self {
        let channel = track.channels.iter().position(|c| c.name == plan.channel).unwrap_or(0);
        // A record may have many channels, and most are never shown.
        let ends = track.channels[channel].ends(&track.time).map(|(first, last)| [first, last]);
        let view = View::whole(Axis::Time(ends.as_ref().map_or(&[], |ends| ends.as_slice())));
        let k = plan.setup.settings.mattering().position(|(p, _)| matches!(p.key, "k" | "c"));
        Self {
            channel,
            samples: Arc::new(Samples::later()),
            drawn: None,
            flags: Flags::default(),
            queue: Vec::new(),
            groups: Vec::new(),
            top: 0,
            gone: Vec::new(),
            gone_at: 0,
            residual_top: 0.0,
            advice: None,
            sweep_asked: false,
            steps: None,
            stale: true,
            error: None,
            touched,
            view,
            views: Vec::new(),
            y_fit: YMode::default(),
            layers: Layers::USUAL,
            after: false,
            pinned: None,
            consensus: None,
            studied: None,
            measured: None,
            smoothed: None,
            unmeasurable: None,
            summary: None,
            summary_stale: true,
            results: 0,
            pictures: Pictures::default(),
            cursor: 0,
            // The multiplier is what is turned most; the first rows are the method (and its rate).
            knob: k.map_or(0, |k| k + 1 + usize::from(plan.setup.method.about().needs_rate)),
            tuned: HashMap::new(),
        }
    }
}
