//! Reports: what is in them, that they are safe to open, and that they keep their word about the same result again.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use program::Folder;
use sha2::{Digest, Sha256};

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|b| format!("{b:02x}")).collect()
}

/// What stands between two texts, the first time.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    text.split_once(from).and_then(|(_, rest)| rest.split_once(to)).map(|(inside, _)| inside).unwrap()
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
    // Each row that the flags have but for unchecked ones, in the table of its channel and with its time.
    let tables: Vec<&str> = html.split("<h3>Flags and decisions</h3>").skip(1).collect();
    assert_eq!(tables.len(), 2);
    let mut seen = 0;
    for line in flags.lines().skip(1).filter(|l| !l.contains(",unchecked,")) {
        let cells: Vec<&str> = line.split(',').collect();
        let table = between(tables[usize::from(cells[2] == "alt_m")], "<tbody>", "</tbody>");
        let wanted = format!("<td class=\"n\">{}</td><td class=\"n\">{}</td>", cells[0], cells[1]);
        assert!(table.contains(&wanted), "{line}");
        seen += 1;
    }
    assert_eq!(tables.iter().map(|t| between(t, "<tbody>", "</tbody>").matches("<tr>").count()).sum::<usize>(), seen);
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
    assert_eq!(pictures, 2 * (3 + 6), "overview, trace, residual and six from near for each channel");
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
    assert!(html.contains(&format!("The first 200 of {all} are listed; the other {} ", all - 200)));
    let table = html.split("<h3>Flags and decisions</h3>").nth(1).unwrap();
    assert_eq!(between(table, "<tbody>", "</tbody>").matches("<tr>").count(), 200);
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
        ("clean demo.csv -o new.csv --report report.pdf", "report.pdf: the ending does not say"),
        ("clean demo.csv -o new.csv --report report", "a report ends in .html"),
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
    // Three results, each with its record, its flags and its residual.
    assert_eq!((page.matches("<h2>[004]</h2>").count(), page.matches("<figure>").count()), (1, 9));
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
