//! A picture of frames, as SVG that stands still or moves, and back.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::cells::{GROUND, HEIGHT, INK, WIDTH};

/// Space around the screen.
const EDGE: u16 = 12;
/// Height of the line below a moving picture that says what is typed.
const CAPTION: u16 = 30;

/// What the screen shows after a step.
pub(crate) struct Frame {
    /// Its rows, as [`super::cells::rows`] gives them.
    pub rows: Vec<String>,
    /// The keys that were typed.
    pub keys: String,
    /// What they do.
    pub words: String,
    /// How long it is shown.
    pub seconds: f64,
}

/// The frames of a picture.
pub(crate) struct Picture {
    pub columns: u16,
    pub frames: Vec<Frame>,
}

impl Picture {
    /// The picture as SVG. Every row that frames share is in it once.
    pub(crate) fn text(&self) -> String {
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        let mut defs = String::new();
        for row in self.frames.iter().flat_map(|frame| &frame.rows).filter(|row| !row.is_empty()) {
            let next = known.len();
            if let std::collections::btree_map::Entry::Vacant(free) = known.entry(row) {
                free.insert(next);
                let _ = writeln!(defs, "<g id=\"r{next}\">{row}</g>");
            }
        }
        let moves = self.frames.len() > 1;
        let rows = u16::try_from(self.frames[0].rows.len()).unwrap();
        let width = self.columns * WIDTH + 2 * EDGE;
        let height = rows * HEIGHT + 2 * EDGE + if moves { CAPTION } else { 0 };
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\n\
             <style>\ntext {{ font: 13.33px \"DejaVu Sans Mono\", Menlo, Consolas, monospace; white-space: pre; }}\n\
             path[stroke] {{ fill: none; }}\n{}</style>\n\
             <rect width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"{GROUND}\"/>\n<defs>\n{defs}</defs>\n",
            self.motion()
        );
        for (at, frame) in self.frames.iter().enumerate() {
            let _ = write!(out, "<g class=\"f f{at}\">");
            for (row, y) in frame.rows.iter().zip((EDGE..).step_by(HEIGHT.into())) {
                match known.get(row.as_str()) {
                    Some(id) => drop(write!(out, "<use href=\"#r{id}\" x=\"{EDGE}\" y=\"{y}\"/>")),
                    None => out.push_str("<!-- -->"),
                }
            }
            if moves {
                out.push_str(&caption(frame, height));
            }
            out.push_str("</g>\n");
        }
        out + "</svg>\n"
    }

    /// The style that shows one frame after the other.
    fn motion(&self) -> String {
        if self.frames.len() < 2 {
            return String::new();
        }
        let whole: f64 = self.frames.iter().map(|frame| frame.seconds).sum();
        let mut out = format!(".f {{ visibility: hidden; animation: {whole:.1}s step-end infinite; }}\n");
        let mut begin = 0.0;
        for (at, frame) in self.frames.iter().enumerate() {
            let (from, to) = (100.0 * begin / whole, 100.0 * (begin + frame.seconds) / whole);
            begin += frame.seconds;
            let before = if at == 0 { String::new() } else { "0% { visibility: hidden; } ".to_owned() };
            let _ = writeln!(
                out,
                ".f{at} {{ animation-name: k{at}; }}\n@keyframes k{at} {{ {before}{from:.2}% {{ visibility: visible; }} \
                 {to:.2}% {{ visibility: hidden; }} }}"
            );
        }
        out + "@media (prefers-reduced-motion: reduce) { .f { animation: none; } .f0 { visibility: visible; } }\n"
    }

    /// The picture of a text that [`Picture::text`] gave.
    pub(crate) fn of_text(text: &str) -> Self {
        let mut rows: BTreeMap<&str, &str> = BTreeMap::new();
        let mut frames = Vec::new();
        for line in text.lines() {
            if let Some((id, row)) = line.strip_prefix("<g id=\"").and_then(|rest| rest.split_once("\">")) {
                rows.insert(id, row.strip_suffix("</g>").unwrap());
            } else if line.starts_with("<g class=\"f") {
                frames.push(Frame {
                    rows: of_frame(line, &rows),
                    keys: String::new(),
                    words: String::new(),
                    seconds: 0.0,
                });
            }
        }
        Self { columns: 0, frames }
    }
}

/// The rows that a frame uses.
fn of_frame(line: &str, rows: &BTreeMap<&str, &str>) -> Vec<String> {
    let screen = line.split("<g class=\"keys\">").next().unwrap();
    let parts = screen.split('<').skip(2);
    let row = |part: &str| match part.strip_prefix("use href=\"#").and_then(|rest| rest.split_once('"')) {
        Some((id, _)) => Some((*rows.get(id)?).to_owned()),
        None => part.starts_with("!--").then(String::new),
    };
    parts.filter_map(row).collect()
}

/// What is typed, and what it does.
fn caption(frame: &Frame, height: u16) -> String {
    let (y, left) = (height - 14, EDGE + 10);
    let wide = u16::try_from(frame.keys.chars().count()).unwrap() * WIDTH;
    format!(
        "<g class=\"keys\"><rect x=\"{EDGE}\" y=\"{}\" width=\"{}\" height=\"22\" rx=\"4\" fill=\"#2c3742\"/>\
         <text x=\"{left}\" y=\"{y}\" fill=\"#f0c94a\" font-weight=\"bold\">{}</text>\
         <text x=\"{}\" y=\"{y}\" fill=\"{INK}\">{}</text></g>",
        y - 15,
        wide + 20,
        frame.keys,
        left + wide + 26,
        frame.words
    )
}

#[test]
fn a_picture_is_read_as_it_was_written() {
    let frame = |rows: [&str; 3]| Frame {
        rows: rows.map(str::to_owned).to_vec(),
        keys: "n".into(),
        words: "next".into(),
        seconds: 1.0,
    };
    let picture =
        Picture { columns: 4, frames: vec![frame(["<text>a</text>", "", "<path/>"]), frame(["", "<path/>", ""])] };
    let back = Picture::of_text(&picture.text());
    assert_eq!(back.frames.len(), 2);
    for (a, b) in picture.frames.iter().zip(&back.frames) {
        assert_eq!(a.rows, b.rows);
    }
}
