//! Records in other layouts than that of the demonstration, repaired where the right value is known: on a straight
//! line, every repair must come out on the line.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use std::io::{Read, Write};

use program::Folder;
use wildpoint::repair::REPAIRS;

/// Rows of the small record.
const ROWS: usize = 60;
/// Row (from 0) of its wild point.
const WILD: usize = 30;
/// Row (from 0) of its empty cell, in the records that have one.
const EMPTY: usize = 40;

/// How the small record is written.
#[derive(Clone, Copy)]
struct Layout {
    delimiter: &'static str,
    decimal: &'static str,
    quote: &'static str,
    end: &'static str,
}

const PLAIN: Layout = Layout { delimiter: ",", decimal: ".", quote: "", end: "\n" };

impl Layout {
    /// A line of slope 1/2 with other texts in two cells.
    fn record(self, wild: &str, empty: Option<&str>) -> String {
        let Self { delimiter, decimal, quote, end } = self;
        let cell = |text: &str| format!("{quote}{}{quote}", text.replace('.', decimal));
        let row = |i: usize| {
            let y = match i {
                WILD => wild.to_owned(),
                EMPTY if empty.is_some() => empty.unwrap_or_default().to_owned(),
                _ => format!("{:.2}", i as f64 / 2.0),
            };
            [cell(&format!("{i}.0")), cell(&y), "\"a, b; c\"".to_owned()].join(delimiter) + end
        };
        let header = ["t_s", "y_m", "remark"].join(delimiter) + end;
        (0..ROWS).fold(header, |text, i| text + &row(i))
    }
}

#[test]
fn the_repaired_cell_is_written_in_the_form_of_the_file() {
    let layouts = [
        PLAIN,
        Layout { end: "\r\n", ..PLAIN },
        Layout { quote: "\"", ..PLAIN },
        Layout { delimiter: ";", decimal: ",", ..PLAIN },
        Layout { delimiter: ";", decimal: ",", quote: "\"", end: "\r\n" },
        Layout { delimiter: "\t", ..PLAIN },
        Layout { delimiter: "|", end: "\r\n", ..PLAIN },
    ];
    for layout in layouts {
        let input = layout.record("99.5", None);
        let folder = Folder::with(&[("in.csv", input.as_bytes())]);
        folder.done("clean in.csv --method hampel --repair linear -o out.csv");
        // Between 14.50 and 15.50.
        assert_eq!(folder.text("out.csv"), layout.record("15.00", None), "{input}");
        assert_eq!(folder.names(), ["in.csv", "out.csv"]);
    }
}

#[test]
fn a_packed_record_is_read_and_a_packed_output_is_written() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    packed.write_all(PLAIN.record("99.5", None).as_bytes()).unwrap();
    let folder = Folder::with(&[("in.csv.gz", &packed.finish().unwrap())]);
    folder.done("clean in.csv.gz --method hampel --repair linear -o out.csv.gz");
    folder.done("clean in.csv.gz --method hampel --repair linear -o out.csv");
    let mut unpacked = String::new();
    flate2::read::MultiGzDecoder::new(std::fs::File::open(folder.path("out.csv.gz")).unwrap())
        .read_to_string(&mut unpacked)
        .unwrap();
    assert_eq!(unpacked, PLAIN.record("15.00", None));
    assert_eq!(folder.text("out.csv"), PLAIN.record("15.00", None));
}

#[test]
fn every_repair_of_a_straight_line_is_on_the_line() {
    let folder = Folder::with(&[("in.csv", PLAIN.record("99.5", None).as_bytes())]);
    for repair in REPAIRS {
        let (id, out) = (repair.id, format!("{}.csv", repair.id));
        folder.done(&format!("clean in.csv --method hampel --repair {id} -o {out}"));
        let text = folder.text(&out);
        let cell = text.lines().nth(WILD + 1).and_then(|line| line.split(',').nth(1)).unwrap();
        if id == "remove" {
            assert_eq!(cell, "");
        } else {
            let value: f64 = cell.parse().unwrap();
            assert!((value - 15.0).abs() < 1e-9, "{id}: {value}");
        }
        assert_eq!(text, PLAIN.record(cell, None), "{id}: only this cell differs");
    }
}

#[test]
fn an_empty_cell_is_filled_only_when_asked() {
    let folder = Folder::with(&[("in.csv", PLAIN.record("15.00", Some("")).as_bytes())]);
    folder.done("clean in.csv --method hampel --repair linear -o off.csv");
    folder.done("clean in.csv --method hampel --repair linear --fill-gaps cells -o cells.csv --flags flags.csv");
    assert_eq!(folder.text("off.csv"), folder.text("in.csv"));
    assert_eq!(folder.text("cells.csv"), PLAIN.record("15.00", Some("20.00")));
    // A filled cell is no flag: the table of flags has samples only.
    assert!(!folder.text("flags.csv").contains("\n41,"), "{}", folder.text("flags.csv"));
}

/// The times of a cleaned demonstration record.
fn times(text: &str) -> Vec<f64> {
    text.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect()
}

#[test]
fn lost_samples_get_rows_inside_segments_and_gaps_stay_boundaries() {
    let folder = Folder::with_demo();
    let rows = |name: &str, words: &str| {
        folder.done(&format!("clean demo.csv --fill-gaps rows -o {name} {words}"));
        times(&folder.text(name))
    };
    // 2400 seconds of which 44 were lost, 21 of them in a row from 1240 s on: with max_gap 5 the record is cut there.
    let five = rows("five.csv", "");
    let expected: Vec<f64> = (0..2400).map(f64::from).filter(|t| !(1240.0..1261.0).contains(t)).collect();
    assert_eq!(five, expected);
    // Never cut: every second has its row. Always cut: none is added.
    assert_eq!(rows("off.csv", "--max-gap off"), (0..2400).map(f64::from).collect::<Vec<_>>());
    assert_eq!(rows("0.csv", "--max-gap 0"), times(&folder.text("demo.csv")));
    // Cells cannot be filled where there are no rows.
    folder.done("clean demo.csv --repair linear --fill-gaps cells -o cells.csv");
    assert_eq!(times(&folder.text("cells.csv")), times(&folder.text("demo.csv")));
}

#[test]
fn what_the_loader_was_told_is_kept_in_the_session() {
    let mut bytes = b"t,H\xf6he\n".to_vec();
    for i in 0..ROWS {
        let y = if i == WILD { 900.0 } else { i as f64 / 2.0 };
        writeln!(bytes, "{},{y:.2}", i * 20).unwrap();
    }
    let folder = Folder::with(&[("r.csv", &bytes)]);
    let inspected = folder.done("inspect r.csv --time-unit ms");
    assert!(inspected.contains("1.18 s"), "59 steps of 20 ms: {inspected}");
    let loading = "--time-unit ms --encoding latin-1";
    folder.done(&format!("clean r.csv {loading} -o c.csv --save-session s.toml"));
    let session = folder.text("s.toml");
    assert!(session.contains("time_unit = \"ms\"\n") && session.contains("encoding = \"latin-1\"\n"), "{session}");
    assert!(session.contains("name = \"Höhe\""), "{session}");
    folder.done("replay s.toml --check");
    // Another unit, or none that there is.
    std::fs::write(folder.path("bad.toml"), session.replace("\"ms\"", "\"weeks\"")).unwrap();
    let ran = folder.run("replay bad.toml --check");
    let line = 1 + session.lines().position(|l| l.starts_with("time_unit")).unwrap();
    assert_eq!(ran.status, 2);
    assert!(
        ran.err.contains(&format!("bad.toml:{line}: ")) && ran.err.contains("ns, us, ms, s, min, h, d"),
        "{}",
        ran.err
    );
    let ran = folder.run("inspect r.csv --encoding utf-8");
    assert!(ran.status == 2 && ran.err.contains("r.csv:1: a byte that is not UTF-8"), "{}", ran.err);
}
