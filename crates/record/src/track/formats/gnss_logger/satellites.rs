//! Which satellite, and which of its signals, a row of an Android GNSS log is about.

use std::collections::HashSet;

use super::Kind;
use super::times::Times;
use crate::track::view::Piece;

/// A label for each row.
pub(super) struct Satellites(Vec<String>);

/// The letters of RINEX for the constellations of Android, from 1.
const LETTERS: [char; 7] = ['G', 'S', 'R', 'J', 'C', 'E', 'I'];

impl Satellites {
    /// None where the rows are about no satellites.
    pub(super) fn of(kind: &Kind, rows: &[&[Piece<'_>]], times: &Times) -> Option<Self> {
        let find = |name: &str| kind.columns.iter().position(|c| c == name);
        let svid = find("Svid")?;
        let text = |row: &&[Piece<'_>], at: Option<usize>| {
            at.and_then(|at| row.get(at)).map_or_else(String::new, |c| c.text().to_owned())
        };
        let constellation = find("ConstellationType");
        let satellite = |row: &&[Piece<'_>]| {
            let kind = text(row, constellation).parse::<usize>().ok();
            let letter = kind.and_then(|k| LETTERS.get(k.checked_sub(1)?)).map_or(String::new(), char::to_string);
            format!("{letter}{:0>2}", text(row, Some(svid)))
        };
        let mut labels: Vec<String> = rows.iter().map(satellite).collect();
        let carrier = |row: &&[Piece<'_>]| {
            let hertz = text(row, find("CarrierFrequencyHz")).parse::<f64>().ok();
            hertz.map_or_else(String::new, |f| format!(" {:.0} MHz", f / 1e6))
        };
        let code = |row: &&[Piece<'_>]| format!(" {}", text(row, find("CodeType")));
        // Several signals of one satellite are told apart by their carrier, and by their code where that does not do.
        let mut append = |part: &dyn Fn(&&[Piece<'_>]) -> String| {
            if repeats(&labels, rows, times) {
                labels.iter_mut().zip(rows).for_each(|(label, row)| label.push_str(part(row).trim_end()));
            }
        };
        append(&carrier);
        append(&code);
        Some(Self(labels))
    }

    pub(super) fn label(&self, row: usize) -> String {
        self.0.get(row).cloned().unwrap_or_default()
    }
}

/// True where one label comes twice in an epoch.
fn repeats(labels: &[String], rows: &[&[Piece<'_>]], times: &Times) -> bool {
    let mut seen: HashSet<&str> = HashSet::new();
    let mut epoch = "";
    labels.iter().zip(rows).any(|(label, row)| {
        let now = times.epoch(row);
        if now != epoch {
            seen.clear();
            epoch = now;
        }
        !seen.insert(label)
    })
}
