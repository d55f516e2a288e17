//! Columns of every kind under names of every kind: ids, counters, flags, constants, texts, times, truths, markers.

use wildpoint::track::{Aside, ColumnKind, LoadOptions, Rules};

use super::bytes::Bytes;
use super::laws;

const NAMES: [&str; 20] = [
    "time",
    "t_s",
    "Date",
    "Time",
    "id",
    "svid",
    "hex",
    "flag",
    "x_flag",
    "truth",
    "x_truth_outlier",
    "quality",
    "#",
    "RECORD",
    "year",
    "alt (m)",
    "x",
    "",
    "T",
    "week",
];

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (width, rows) = (1 + bytes.below(8), 4 + bytes.below(60));
    let rules = [Rules::Second, Rules::Second, Rules::First][bytes.below(3)];
    let names: Vec<&str> = (0..width).map(|_| NAMES[bytes.below(NAMES.len())]).collect();
    let kinds: Vec<u8> = (0..width).map(|_| bytes.byte()).collect();
    let noise: Vec<u8> = bytes.0.to_vec();
    let cell = |row: usize, kind: u8| {
        let odd = noise.get(row * 7 % noise.len().max(1)).copied().unwrap_or(0);
        let n = row + usize::from(kind >> 4);
        match kind % 16 {
            0 => n.to_string(),
            1 => format!("{}.{}", n, odd % 10),
            2 => (odd % 2).to_string(),
            3 => (n % 3).to_string(),
            4 => "7".to_owned(),
            5 => ["A", "B", "1"][usize::from(odd) % 3].to_owned(),
            6 => format!("2021-03-{:02} 10:{:02}", 1 + row / 60 % 28, row % 60),
            7 => format!("{:02}:{:02}:{:02}", row / 3600, row / 60 % 60, row % 60),
            8 => ["TRUE", "FALSE"][usize::from(odd) % 2].to_owned(),
            9 => {
                if odd.is_multiple_of(3) {
                    "M".to_owned()
                } else {
                    format!("{}.5", odd)
                }
            }
            10 => String::new(),
            11 => (1_614_852_000_u64 + 5 * (row / 2) as u64).to_string(),
            12 => {
                if row < rows / 2 {
                    "-".to_owned()
                } else {
                    odd.to_string()
                }
            }
            13 => (200 - row.min(200)).to_string(),
            14 => format!("{odd} kt"),
            _ => "-9999".to_owned(),
        }
    };
    let mut text = names.join(",") + "\n";
    for row in 0..rows {
        let cells: Vec<String> = kinds.iter().map(|kind| cell(row, *kind)).collect();
        text += &(cells.join(",") + "\n");
    }
    let options = LoadOptions { rules, ..LoadOptions::default() };
    let Some(track) = laws::loaded(text.as_bytes(), &options) else { return };
    let aside = |kind| matches!(kind, ColumnKind::Aside(_));
    assert!(
        rules == Rules::Second || !track.columns.iter().any(|c| aside(c.kind)),
        "the first rules leave nothing aside"
    );
    let constants = |c: &&wildpoint::track::Column| c.kind == ColumnKind::Aside(Aside::Constant);
    assert!(track.columns.iter().filter(constants).count() < track.columns.len());
    let tracks = track.columns.iter().filter(|c| c.kind == ColumnKind::Track).count();
    assert!(tracks <= 1, "one column tells tracks apart");
    assert_eq!(tracks == 1, track.channels.iter().any(|c| c.target.is_some()), "tracks have channels of their own");
}
