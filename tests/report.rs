//! Reports: what is in them, that they are safe to open, and that what they say about reproducing the result is true.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use program::Folder;
use sha2::{Digest, Sha256};

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|b| format!("{b:02x}")).collect()
}

/// The text between two others, the first time.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    text.split_once(from).and_then(|(_, rest)| rest.split_once(to)).map(|(inside, _)| inside).unwrap()
}

/// The rows that a table of flags lists, those of runs one by one.
fn rows_of(table: &str) -> Vec<usize> {
    let cells = table.split("data-name=\"row\">").skip(1).map(|cell| cell.split('<').next().unwrap());
    let ends = cells.map(|cell| cell.split_once(" to ").unwrap_or((cell, cell)));
    ends.flat_map(|(from, to)| from.parse::<usize>().unwrap()..=to.parse().unwrap()).collect()
}

fn unescaped(html: &str) -> String {
    let entities = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    entities.iter().fold(html.to_owned(), |text, (entity, c)| text.replace(entity, c))
}

#[test]
fn a_report_says_what_the_tables_say() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -o clean.csv --flags flags.csv --report report.html --save-session s.toml -q");
    let (html, flags) = (folder.text("report.html"), folder.text("flags.csv"));
    assert!(html.contains(&sha256(&folder.text("demo.csv"))) && html.contains(&sha256(&folder.text("clean.csv"))));
    assert!(html.contains(concat!("wildpoint ", env!("CARGO_PKG_VERSION"))));
    // Each row that the flags have but for unchecked ones, in the table of its channel, by itself or in a run.
    let tables: Vec<&str> = html.split("<h3>Flags and decisions</h3>").skip(1).collect();
    assert_eq!(tables.len(), 2);
    let listed: Vec<Vec<usize>> = tables.iter().map(|table| rows_of(between(table, "<tbody>", "</tbody>"))).collect();
    let mut seen = [Vec::new(), Vec::new()];
    for line in flags.lines().skip(1).filter(|l| !l.contains(",unchecked,")) {
        let cells: Vec<&str> = line.split(',').collect();
        seen[usize::from(cells[2] == "alt_m")].push(cells[0].parse::<usize>().unwrap());
    }
    assert!(seen[0].len() > 70 && listed == seen, "{listed:?}");
    assert!(html.contains("<p class=\"byline\">2026-01-01</p>"), "the day of the environment, and nobody's name");
    // Nothing is fetched and nothing runs.
    assert!(html.contains("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src"));
    for outside in ["<script", "src=", "href=", "@import", "url("] {
        assert!(!html.contains(outside), "{outside}");
    }
    // The same result makes the same bytes, from the session too.
    folder.done("clean demo.csv --report again.html -q");
    assert!(folder.text("again.html") == html);
    folder.done("replay s.toml --report replayed.html -q");
    assert!(folder.text("replayed.html") == html);
}

#[test]
fn the_command_of_a_report_gives_the_result_of_the_report() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --method hampel --set k=5 --channel alt_m --max-fill 3 --report report.html -q");
    let html = folder.text("report.html");
    let command = unescaped(between(&html, "<pre class=\"command\">", "</pre>"));
    let words = command.strip_prefix("wildpoint ").unwrap();
    assert!(words.contains("--set k=5.0") && words.contains("--channel alt_m"), "{words}");
    folder.done(words);
    assert!(html.contains(&sha256(&folder.text("cleaned.csv"))));
}

#[test]
fn the_session_in_a_report_gives_the_result_of_the_report() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --channel vx_mps --save-session s.toml -q");
    let decided = folder.text("s.toml").replacen(
        "repair = ",
        "decisions = [{ row = 61, time = \"61.0\", value = \"135.93\", verdict = \"normal\", note = \"a <b>glint</b>\" }]\nrepair = ",
        1,
    );
    std::fs::write(folder.path("s.toml"), decided).unwrap();
    std::fs::create_dir(folder.path("out")).unwrap();
    folder.done("replay s.toml --report out/report.html -q");
    let html = folder.text("out/report.html");
    assert!(html.contains("a &lt;b&gt;glint&lt;/b&gt;") && !html.contains("<b>glint"));
    assert!(between(&html, "<pre class=\"command\">", "</pre>").starts_with("wildpoint replay session.toml"));
    let session = unescaped(between(&html, "</summary>\n<pre>", "</pre>"));
    std::fs::write(folder.path("out/session.toml"), session).unwrap();
    folder.done("replay out/session.toml -o cleaned.csv -q");
    assert!(html.contains(&sha256(&folder.text("cleaned.csv"))));
}

#[test]
fn hostile_names_and_cells_stay_text() {
    let header = "t,\"<script>alert(1)</script>\",\"a|b `x` \u{202e}![i](http://e.x)\"\n";
    let rows: String = (0..60).map(|i| format!("{i},{},{}\n", if i == 30 { 900 } else { i }, i % 7)).collect();
    let folder = Folder::with(&[("a&b<i>.csv", (header.to_owned() + &rows).as_bytes())]);
    folder.done("clean a&b<i>.csv --report r.html -q");
    folder.done("clean a&b<i>.csv --report r.md -q");
    let html = folder.text("r.html");
    assert!(!html.contains("<script") && !html.contains("<i>.csv") && !html.contains('\u{202e}'));
    assert!(html.contains("&lt;script&gt;alert(1)&lt;/script&gt;") && html.contains("a&amp;b&lt;i&gt;.csv"));
    let markdown = folder.text("r.md");
    assert!(!markdown.contains('\u{202e}'));
    // Outside of the fences, where it is text anyhow.
    let prose = markdown.split("```").next().unwrap();
    assert!(!prose.contains("<script") && !prose.contains("![i]"), "{prose}");
    assert!(prose.lines().filter(|l| l.starts_with("| a\\|b")).count() == 1, "a bar in a name parts no cells: {prose}");
}

#[test]
fn a_markdown_report_carries_its_pictures() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --report report.md -q");
    let markdown = folder.text("report.md");
    let pictures = markdown.matches("](data:image/svg+xml;base64,").count();
    assert_eq!(
        pictures,
        2 * (5 + 12),
        "overview, trace, two residuals, histogram and twelve close-ups for each channel"
    );
    assert!(markdown.starts_with("# demo.csv\n") && markdown.contains("## vx\\_mps \\[m/s\\]\n"));
}

#[test]
fn long_tables_are_cut_and_say_so() {
    // Every fourth sample is wild: more than a table lists.
    let rows: String = (0..2000).map(|i| format!("{i},{}\n", if i % 6 == 3 { 500 + i } else { i % 3 })).collect();
    let folder = Folder::with(&[("many.csv", ("t,y\n".to_owned() + &rows).as_bytes())]);
    folder.done("clean many.csv --method hampel --flags flags.csv --report r.html -q");
    let all = folder.text("flags.csv").lines().skip(1).filter(|l| !l.contains(",unchecked,")).count();
    assert!(all > 300, "{all}");
    let html = folder.text("r.html");
    let table = html.split("<h3>Flags and decisions</h3>").nth(1).unwrap();
    let body = between(table, "<tbody>", "</tbody>");
    let listed = rows_of(body).len();
    assert!(body.matches("<tr>").count() == 200 && listed >= 200);
    let cut = format!(
        "The first {listed} of {all} flags and decisions are listed; the other {} are in flags.csv.",
        all - listed
    );
    assert!(html.contains(&cut), "{cut}");
    assert!(html.contains("<a href=\"./flags.csv\">flags.csv</a>"), "the file beside is a link");
    folder.done("clean many.csv --method hampel --report alone.html -q");
    assert!(folder.text("alone.html").contains("not listed; `--flags FILE` writes all of them"));
}

#[test]
fn several_records_have_a_report_each() {
    let demo = include_bytes!("../data/demo.csv");
    let folder = Folder::with(&[("a.csv", demo), ("b.csv", demo)]);
    folder.done("clean a.csv b.csv --report reports/ -q");
    assert!(folder.text("reports/a.html").contains("<h1>a.csv</h1>"));
    assert!(folder.text("reports/b.html").contains("<h1>b.csv</h1>"));
}

#[test]
fn a_report_that_cannot_be_written_leaves_nothing() {
    let folder = Folder::with_demo();
    std::fs::write(folder.path("there.html"), "kept").unwrap();
    let before = folder.names();
    for (words, says) in [
        ("clean demo.csv -o new.csv --report report.pdf", "report.pdf: unknown report format"),
        ("clean demo.csv -o new.csv --report report", "ends in .html"),
        ("clean demo.csv -o new.csv --report there.html", "there.html: already exists"),
        ("clean demo.csv -o new.csv --report gone/r.html", "gone"),
        ("clean demo.csv -o same.html --report same.html", "two outputs would be this file"),
    ] {
        let ran = folder.run(words);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{words}");
        assert!(ran.err.contains(says), "{words}: {}", ran.err);
        assert_eq!(folder.names(), before, "{words} left a file");
    }
    assert_eq!(folder.text("there.html"), "kept");
    folder.done("clean demo.csv --report there.html --force -q");
    assert!(folder.text("there.html").starts_with("<!DOCTYPE html>"));
}

/// A record with runs, and a session with notes on a flag and on a suspect.
fn with_notes() -> Folder {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --channel vx_mps --save-session s.toml -q");
    let decided = "decisions = [{ row = 61, time = \"61.0\", value = \"135.93\", verdict = \"outlier\", note = \"a glint, seen by \
                   both radars and confirmed by telephone with the site\", by = \"A. Kim\", at = \"2026-01-02T03:04:05Z\" }, { row = 91, time = \"91.0\", value = \"55.21\", \
                   verdict = \"normal\", note = \"staging\" }]\nrepair = ";
    std::fs::write(folder.path("s.toml"), folder.text("s.toml").replacen("repair = ", decided, 1)).unwrap();
    folder
}

#[test]
fn notes_are_below_their_rows_and_reports_are_signed() {
    let folder = with_notes();
    folder.done("replay s.toml --report r.html --analyst M.Ito -q");
    let html = folder.text("r.html");
    assert!(html.contains("<p class=\"byline\">2026-01-01, M.Ito</p>"));
    for note in ["a glint, seen by both radars and confirmed by telephone with the site", "staging"] {
        assert!(html.contains(&format!("<td colspan=\"10\">note: {note}</td>")), "{note}");
    }
    // Who decided is not who makes the report.
    for who in ["A. Kim, 2026-01-02 03:04 UTC", "analyst"] {
        assert!(html.contains(&format!("<td data-name=\"decided by\">{who}</td>")), "{who}");
    }
    folder.done("replay s.toml --report r.md --analyst M.Ito -q");
    let markdown = folder.text("r.md");
    assert!(markdown.contains("2026-01-01, M.Ito") && markdown.contains("; note: staging |"));
    // The configuration signs where the command line does not.
    std::fs::create_dir(folder.path("wildpoint")).unwrap();
    std::fs::write(folder.path("wildpoint/config.toml"), "analyst = \"K. Sato\"").unwrap();
    folder.done("replay s.toml --report c.html -q");
    assert!(folder.text("c.html").contains("2026-01-01, K. Sato"));
}

#[test]
fn both_forms_have_the_same_content() {
    let folder = with_notes();
    folder.done("replay s.toml --report r.html -q");
    folder.done("replay s.toml --report r.md -q");
    let (html, markdown) = (unescaped(&folder.text("r.html")), folder.text("r.md").replace('\\', ""));
    for text in [
        "References",
        "How to reproduce",
        "Largest flags, close up",
        "Histogram of the residual",
        "Residual after repair",
        "Jiang Dazhi",
        "Settings that matter",
        "Flags and decisions",
        "Recorded tracks with isolated outliers",
        "SHA-256 of the record",
    ] {
        assert!(html.contains(text) && markdown.contains(text), "{text}");
    }
    assert_eq!(html.matches("<svg xmlns").count(), markdown.matches("](data:image/svg+xml").count());
}

#[test]
fn a_fill_value_does_not_set_the_scale_of_a_picture() {
    let rows: String =
        (0..400).map(|i| format!("{i},{}\n", if i % 40 == 20 { -9999.0 } else { 20.0 + f64::from(i % 7) })).collect();
    let folder = Folder::with(&[("t.csv", ("t,y\n".to_owned() + &rows).as_bytes())]);
    folder.done("clean t.csv --report r.html -q");
    let html = folder.text("r.html");
    assert!(
        !html.contains(">-10,000<") && !html.contains(">-5000<") && !html.contains(">-10000<"),
        "an axis reaches the fill value"
    );
    assert!(html.contains("arrows at the edge"));
}

/// Whether a program is there.
fn is_there(program: &str) -> bool {
    std::process::Command::new(program).arg("--version").output().is_ok_and(|out| out.status.success())
        || std::process::Command::new(program).arg("-v").output().is_ok_and(|out| out.status.success())
}

/// Needs headless Chromium and poppler; see `docs/testing.md`.
#[test]
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn printed_nothing_is_cut() {
    if !is_there("chromium") || !is_there("pdftotext") {
        eprintln!("skipped: chromium or pdftotext is not there");
        return;
    }
    let folder = with_notes();
    folder.done("replay s.toml --report r.html --analyst M.Ito -q");
    let page = format!("file://{}", folder.path("r.html").display());
    let pdf = format!("--print-to-pdf={}", folder.path("r.pdf").display());
    let printed = std::process::Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer", &pdf, &page])
        .output()
        .unwrap();
    assert!(printed.status.success(), "{}", String::from_utf8_lossy(&printed.stderr));
    let text = std::process::Command::new("pdftotext")
        .args(["-raw", "r.pdf", "-"])
        .current_dir(folder.path(""))
        .output()
        .unwrap();
    // Lines are broken anywhere: blanks do not count.
    let plain = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    let text = plain(&String::from_utf8_lossy(&text.stdout));
    let html = folder.text("r.html");
    let session = unescaped(between(&html, "</summary>\n<pre>", "</pre>"));
    let sha = session.lines().find(|line| line.starts_with("clean_sha256")).unwrap();
    for wanted in ["confirmed by telephone with the site", "note: staging", "M.Ito", "decided by", sha, "Jiang Dazhi"] {
        assert!(text.contains(&plain(wanted)), "{wanted} is cut");
    }
}

#[test]
fn a_reproduction_is_drawn_as_a_page_for_each_document() {
    let folder = Folder::with(&[]);
    let text = folder.done("reproduce gan --runs 2 --report gan.html");
    let page = folder.text("gan.html");
    // Every statement of the text is a row of the page, with the same word.
    let words = ["holds", "does not", "cannot be told"];
    let told = |word: &&str| text.lines().filter(|l| l.starts_with(&format!("  {word:14}  "))).count();
    let drawn = |word: &&str| page.matches(&format!("\">{word}</td>")).count();
    assert_eq!(words.iter().map(told).collect::<Vec<_>>(), words.iter().map(drawn).collect::<Vec<_>>());
    assert!(words.iter().map(told).sum::<usize>() >= 6, "{text}");
    // Three results, each with its record, its flags, its residual before and after the repair, and a histogram.
    assert_eq!((page.matches("<h2>[004]</h2>").count(), page.matches("<figure>").count()), (1, 15));
    assert!(!page.contains("<script") && !page.contains(" src="), "nothing runs, nothing is fetched");
    let curves = folder.done("reproduce qin --runs 2 --json --report qin.html");
    assert!(curves.starts_with('[') && folder.text("qin.html").matches("class=\"curve ").count() == 24);
}

#[test]
fn a_report_of_a_reproduction_is_refused_before_the_runs() {
    let folder = Folder::with(&[("there.html", b"mine")]);
    let refused = |words: &str| folder.run(&format!("reproduce gan --runs 2 {words}"));
    let exists = refused("--report there.html");
    assert_eq!((exists.status, exists.out.as_str(), folder.text("there.html").as_str()), (2, "", "mine"));
    let ending = refused("--report page.pdf");
    assert!(ending.status == 2 && ending.err.contains(".html"), "{}", ending.err);
    assert_eq!(refused("--report there.html --force").status, 0);
    assert_eq!(folder.names(), ["there.html"]);
}
