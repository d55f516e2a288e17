//! What goes out beside the audit table: columns of flags in the cleaned file, and the changed cells alone.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other tests use all of it")]
mod program;

use program::Folder;

/// Rows of the small record, on a straight line but for one wild point.
const ROWS: usize = 60;
/// Row (from 0) of the wild point.
const WILD: usize = 30;
/// Row (from 0) of the empty cell.
const EMPTY: usize = 40;
/// How it is judged.
const JUDGED: &str = "--method hampel --repair linear";

/// How the small record is written.
struct Layout {
    above: &'static str,
    delimiter: &'static str,
    decimal: &'static str,
    end: &'static str,
    /// A line that comes again among the rows.
    between: &'static str,
    /// What stands at the end of each row.
    tail: &'static str,
}

const PLAIN: Layout = Layout { above: "t_s,y_m,who\n", delimiter: ",", decimal: ".", end: "\n", between: "", tail: "" };

impl Layout {
    /// `y` is half the time.
    fn record(&self) -> String {
        let mut text = self.above.to_owned();
        for i in 0..ROWS {
            let y = match i {
                WILD => "99.50".to_owned(),
                EMPTY => String::new(),
                _ => format!("{:.2}", i as f64 / 2.0),
            };
            let cells = [format!("{i}.0"), if y.is_empty() { self.nothing().into() } else { y }, "a".to_owned()];
            let cells = cells.map(|cell| cell.replace('.', self.decimal));
            text += &(cells.join(self.delimiter) + self.tail + self.end);
            if i == 20 {
                text += self.between;
            }
        }
        text
    }

    fn nothing(&self) -> &'static str {
        if self.delimiter == " " { "NaN" } else { "" }
    }
}

/// The flags of a file whose last column they are, and the file without them.
fn taken_off(text: &str, delimiter: &str, end: &str) -> (Vec<String>, String) {
    let mut flags = Vec::new();
    let mut rest = String::new();
    for line in text.split_inclusive(end) {
        let bare = line.strip_suffix(end).unwrap_or(line);
        let (cells, flag) = bare.rsplit_once(delimiter).unwrap();
        flags.push(flag.to_owned());
        rest += &format!("{cells}{}", &line[bare.len()..]);
    }
    (flags, rest)
}

#[test]
fn the_cleaned_file_has_flags_at_its_right_and_is_otherwise_the_same() {
    let layouts = [
        PLAIN,
        Layout { above: "t_s,y_m,who\r\n", end: "\r\n", ..PLAIN },
        Layout { above: "t_s;y_m;who\n", delimiter: ";", decimal: ",", ..PLAIN },
        Layout { above: "t_s y_m who\n", delimiter: " ", ..PLAIN },
        Layout { between: "t_s,y_m,who\n", ..PLAIN },
    ];
    for layout in layouts {
        let folder = Folder::with(&[("in.csv", layout.record().as_bytes())]);
        folder.done(&format!("clean in.csv {JUDGED} --channel y_m -o plain.csv"));
        for (scheme, [normal, repaired, missing]) in
            [("qartod", ["1", "4", "9"]), ("argo", ["1", "8", "9"]), ("words", ["normal", "repaired", "missing"])]
        {
            folder.done(&format!("clean in.csv {JUDGED} --channel y_m -o out.csv --force --flag-columns {scheme}"));
            let text = folder.text("out.csv");
            let (flags, rest) = taken_off(&text, layout.delimiter, layout.end);
            assert_eq!(rest, folder.text("plain.csv"), "{text}");
            let rows: Vec<&String> = flags.iter().filter(|flag| *flag != "y_m_flag").collect();
            assert_eq!((rows.len(), flags.first().unwrap().as_str()), (ROWS, "y_m_flag"), "{text}");
            for (row, flag) in rows.into_iter().enumerate() {
                let expected = match row {
                    WILD => repaired,
                    EMPTY => missing,
                    _ => normal,
                };
                assert_eq!(flag, expected, "row {row} of\n{text}");
            }
        }
    }
}

#[test]
fn removed_filled_and_unjudged_cells_have_flags_of_their_own() {
    // A row without a time has a value that nobody judges.
    let record = PLAIN.record().replace("\n50.0,", "\nnoon,");
    let folder = Folder::with(&[("in.csv", record.as_bytes())]);
    let flags = |options: &str, scheme: &str| {
        folder.done(&format!(
            "clean in.csv --method hampel --channel y_m {options} -o o.csv --force --flag-columns {scheme}"
        ));
        taken_off(&folder.text("o.csv"), ",", "\n").0
    };
    for (scheme, removed, filled, unjudged) in
        [("qartod", "4", "9", "2"), ("argo", "4", "8", "0"), ("words", "removed", "filled", "unchecked")]
    {
        let found = flags("--repair remove --fill-gaps cells", scheme);
        assert_eq!([&found[1 + WILD], &found[1 + EMPTY], &found[51]], [removed, filled, unjudged], "{scheme}");
    }
    // Rows 10 to 12 are not there: they are made, and filled.
    let lines: Vec<&str> = record.lines().enumerate().filter(|(i, _)| !(11..14).contains(i)).map(|(_, l)| l).collect();
    let shorter = lines.join("\n") + "\n";
    let folder = Folder::with(&[("in.csv", shorter.as_bytes())]);
    folder.done(&format!("clean in.csv {JUDGED} --channel y_m --fill-gaps rows -o o.csv --flag-columns words"));
    let text = folder.text("o.csv");
    assert!(text.contains("\n10.0,5.00,,filled\n11.0,5.50,,filled\n12.0,6.00,,filled\n"), "{text}");
}

#[test]
fn a_name_that_is_taken_gets_a_number_and_nameless_columns_are_told() {
    let taken = PLAIN.record().replace("y_m,who", "y_m,y_m_flag");
    let nameless = PLAIN.record().replace("t_s,y_m,who\n", "");
    let folder = Folder::with(&[("taken.csv", taken.as_bytes()), ("nameless.csv", nameless.as_bytes())]);
    folder.done(&format!("clean taken.csv {JUDGED} --channel y_m -o out.csv --flag-columns words"));
    assert!(folder.text("out.csv").starts_with("t_s,y_m,y_m_flag,y_m_flag_2\n"));
    let told = folder.done(&format!("clean nameless.csv {JUDGED} -o bare.csv --flag-columns qartod"));
    assert!(told.contains("column_2_flag"), "{told}");
    assert!(folder.text("bare.csv").starts_with("0.0,0.00,a,1\n"));
}

#[test]
fn the_tracks_of_a_table_share_a_column_of_flags() {
    let mut text = String::from("t,id,y\n");
    for i in 0..ROWS {
        let y = if i == WILD { 99.5 } else { i as f64 / 2.0 };
        text += &format!("{i},A,{y:.2}\n{i},B,{:.2}\n", 7.0 + i as f64);
    }
    let folder = Folder::with(&[("in.csv", text.as_bytes())]);
    folder.done(&format!("clean in.csv {JUDGED} --track id --channel y@A -o out.csv --flag-columns words"));
    let out = folder.text("out.csv");
    let flags: Vec<&str> = out.lines().map(|l| l.rsplit(',').next().unwrap()).collect();
    assert_eq!((flags[0], flags.len()), ("y_flag", 1 + 2 * ROWS));
    // B is in the table and not judged.
    assert_eq!(
        (flags[1 + 2 * WILD], flags[2 + 2 * WILD], flags[1], flags[2]),
        ("repaired", "unchecked", "normal", "unchecked")
    );
}

#[test]
fn the_changed_cells_alone_say_what_differs() {
    for layout in [PLAIN, Layout { above: "t_s;y_m;who\n", delimiter: ";", decimal: ",", ..PLAIN }] {
        let folder = Folder::with(&[("in.csv", layout.record().as_bytes())]);
        folder.done(&format!("clean in.csv {JUDGED} --fill-gaps cells -o out.csv --changed changed.csv"));
        let (before, after) = (folder.text("in.csv"), folder.text("out.csv"));
        let lines: Vec<(usize, &str, &str)> = before
            .lines()
            .zip(after.lines())
            .enumerate()
            .skip(1)
            .filter(|(_, (a, b))| a != b)
            .map(|(i, (a, b))| (i, a, b))
            .collect();
        let table = folder.text("changed.csv");
        let mut rows = csv::Reader::from_reader(table.as_bytes());
        assert_eq!(rows.headers().unwrap(), vec!["row", "time", "channel", "old", "new", "verdict", "by"]);
        let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
        assert_eq!((rows.len(), lines.len()), (2, 2), "{table}");
        for (row, (line, a, b)) in rows.iter().zip(lines) {
            let cell = |text: &str, n: usize| text.split(layout.delimiter).nth(n).unwrap().to_owned();
            assert_eq!([&row[0], &row[1], &row[2]], [&line.to_string(), &cell(a, 0), "y_m"]);
            assert_eq!([&row[3], &row[4]], [cell(a, 1), cell(b, 1)], "as the files have them");
        }
        assert_eq!([&rows[0][5], &rows[0][6]], ["outlier", "hampel"]);
        assert_eq!([&rows[1][5], &rows[1][6]], ["missing", "fill_gaps"]);
        let printed = folder.run(&format!("clean in.csv {JUDGED} --fill-gaps cells --changed - --quiet"));
        assert_eq!((printed.status, printed.out), (0, table));
    }
}

#[test]
fn rows_that_are_new_stand_in_the_changes_without_a_number() {
    let lines: Vec<String> =
        PLAIN.record().lines().enumerate().filter(|(i, _)| *i != 11).map(|(_, l)| l.to_owned()).collect();
    let folder = Folder::with(&[("in.csv", (lines.join("\n") + "\n").as_bytes())]);
    folder.done(&format!("clean in.csv {JUDGED} --fill-gaps rows --changed changed.csv"));
    let table = folder.text("changed.csv");
    assert!(table.contains("\n,10.0,y_m,,5.00,missing,fill_gaps\n30,30.0,y_m,99.50,"), "{table}");
}

#[test]
fn a_session_replays_with_flags_and_is_no_other_result() {
    let folder = Folder::with(&[("in.csv", PLAIN.record().as_bytes())]);
    let options = "--flag-columns argo --changed";
    folder.done(&format!("clean in.csv {JUDGED} -o a.csv {options} ac.csv --save-session s.toml"));
    let told = folder.done(&format!("replay s.toml -o b.csv {options} bc.csv --json"));
    assert_eq!((folder.text("a.csv"), folder.text("ac.csv")), (folder.text("b.csv"), folder.text("bc.csv")));
    assert!(told.contains("\"differs\": []"), "{told}");
    assert!(!folder.text("s.toml").contains("argo"), "flags are no part of a session");
    folder.done("replay s.toml --check");
}

#[test]
fn many_files_have_theirs_in_folders() {
    let record = PLAIN.record();
    let folder = Folder::with(&[("a.csv", record.as_bytes()), ("b.csv", record.as_bytes())]);
    folder.done(&format!("clean a.csv b.csv {JUDGED} -o out/ --changed out/ --flag-columns qartod"));
    for name in ["a", "b"] {
        assert!(folder.text(&format!("out/{name}.csv")).starts_with("t_s,y_m,who,y_m_flag\n"));
        assert!(folder.text(&format!("out/{name}.changed.csv")).lines().count() == 2);
    }
    let ran = folder.run(&format!("clean a.csv {JUDGED} --flag-columns qartod"));
    assert!(ran.status == 2 && ran.err.contains("--output"), "flags need a file: {}", ran.err);
    let ran = folder.run("clean a.csv -o c.csv --flag-columns best");
    assert!(ran.status == 2 && ran.err.contains("qartod, argo, words"), "{}", ran.err);
}

#[test]
fn records_whose_newest_row_stands_first_are_flagged_at_their_rows() {
    let mut lines: Vec<String> = PLAIN.record().lines().map(str::to_owned).collect();
    lines[1..].reverse();
    let folder = Folder::with(&[("in.csv", (lines.join("\n") + "\n").as_bytes())]);
    folder.done(&format!(
        "clean in.csv {JUDGED} -o out.csv --flag-columns words --changed c.csv --flags f.csv --diagnostics d.csv"
    ));
    let row = ROWS - WILD;
    assert!(folder.text("out.csv").lines().nth(row).unwrap().ends_with(",repaired"));
    assert!(folder.text("c.csv").contains(&format!("\n{row},30.0,y_m,99.50,")));
    assert!(folder.text("f.csv").contains(&format!("\n{row},30.0,y_m,99.5,outlier")), "{}", folder.text("f.csv"));
    let diagnostics = folder.text("d.csv");
    assert!(diagnostics.lines().nth(row).unwrap().contains(",outlier,"), "{diagnostics}");
    assert_eq!(diagnostics.matches(",missing,").count(), 1, "{diagnostics}");
}

#[test]
fn packed_outputs_are_named_after_their_packing() {
    let folder = Folder::with(&[("in.csv", PLAIN.record().as_bytes())]);
    folder.done(&format!("clean in.csv {JUDGED} -o plain.csv"));
    for ending in ["gz", "zst", "xz", "bz2", "zip"] {
        folder.done(&format!("clean in.csv {JUDGED} -o out.csv.{ending}"));
        // Cleaned again without a change, it is the same text.
        folder.done(&format!("clean out.csv.{ending} {JUDGED} -o again_{ending}.csv"));
        assert_eq!(folder.text(&format!("again_{ending}.csv")), folder.text("plain.csv"), "{ending}");
    }
    std::fs::rename(folder.path("out.csv.zip"), folder.path("other.zip")).unwrap();
    folder.done(&format!("clean out.csv.xz other.zip {JUDGED} -o d/ --flags d/"));
    let mut names: Vec<String> =
        folder.path("d").read_dir().unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["other.flags.csv", "other.zip", "out.csv.xz", "out.flags.csv"]);
}
