//! Property: however the rows of an archive are cut into streams and batches, and in whatever order rows of the same
//! time come, the digests are the same.

use std::sync::Arc;

use crate::common::{batch, kernel, session, stream_of, texts};
use arrow_array::{Float64Array, RecordBatch, StringArray};
use proptest::prelude::*;
use wildpoint_record::session::archive::archive_digest;

#[derive(Debug, Clone)]
struct Row {
    track: usize,
    time: f64,
    values: [Option<f64>; 2],
}

/// Three tracks whose times come twice now and then.
fn rows() -> Vec<Row> {
    let row = |i: usize| {
        let ripple = |n: usize| ((n * n + 3) as f64).sin() + if n % 41 == 7 { 30.0 } else { 0.0 };
        let time = (i / 3) as f64 - if i % 30 == 17 { 1.0 } else { 0.0 };
        Row { track: i % 3, time, values: [Some(ripple(i)).filter(|_| i % 13 != 5), Some(ripple(i + 1000))] }
    };
    (0..360).map(row).collect()
}

fn as_batch(rows: &[Row]) -> RecordBatch {
    let names = ["a", "b", "c"];
    let ids: StringArray = rows.iter().map(|row| Some(names[row.track])).collect();
    let times: Float64Array = rows.iter().map(|row| Some(row.time)).collect();
    let values = |at: usize| rows.iter().map(|row| row.values[at]).collect::<Float64Array>();
    batch(vec![("pass", Arc::new(ids)), ("t", Arc::new(times)), ("v", Arc::new(values(0))), ("w", Arc::new(values(1)))])
}

/// The lines of the summaries of `rows`, sorted by track and time but otherwise as they come, in batches of `sizes`.
fn lines(session: &str, mut rows: Vec<Row>, sizes: &[usize]) -> Vec<String> {
    rows.sort_by(|a, b| a.track.cmp(&b.track).then(a.time.total_cmp(&b.time)));
    let whole = as_batch(&rows);
    let mut at = 0;
    let pieces = sizes.iter().cycle().map_while(|size| {
        let length = (*size).min(whole.num_rows() - at);
        at += length;
        (length > 0).then(|| whole.slice(at - length, length))
    });
    texts(&kernel(&["--session", session, "--emit", "summary"], stream_of(&whole, pieces)), "line")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn any_partition_of_the_rows_gives_the_same_digests(
        shuffled in Just(rows()).prop_shuffle(),
        sizes in prop::collection::vec(1_usize..90, 1..6),
        machine in prop::collection::vec(0_usize..3, 3),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let channels = "[[channel]]\nname = \"v\"\nmethod = \"hampel\"\n\n[[channel]]\nname = \"w\"\nmethod = \"two-sided\"\n";
        let path = session(folder.path(), "time = \"t\"\ntrack = \"pass\"", channels);
        let session = path.to_str().unwrap();
        let expected = lines(session, rows(), &[65_536]);
        prop_assert_eq!(expected.len(), 6);
        // Each machine has some of the tracks.
        let mut found = Vec::new();
        for one in 0..3 {
            let own: Vec<Row> = shuffled.iter().filter(|row| machine[row.track] == one).cloned().collect();
            found.extend(lines(session, own, &sizes));
        }
        prop_assert_eq!(archive_digest(found), archive_digest(expected));
    }
}
