//! A report as one HTML file: no script, nothing fetched, every text of the record escaped.

use std::fmt::Write as _;

use super::page::{Page, Section, Table};
use super::svg::STATES;
use crate::track::printable;

/// The style of pages and pictures.
pub(super) const STYLE: &str = include_str!("html/style.css");

/// What a browser may do for the page: nothing is fetched and nothing runs, whatever a name in it tries.
pub(super) const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// Text made safe to stand in an element or an attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in printable(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// The page.
pub(super) fn html(page: &Page) -> String {
    let title = escaped(&page.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>wildpoint: {title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>{title}</h1>\n<p class=\"byline\">{}</p>\n<p class=\"outcome\">{}</p>\n",
        escaped(&page.byline),
        escaped(&page.outcome)
    );
    out.push_str("<dl class=\"facts\">\n");
    for (name, value) in &page.facts {
        let _ = writeln!(out, "<dt>{name}</dt><dd>{}</dd>", escaped(value));
    }
    out.push_str("</dl>\n");
    notes(&page.notes, &mut out);
    out.push_str("<h2>Columns</h2>\n");
    table(&page.columns, &mut out);
    for section in &page.channels {
        channel(section, &mut out);
    }
    references(&page.references, &mut out);
    out.push_str("<h2>How to reproduce</h2>\n");
    let _ = writeln!(out, "<pre class=\"command\">{}</pre>", escaped(&page.command));
    let _ = writeln!(out, "<p>{}</p>", escaped(&page.command_note));
    match &page.session {
        Some(session) => {
            // Open, so that it is printed too.
            out.push_str("<details open><summary>The session file</summary>\n<pre>");
            // Line by line: the ends of lines are to stay what they are.
            session.lines().for_each(|line| {
                let _ = writeln!(out, "{}", escaped(line));
            });
            out.push_str("</pre></details>\n");
        }
        None => out.push_str("<p>The session is too long to be repeated here; save it beside this report.</p>\n"),
    }
    out.push_str("</main>\n</body>\n</html>\n");
    out
}

fn notes(notes: &[String], out: &mut String) {
    if notes.is_empty() {
        return;
    }
    out.push_str("<ul class=\"notes\">\n");
    for note in notes {
        let _ = writeln!(out, "<li>{}</li>", escaped(note));
    }
    out.push_str("</ul>\n");
}

fn references(references: &[(String, String)], out: &mut String) {
    if references.is_empty() {
        return;
    }
    out.push_str("<h2>References</h2>\n<dl class=\"facts\">\n");
    for (cited, document) in references {
        let _ = writeln!(out, "<dt>{}</dt><dd>{}</dd>", escaped(cited), escaped(document));
    }
    out.push_str("</dl>\n");
}

fn channel(section: &Section, out: &mut String) {
    let (title, method) = (escaped(&section.title), escaped(&section.method));
    let _ = writeln!(
        out,
        "<section>\n<h2>{title}</h2>\n<p>{method}</p>\n<p class=\"advice\">{}</p>",
        escaped(&section.advice)
    );
    out.push_str("<ul class=\"counts\">");
    for (what, count) in &section.counts {
        let _ = write!(out, "<li><b>{}</b> {}</li>", escaped(count), escaped(what));
    }
    out.push_str("</ul>\n");
    notes(&section.notes, out);
    figures(section, out);
    out.push_str("<h3>Settings that matter</h3>\n");
    table(&section.settings, out);
    if let Some(compared) = &section.compared {
        out.push_str("<h3>Methods compared on this record</h3>\n");
        notes(&compared.lines, out);
        if !compared.table.rows.is_empty() {
            table(&compared.table, out);
        }
    }
    out.push_str("<h3>Flags and decisions</h3>\n");
    if !section.listed.is_empty() {
        let link = section.beside.as_ref().map_or(String::new(), |file| linked(file));
        let _ = writeln!(out, "<p>{}{link}</p>", escaped(&section.listed));
    }
    if !section.flags.rows.is_empty() {
        table(&section.flags, out);
    }
    out.push_str("</section>\n");
}

fn figures(section: &Section, out: &mut String) {
    let mut small = false;
    for (i, figure) in section.figures.iter().enumerate() {
        if figure.small && !small {
            out.push_str("<h3>Largest flags, close up</h3>\n");
            if !section.close.is_empty() {
                let _ = writeln!(out, "<p>{}</p>", escaped(&section.close));
            }
            out.push_str("<div class=\"near\">\n");
            small = true;
        }
        let _ = writeln!(
            out,
            "<figure>{}<figcaption>{}</figcaption></figure>",
            labelled(&figure.svg, &figure.caption),
            escaped(&figure.caption)
        );
        if i == 2 {
            legend(section.filtered, out);
        }
    }
    if small {
        out.push_str("</div>\n");
    }
}

/// A link to a file beside the report.
fn linked(file: &str) -> String {
    // Of a path, every byte that could mean anything else is written as its number.
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-._~/".contains(&b);
    let address: String =
        file.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect();
    // `./` keeps a colon in a name from being a scheme.
    format!(" <a href=\"./{address}\">{}</a>", escaped(file))
}

/// The picture with its words for those who do not see it.
pub(super) fn labelled(svg: &str, caption: &str) -> String {
    svg.replacen(r#"role="img""#, &format!(r#"role="img" aria-label="{}""#, escaped(caption)), 1)
}

/// What the marks of pictures mean; `filtered` where some show the filtered track.
pub(super) fn legend(filtered: bool, out: &mut String) {
    out.push_str("<p class=\"legend\">");
    for (_, class, shape, words) in STATES {
        let _ = write!(out, "<span><i class=\"{class}\">{shape}</i> {words}</span> ");
    }
    out.push_str(
        "<span><i class=\"repaired\">+</i> repaired</span> <span><i class=\"expected\">—</i> expected and tolerance\
         </span> <span><i class=\"gap\">▒</i> lost samples</span>",
    );
    if filtered {
        out.push_str(" <span><i class=\"filtered\">—</i> filtered track</span>");
    }
    out.push_str("</p>\n");
}

fn table(table: &Table, out: &mut String) {
    out.push_str("<div class=\"table\"><table>\n<thead><tr>");
    if !table.marks.is_empty() {
        out.push_str("<th></th>");
    }
    for (name, number) in &table.head {
        let _ = write!(out, "<th{}>{}</th>", numeric(*number), escaped(name));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for (at, row) in table.rows.iter().enumerate() {
        out.push_str("<tr>");
        if let Some(mark) = table.marks.get(at) {
            let mark = STATES.iter().find(|s| Some(s.0) == *mark);
            let shape = |(_, class, shape, words): &(_, &str, &str, &str)| {
                format!("<i class=\"{class}\" title=\"{words}\">{shape}</i>")
            };
            let _ = write!(out, "<td>{}</td>", mark.map(shape).unwrap_or_default());
        }
        for ((name, number), cell) in table.head.iter().zip(row) {
            let _ = write!(out, "<td{} data-name=\"{}\">{}</td>", numeric(*number), escaped(name), escaped(cell));
        }
        out.push_str("</tr>\n");
        if let Some(note) = table.notes.get(at).filter(|note| !note.is_empty()) {
            // Below its row over the whole width: it is never beyond an edge.
            let columns = table.head.len() + usize::from(!table.marks.is_empty());
            let _ = writeln!(out, "<tr class=\"note\"><td colspan=\"{columns}\">note: {}</td></tr>", escaped(note));
        }
    }
    out.push_str("</tbody>\n</table></div>\n");
}

fn numeric(number: bool) -> &'static str {
    if number { " class=\"n\"" } else { "" }
}
