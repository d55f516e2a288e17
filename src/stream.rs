//! `stream`: judges samples from standard input as they arrive, by the methods that need only the past.
//!
//! What is said of a row may be said again: when a start group is complete, and when a model is lost and a new one
//! judges the run at which that happened. The last word about a row is what the method says of it over the whole
//! record with the same settings, `look_back` and the fill of patches off. What is kept is bounded: the run at
//! hand, the start group and the windows.

use std::io::{Read, Write};

use crate::cli::{FormatArg, StreamArgs};
use crate::error::{Error, Result};
use crate::method::Verdict;
use crate::track::{LoadOptions, Series};

mod judge;
mod layout;
mod lines;
mod notes;
mod output;
mod predict;
mod setup;
mod template;

pub use judge::{Heard, Judge, Said};
use layout::{Content, Layout, Sample};
use lines::{Line, Lines};
use notes::{Counts, Notes};
use output::Label;
pub use output::STREAM_COLUMNS;
pub use setup::Plan;

/// The nominal interval is learnt from this many samples.
const LEARNT_FROM: usize = 10;

/// The layout must be clear after this many lines, and the interval after this many rows.
const MOST_HEAD: usize = 20;
const MOST_HELD: usize = 10_000;

/// This many bad lines are told one by one.
const MOST_TOLD: u64 = 5;

/// Judges the lines of `input` as `args` say: a line for each goes to `out`, which is flushed whenever the sender
/// makes us wait; what the user should know goes to `err`.
///
/// # Errors
/// [`Error::Usage`] for settings that a stream cannot have; [`Error::Input`] when no layout can be made out;
/// [`Error::Io`], also when the reader of `out` has gone away.
pub fn run(args: &StreamArgs, input: impl Read, out: &mut dyn Write, err: &mut dyn Write) -> Result<()> {
    let planned = setup::plan(args)?;
    let mut err = Notes::new(err, args.quiet);
    planned.notes.iter().for_each(|note| err.tell(note));
    let mut stream = Stream {
        plan: planned.plan,
        options: planned.options,
        format: args.format,
        interval: args.interval,
        head: Vec::new(),
        layout: None,
        held: Vec::new(),
        judge: None,
        last: f64::NEG_INFINITY,
        rows: 0,
        counts: Counts::default(),
        out,
        err,
    };
    let mut lines = Lines::new(input);
    while let Some(line) = lines.next(|| stream.out.flush().map_err(output::write_error))? {
        if line.open {
            stream.err.tell(&format!("line {}: has no line end, it may be cut short", line.number));
        }
        stream.take(line)?;
    }
    stream.finish()
}

/// A stream on its way.
struct Stream<'a> {
    plan: Plan,
    options: LoadOptions,
    format: Option<FormatArg>,
    interval: Option<f64>,
    /// Lines that wait for the layout to become clear.
    head: Vec<Line>,
    layout: Option<Layout>,
    /// Samples that wait for the interval to become clear.
    held: Vec<Sample>,
    judge: Option<Judge<Label>>,
    /// Time of the last sample that had one after those before.
    last: f64,
    rows: u64,
    counts: Counts,
    out: &'a mut dyn Write,
    err: Notes<'a>,
}

impl Stream<'_> {
    fn take(&mut self, line: Line) -> Result<()> {
        let text = line.bytes.trim_ascii_start();
        if matches!(text, [] | [b'#' | b'%', ..] | [b'/', b'/', ..]) {
            return Ok(());
        }
        if self.layout.is_some() {
            return self.read(&line);
        }
        self.format.get_or_insert(if text.first() == Some(&b'{') { FormatArg::Jsonl } else { FormatArg::Csv });
        self.head.push(line);
        self.look_at_head(false)
    }

    fn format(&self) -> FormatArg {
        self.format.unwrap_or(FormatArg::Csv)
    }

    fn look_at_head(&mut self, ended: bool) -> Result<()> {
        let (layout, rows) = match Layout::of(&self.head, self.format(), &self.options, ended) {
            Ok(Some(found)) => found,
            Ok(None) => return Ok(()),
            // A line more may make it clear.
            Err(_) if !ended && self.head.len() < MOST_HEAD => return Ok(()),
            Err(e) => return Err(e),
        };
        if layout.others > 0 {
            let note = format!("judging {}; --channel names one of the {} others", layout.name, layout.others);
            self.err.tell(&note);
        }
        self.layout = Some(layout);
        output::header(self.format(), self.out)?;
        let head = std::mem::take(&mut self.head);
        head[head.len().saturating_sub(rows)..].iter().try_for_each(|line| self.read(line))
    }

    fn read(&mut self, line: &Line) -> Result<()> {
        let Some(layout) = &mut self.layout else { return Ok(()) };
        self.rows += 1;
        let sample = layout.read(line, self.rows);
        if self.judge.is_some() {
            return self.judge(&sample);
        }
        self.held.push(sample);
        self.learn(false)
    }

    /// Begins to judge when the nominal interval is known.
    fn learn(&mut self, ended: bool) -> Result<()> {
        let interval = match self.interval {
            Some(interval) => interval,
            None => {
                let mut times: Vec<f64> = Vec::new();
                for sample in &self.held {
                    if let Content::Measured(t, _) = sample.content
                        && times.last().is_none_or(|last| t > *last)
                    {
                        times.push(t);
                    }
                }
                if times.len() < LEARNT_FROM && !ended {
                    return if self.held.len() < MOST_HELD { Ok(()) } else { Err(no_interval()) };
                }
                times.truncate(LEARNT_FROM);
                Series::new(&times, &times).interval
            }
        };
        self.judge = Some(Judge::new(self.plan.clone(), interval));
        std::mem::take(&mut self.held).iter().try_for_each(|sample| self.judge(sample))
    }

    fn judge(&mut self, sample: &Sample) -> Result<()> {
        let format = self.format();
        let (t, y) = match sample.content {
            Content::Measured(t, y) if t > self.last => (t, y),
            Content::Measured(..) => {
                self.counts.untimely += 1;
                return output::passed(format, sample, Verdict::Missing.word(), self.out);
            }
            Content::Missing => {
                self.counts.missing += 1;
                return output::passed(format, sample, Verdict::Missing.word(), self.out);
            }
            Content::Unreadable => {
                self.counts.unreadable += 1;
                if self.counts.unreadable <= MOST_TOLD {
                    self.err.tell(&format!("line {}: cannot be read: {}", sample.line, sample.value));
                }
                return output::passed(format, sample, "unreadable", self.out);
            }
        };
        self.last = t;
        let Some(judge) = &mut self.judge else { return Ok(()) };
        let label = Label::of(sample, y);
        let heard = judge.push(t, y, label.clone());
        output::said(format, &label, &heard.said, false, self.out)?;
        self.counts.say(heard.said.verdict, None);
        for (label, before, now) in &heard.corrections {
            output::said(format, label, now, true, self.out)?;
            self.counts.say(now.verdict, Some(before.verdict));
        }
        for label in &heard.lost {
            self.counts.restarts += 1;
            self.err.tell(&format!(
                "row {}, time {}: more than max_run outliers in a row from here on: the model starts again",
                label.row, label.time
            ));
        }
        Ok(())
    }

    /// The sender has ended.
    fn finish(mut self) -> Result<()> {
        if self.layout.is_none() && !self.head.is_empty() {
            self.look_at_head(true)?;
        }
        if self.judge.is_none() && !self.held.is_empty() {
            self.learn(true)?;
        }
        self.out.flush().map_err(output::write_error)?;
        self.err.tell(&self.counts.text(self.rows));
        Ok(())
    }
}

fn no_interval() -> Error {
    Error::input(
        "standard input",
        format!(
            "the nominal interval cannot be measured: of {MOST_HELD} rows fewer than {LEARNT_FROM} have a value and a later time"
        ),
        "give it with --interval, or name the right columns with --time and --channel",
    )
}

#[cfg(test)]
mod tests;
