//! The reproduced experiments as one HTML file, a page for each document: its figures from our runs, its tables beside
//! ours, and its statements with what became of them. It is made of the same tables and statements as the text.

use std::fmt::Write as _;

use super::html::{POLICY, STYLE, escaped, labelled, legend};
use super::page::numbered;
use super::svg::{self, CURVES};
use crate::experiment::{Cell, Chart, Finding, Held, Reproduction, Shown, Table};

/// An experiment with the pictures of one of its runs.
#[derive(Debug)]
pub struct Reproduced {
    /// Tables, statements and curves.
    pub result: Reproduction,
    /// What its document's figures show.
    pub shown: Vec<Shown>,
}

/// The page.
#[must_use]
pub fn reproduced_html(experiments: &[Reproduced]) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>wildpoint: the documents and what comes out</title>\n<style>\n{STYLE}{}</style>\n</head>\n<body>\n<main>\n\
         <h1>The documents and what comes out</h1>\n<p class=\"outcome\">{}</p>\n",
        include_str!("html/reproduction.css"),
        escaped(&counted(experiments.iter().flat_map(|e| &e.result.findings)))
    );
    let mut document = "";
    for experiment in experiments {
        let of = document_of(experiment.result.source);
        if of != document {
            if !document.is_empty() {
                out.push_str("</section>\n");
            }
            let all = experiments.iter().filter(|e| document_of(e.result.source) == of);
            let counts = counted(all.flat_map(|e| &e.result.findings));
            let cited: String = numbered(of).map(|(_, document)| document).collect();
            let _ = writeln!(
                out,
                "<section class=\"document\">\n<h2>{}</h2>\n<p class=\"advice\">{}</p>\n<p>{}</p>",
                escaped(of),
                escaped(&cited),
                escaped(&counts)
            );
            document = of;
        }
        section(experiment, &mut out);
    }
    if !document.is_empty() {
        out.push_str("</section>\n");
    }
    out.push_str("</main>\n</body>\n</html>\n");
    out
}

/// The number of the document in a source: `[000]`.
fn document_of(source: &str) -> &str {
    source.split(' ').next().unwrap_or(source)
}

/// How many statements hold.
fn counted<'a>(findings: impl Iterator<Item = &'a Finding>) -> String {
    let (mut all, mut counts) = (0, [0; 3]);
    for finding in findings {
        all += 1;
        counts[finding.held as usize] += 1;
    }
    let [yes, no, untold] = counts;
    format!("{all} statements: {yes} hold here, {no} do not, {untold} cannot be told")
}

fn section(experiment: &Reproduced, out: &mut String) {
    let result = &experiment.result;
    let runs = if result.runs == 1 { "1 run".to_owned() } else { format!("{} runs", result.runs) };
    let _ = writeln!(
        out,
        "<h2>{}: {}</h2>\n<p>{}; {runs} from seed {}.</p>\n<p>{}</p>",
        escaped(result.id),
        escaped(result.source),
        escaped(result.help),
        result.seed,
        escaped(result.stand_in)
    );
    out.push_str("<h3>Statements</h3>\n");
    findings(&result.findings, out);
    for of in &result.tables {
        let _ = writeln!(out, "<h3>{}</h3>", escaped(&of.title));
        table(of, out);
    }
    result.charts.iter().for_each(|of| chart(of, out));
    if experiment.shown.is_empty() {
        return;
    }
    let _ = writeln!(out, "<h3>Figures, from the run with seed {}</h3>", result.seed);
    legend(experiment.shown.iter().any(|shown| shown.filtered.is_some()), out);
    experiment.shown.iter().for_each(|one| pictures(one, out));
}

fn findings(findings: &[Finding], out: &mut String) {
    out.push_str(
        "<div class=\"table\"><table>\n<thead><tr><th></th><th>the document</th><th>here</th></tr></thead>\n<tbody>\n",
    );
    for finding in findings {
        let class = match finding.held {
            Held::Yes => "holds",
            Held::No => "not",
            Held::CannotTell => "untold",
        };
        let fitted = if finding.fitted { ". <b>The stand-in was fitted to this.</b>" } else { "" };
        let _ = writeln!(
            out,
            "<tr><td class=\"wide {class}\">{}</td><td>{}</td><td>{}{fitted}</td></tr>",
            finding.held.word(),
            escaped(finding.statement),
            escaped(&finding.measured)
        );
    }
    out.push_str("</tbody>\n</table></div>\n");
}

fn table(table: &Table, out: &mut String) {
    let is_text = |c: usize| table.rows.iter().any(|r| matches!(r.get(c), Some(Cell::Text(_))));
    let class = |c: usize| if is_text(c) { "" } else { " class=\"n\"" };
    out.push_str("<div class=\"table\"><table>\n<thead><tr>");
    for (c, name) in table.columns.iter().enumerate() {
        let _ = write!(out, "<th{}>{}</th>", class(c), escaped(name));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        out.push_str("<tr>");
        for (c, cell) in row.iter().enumerate() {
            let _ = write!(out, "<td{}>{}</td>", class(c), escaped(&cell.shown()));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table></div>\n");
}

fn chart(chart: &Chart, out: &mut String) {
    let Some(figure) = svg::chart(chart) else { return };
    out.push_str("<p class=\"legend\">");
    for (curve, class) in chart.curves.iter().zip(CURVES.iter().cycle()) {
        let _ = write!(out, "<span><i class=\"{class}\">—</i> {}</span> ", escaped(curve.name));
    }
    out.push_str("</p>\n");
    figure_of(&figure.svg, &figure.caption, out);
}

/// Record, flags with their repair, and residual.
fn pictures(shown: &Shown, out: &mut String) {
    let _ = writeln!(out, "<h3>{}</h3>", escaped(shown.title));
    let Some(channel) = shown.track.channels.first() else { return };
    let series = shown.samples.series(channel, &shown.track.time);
    let pictures = svg::figures(&shown.track, channel, series, &shown.outcome, shown.filtered.as_ref());
    pictures
        .figures
        .iter()
        .filter(|figure| !figure.small)
        .for_each(|figure| figure_of(&figure.svg, &figure.caption, out));
}

fn figure_of(svg: &str, caption: &str, out: &mut String) {
    let _ = writeln!(out, "<figure>{}<figcaption>{}</figcaption></figure>", labelled(svg, caption), escaped(caption));
}
