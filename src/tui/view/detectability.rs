//! How small a wild point is found, in words and bars.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span;
use ratatui::widgets::Widget;

use super::super::detectability::{MeasuredSetting, Subject};
use super::super::model::Model;
use super::super::plot::RecallPlot;
use super::short;
use crate::session::detectability::{Advice, Curve, OF_ALL};
use crate::track::printable;

/// What was measured of the settings in force; of the ones before while these are measured.
fn measured(model: &Model) -> Option<&MeasuredSetting> {
    model.state().measured.as_deref()
}

/// Draws the picture of detectability; gives the words of its heading.
pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) -> Vec<Span<'static>> {
    let theme = &model.theme;
    let found = measured(model);
    let curves = found.map_or(&[][..], |m| m.measured.kinds.as_slice());
    let unit = printable(&model.channel().unit);
    let words: Vec<String> = curves.iter().filter(|c| c.kind.has_sizes()).map(|c| from(c, &unit)).collect();
    let limit = found.map_or(1.0, |m| m.limit);
    RecallPlot { curves, words: &words, limit, theme, glyphs: model.glyphs }.render(area, buffer);
    let mut heading = Vec::new();
    let dim = |text: String| Span::styled(text, theme.dim);
    if let Some(why) = &model.state().unmeasurable {
        return vec![Span::styled(format!("not measured: {why}  "), theme.warning)];
    }
    if let Some([done, all]) = progress(model) {
        let text = if all == 0 { "measuring …  ".to_owned() } else { format!("measuring, {done} of {all} copies  ") };
        heading.push(Span::styled(text, theme.warning));
    }
    if let Some(found) = found {
        let in_force = found.setup.same_detection(&model.plan().setup);
        let whose = if in_force { "" } else { "the settings before: " };
        heading.push(dim(format!("{whose}share found by size{}  ", in_unit(&unit))));
        heading.push(dim(format!("all {:.0} %  ", 100.0 * found.measured.recall)));
        if let Some(error) = found.measured.repair_error {
            heading.push(dim(format!("repair error {}  ", two_digits(error))));
        }
    }
    heading
}

/// How far the measurement that is shown is; none where none is under way.
fn progress(model: &Model) -> Option<[usize; 2]> {
    let studying = model.studying.as_ref().filter(|s| s.plan == model.shown)?;
    matches!(studying.subject, Subject::Setting(_)).then_some(studying.rounds)
}

fn in_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" in {unit}") }
}

fn two_digits(value: f64) -> String {
    short(format!("{value:.1e}").parse().unwrap_or(value))
}

/// From which size on wild points of a kind are found.
fn from(curve: &Curve, unit: &str) -> String {
    let share = 100.0 * OF_ALL;
    match curve.smallest {
        Some(size) if unit.is_empty() => format!("{share:.0} % from {}", two_digits(size)),
        Some(size) => format!("{share:.0} % from {} {unit}", two_digits(size)),
        None => format!("never {share:.0} %"),
    }
}

/// What is known of a method, for its row in the list of methods: the share found, the flags and suspects on the
/// record, and the time; with `*` at the one that is recommended.
pub(super) fn cells(model: &Model, method: &str) -> Option<String> {
    let studied = model.state().studied.as_deref()?;
    let advice = &studied.advice;
    let index = advice.methods.iter().position(|m| m.setup.method.about().id == method)?;
    let found = &advice.methods[index];
    let mark = if advice.recommended == Some(index) { '*' } else { ' ' };
    let share = 100.0 * found.recall;
    let said = &found.untouched;
    Some(format!("{share:>4.0} %{mark}{:>7}{:>9}{:>6.0}", said.flagged, said.suspects, found.milliseconds))
}

/// The heading of these cells: as wide as they are.
pub(super) const CELLS: &str = " found   flags suspects    ms";

/// What the list of methods says of them: how far they have been compared, and which is recommended.
pub(super) fn about_list(model: &Model) -> Option<String> {
    let running = model.studying.as_ref().filter(|s| matches!(s.subject, Subject::Methods(_)));
    let studied = model.state().studied.as_deref();
    if let Some(why) = &model.state().unmeasurable {
        return Some(format!("not compared: {why}"));
    }
    match (running.map(|s| s.rounds), studied) {
        (Some([done, all]), _) if all > 0 => Some(format!("comparing on this record: {done} of {all} copies")),
        (Some(_), _) => Some("comparing on this record …".to_owned()),
        (None, Some(studied)) => best(&studied.advice).map(|id| format!("best on this record: {id}")),
        (None, None) => None,
    }
}

/// The method that is recommended.
pub(super) fn best(advice: &Advice) -> Option<&'static str> {
    advice.best().map(|best| best.setup.method.about().id)
}
