//! Work done beside the screen: judging on the worker thread, files on threads of their own.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crossbeam_channel::Sender;

use super::advice::StepsJob;
use super::message::{Message, Output, OutputKind, Written};
use super::model::Model;
use super::session_guard::Known;
use super::survey::ChannelSummary;
use super::words::counted;
use crate::error::{Error, Result};
use crate::job::Worker;
use crate::plot::Drawn;
use crate::report::{self, Byline};
use crate::review::Decisions;
use crate::session::{
    Analysed, Detection, Member, Session, Setup, decisions, detect_taught, detect_together, document,
    document_without_record, settle, write_cleaned,
};
use crate::stop::Stop;
use crate::track::{CopyForm, Lost, Outputs, Samples, Standing, Track, copy_form, write_columns};

/// A channel to judge.
#[derive(Debug)]
pub struct Judge {
    track: Arc<Track>,
    plan: usize,
    channel: usize,
    samples: Arc<Samples>,
    setup: Setup,
    decisions: Decisions,
    /// The last result of the channel.
    previous: Option<Arc<Drawn>>,
    /// All channels that are judged together with this one, itself among them; empty when it is judged alone.
    together: Vec<Together>,
    /// What one step of the active parameter changes, where that is to come with the result.
    steps: Option<Box<StepsJob>>,
}

/// A channel that is judged together with others.
#[derive(Debug)]
struct Together {
    channel: usize,
    samples: Arc<Samples>,
    setup: Setup,
    decisions: Decisions,
}

impl Together {
    fn member<'a>(&'a self, track: &'a Track) -> Member<'a> {
        let Self { channel, samples, setup, decisions } = self;
        Member { channel: &track.channels[*channel], samples, setup, decisions }
    }
}

/// Samples up to which a result comes with what a step of the active parameter changes: one frame tells all then. It
/// takes two more judgements, which is nothing on a record of that length.
const SHORT: usize = 20_000;

impl Judge {
    /// The job for a plan of the model as it is now.
    #[must_use]
    pub fn new(model: &Model, plan: usize) -> Self {
        Self::under(model, plan, model.session.plans[plan].setup.clone())
    }

    /// The job for a plan of the model as it would be with another setup.
    #[must_use]
    pub fn under(model: &Model, plan: usize, setup: Setup) -> Self {
        let state = &model.channels[plan];
        let channel = |plan: usize| &model.track.channels[model.channels[plan].channel];
        let of_target = |i: usize| channel(i).same_target(channel(plan));
        let alike = |i: usize| i == plan || model.session.plans[i].setup.same_method(&setup);
        let shares = |i: &usize| setup.together() && of_target(*i) && alike(*i);
        let member = |i: usize| Together {
            channel: model.channels[i].channel,
            samples: Arc::clone(&model.channels[i].samples),
            setup: if i == plan { setup.clone() } else { model.session.plans[i].setup.clone() },
            decisions: model.session.plans[i].decisions.clone(),
        };
        Self {
            track: Arc::clone(&model.track),
            plan,
            channel: state.channel,
            samples: Arc::clone(&state.samples),
            decisions: model.session.plans[plan].decisions.clone(),
            previous: state.drawn.clone(),
            together: (0..model.channels.len()).filter(shares).map(member).collect(),
            setup,
            steps: None,
        }
    }

    /// The same with what a step of the active parameter changes, on a record that is short.
    #[must_use]
    pub fn with_steps(self, model: &Model) -> Self {
        let short = model.channels[self.plan].drawn.as_ref().is_some_and(|d| d.hidden.len() <= SHORT);
        let steps = if short { StepsJob::new(model, self.plan).map(Box::new) } else { None };
        Self { steps, ..self }
    }

    /// The same job with its own samples, which are freed at its end; a channel that was shown keeps its samples.
    #[must_use]
    pub fn apart(self) -> Self {
        let samples = if self.previous.is_some() { self.samples } else { Arc::new(Samples::later()) };
        Self { samples, ..self }
    }

    /// Index of the plan.
    #[must_use]
    pub fn plan(&self) -> usize {
        self.plan
    }

    /// What the overview tells of the channel.
    ///
    /// # Errors
    /// As [`Judge::run`].
    pub fn summary(&self, stop: &Stop) -> Result<ChannelSummary> {
        let drawn = self.run(stop)?;
        let series = self.samples.series(&self.track.channels[self.channel], &self.track.time);
        Ok(ChannelSummary::of(&drawn, &series))
    }

    /// Does it.
    ///
    /// # Errors
    /// [`Error::Stopped`], and what the method cannot do under the settings.
    pub fn run(&self, stop: &Stop) -> Result<Drawn> {
        let channel = &self.track.channels[self.channel];
        let detection = self.detection(stop)?;
        let outcome = settle(&self.track, channel, &self.samples, detection, &self.decisions, stop)?;
        let series = self.samples.series(channel, &self.track.time);
        Ok(Drawn::new(outcome, &series, self.previous.as_deref(), stop)?)
    }
}

impl Judge {
    /// What the method says.
    ///
    /// # Errors
    /// As [`Judge::run`].
    pub fn detection(&self, stop: &Stop) -> Result<Arc<Detection>> {
        let channel = &self.track.channels[self.channel];
        Ok(match self.previous.as_ref().map(|d| &d.outcome.detection) {
            // Which channels share the setup may have changed, though this one's has not.
            _ if !self.together.is_empty() => Arc::new(self.detect_together(stop)?),
            Some(previous) if previous.holds_for(&self.setup, &self.decisions) => {
                // Only the repair has changed, or decisions that the method does not see: what it says stands.
                let same = previous.setup == self.setup;
                if same { Arc::clone(previous) } else { Arc::new(previous.with_repair(&self.setup)) }
            }
            previous => {
                let previous = previous.map(Arc::as_ref);
                let asked = (&self.setup, &self.decisions);
                Arc::new(detect_taught(&self.track, channel, &self.samples, asked, previous, stop)?)
            }
        })
    }

    fn detect_together(&self, stop: &Stop) -> Result<Detection> {
        let members: Vec<Member<'_>> = self.together.iter().map(|m| m.member(&self.track)).collect();
        let found = detect_together(&self.track, &members, stop)?;
        let own = self.together.iter().position(|m| m.channel == self.channel);
        own.and_then(|at| found.into_iter().nth(at)).ok_or(Error::Stopped)
    }
}

/// A worker that judges channels and sends what comes out.
#[must_use]
pub fn judge(results: Sender<Message>) -> Worker<Judge> {
    Worker::new(move |generation, job: Judge, stop: &Stop| {
        let result = job.run(stop).map(Box::new);
        if let (Some(steps), Ok(drawn)) = (&job.steps, &result)
            && let Ok(steps) = steps.run(&drawn.outcome.detection, stop)
        {
            let _ = results.send(Message::Stepped { plan: job.plan, steps: Box::new(steps) });
        }
        // Nobody listens any more when the program is about to end.
        let _ = results.send(Message::Analysed { generation, plan: job.plan, result });
    })
}

/// What is to be written.
#[derive(Debug, Clone)]
pub struct Errand {
    /// What, and when.
    pub what: Written,
    /// Where; of several files, the first.
    pub path: PathBuf,
    /// Whether they may take the place of files that are there.
    pub overwrite: bool,
    /// The name of the analyst, for a report.
    pub analyst: Option<String>,
}

/// Writes files on a thread of its own and sends how it went. A session file that is as `known` is written again even
/// where nothing may be overwritten.
pub fn write(track: Arc<Track>, session: Session, errand: Errand, known: Known, results: Sender<Message>) {
    std::thread::spawn(move || {
        let result = match &errand.what {
            Written::Session { .. } => save(&track, session, &errand, &known),
            Written::Exported { outputs, .. } => {
                let byline = Byline::today(errand.analyst.clone());
                export(&track, &session, outputs, errand.overwrite, &byline)
            }
        };
        if let (Ok(_), Written::Exported { .. }, Some(path)) =
            (&result, &errand.what, errand.what.session(&errand.path))
        {
            known.read(path);
        }
        let _ = results.send(Message::Written { what: errand.what, path: errand.path, result });
    });
}

fn save(track: &Track, mut session: Session, errand: &Errand, known: &Known) -> Result<String> {
    let analysed = Analysed::of(&session, track, &Stop::never())?;
    let text = session_text(&mut session, track, &analysed, &errand.path)?;
    let mut files = outputs_of(track, errand.overwrite || known.still(&errand.path));
    files.stage(&errand.path, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", &errand.path)))?;
    files.commit()?;
    known.wrote(&errand.path, text.as_bytes());
    let channels = session.plans.iter().map(|p| p.channel.as_str()).collect::<Vec<_>>().join(", ");
    let decisions: usize = session.plans.iter().map(|p| p.decisions.len()).sum();
    let path = errand.path.display();
    let since = since(session.data.record_was, track);
    Ok(format!("saved {path}: {channels}; {} flagged, {}{since}", analysed.flagged(), counted(decisions, "decision")))
}

/// The text of the session file; without what only the record tells where that is lost.
fn session_text(session: &mut Session, track: &Track, analysed: &Analysed, path: &Path) -> Result<String> {
    document(session, track, analysed, path).or_else(|e| match Standing::of(track) {
        Standing::Lost(lost) => document_without_record(session, track, lost, path),
        Standing::Same | Standing::Grown { .. } => Err(e),
    })
}

/// What is to be known of the record that a file was made of.
fn since(record_was: Option<Lost>, track: &Track) -> String {
    match (record_was, Standing::of(track)) {
        (Some(lost), _) => {
            format!(" · without the record, which {}: no result is in it", Standing::Lost(lost).words())
        }
        (None, Standing::Grown { rows }) if rows > 0 => {
            format!(" · about the first {}; {rows} added since", counted(track.rows, "row"))
        }
        _ => String::new(),
    }
}

/// Writes outputs of a result, all of them or none; gives a few words for the user.
///
/// # Errors
/// What the outputs give; nothing has been written then.
pub fn export(
    track: &Track,
    session: &Session,
    outputs: &[Output],
    overwrite: bool,
    byline: &Byline,
) -> Result<String> {
    let analysed = Analysed::of(session, track, &Stop::never())?;
    let changes = analysed.changes(track);
    let mut files = outputs_of(track, overwrite);
    for Output { kind, path } in outputs {
        match kind {
            OutputKind::Cleaned if copy_form(path, track)? == CopyForm::Columns => {
                files.stage_columns(path, |w| write_columns(track, &changes, None, w))
            }
            OutputKind::Cleaned => files.stage(path, |w| write_cleaned(track, &changes, w).map(|_| ())),
            OutputKind::Flags => files.stage(path, |w| report::flags(track, session, &analysed, w)),
            OutputKind::Diagnostics => files.stage(path, |w| report::diagnostics(track, session, &analysed, w)),
            OutputKind::Report => {
                let flags = outputs.iter().find(|output| output.kind == OutputKind::Flags).map(|output| &*output.path);
                let byline = byline.beside(path, flags);
                files.stage(path, |w| report::report(track, session, &analysed, (&byline, path), w))
            }
            OutputKind::Decisions => files.stage(path, |w| decisions(track, session, w)),
            OutputKind::Session => {
                let text = session_text(&mut session.clone(), track, &analysed, path)?;
                files.stage(path, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", path)))
            }
        }?;
    }
    files.commit()?;
    Ok(match outputs {
        [Output { kind: OutputKind::Cleaned, path }] => {
            let n = changes.cells.len();
            let s = if n == 1 { "" } else { "s" };
            let rows = if changes.rows.is_empty() {
                String::new()
            } else {
                format!(", {} added", counted(changes.rows.len(), "row"))
            };
            format!("wrote {}: {n} cell{s} changed{rows}{}", path.display(), since(None, track))
        }
        [only] => format!("wrote {}: {}", only.path.display(), only.kind.name()),
        several => {
            let names: Vec<String> = several.iter().map(|o| o.path.display().to_string()).collect();
            format!("wrote {} files: {}", names.len(), names.join(", "))
        }
    })
}

fn outputs_of(track: &Track, overwrite: bool) -> Outputs {
    let inputs: Vec<&Path> = track.source.path().into_iter().collect();
    Outputs::new(overwrite, &inputs)
}

#[cfg(test)]
mod tests;
