//! Each method with any legal parameters and any repair on arbitrary samples: it ends, and what it says makes sense.

use std::sync::Arc;

use wildpoint::method::{METHODS, Verdict};
use wildpoint::param::{Kind, Numbers, Settings, Value, Words};
use wildpoint::review::{Decision, Ruling, Signature};
use wildpoint::session::{Analysed, Outcome, Preset, Session, Setup};
use wildpoint::stop::Stop;
use wildpoint::track::{
    Channel, Column, ColumnKind, Delimiter, Dialect, Encoding, Faults, LoadOptions, RowsAt, Samples, Source, TimeAxis,
    TimeFormat, Track,
};

use super::bytes::Bytes;

/// More samples find nothing that fewer do not, and some methods are cubic in their windows.
const MOST: usize = 300;

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let method = METHODS[bytes.below(METHODS.len())];
    let mut setup = Setup::new(method, if bytes.byte() & 1 == 0 { Preset::Default } else { Preset::Paper });
    setup.rate = Some("rate".into());
    vary(&mut setup.settings, &mut bytes);
    vary(&mut setup.repair, &mut bytes);
    let decided = bytes.byte();
    let track = track(&mut bytes);
    let mut session = Session::new(&track, LoadOptions::default(), &setup);
    if decided & 1 == 1 {
        let rows = u32::try_from(track.rows).unwrap_or(0);
        for row in (0..rows).step_by(1 + usize::from(decided)) {
            let ruling = if row % 2 == 0 { Ruling::Outlier } else { Ruling::Normal };
            session.plans[0]
                .decisions
                .set(row, Some(Decision { ruling, note: String::new(), said: None, signature: Signature::default() }));
        }
    }
    judged(&session, &track);
}

/// Runs a session on a record and holds what comes out to the laws.
pub(crate) fn judged(session: &Session, track: &Track) {
    let analysed = Analysed::of(session, track, &Stop::never()).expect("nobody stops it");
    for (index, samples, outcome) in &analysed.channels {
        sensible(track, &track.channels[*index], samples, outcome);
    }
    let changes = analysed.changes(track);
    assert!(changes.cells.windows(2).all(|w| (w[0].row, w[0].column) < (w[1].row, w[1].column)), "sorted, each once");
    assert!(changes.rows.len() <= 8 * (track.rows + 1), "memory is bounded");
}

fn sensible(track: &Track, channel: &Channel, samples: &Samples, outcome: &Outcome) {
    let series = samples.series(channel, &track.time);
    let judged = &outcome.detection.judged;
    let what = &outcome.detection.setup;
    let n = series.len();
    assert_eq!((judged.verdict().len(), judged.expected().len()), (n, n), "{what:?}");
    for i in 0..n {
        let (e, tol) = (judged.expected()[i], judged.tolerance(i).unwrap());
        assert!(!e.is_infinite() && !tol.is_infinite(), "{what:?} at {i}: expected {e}, tolerance {tol}");
        assert!(tol.is_nan() || tol >= 0.0, "{what:?} at {i}: tolerance {tol}");
        assert!(judged.verdict()[i] != Verdict::Missing, "{what:?} at {i}: missing");
        if judged.verdict()[i] == Verdict::Outlier {
            assert!(e.is_finite() && tol.is_finite(), "{what:?} at {i}: outlier with expected {e}, tolerance {tol}");
        }
    }
    assert!(outcome.outliers.windows(2).all(|w| w[0] < w[1]) && outcome.outliers.iter().all(|i| *i < n));
    assert_eq!(outcome.fixes.len(), outcome.outliers.len());
    assert!(outcome.fixes.iter().all(|v| !v.is_infinite()), "{what:?}: {:?}", outcome.fixes);
    assert!(outcome.fills.iter().all(|f| !f.value.is_infinite() && f.seconds.is_finite()), "{what:?}");
    assert_eq!(outcome.runs.iter().map(|r| r.length).sum::<usize>(), outcome.outliers.len());
    let counts = outcome.counts;
    assert_eq!((counts.present + counts.missing, counts.repaired + counts.removed), (track.rows, counts.flagged));
}

/// Other legal values for some of the parameters.
fn vary(settings: &mut Settings, bytes: &mut Bytes<'_>) {
    for param in settings.params() {
        if bytes.byte() < 128 {
            continue;
        }
        let value = match param.kind {
            Kind::Whole { min, max, .. } => Value::Whole(bytes.whole(min, max)),
            Kind::Real { min, max, .. } => Value::Real(bytes.real(min, max)),
            Kind::Choice(words) => Value::Word(words[bytes.below(words.len())]),
            Kind::Switch => Value::Switch(bytes.byte() & 1 == 1),
            Kind::RealOr { words, min, max } => match bytes.below(words.len() + 2) {
                i if i < words.len() => Value::Word(words[i]),
                _ => Value::Real(bytes.real(min, max)),
            },
            Kind::Numbers => Value::Numbers(Numbers::NONE),
            Kind::Words(list) => Value::Words(Words::all(list)),
            Kind::WholeOrOff { min, max } => match bytes.below(4) {
                0 => Value::Word("off"),
                _ => Value::Whole(bytes.whole(min, max)),
            },
        };
        settings.set("fuzz", param.key, value).expect("a legal value");
    }
}

/// Times and two channels from what is left of the bytes.
fn track(bytes: &mut Bytes<'_>) -> Track {
    let (clock, shape) = (bytes.byte(), bytes.byte());
    let (mut time, mut value, mut phase) = (0.0, 0.0, 0_u32);
    let (mut seconds, mut values, mut rates) = (Vec::new(), Vec::new(), Vec::new());
    while !bytes.is_empty() && seconds.len() < MOST {
        time += step(clock, bytes);
        seconds.push(if clock >= 250 && bytes.byte() == 0 { f64::NAN } else { time });
        phase += 1;
        value = match shape % 5 {
            0 => bytes.double(),
            1 => value + f64::from(bytes.byte() as i8),
            2 => f64::from(bytes.byte() & 1),
            3 => 7.0,
            // A track with wild points, three of ten at most.
            _ => match bytes.byte() {
                wild @ 0..=70 => f64::from(wild) * 1e3,
                noise => f64::from(phase).powi(2) * 0.01 + f64::from(noise) / 255.0,
            },
        };
        values.push(if value.is_infinite() { f64::NAN } else { value });
        let rate = if shape & 16 == 0 { f64::from(phase) * 0.02 } else { bytes.double() };
        rates.push(if rate.is_infinite() { f64::NAN } else { rate });
    }
    // Times that a double cannot tell apart are repeated ones, which the loader makes missing.
    let mut last = f64::NEG_INFINITY;
    for t in &mut seconds {
        if *t > last {
            last = *t;
        } else {
            *t = f64::NAN;
        }
    }
    made_of(seconds, [("x", values), ("rate", rates)])
}

fn step(clock: u8, bytes: &mut Bytes<'_>) -> f64 {
    match clock % 6 {
        0 => 1.0,
        1 => 0.1,
        2 => f64::from(bytes.byte()) * 0.25,
        3 => [1.0, 1e-9, 1e9, 50.0, 1e-3, 3.0, 1e15, 0.0][bytes.below(8)],
        4 => bytes.double().abs().min(1e300),
        _ => 1e-300,
    }
}

/// A record of these times (seconds, NaN where there is none) and of the channels `x` and `rate`.
pub(crate) fn made_of(seconds: Vec<f64>, channels: [(&str, Vec<f64>); 2]) -> Track {
    let column = |name: &str, kind| Column { name: name.into(), unit: String::new(), kind, missing: 0 };
    let kinds = [("t", ColumnKind::Time), ("x", ColumnKind::Number), ("rate", ColumnKind::Number)];
    let channel = |(i, (name, values)): (usize, (&str, Vec<f64>))| Channel {
        name: name.into(),
        unit: String::new(),
        column: i + 1,
        target: None,
        values,
    };
    Track {
        source: Source::BuiltIn { name: "fuzz", bytes: Arc::from(&[][..]) },
        sha256: String::new(),
        bytes: 0,
        share: Default::default(),
        dialect: Dialect {
            view: None,
            delimiter: Delimiter::Byte(b','),
            quote: None,
            decimal_comma: false,
            encoding: Encoding::Utf8 { bom: false },
            packing: None,
            header: true,
            units_row: false,
            missing: Vec::new(),
            preamble: 1,
            rows: RowsAt::default(),
            styles: Vec::new(),
            fixed_width: false,
        },
        rows: seconds.len(),
        columns: kinds.into_iter().map(|(name, kind)| column(name, kind)).collect(),
        time: TimeAxis {
            name: "t".into(),
            column: Some(0),
            date_column: None,
            part_columns: Vec::new(),
            zone: None,
            clocks: Default::default(),
            newest_first: false,
            format: TimeFormat::Seconds,
            origin_ns: 0,
            seconds,
        },
        channels: channels.into_iter().enumerate().map(channel).collect(),
        truth: None,
        truth_told: false,
        faults: Faults::default(),
        notes: Vec::new(),
    }
}
