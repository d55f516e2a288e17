//! The state of the workbench. `update` changes it, `view` draws it, nothing else touches it.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use rayon::prelude::*;
use tui_input::Input;

use super::action::Panel;
use super::advice::Advice;
use super::journal::Found;
use super::plot::{Axis, Flags, Glyphs, View};
use super::theme::Theme;
use crate::param::{Param, Settings};
use crate::plot::Drawn;
use crate::repair;
use crate::review::History;
use crate::session::{Edit, Plan, Session};
use crate::track::{Channel, Samples, Series, Track};

/// Everything on the screen comes from here.
#[derive(Debug)]
pub struct Model {
    /// The record.
    pub track: Arc<Track>,
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
    /// The job whose result is awaited.
    pub awaited: Option<u64>,
    /// Order of the queue.
    pub sort: Sort,
    /// Whether the next quit is meant.
    pub interrupted: bool,
    /// Changes of the document that the journal does not have yet.
    pub unjournalled: Vec<Touched>,
}

/// Where the document has changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Touched {
    /// Index of the plan.
    pub plan: usize,
    /// Rows (from 0) whose decisions have changed; none when it was the setup.
    pub rows: Vec<u32>,
}

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
    /// Positions of the flags in the order of the queue.
    pub queue: Vec<u32>,
    /// The counts along the multiplier, for the setup they were found for.
    pub advice: Option<Advice>,
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
    /// Position of the sample under the cursor.
    pub cursor: usize,
    /// Index of the active knob.
    pub knob: usize,
    /// Settings of methods that were tuned and left, by id.
    pub tuned: HashMap<&'static str, Settings>,
}

/// How the y range is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum YMode {
    /// From the samples that are kept: outliers do not squash the curve.
    #[default]
    Kept,
    /// From all samples.
    All,
    /// From the middle 99.8 % of the samples.
    Robust,
}

/// Which layers are drawn over the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Layers {
    /// The band of expected value and tolerance, and repaired values.
    #[default]
    Band,
    /// The expected value alone, and repaired values.
    Expected,
    /// The curve alone.
    Raw,
    /// The record after repair: outliers in their new place.
    After,
}

/// Order of the queue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sort {
    /// By time.
    #[default]
    Time,
    /// The largest residual in tolerances first.
    Ratio,
    /// Those nobody decided on first.
    State,
}

/// What lies over the panels.
#[derive(Debug, Default)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The help, from this line on, filtered by what was typed.
    Help(Input, usize),
    /// A list to choose from.
    Picker(Picker),
    /// A line to type in.
    Prompt(Prompt),
    /// Quit although something is not saved?
    ConfirmQuit,
    /// Take back in what an earlier workbench left? The newest first.
    Recover(Vec<Found>),
}

/// A list to choose from.
#[derive(Debug)]
pub struct Picker {
    /// What is chosen.
    pub kind: PickerKind,
    /// What was typed to narrow it.
    pub filter: Input,
    /// Index of the choice among those that fit.
    pub choice: usize,
}

/// What a picker chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PickerKind {
    /// A method.
    Method,
    /// A repair.
    Repair,
    /// A channel.
    Channel,
    /// The channel that measures the rate.
    Rate,
}

/// A line to type in.
#[derive(Debug)]
pub struct Prompt {
    /// What it is for.
    pub kind: PromptKind,
    /// What has been typed.
    pub input: Input,
    /// What is wrong with it.
    pub error: Option<String>,
}

/// What a prompt is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PromptKind {
    /// A command after `:`.
    Command,
    /// Where to jump.
    Jump,
    /// The value of the active knob.
    Value,
    /// A note on the decision about this row (from 0).
    Note(u32),
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
}

impl Model {
    /// A workbench on `track` with `session`, whose plans cover channels of the track.
    #[must_use]
    pub fn new(track: Arc<Track>, session: Session, file: Option<PathBuf>, theme: Theme, glyphs: Glyphs) -> Self {
        let channels = session.plans.par_iter().map(|plan| ChannelState::new(&track, plan, file.is_some())).collect();
        Self {
            track,
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
            awaited: None,
            sort: Sort::Time,
            interrupted: false,
            unjournalled: Vec::new(),
        }
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

    /// True when the document has changed since it was saved.
    #[must_use]
    pub fn unsaved(&self) -> bool {
        self.revision != self.saved_revision
    }

    /// The knobs that matter now, in the order of the panel.
    #[must_use]
    pub fn knobs(&self) -> Vec<Knob> {
        let setup = &self.plan().setup;
        let mut knobs = vec![Knob::Method];
        if setup.method.about().needs_rate {
            knobs.push(Knob::Rate);
        }
        knobs.extend(setup.settings.mattering().map(|(p, _)| Knob::Detection(p)));
        knobs.extend(setup.repair.mattering().map(|(p, _)| Knob::Repair(p)));
        knobs
    }

    /// The active knob.
    #[must_use]
    pub fn knob(&self) -> Knob {
        let knobs = self.knobs();
        knobs.get(self.state().knob).or(knobs.last()).copied().unwrap_or(Knob::Method)
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
        document.plans.retain(|_| kept.pop().unwrap_or(true));
        document
    }

    /// Says something in the footer.
    pub fn say(&mut self, tone: Tone, text: impl Into<String>) {
        self.toast = Some(Toast { text: text.into(), tone });
    }
}

impl Knob {
    /// Its name in the panel.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Method => "method",
            Self::Rate => "rate",
            Self::Repair(p) if p.key == repair::METHOD.key => "repair",
            Self::Detection(p) | Self::Repair(p) => p.key,
        }
    }
}

impl ChannelState {
    fn new(track: &Track, plan: &Plan, touched: bool) -> Self {
        let channel = track.channels.iter().position(|c| c.name == plan.channel).unwrap_or(0);
        let samples = Samples::of(&track.channels[channel], &track.time);
        let view = View::whole(Axis::Time(&samples.series(&track.channels[channel], &track.time).t));
        let k = plan.setup.settings.mattering().position(|(p, _)| matches!(p.key, "k" | "c"));
        Self {
            channel,
            samples: Arc::new(samples),
            drawn: None,
            flags: Flags::default(),
            queue: Vec::new(),
            advice: None,
            stale: true,
            error: None,
            touched,
            view,
            views: Vec::new(),
            y_fit: YMode::default(),
            layers: Layers::default(),
            cursor: 0,
            // The multiplier is what is turned most; the first rows are the method (and its rate).
            knob: k.map_or(0, |k| k + 1 + usize::from(plan.setup.method.about().needs_rate)),
            tuned: HashMap::new(),
        }
    }
}
