//! The state of the workbench. `update` changes it, `view` draws it, nothing else touches it.

use std::path::PathBuf;
use std::sync::Arc;

use ratatui::layout::Rect;
use rayon::prelude::*;

use super::action::{Action, Panel};
use super::advice::{Advice, Steps};
use super::consensus::Polling;
use super::detectability::Studying;
use super::files::Request;
use super::keys::Keys;
use super::plot::{Axis, Glyphs, View};
use super::smoothing;
use super::theme::Theme;
use super::words;
use crate::param::Param;
use crate::repair;
use crate::review::{History, Signature};
use crate::session::{Edit, Plan, Session};
use crate::track::{Channel, Series, Standing, Track};

mod channel;
mod channels_overview;
mod dialog;
mod overlay;
mod review;
mod secondary_chart;

pub use channel::{ChannelState, Pinned, YMode};
pub use channels_overview::{ChannelsOverview, ReviewState, SortColumn};
pub use dialog::{Browser, Dialog, ExportForm, ExportRow, LoaderForm, Over, Waiting};
pub use overlay::{Merging, Overlay, Picker, PickerKind, Prompt, PromptKind};
pub use review::{Group, Reviewing, Sort, Unit};
pub use secondary_chart::{Lower, LowerKind, Second};

/// Everything on the screen comes from here.
#[derive(Debug)]
pub struct Model {
    /// The record.
    pub track: Arc<Track>,
    /// What has become of its file since it was loaded.
    pub standing: Standing,
    /// The document.
    pub session: Session,
    /// What was done to it.
    pub history: History<Edit>,
    /// Counts every change of the document.
    pub revision: u64,
    /// The revision that was saved last.
    pub saved_revision: u64,
    /// Where the session is saved.
    pub file: Option<PathBuf>,
    /// One state for each plan of the session.
    pub channels: Vec<ChannelState>,
    /// Index of the plan on the screen.
    pub shown: usize,
    /// The panel with the keyboard.
    pub focus: Panel,
    /// Whether it has the screen for itself.
    pub maximised: bool,
    /// What lies over the panels.
    pub overlay: Overlay,
    /// The last thing said to the user.
    pub toast: Option<Toast>,
    /// The first key of two, waiting for the second.
    pub prefix: Option<char>,
    /// Columns and rows of the screen.
    pub size: (u16, u16),
    /// Styles.
    pub theme: Theme,
    /// Glyphs.
    pub glyphs: Glyphs,
    /// The key map in force.
    pub keys: Keys,
    /// Whether the mouse is the program's; otherwise the terminal selects text with it.
    pub mouse: bool,
    /// The name of the analyst, in decisions and reports.
    pub analyst: Option<String>,
    /// When the message came that is being handled, in seconds since 1970; the runtime sets it.
    pub now: Option<i64>,
    /// The cell of the trace in which a button went down, until it comes up.
    pub pressed: Option<(u16, u16)>,
    /// The cell in which the last click chose a row of a list, as long as nothing else has moved that list.
    pub clicked: Option<(u16, u16)>,
    /// The lines that were run in the palette, the last one last.
    pub lines: Vec<String>,
    /// The last jump, to be repeated.
    pub jumped: Option<String>,
    /// The job whose result is awaited.
    pub awaited: Option<u64>,
    /// How the flags are reviewed.
    pub review: Reviewing,
    /// The picture below the trace.
    pub lower: Lower,
    /// Which channel is shown beside the one on the screen.
    pub second: Second,
    /// How far all methods have been asked.
    pub polling: Option<Polling>,
    /// What was asked last about smoothing a result.
    pub smoothing: Option<smoothing::Question>,
    /// The measurement of detectability that is under way.
    pub studying: Option<Studying>,
    /// The job that judges channels for the overview.
    pub surveying: Option<u64>,
    /// True when x is the number of the sample, false when it is its time.
    pub by_number: bool,
    /// Whether the next quit is meant.
    pub interrupted: bool,
    /// By which the answer to the latest request to open something is known.
    pub ticket: u64,
    /// What is opened as soon as the session has been saved.
    pub then_open: Option<Request>,
    /// Why changes are not journalled; none while they are, or where no journal is wanted.
    pub not_journalled: Option<String>,
    /// True while the journal has not yet written what the screen shows: the disk is slow.
    pub behind: bool,
    /// Edits of the document that the journal does not have yet, as [`Edit::touched`] says.
    pub unjournalled: Vec<Vec<(usize, Vec<u32>)>>,
}

/// Something said to the user in the footer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Toast {
    /// The words.
    pub text: String,
    /// How they sound.
    pub tone: Tone,
}

/// How a toast sounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Something was done.
    Done,
    /// Something deserves a look.
    Warning,
    /// Something failed.
    Error,
}

/// Something in the parameter panel that can be turned.
#[derive(Debug, Clone, Copy)]
pub enum Knob {
    /// Which method.
    Method,
    /// Which channel measures the rate.
    Rate,
    /// A parameter of the method.
    Detection(&'static Param),
    /// A parameter of repair (which repair, too).
    Repair(&'static Param),
    /// A check before the method, by its index in the plan and its id: on or off.
    Check(usize, &'static str),
    /// A parameter of the check of this index.
    OfCheck(usize, &'static Param),
    /// The period of a circular channel.
    Period,
    /// Whether the method learns from decisions.
    ExcludeDecided,
}

impl Model {
    /// A workbench on `track` with `session`, whose plans cover channels of the track.
    #[must_use]
    pub fn new(track: Arc<Track>, session: Session, file: Option<PathBuf>, theme: Theme, glyphs: Glyphs) -> Self {
        let channels = session.plans.par_iter().map(|plan| ChannelState::new(&track, plan, file.is_some())).collect();
        Self {
            track,
            standing: Standing::Same,
            session,
            history: History::default(),
            revision: 0,
            saved_revision: 0,
            file,
            channels,
            shown: 0,
            focus: Panel::Trace,
            maximised: false,
            overlay: Overlay::None,
            toast: None,
            prefix: None,
            size: (80, 24),
            theme,
            glyphs,
            keys: Keys::default(),
            mouse: false,
            analyst: None,
            now: None,
            pressed: None,
            clicked: None,
            lines: Vec::new(),
            jumped: None,
            awaited: None,
            review: Reviewing::default(),
            lower: Lower::default(),
            second: Second::default(),
            polling: None,
            smoothing: None,
            studying: None,
            surveying: None,
            by_number: false,
            interrupted: false,
            ticket: 0,
            then_open: None,
            not_journalled: None,
            behind: false,
            unjournalled: Vec::new(),
        }
    }

    /// Takes over from the workbench before what belongs to the screen and the user, not to the record.
    pub fn keep_screen_of(&mut self, old: Self) {
        self.size = old.size;
        self.focus = old.focus;
        self.maximised = old.maximised;
        self.ticket = old.ticket;
        (self.keys, self.mouse, self.lines) = (old.keys, old.mouse, old.lines);
        self.lower = old.lower;
        self.review.keep_habits_of(old.review);
    }

    /// The screen, as large as the last message about it said.
    #[must_use]
    pub fn screen(&self) -> Rect {
        Rect { x: 0, y: 0, width: self.size.0, height: self.size.1 }
    }

    /// The channel on the screen.
    #[must_use]
    pub fn state(&self) -> &ChannelState {
        &self.channels[self.shown]
    }

    /// The channel on the screen.
    pub fn state_mut(&mut self) -> &mut ChannelState {
        &mut self.channels[self.shown]
    }

    /// By whom and when a decision is made that is made now.
    #[must_use]
    pub fn signature(&self) -> Signature {
        Signature { by: self.analyst.as_deref().map(Into::into), at: self.now }
    }

    /// The plan of the channel on the screen.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.session.plans[self.shown]
    }

    /// The channel on the screen as it is in the track.
    #[must_use]
    pub fn channel(&self) -> &Channel {
        &self.track.channels[self.state().channel]
    }

    /// The present samples of the channel on the screen.
    #[must_use]
    pub fn series(&self) -> Series<'_> {
        let state = self.state();
        state.samples.series(&self.track.channels[state.channel], &self.track.time)
    }

    /// Where samples lie along x.
    #[must_use]
    pub fn axis<'s>(&self, series: &'s Series<'_>) -> Axis<'s> {
        if self.by_number { Axis::Position(&series.t) } else { Axis::Time(&series.t) }
    }

    /// The positions of the samples in view.
    #[must_use]
    pub fn in_view(&self) -> std::ops::Range<usize> {
        self.state().view.positions(self.axis(&self.series()))
    }

    /// The plan of the channel that is shown beside the one on the screen, where there is room for it.
    #[must_use]
    pub fn second_plan(&self) -> Option<usize> {
        let next = (self.shown + 1) % self.channels.len().max(1);
        let plan = match self.second {
            Second::Off => return None,
            Second::Plan(plan) if plan != self.shown && plan < self.channels.len() => plan,
            Second::Next | Second::Plan(_) => next,
        };
        (plan != self.shown).then_some(plan)
    }

    /// The part of the x axis that holds the whole record.
    #[must_use]
    pub fn whole(&self) -> View {
        View::whole(self.axis(&self.series()))
    }

    /// The sample of the channel on the screen that is nearest to a place on the x axis.
    #[must_use]
    pub fn nearest_x(&self, x: f64) -> Option<usize> {
        if !self.by_number {
            return self.nearest(x);
        }
        let last = self.series().len().checked_sub(1)?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast from float saturates")]
        let position = x.round() as usize;
        Some(position.min(last))
    }

    /// The sample of the channel on the screen that is nearest to a time, the earlier of two; none when there is none.
    #[must_use]
    pub fn nearest(&self, t: f64) -> Option<usize> {
        let series = self.series();
        let after = series.before(t);
        let before = after.saturating_sub(1);
        match (series.t.get(before), series.t.get(after)) {
            (Some(x), Some(y)) if (x - t).abs() <= (y - t).abs() => Some(before),
            (_, Some(_)) => Some(after),
            (Some(_), None) => Some(before),
            (None, None) => None,
        }
    }

    /// True when the document has changed since it was saved.
    #[must_use]
    pub fn unsaved(&self) -> bool {
        self.revision != self.saved_revision
    }

    /// The parameters that matter now, in the order of the panel.
    #[must_use]
    pub fn knobs(&self) -> Vec<Knob> {
        self.knobs_of(self.shown)
    }

    fn knobs_of(&self, plan: usize) -> Vec<Knob> {
        let setup = &self.session.plans[plan].setup;
        let mut knobs = vec![Knob::Method];
        if setup.method.about().needs_rate {
            knobs.push(Knob::Rate);
        }
        knobs.extend(setup.settings.mattering().map(|(p, _)| Knob::Detection(p)));
        knobs.extend(setup.repair.mattering().map(|(p, _)| Knob::Repair(p)));
        for (index, check) in setup.preparation.checks.iter().enumerate() {
            knobs.push(Knob::Check(index, check.id()));
            knobs.extend(check.settings.mattering().map(|(p, _)| Knob::OfCheck(index, p)));
        }
        if !setup.preparation.is_empty() {
            knobs.extend([Knob::Period, Knob::ExcludeDecided]);
        }
        knobs
    }

    /// The active parameter.
    #[must_use]
    pub fn knob(&self) -> Knob {
        self.knob_of(self.shown)
    }

    /// The active parameter of a plan.
    #[must_use]
    pub fn knob_of(&self, plan: usize) -> Knob {
        let knobs = self.knobs_of(plan);
        knobs.get(self.channels[plan].knob).or(knobs.last()).copied().unwrap_or(Knob::Method)
    }

    /// What one step of the active parameter of the channel on the screen changes from the result on the screen, if
    /// that is known.
    #[must_use]
    pub fn steps(&self) -> Option<&Steps> {
        let state = self.state();
        let shown = &state.drawn.as_ref()?.outcome.detection.setup;
        state.steps.as_ref().filter(|s| s.is_for(shown, self.knob()))
    }

    /// The advice on the multiplier of the channel on the screen, if it is there and holds for the setup as it is now.
    #[must_use]
    pub fn advice(&self) -> Option<&Advice> {
        self.state().advice.as_ref().filter(|advice| advice.is_for(&self.plan().setup))
    }

    /// The session as it is saved: with the channels that somebody worked on, and the one on the screen.
    #[must_use]
    pub fn document(&self) -> Session {
        let mut document = self.session.clone();
        let kept = self.channels.iter().enumerate().map(|(i, c)| c.touched || i == self.shown);
        let mut kept: Vec<bool> = kept.collect();
        kept.reverse();
        for (plan, channel) in document.plans.iter_mut().zip(&self.channels) {
            plan.measured = channel.measurement(plan, &self.track.channels[channel.channel].unit);
        }
        document.plans.retain(|_| kept.pop().unwrap_or(true));
        document
    }

    /// The key in force of an action, for hints.
    #[must_use]
    pub fn key(&self, action: Action) -> String {
        words::key(&self.keys, action)
    }

    /// Says something in the footer after what is said there already.
    pub fn say_too(&mut self, tone: Tone, text: &str) {
        let before = self.toast.take().map(|toast| toast.text + " · ").unwrap_or_default();
        self.say(tone, before + text);
    }

    /// Says something in the footer.
    pub fn say(&mut self, tone: Tone, text: impl Into<String>) {
        self.toast = Some(Toast { text: text.into(), tone });
    }
}

impl Knob {
    /// The parameter that it turns; none where it is something else.
    #[must_use]
    pub fn param(self) -> Option<&'static Param> {
        match self {
            Self::Detection(p) | Self::Repair(p) | Self::OfCheck(_, p) => Some(p),
            Self::Method | Self::Rate | Self::Check(..) | Self::Period | Self::ExcludeDecided => None,
        }
    }

    /// True where a group of parameters begins.
    #[must_use]
    pub fn begins_group(self) -> bool {
        matches!(self, Self::Method | Self::Check(..)) || self.name() == "repair"
    }

    /// Its name in the panel.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Method => "method",
            Self::Rate => "rate",
            Self::Repair(p) if p.key == repair::METHOD.key => "repair",
            Self::Check(_, id) => id,
            Self::Period => "period",
            Self::ExcludeDecided => "exclude_decided",
            Self::Detection(p) | Self::Repair(p) | Self::OfCheck(_, p) => p.key,
        }
    }
}
