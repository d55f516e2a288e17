//! `sweep`: the count of outliers along a parameter, as a table with a plot, and what it advises.

use std::fmt::Write as _;
use std::io::Write;

use serde::Serialize;

use super::progress::Progress;
use super::table::{columns, row};
use super::{Ending, one_channel, print, print_json, set_threads};
use crate::cli::SweepArgs;
use crate::error::Result;
use crate::param::Param;
use crate::session::sweep::{FROM, STEPS, Sweep, TO, Threshold, grid, multiplier, numeric, sweep, usual_values};
use crate::stop::Stop;
use crate::track::{Samples, printable};

/// What `--json` prints.
#[derive(Serialize)]
struct Told<'a> {
    file: String,
    channel: &'a str,
    method: &'static str,
    #[serde(flatten)]
    sweep: &'a Sweep,
}

pub(super) fn run(args: &SweepArgs, out: &mut dyn Write) -> Result<Ending> {
    set_threads(args.threads)?;
    let setup = args.judge.setup()?;
    let key = match &args.param {
        Some(key) => key.as_str(),
        None => multiplier(&setup)?.key,
    };
    let param = numeric(&setup, key, args.from, args.to)?;
    let values = values(args, param)?;
    let (track, index, note) = one_channel(&args.file, &args.load, args.judge.rate.as_deref())?;
    let channel = &track.channels[index];
    let samples = Samples::of(channel, &track.time);
    let setup = setup.prepared(&args.judge.prepare.of(&track, channel, args.judge.preset)?);
    let progress = Progress::new(1, args.json);
    let swept = sweep(&track, channel, &samples, &setup, (param, &values), &Stop::never())?;
    drop(progress);
    let method = setup.method.about().id;
    if args.json {
        let file = args.file.display().to_string();
        return print_json(out, &Told { file, channel: &channel.name, method, sweep: &swept });
    }
    let unit = if param.unit.is_empty() { String::new() } else { format!(" ({})", param.unit) };
    let title = format!("{}: outliers of {method} along {key}{unit}{note}\n\n", printable(&channel.name));
    print(out, &(title + &table(&swept) + "\n" + &advice(&swept, method)))
}

/// The values that the arguments ask for: where they ask for nothing, the default of the parameter is among them.
fn values(args: &SweepArgs, param: &Param) -> Result<Vec<f64>> {
    let usual = args.param.is_none() && !args.linear && args.steps == STEPS && args.from == FROM && args.to == TO;
    if usual { Ok(usual_values(param)) } else { Ok(grid(args.from, args.to, args.steps, !args.linear)?) }
}

/// The longest bar of the plot.
const BAR: usize = 40;

/// A row per value, with a bar on a logarithmic scale: `=` on plateaus, `#` elsewhere.
fn table(sweep: &Sweep) -> String {
    let scored = sweep.points.iter().any(|p| p.missed.is_some());
    let mut header = row([sweep.key, "flagged"]);
    if scored {
        header.extend(row(["missed", "false alarms"]));
    }
    let mut rows = vec![header];
    let most = sweep.points.iter().map(|p| p.flagged).max().unwrap_or(0);
    for p in &sweep.points {
        let mut cells = vec![figure(p.value), p.flagged.to_string()];
        cells.extend([p.missed, p.false_alarms].into_iter().flatten().map(|n| n.to_string()));
        rows.push(cells);
    }
    let plain = columns(&rows);
    let widest = plain.lines().map(str::len).max().unwrap_or(0);
    let mut out = String::new();
    for (i, line) in plain.lines().enumerate() {
        let bar = i.checked_sub(1).and_then(|i| sweep.points.get(i)).map_or(String::new(), |p| {
            let still = sweep.plateaus.iter().any(|q| (q.from..=q.to).contains(&p.value));
            (if still { "=" } else { "#" }).repeat(length(p.flagged, most))
        });
        let _ = writeln!(out, "{}", format!("{line:widest$}  {bar}").trim_end());
    }
    out
}

/// Length of the bar for a count: one for 1, the longest for `most`.
fn length(count: usize, most: usize) -> usize {
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let share = (count as f64).ln_1p() / (most.max(1) as f64).ln_1p();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "between 0 and the longest bar"
    )]
    let length = (share * BAR as f64).round() as usize;
    if count == 0 { 0 } else { length.max(1) }
}

/// A number to four digits.
fn figure(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}

fn advice(sweep: &Sweep, method: &str) -> String {
    let key = sweep.key;
    let mut out = String::new();
    for p in &sweep.plateaus {
        let (from, to) = (figure(p.from), figure(p.to));
        let _ = writeln!(out, "plateau: {p} from {key} = {from} to {to}, a factor of {:.1}", p.factor());
    }
    let _ = match sweep.threshold {
        Threshold::Suggested { suggestion, range } => {
            writeln!(out, "suggestion: --method {method} --set {key}={suggestion} ({range})")
        }
        Threshold::None { no_suggestion } => writeln!(out, "no suggestion: {no_suggestion}"),
    };
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::sweep::Point;

    fn swept(counts: &[usize]) -> Sweep {
        let point = |(i, &flagged): (usize, &usize)| Point {
            value: 2.0_f64.powi(i32::try_from(i).unwrap()),
            flagged,
            missed: None,
            false_alarms: None,
        };
        Sweep::of("k", counts.iter().enumerate().map(point).collect(), 100_000, None)
    }

    #[test]
    fn bars_show_the_plateau_and_never_hide_a_single_outlier() {
        let text = table(&swept(&[10_000, 7, 7, 1, 0]));
        let bars: Vec<&str> = text.lines().skip(1).map(|l| l.trim_start_matches(|c| c != '#' && c != '=')).collect();
        assert_eq!(bars[0], "#".repeat(BAR));
        assert!(bars[1].starts_with('=') && bars[1] == bars[2] && bars[3].starts_with('#') && bars[4].is_empty());
        assert_eq!(length(1, 1_000_000_000), 1);
    }

    #[test]
    fn the_advice_is_a_command_or_says_why_there_is_none() {
        assert!(advice(&swept(&[90, 7, 7, 0]), "hampel").contains("--method hampel --set k=2 (7 flagged)"));
        assert!(advice(&swept(&[90, 40, 10, 0]), "hampel").contains("no clear gap"));
        assert!(advice(&swept(&[0, 0, 0]), "hampel").contains("nothing is flagged at the default or above"));
    }
}
