//! Choosing the time among the columns: by what their cells hold and whether it goes forward; names only break ties.

use std::collections::BTreeMap;
use std::path::Path;

use super::super::head::Head;
use super::super::time::{DateOrder, Numbers, Part, Pattern, Zone, number_form, order_of, zone_in};
use super::super::{Aside, LoadOptions, TimeFormat, Worded, names, printable};
use super::form::{Form, numbers};
use super::zones::{are_local, with_column};
use super::{Count, Timing, columns, undecided, unitless, unreadable};
use crate::error::{Error, Result};

/// The columns of a file as candidates for its time.
pub(crate) struct Candidates<'a> {
    pub(super) head: &'a Head,
    options: &'a LoadOptions,
    /// What the cells of each column look like.
    pub(super) forms: Vec<Option<Form>>,
}

/// How the moments of the sampled rows follow each other.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Steps {
    pub(crate) forward: usize,
    pub(crate) back: usize,
    pub(crate) repeated: usize,
    /// The usual step, in nanoseconds, where there is one.
    pub(crate) usual: i64,
}

/// The order that a name like `Date (MM/DD/YYYY)` tells.
fn named_order(name: &str) -> Option<DateOrder> {
    let lower: String = name.to_lowercase().chars().map(|c| if matches!(c, '.' | '-') { '/' } else { c }).collect();
    let german = lower.contains("tt/mm");
    match () {
        () if lower.contains("mm/dd") && !lower.contains("yy/mm/dd") => Some(DateOrder::MonthFirst),
        () if lower.contains("dd/mm") || german => Some(DateOrder::DayFirst),
        () => None,
    }
}

impl Steps {
    /// Of moments in the order of the file; those that cannot be read are left out.
    pub(crate) fn of(moments: &[i64]) -> Self {
        let mut steps = Self::default();
        let mut sizes = Vec::new();
        for pair in moments.windows(2) {
            let step = pair[1].saturating_sub(pair[0]);
            match step {
                0 => steps.repeated += 1,
                1.. => steps.forward += 1,
                _ => steps.back += 1,
            }
            if step != 0 {
                sizes.push(step.saturating_abs());
            }
        }
        sizes.sort_unstable();
        steps.usual = sizes.get(sizes.len() / 2).copied().unwrap_or(0);
        steps
    }

    /// True where time goes one way, forward or back, but for faults of single rows.
    pub(crate) fn one_way(self) -> bool {
        let (most, least) = (self.forward.max(self.back), self.forward.min(self.back));
        most > 0 && least * 4 <= most
    }

    /// True where it also moves on in most rows.
    pub(crate) fn moves_on(self) -> bool {
        self.one_way() && self.repeated <= self.forward.max(self.back)
    }

    /// The steps of two tracks together.
    fn and(self, other: Self) -> Self {
        Self {
            forward: self.forward + other.forward,
            back: self.back + other.back,
            repeated: self.repeated + other.repeated,
            usual: self.usual.max(other.usual),
        }
    }

    fn total(self) -> usize {
        self.forward + self.back + self.repeated
    }

    /// True where a tenth of the rows and more have the time of the row before.
    fn stutters(self) -> bool {
        self.repeated * 10 >= self.total().max(1)
    }
}

impl<'a> Candidates<'a> {
    /// Of the sampled rows of a file.
    pub(crate) fn of(head: &'a Head, options: &'a LoadOptions) -> Self {
        let pattern = options.time_format.as_ref();
        // In a wide table the time stands among the first columns, or has a name that says so.
        let looked_at =
            |c: usize| c < 64 || names::time_rank(&head.names[c]) > 0 || columns::is_named_part(&head.names[c]);
        let form = |c: usize| if looked_at(c) { Form::of(head, c, pattern) } else { None };
        Self { head, options, forms: (0..head.names.len()).map(form).collect() }
    }

    /// The time of the file; none for the sample number.
    ///
    /// # Errors
    /// As [`super::choose`].
    pub(crate) fn choose(&self, path: &Path) -> Result<Option<Timing>> {
        let chosen = match &self.options.time {
            Some(name) => Some(self.told(name, path)?),
            None => self.recognised(path)?,
        };
        let unit = self.options.time_unit.and_then(Worded::word);
        let Some(mut timing) = chosen else {
            return match unit {
                None => Ok(None),
                Some(word) => Err(unitless("the times are sample numbers", word)),
            };
        };
        let counts = matches!(
            timing.format,
            TimeFormat::Seconds | TimeFormat::Elapsed { .. } | TimeFormat::Epoch { .. } | TimeFormat::Since { .. }
        );
        if let Some(word) = unit.filter(|_| !counts) {
            let column = timing.date_column.unwrap_or(timing.column);
            let what = format!("`{}` holds dates or times of day", printable(&self.head.names[column]));
            return Err(unitless(&what, word));
        }
        timing.zone = match self.options.time_zone.as_deref() {
            Some(told) => Some(Zone::find(told)?),
            None => {
                timing = with_column(self.head, timing);
                self.named_zone(&mut timing)
            }
        };
        let fits = |pattern: &Pattern| match &timing.format {
            TimeFormat::Pattern(_) => true,
            TimeFormat::Parts(parts) => {
                parts.iter().any(|p| matches!(p, Part::Date(o) if pattern.date_order() == Some(*o)))
            }
            _ => false,
        };
        if let Some(pattern) = self.options.time_format.as_ref().filter(|pattern| !fits(pattern)) {
            return Err(Error::usage(
                format!("`{}` does not fit the pattern {}", printable(&self.head.names[timing.column]), pattern.text()),
                format!("it holds {}; name another column with --time", self.example(timing.column)),
            ));
        }
        Ok(Some(timing))
    }

    /// The zone that the name or the unit of a column of the time tells, where its cells tell none.
    fn named_zone(&self, timing: &mut Timing) -> Option<Zone> {
        let local = are_local(&timing.format);
        let head = self.head;
        let in_cell = |cell: &&str| {
            let pieces = super::fields(cell.as_bytes(), DateOrder::YearFirst);
            pieces.and_then(|p| p.told(cell.as_bytes())).is_some_and(|t| t.offset.is_some())
        };
        if !local || head.column(timing.column).first().is_some_and(in_cell) {
            return None;
        }
        let zoned =
            |column: usize| Some((column, zone_in(&head.names[column]).or_else(|| zone_in(&head.units[column]))?));
        let (column, name) = (0..head.names.len()).filter(|c| timing.has(*c)).find_map(zoned)?;
        let zone = Zone::find(&name).ok()?;
        let column = printable(&head.names[column]);
        timing.said.push(format!("clocks are those of {name}, as `{column}` says (--time-zone names another zone)"));
        Some(zone)
    }

    fn example(&self, column: usize) -> String {
        let cells = self.head.column(column);
        cells.iter().find(|c| !c.is_empty()).map_or_else(|| "nothing".to_owned(), |c| printable(c))
    }

    /// The column, or the columns with commas between them, that the user names.
    fn told(&self, name: &str, path: &Path) -> Result<Timing> {
        let find = |name: &str| names::find(self.head.names.iter().map(String::as_str), name);
        let found = find(name);
        if let (Err(_), true) = (&found, name.contains(',')) {
            let places = name.split(',').map(|part| find(part.trim())).collect::<Result<Vec<_>>>()?;
            return self.of_columns(&places, path);
        }
        let column = found?;
        let form = self.forms[column]
            .or_else(|| Form::of(self.head, column, self.options.time_format.as_ref()))
            .ok_or_else(|| unreadable(self.head, column, path))?;
        self.timing(column, form, path)
    }

    /// Several columns that the user says are one time.
    fn of_columns(&self, places: &[usize], path: &Path) -> Result<Timing> {
        let named = columns::told(self, places);
        named.ok_or_else(|| Error::Input {
            path: path.to_path_buf(),
            line: Some(self.head.data_line),
            what: "these columns make no time together".into(),
            help:
                "name a date and a time of day, year month day (hour minute second), seconds and nanoseconds, year and \
                   day of the year, or GPS week and seconds of the week"
                    .into(),
        })
    }

    fn recognised(&self, path: &Path) -> Result<Option<Timing>> {
        let single = match self.best() {
            Some((column, form)) => Some(self.timing(column, form, path)?),
            None => None,
        };
        let parts = columns::recognised(self);
        let Some(parts) = parts else {
            return Ok(match single {
                Some(single) => Some(self.finer(single, path)),
                None => self.unnamed(),
            });
        };
        let Some(single) = single else { return Ok(Some(parts)) };
        // Parts are the time where nothing else tells a date, or where they go on when it stands still.
        let dated = single.date_column.is_some() || self.forms[single.column].is_some_and(Form::is_dated);
        let (one, several) = (self.steps(&single), self.steps(&parts));
        let better = several.one_way() && (several.forward + several.back > one.forward + one.back || !one.one_way());
        let as_fine = (several.forward + several.back) * 10 >= (one.forward + one.back) * 9;
        let tells_more = !dated && as_fine && columns::tells_date(&parts);
        Ok(Some(if better || tells_more { parts } else { self.finer(single, path) }))
    }

    /// The column that looks most like a time.
    fn best(&self) -> Option<(usize, Form)> {
        let scored = self.head.names.iter().enumerate().filter_map(|(column, name)| {
            let form = self.forms[column]?;
            let rank = names::time_rank(name);
            let content = match form {
                Form::Told { .. } => 9,
                form if form.is_dated() => 5,
                Form::Clock | Form::OtherClock | Form::Duration if rank > 0 => 3,
                Form::Clock | Form::OtherClock | Form::Duration => 1,
                Form::Number => self.number_score(column, rank)?,
                _ => return None,
            };
            Some((rank + content, column, form))
        });
        scored.max_by_key(|(score, column, _)| (*score, usize::MAX - column)).map(|(_, column, form)| (column, form))
    }

    /// How much a column of numbers is a time; none where it goes to and fro, whatever it is called.
    fn number_score(&self, column: usize, rank: u8) -> Option<u8> {
        let steps = self.steps(&self.number_timing(column));
        if self.head.sample.len() < 2 {
            return (rank == 4).then_some(2);
        }
        let goes_on = || {
            steps.moves_on()
                || self.ids(column).any(|id| self.steps_by_track(&self.number_timing(column), id).moves_on())
        };
        // What is called a time outright may have faults in a good part of its rows.
        let mostly = rank == 4 && steps.forward.max(steps.back) >= 2 * steps.forward.min(steps.back).max(1);
        if mostly || rank >= 3 && steps.one_way() || rank > 0 && goes_on() {
            return Some(2);
        }
        // Digits that are dates need no name.
        let cells = self.head.column(column);
        (super::super::time::digits_are_dates(&cells) && steps.one_way() && cells.len() > 2).then_some(3)
    }

    /// The columns that may tell tracks apart: the one that was told, otherwise those with the name of an id.
    fn ids(&self, time: usize) -> impl Iterator<Item = usize> + '_ {
        let names = &self.head.names;
        let told = self.options.track.as_deref();
        let told = told.map(|told| names::find(names.iter().map(String::as_str), told).ok());
        let is_id = move |c: &usize| match told {
            Some(told) => told == Some(*c),
            None => super::super::column_roles::is_id_column(&names[*c]),
        };
        (0..names.len()).filter(move |c| *c != time).filter(is_id)
    }

    /// How the sampled rows of each track follow each other, all tracks together.
    fn steps_by_track(&self, timing: &Timing, id: usize) -> Steps {
        let mut tracks: BTreeMap<&str, Vec<i64>> = BTreeMap::new();
        for row in self.sampled() {
            if let (Some(id), Some(moment)) = (row.get(id), self.moment(timing, row)) {
                tracks.entry(id).or_default().push(moment);
            }
        }
        tracks.values().map(|moments| Steps::of(moments)).fold(Steps::default(), Steps::and)
    }

    /// A first column without a name that says more, which goes forward evenly: the time of a table of measurements.
    fn unnamed(&self) -> Option<Timing> {
        // Settings may stand at the left of the rows.
        let is_setting = |c: &usize| self.head.asides.get(*c) == Some(&Some(Aside::Setting));
        let column = (0..self.head.names.len()).find(|c| !is_setting(c))?;
        let alone = column + 1 >= self.head.names.len();
        if alone || self.forms[column] != Some(Form::Number) || self.head.sample.len() < 8 {
            return None;
        }
        let values = numbers(self.head, column);
        let steps: Vec<f64> = values.windows(2).map(|w| w[1] - w[0]).collect();
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let usual = sorted.get(sorted.len() / 2).copied()?;
        let even = steps.iter().filter(|s| (**s - usual).abs() <= 0.02 * usual.abs()).count();
        let decimals = self.head.column(column).iter().any(|c| c.contains('.'));
        // Rows that are counted are what the sample number counts too.
        if usual <= 0.0 || even * 10 < steps.len() * 9 || (usual == 1.0 && !decimals) || self.head.header {
            return None;
        }
        let mut timing = self.number_timing(column);
        let unit = timing.format.words();
        timing.said = vec![format!(
            "`{}` goes forward evenly and is taken as the time ({unit})",
            printable(&self.head.names[column])
        )];
        Some(timing)
    }

    /// The time in `column`, with the date beside it where that stands apart.
    fn timing(&self, column: usize, form: Form, path: &Path) -> Result<Timing> {
        let (column, date_column) = self.paired(column, form);
        let dated = date_column.unwrap_or(column);
        let date_form = self.forms[dated].unwrap_or(form);
        if let Form::Told { .. } = date_form
            && let Some(pattern) = &self.options.time_format
        {
            // A pattern of dates, and clocks in a column of their own.
            let clock = |order| {
                let clock = date_column.filter(|date| *date != column).map(|_| column)?;
                Some(Timing::of_parts(vec![dated, clock], vec![Part::Date(order), Part::Clock]))
            };
            let apart = pattern.date_order().and_then(clock);
            return Ok(apart.unwrap_or_else(|| Timing::of(dated, None, TimeFormat::Pattern(Pattern::clone(pattern)))));
        }
        let clock = date_column.map(|_| self.forms[column]);
        let plain_clock = matches!(clock, None | Some(Some(Form::Clock)));
        let format = match date_form {
            Form::Iso { .. } => TimeFormat::Iso,
            Form::Clock => TimeFormat::Clock,
            Form::YearLast { .. } if plain_clock => {
                TimeFormat::YearLast { day_first: self.order(dated, path)? == DateOrder::DayFirst }
            }
            Form::YearLast { .. } | Form::Stamp { .. } => TimeFormat::Stamp { order: self.order(dated, path)? },
            Form::OtherClock => TimeFormat::Parts(vec![Part::Clock]),
            Form::Duration => TimeFormat::Duration,
            Form::Number | Form::Told { .. } => return Ok(self.number_timing(column)),
        };
        let mut timing = match (&format, date_column) {
            (TimeFormat::Iso | TimeFormat::YearLast { .. }, Some(date)) if plain_clock => {
                Timing::of(column, Some(date), format)
            }
            (TimeFormat::Stamp { order }, Some(date)) => {
                Timing::of_parts(vec![date, column], vec![Part::Date(*order), Part::Clock])
            }
            (TimeFormat::Iso, Some(date)) => {
                Timing::of_parts(vec![date, column], vec![Part::Date(DateOrder::YearFirst), Part::Clock])
            }
            (TimeFormat::Parts(parts), _) => Timing::of_parts(vec![column], parts.clone()),
            _ => Timing::of(column, None, format),
        };
        timing.said.extend(self.assumed(&timing, dated));
        let cells = self.head.column(column);
        timing.of_hour = timing.format == TimeFormat::Duration && cells.iter().all(|c| c.matches(':').count() == 1);
        Ok(timing)
    }

    /// What was assumed of the order of a date.
    fn assumed(&self, timing: &Timing, dated: usize) -> Option<String> {
        let order = match &timing.format {
            TimeFormat::YearLast { day_first } => {
                if *day_first {
                    DateOrder::DayFirst
                } else {
                    DateOrder::MonthFirst
                }
            }
            TimeFormat::Stamp { order } => *order,
            TimeFormat::Parts(parts) => match parts.first() {
                Some(Part::Date(order)) => *order,
                _ => return None,
            },
            _ => return None,
        };
        let example = self.example(dated);
        let several = DateOrder::ALL.into_iter().filter(|o| {
            super::fields(example.as_bytes(), *o)
                .and_then(|p| p.told(example.as_bytes()))
                .is_some_and(|t| t.days.is_some())
        });
        let moments = several.filter_map(|o| super::fields(example.as_bytes(), o)?.told(example.as_bytes())?.days);
        let mut days: Vec<i64> = moments.collect();
        days.dedup();
        let words = match order {
            DateOrder::YearFirst => "with the year first",
            DateOrder::DayFirst => "with the day first (--dates month-first for the other)",
            DateOrder::MonthFirst => "with the month first (--dates day-first for the other)",
        };
        let asked = self.options.day_first.is_some() || self.options.time_format.is_some();
        (days.len() > 1 && !asked).then(|| format!("dates like {example} are read {words}"))
    }

    fn order(&self, column: usize, path: &Path) -> Result<DateOrder> {
        self.date_order(column).ok_or_else(|| undecided(self.head, column, path))
    }

    /// The order of the dates of a column: by its name, by the cells, or by what else is written in the file as those do
    /// who write dates so. None where nothing tells it.
    pub(super) fn date_order(&self, column: usize) -> Option<DateOrder> {
        let cells = self.head.column(column);
        if let Some(day_first) = self.options.day_first {
            return Some(if day_first { DateOrder::DayFirst } else { DateOrder::MonthFirst });
        }
        named_order(&self.head.names[column]).or_else(|| order_of(&cells)).or_else(|| self.customary(&cells))
    }

    /// Decimal commas are written where the day stands first, and clocks of twelve hours beside dates like 3/4/2021 where
    /// the month does.
    fn customary(&self, cells: &[&str]) -> Option<DateOrder> {
        let reads = |order: DateOrder| {
            let told = |c: &&str| super::fields(c.as_bytes(), order).and_then(|p| p.told(c.as_bytes())).is_some();
            cells.iter().filter(|c| !c.is_empty()).all(told)
        };
        let halves = |column: usize| {
            let half =
                |c: &&&str| c.contains(':') && c.to_ascii_lowercase().trim_end_matches('m').ends_with(['a', 'p']);
            let clocks = self.head.column(column);
            clocks.iter().filter(half).count() * 2 > clocks.len()
        };
        let clock = |c: &usize| matches!(self.forms[*c], Some(Form::Clock | Form::OtherClock));
        if self.head.reading.decimal_comma && reads(DateOrder::DayFirst) {
            return Some(DateOrder::DayFirst);
        }
        let slashes = cells.iter().all(|c| c.is_empty() || c.contains('/'));
        let twelve = slashes && (0..self.forms.len()).filter(clock).any(halves);
        (twelve && reads(DateOrder::MonthFirst)).then_some(DateOrder::MonthFirst)
    }

    fn number_timing(&self, column: usize) -> Timing {
        let name = &self.head.names[column];
        let named = self.options.time.as_ref() == Some(name) && self.options.time_unit.is_none();
        if let Some((unit_ns, zero)) = self.head.counted.filter(|_| named) {
            return Timing::of(column, None, TimeFormat::Since { unit_ns, zero });
        }
        let cells: Vec<&str> =
            self.head.column(column).into_iter().filter(|c| !self.head.reading.is_marker(c.as_bytes())).collect();
        let values = numbers(self.head, column);
        let unit = names::time_unit_ns(&self.head.units[column])
            .or_else(|| names::time_unit_ns(&names::unit_of(name)))
            .or_else(|| names::time_unit_ns(name));
        let numbers = Numbers { name, unit, told: self.options.time_unit, cells: &cells, values: &values };
        let (format, said) = number_form(&numbers);
        let mut timing = match format {
            TimeFormat::Parts(parts) => Timing::of_parts(vec![column], parts),
            format => Timing::of(column, None, format),
        };
        timing.said.extend(said);
        let counts = matches!(timing.format, TimeFormat::Seconds | TimeFormat::Elapsed { .. });
        timing.of_week = counts && columns::is_second_of_week(name);
        timing
    }

    /// Where date and time of day stand apart: the column of the time of day and that of the date.
    fn paired(&self, column: usize, form: Form) -> (usize, Option<usize>) {
        let other = |fits: &dyn Fn(Form) -> bool| {
            let places = (0..self.forms.len()).filter(|c| *c != column);
            // The nearest: a record may have a date of its calibration, too.
            places.filter(|c| self.forms[*c].is_some_and(fits)).min_by_key(|c| c.abs_diff(column))
        };
        let clock = |f: Form| matches!(f, Form::Clock | Form::OtherClock);
        match form {
            form if clock(form) => (column, other(&Form::is_date_only)),
            _ if form.is_date_only() => match other(&clock) {
                Some(clock) => (clock, Some(column)),
                None => (column, None),
            },
            _ => (column, None),
        }
    }

    /// `timing`, or another column where that stands still for several rows and the other moves on.
    fn finer(&self, timing: Timing, path: &Path) -> Timing {
        let coarse = self.steps(&timing);
        if !coarse.stutters() || coarse.total() < 8 {
            return timing;
        }
        let other = (0..self.forms.len()).filter(|c| !timing.has(*c)).filter_map(|column| {
            let form = self.forms[column]?;
            let named = names::time_rank(&self.head.names[column]) > 0;
            if !(form.is_dated() || named) {
                return None;
            }
            let other = self.timing(column, form, path).ok()?;
            let steps = self.steps(&other);
            (steps.moves_on() && !steps.stutters()).then_some(other)
        });
        let Some(mut finer) = other.max_by_key(|t| self.forms[t.column].is_some_and(Form::is_dated)) else {
            return timing;
        };
        let name = |t: &Timing| printable(&self.head.names[t.column]);
        finer.said.push(format!(
            "the time is `{}`, which goes on where `{}` has one time for several rows (--time names another)",
            name(&finer),
            name(&timing)
        ));
        finer
    }

    /// The sampled rows with as many cells as rows have.
    fn sampled(&self) -> impl Iterator<Item = &'a Vec<String>> {
        self.head.sample.iter().filter(|row| self.head.counts.contains(&row.len()))
    }

    fn moment(&self, timing: &Timing, row: &[String]) -> Option<i64> {
        let cell = |c: usize| row.get(c).map_or(&[][..], |c: &String| c.as_bytes());
        match timing.read(cell, self.head.reading.decimal_comma)? {
            Count::Exact(ns) => Some(ns),
            Count::Inexact(seconds) => match super::nanoseconds(seconds * 1e9)? {
                Count::Exact(ns) => Some(ns),
                Count::Inexact(_) => None,
            },
        }
    }

    /// The moments of the sampled rows.
    pub(crate) fn moments(&self, timing: &Timing) -> Vec<i64> {
        self.sampled().filter_map(|row| self.moment(timing, row)).collect()
    }

    /// How the sampled rows follow each other under `timing`; midnights are no steps back.
    pub(crate) fn steps(&self, timing: &Timing) -> Steps {
        let mut moments = self.moments(timing);
        if timing.is_of_day() {
            let mut passed = 0;
            for i in 1..moments.len() {
                let now = moments[i].saturating_add(passed);
                passed += if super::is_midnight(moments[i - 1], now) { super::DAY } else { 0 };
                moments[i] = moments[i].saturating_add(passed);
            }
        }
        Steps::of(&moments)
    }
}
