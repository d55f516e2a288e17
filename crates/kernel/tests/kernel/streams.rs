//! Streams with nulls and without rows, kinds of columns, and what the kernel refuses.

use std::sync::Arc;

use crate::common::{batch, kernel, reals, refused, session, stream, texts, wholes};
use arrow_array::{
    ArrayRef, Float32Array, Float64Array, Int32Array, Int64Array, RecordBatch, StringArray, TimestampMicrosecondArray,
};

const HAMPEL: &str = "[[channel]]\nname = \"v\"\nmethod = \"hampel\"\n";
const PASSES: &str = "time = \"t\"\ntrack = \"pass\"";
const WILD: usize = 30;

/// 60 values of a line with a ripple, one of them wild.
fn values() -> Vec<f64> {
    let ripple = |i: usize| i as f64 + 0.1 * ((i * i) as f64).sin() + if i == WILD { 50.0 } else { 0.0 };
    (0..60).map(ripple).collect()
}

fn column<T: 'static>(values: impl IntoIterator<Item = T>) -> ArrayRef
where
    Float64Array: FromIterator<T>,
{
    Arc::new(values.into_iter().collect::<Float64Array>())
}

fn seconds(n: usize) -> ArrayRef {
    column((0..n).map(|i| Some(i as f64)))
}

fn pass(id: &str, n: usize) -> ArrayRef {
    Arc::new(StringArray::from(vec![id; n]))
}

fn with_session<T>(about_data: &str, channels: &str, work: impl FnOnce(&str) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    work(session(folder.path(), about_data, channels).to_str().unwrap())
}

fn outliers(found: &RecordBatch) -> Vec<usize> {
    let words = texts(found, "v_verdict");
    (0..words.len()).filter(|row| words[*row] == "outlier").collect()
}

#[test]
fn nulls_are_missing_and_what_the_session_does_not_name_is_handed_on() {
    let mut v: Vec<Option<f64>> = values().into_iter().map(Some).collect();
    v[10] = None;
    v[11] = Some(f64::INFINITY);
    let mut t: Vec<Option<f64>> = (0..60).map(|i| Some(f64::from(i))).collect();
    t[20] = None;
    let other: ArrayRef = Arc::new(StringArray::from(vec!["x"; 60]));
    let input = batch(vec![("t", column(t)), ("other", other), ("v", column(v)), ("pass", pass("a", 60))]);
    let found = with_session(PASSES, HAMPEL, |s| kernel(&["--session", s], stream(&input, 7)));
    let words = texts(&found, "v_verdict");
    assert_eq!([&words[10], &words[11], &words[20]], ["missing"; 3]);
    assert_eq!(outliers(&found), [WILD]);
    assert_eq!(texts(&found, "other"), ["x"; 60]);
    let clean = reals(&found, "v_clean");
    assert_eq!((clean[10], clean[11], clean[20]), (None, None, Some(values()[20])));
    assert!((clean[WILD].unwrap() - WILD as f64).abs() < 1.0);
    assert_eq!(found.columns()[..4], input.columns()[..], "the input comes first, unchanged");
}

#[test]
fn tracks_without_values_and_streams_without_rows_are_no_fault() {
    let ids: ArrayRef = Arc::new(StringArray::from([vec!["empty"; 5], vec!["full"; 60], vec!["one"]].concat()));
    let t = column((0..5).chain(0..60).chain([7]).map(|i| Some(f64::from(i))));
    let v = column([None; 5].into_iter().chain(values().into_iter().map(Some)).chain([Some(1.0)]));
    let input = batch(vec![("pass", ids), ("t", t), ("v", v)]);
    with_session(PASSES, HAMPEL, |s| {
        let found = kernel(&["--session", s, "--emit", "summary"], stream(&input, 4));
        assert_eq!(texts(&found, "track"), ["empty", "full", "one"]);
        assert_eq!(wholes(&found, "rows"), [Some(5), Some(60), Some(1)]);
        assert_eq!(wholes(&found, "present"), [Some(0), Some(60), Some(1)]);
        assert_eq!(wholes(&found, "flagged"), [Some(0), Some(1), Some(0)]);
        for emit in ["samples", "flags", "summary"] {
            let none = kernel(&["--session", s, "--emit", emit], stream(&input.slice(0, 0), 1));
            assert_eq!(none.num_rows(), 0, "{emit}");
        }
    });
}

#[test]
fn times_and_values_come_in_any_kind_of_number() {
    let v32: ArrayRef = Arc::new(values().iter().map(|v| Some(v.round() as f32)).collect::<Float32Array>());
    let v64 = column(values().iter().map(|v| Some(v.round())));
    let millis: ArrayRef = Arc::new(Int64Array::from_iter_values((0..60).map(|i| i * 1000)));
    let stamps: ArrayRef = Arc::new(TimestampMicrosecondArray::from_iter_values((0..60).map(|i| i * 1_000_000)));
    let ids: ArrayRef = Arc::new(Int32Array::from(vec![7; 60]));
    with_session(PASSES, HAMPEL, |s| {
        let summary = |t: ArrayRef, v: &ArrayRef, unit: &str| {
            let input = batch(vec![("pass", ids.clone()), ("t", t), ("v", v.clone())]);
            let args = ["--session", s, "--emit", "summary", "--time-unit", unit];
            kernel(&args, stream(&input, 60))
        };
        let expected = summary(seconds(60), &v64, "s");
        assert_eq!(texts(&expected, "track"), ["7"]);
        assert_eq!(wholes(&expected, "flagged"), [Some(1)]);
        assert_eq!(summary(millis, &v64, "ms"), expected);
        assert_eq!(summary(stamps, &v32, "s"), expected);
    });
}

#[test]
fn a_method_gets_the_channel_of_its_rate() {
    let rate = column((0..60).map(|_| Some(1.0)));
    let input = batch(vec![
        ("pass", pass("a", 60)),
        ("t", seconds(60)),
        ("v", column(values().into_iter().map(Some))),
        ("r", rate),
    ]);
    let matched = "[[channel]]\nname = \"v\"\nmethod = \"matched\"\nrate = \"r\"\n";
    let found = with_session(PASSES, matched, |s| kernel(&["--session", s], stream(&input, 60)));
    assert_eq!(outliers(&found), [WILD]);
}

#[test]
fn what_is_no_track_is_refused_with_the_reason() {
    let v = || column(values().into_iter().map(Some));
    let good = || vec![("pass", pass("a", 60)), ("t", seconds(60)), ("v", v())];
    let refusal = |columns: Vec<(&str, ArrayRef)>| {
        with_session(PASSES, HAMPEL, |s| refused(&["--session", s], stream(&batch(columns), 7)))
    };
    let with = |name: &str, column: ArrayRef| {
        let mut columns = good();
        let at = columns.iter().position(|(n, _)| *n == name).unwrap();
        columns[at].1 = column;
        refusal(columns)
    };
    let backward = with("t", column((0..60).map(|i| Some(if i == 40 { 3.0 } else { f64::from(i) }))));
    assert!(backward.contains("track a: the time of row 41 lies before"), "{backward}");
    let ids =
        |of: fn(usize) -> Option<&'static str>| -> ArrayRef { Arc::new((0..60).map(of).collect::<StringArray>()) };
    let apart = with("pass", ids(|i| Some(if i / 20 == 1 { "b" } else { "a" })));
    assert!(apart.contains("track a: its rows do not stand together"), "{apart}");
    let nameless = with("pass", ids(|i| Some("a").filter(|_| i != 5)));
    assert!(nameless.contains("a row names no track"), "{nameless}");
    assert!(with("v", pass("1.0", 60)).contains("v: Utf8 is no number"));
    assert!(with("t", pass("1.0", 60)).contains("t: Utf8 is no time"));
    let mut twice = good();
    twice.push(("v_clean", v()));
    assert!(refusal(twice).contains("v_clean: the stream has such a column already"));
    let missing = refusal(good().into_iter().filter(|(name, _)| *name != "v").collect());
    assert!(missing.contains("v: no such column") && missing.contains("pass"), "{missing}");
    let no_stream = with_session(PASSES, HAMPEL, |s| refused(&["--session", s], b"t,v\n1,2\n".to_vec()));
    assert!(no_stream.contains("Arrow IPC stream"), "{no_stream}");
}

#[test]
fn decisions_hold_for_the_track_time_and_value_that_they_were_made_on() {
    let decided = |value: &str| {
        format!("{HAMPEL}decisions = [ {{ row = 9, time = \"30,0\", value = \"{value}\", verdict = \"normal\" }} ]\n")
    };
    let value = values()[WILD].to_string();
    let two: ArrayRef = Arc::new(StringArray::from([vec!["a"; 60], vec!["b"; 60]].concat()));
    let t = column((0..120).map(|i| Some(f64::from(i % 60))));
    let v = column(values().into_iter().chain(values()).map(Some));
    let input = stream(&batch(vec![("pass", two), ("t", t), ("v", v)]), 50);
    with_session(PASSES, &decided(&value), |s| {
        let said = refused(&["--session", s], input.clone());
        assert!(
            said.contains("the session has decisions (1), which belong to one record") && said.contains("--decisions"),
            "{said}"
        );
        let found = kernel(&["--session", s, "--decisions=b"], input.clone());
        assert_eq!(outliers(&found), [WILD], "not in track b");
    });
    let other = with_session(PASSES, &decided("1.5"), |s| refused(&["--session", s, "--decisions=b"], input));
    assert!(other.contains("v at 30,0 with the value 1.5: no row of the track has both"), "{other}");
}

#[test]
fn a_session_made_on_several_tracks_tells_what_is_done_with_others() {
    let plan = |track: &str, k: f64| {
        format!("[[channel]]\nname = \"v@{track}\"\nmethod = \"hampel\"\nsettings = {{ k = {k:?} }}\n")
    };
    let input = batch(vec![("pass", pass("c", 60)), ("t", seconds(60)), ("v", column(values().into_iter().map(Some)))]);
    let same = plan("a", 4.0) + &plan("b", 4.0);
    let found = with_session(PASSES, &same, |s| kernel(&["--session", s], stream(&input, 60)));
    assert_eq!(outliers(&found), [WILD]);
    let differing = plan("a", 4.0) + &plan("b", 5.0);
    let said = with_session(PASSES, &differing, |s| refused(&["--session", s], stream(&input, 60)));
    assert!(said.contains("v: its settings differ from track to track, and there are none for c"), "{said}");
}
