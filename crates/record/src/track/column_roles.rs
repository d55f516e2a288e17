//! What each column is read for.

use super::body::{Numbers, truth};
use super::head::Head;
use super::sniff::{Look, look};
use super::timing::Timing;
use super::{Aside, ColumnKind, LoadOptions, Rules, multi_track, names, printable};
use crate::error::{Error, Result};

mod aside;

pub(crate) use aside::{is_id_column, release};

/// Which columns are parsed as numbers, and why.
#[derive(Debug)]
pub(crate) struct Roles {
    /// For each column, its place among the parsed ones.
    pub(crate) slots: Vec<Option<usize>>,
    /// The channels that the user named, in that order.
    pub(crate) channels: Option<Vec<usize>>,
    /// The truth column that the user named.
    pub(crate) truth: Option<usize>,
    /// The column that tells tracks apart.
    pub(crate) track: Option<usize>,
    /// For each column, its kind by the first rows, for the columns that are not parsed.
    pub(crate) unread: Vec<ColumnKind>,
    /// For each column, whether its cells are TRUE and FALSE.
    pub(crate) truths: Vec<bool>,
    /// For each column, texts that stand where its numbers have not begun.
    pub(crate) late: Vec<Vec<String>>,
    /// Columns that are needed as numbers, whatever they look like.
    beside: Vec<usize>,
    /// By which rules.
    rules: Rules,
}

/// Gives each column its role.
///
/// # Errors
/// [`Error::Usage`] for a column that is not there, or named for two roles.
pub(crate) fn assign(head: &Head, timing: Option<&Timing>, options: &LoadOptions) -> Result<Roles> {
    let find = |name: &String| names::find(head.names.iter().map(String::as_str), name);
    let mut channels =
        options.channels.iter().map(|name| multi_track::base(head, options, name)).collect::<Result<Vec<_>>>()?;
    let mut seen = vec![false; head.names.len()];
    let beside =
        options.beside.iter().map(|name| multi_track::base(head, options, name)).collect::<Result<Vec<_>>>()?;
    if !channels.is_empty() {
        channels.extend(&beside);
    }
    channels.retain(|c| !std::mem::replace(&mut seen[*c], true));
    let truth = options.truth.as_ref().map(find).transpose()?;
    let track = multi_track::column(head, options)?;
    let is_time = |c: usize| timing.is_some_and(|t| t.has(c));
    let told = channels.iter().copied().find(|c| is_time(*c) || truth == Some(*c) || track == Some(*c));
    let twice = told.or(truth.filter(|t| is_time(*t) || track == truth)).or(track.filter(|t| is_time(*t)));
    if let Some(column) = twice {
        let role = match column {
            c if is_time(c) => "the time",
            c if track == Some(c) => "what tells tracks apart (--track)",
            _ => "the truth column",
        };
        return Err(Error::usage(
            format!("`{}` is {role} and cannot be another thing too", printable(&head.names[column])),
            "name other columns, or another time with --time",
        ));
    }
    let kind = |c: usize| match kind_by_sample(head, c) {
        ColumnKind::Text if options.rules == Rules::Second && holds_truths(head, c, false) => {
            ColumnKind::Aside(Aside::Flag)
        }
        ColumnKind::Number if options.rules == Rules::Second && !is_time(c) && !beside.contains(&c) => {
            let told = head.asides.get(c).copied().flatten();
            told.or_else(|| aside::by_sample(head, c, timing)).map_or(ColumnKind::Number, ColumnKind::Aside)
        }
        kind => kind,
    };
    let late = late_markers(head, options, &is_time);
    let mut unread: Vec<ColumnKind> = (0..head.names.len()).map(kind).collect();
    if options.rules == Rules::Second {
        aside::keep_one_channel(&mut unread, &is_time);
    }
    let words = |c: usize| options.rules == Rules::Second || truth == Some(c);
    let truths: Vec<bool> =
        (0..head.names.len()).map(|c| words(c) && holds_truths(head, c, truth == Some(c))).collect();
    let named = |c: usize| is_truth(&head.names[c], options.rules);
    let wanted = |c: usize| {
        if is_time(c) || track == Some(c) {
            false
        } else if truth == Some(c) {
            true
        } else if channels.is_empty() {
            matches!(unread[c], ColumnKind::Number | ColumnKind::Empty)
                || !late[c].is_empty()
                || (truths[c] && named(c))
        } else {
            channels.contains(&c) || (named(c) && (truths[c] || unread[c] == ColumnKind::Number))
        }
    };
    let mut next = 0;
    let slots = (0..head.names.len()).map(|c| {
        wanted(c).then(|| {
            next += 1;
            next - 1
        })
    });
    Ok(Roles {
        slots: slots.collect(),
        channels: (!channels.is_empty()).then_some(channels),
        truth,
        track,
        truths,
        late,
        beside,
        rules: options.rules,
        unread,
    })
}

impl Roles {
    /// The kind of a parsed column: numbers where they are the majority of what is there.
    pub(crate) fn kind(&self, index: usize, name: &str, numbers: &Numbers) -> ColumnKind {
        let told = self.channels.as_ref().is_some_and(|c| c.contains(&index)) || self.beside.contains(&index);
        let all_bits = || numbers.values.iter().all(|v| v.is_nan() || *v == 0.0 || *v == 1.0);
        if numbers.present == 0 {
            let text = numbers.unreadable.count > 0 || self.late.get(index).is_some_and(|l| !l.is_empty());
            if text && self.truths.get(index) == Some(&true) {
                return ColumnKind::Aside(Aside::Flag);
            }
            if text { ColumnKind::Text } else { ColumnKind::Empty }
        } else if numbers.unreadable.count > numbers.present && !told {
            ColumnKind::Text
        } else if !told && is_truth(name, self.rules) && numbers.unreadable.count == 0 && all_bits() {
            ColumnKind::Truth
        } else if self.rules == Rules::Second && !told {
            aside::by_values(name, &numbers.values).map_or(ColumnKind::Number, ColumnKind::Aside)
        } else {
            ColumnKind::Number
        }
    }
}

/// True for the name of a column of truths.
fn is_truth(name: &str, rules: Rules) -> bool {
    match rules {
        Rules::First => names::earlier::is_truth(name),
        Rules::Second => names::is_truth(name),
    }
}

/// For each column whose sampled cells are one text or two, or such texts and fewer numbers, these texts: its numbers may
/// begin further on, or be few.
fn late_markers(head: &Head, options: &LoadOptions, is_time: &impl Fn(usize) -> bool) -> Vec<Vec<String>> {
    let of = |column: usize| {
        let mut texts: Vec<String> = Vec::new();
        if options.rules == Rules::First || is_time(column) || head.sample.len() < 8 {
            return texts;
        }
        let mut numbers: Vec<&str> = Vec::new();
        let mut worded = 0;
        for cell in head.column(column) {
            let look = look(cell.as_bytes(), &head.reading);
            worded += usize::from(look == Look::Text);
            match look {
                Look::Empty => {}
                Look::Text if texts.iter().any(|t| t == cell) => {}
                Look::Text if texts.len() < 2 => texts.push(cell.to_owned()),
                Look::Number if head.reading.number(cell.as_bytes()).is_some() => numbers.push(cell),
                _ => return Vec::new(),
            }
        }
        // Among more numbers a text is a fault of its cell.
        let few = numbers.len() < worded && are_measured(&mut numbers);
        if numbers.is_empty() || few { texts } else { Vec::new() }
    };
    (0..head.names.len()).map(of).collect()
}

/// True where few of the numbers are the same, or where they have decimals: codes beside texts are no measurements.
fn are_measured(numbers: &mut Vec<&str>) -> bool {
    let decimals = numbers.iter().filter(|n| n.contains(['.', ','])).count() * 2 > numbers.len();
    let count = numbers.len();
    numbers.sort_unstable();
    numbers.dedup();
    count > 2 && numbers.len() > 1 && (decimals || numbers.len() * 2 > count)
}

/// True for a column of TRUE and FALSE; where the user says that it is one of truths, for any words.
fn holds_truths(head: &Head, column: usize, told: bool) -> bool {
    let cells = head.column(column);
    let filled: Vec<&&str> = cells.iter().filter(|c| !head.reading.is_marker(c.as_bytes())).collect();
    let word = |c: &&&str| truth(c.as_bytes()).is_some() && (told || c.len() > 1);
    !filled.is_empty() && filled.iter().all(word)
}

fn kind_by_sample(head: &Head, column: usize) -> ColumnKind {
    let looks = head.column(column).into_iter().map(|c| look(c.as_bytes(), &head.reading));
    let (numbers, others) = looks.fold((0, 0), |(numbers, others), look| match look {
        Look::Number => (numbers + 1, others),
        Look::Time | Look::Text => (numbers, others + 1),
        Look::Empty => (numbers, others),
    });
    if numbers == 0 && others == 0 {
        ColumnKind::Empty
    } else if numbers >= others {
        ColumnKind::Number
    } else {
        ColumnKind::Text
    }
}
