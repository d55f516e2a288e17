//! What a session says about a track that it was not made on: by the names of channels.

use std::path::{Path, PathBuf};

use super::decided::decisions_at;
use super::{Judged, Rows};
use crate::error::{Error, Result};
use crate::review::Decisions;
use crate::session::document::{Read, WrittenDecision, read_with_texts};
use crate::session::{Data, Plan, Session, Setup};
use crate::track::{LoadOptions, Reading, Track, unit_in_name};

/// What is done with the decisions of a session.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum DecisionsFor {
    /// A session that has any is refused.
    #[default]
    Nobody,
    /// They hold where track, time and value are those that they were made on. Those of channels that name no track are
    /// about this one.
    Track(String),
}

/// A session that is applied to tracks.
#[derive(Debug)]
pub struct Template {
    path: PathBuf,
    session: Session,
    texts: Vec<Vec<WrittenDecision>>,
    decisions: DecisionsFor,
    columns: Named,
    prepare: Prepare,
}

type Completes = dyn Fn(&mut Session, &Track) -> Result<()> + Send + Sync;

/// Completes the plans of a track once its rows are known.
pub struct Prepare(Box<Completes>);

impl Prepare {
    /// Calls `prepare` with the plans of each track and its rows.
    pub fn with(prepare: impl Fn(&mut Session, &Track) -> Result<()> + Send + Sync + 'static) -> Self {
        Self(Box::new(prepare))
    }

    /// The plans are complete.
    fn nothing() -> Self {
        Self::with(|_, _| Ok(()))
    }

    pub(super) fn complete(&self, session: &mut Session, track: &Track) -> Result<()> {
        (self.0)(session, track)
    }
}

impl std::fmt::Debug for Prepare {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Prepare")
    }
}

/// What is said of the columns of the archive beside the session.
#[derive(Debug, Clone, Default)]
pub struct Named {
    /// The column of the time.
    pub time: Option<String>,
    /// The column that tells tracks apart.
    pub track: Option<String>,
    /// Nanoseconds in one unit of a time that is a number.
    pub unit_ns: Option<i64>,
}

/// The name of a channel in a session: that of its column and, in a table of several tracks, the id of its track.
struct OfSession<'a> {
    column: &'a str,
    track: Option<&'a str>,
}

impl Template {
    /// Reads the session at `path`.
    ///
    /// # Errors
    /// What reading gives; [`Error::Session`] for a session with decisions, unless they are for a track.
    pub fn read(path: &Path, decisions: DecisionsFor, columns: Named) -> Result<Self> {
        let Read { session, texts, .. } = read_with_texts(path)?;
        if let (DecisionsFor::Nobody, Some(at)) = (&decisions, texts.iter().position(|t| !t.is_empty())) {
            let line = texts[at].first().and_then(|d| d.line);
            let count: usize = texts.iter().map(Vec::len).sum();
            let what = format!("the session has decisions ({count}), which belong to one record");
            let help = "--decisions=TRACK applies them where track, time and value are the same".to_owned();
            return Err(Error::Session { path: path.to_path_buf(), line, what, help });
        }
        let prepare = Prepare::nothing();
        Ok(Self { path: path.to_path_buf(), session, texts, decisions, columns, prepare })
    }

    /// The same setup for the columns `channels`, as a new session on each track has it.
    #[must_use]
    pub fn of_setup(setup: &Setup, channels: &[String], columns: Named, prepare: Prepare) -> Self {
        let track = Track::of_columns("time", Vec::new(), Vec::new(), &Reading::new(false, &[]));
        let plan = |name: &String| Plan::new(name.clone(), setup.clone(), Decisions::default());
        // Without a column of time and tracks: `columns` names them.
        let session = Session::new(&track, LoadOptions::default(), setup);
        let data = Data { options: LoadOptions::default(), ..session.data };
        let session = Session { plans: channels.iter().map(plan).collect(), data, ..session };
        let texts = vec![Vec::new(); channels.len()];
        Self { path: PathBuf::new(), session, texts, decisions: DecisionsFor::Nobody, columns, prepare }
    }

    /// The column of the time, if one is named.
    #[must_use]
    pub fn time(&self) -> Option<&str> {
        self.columns.time.as_deref().or(self.session.data.options.time.as_deref())
    }

    /// The column that tells tracks apart, if one is named.
    #[must_use]
    pub fn track(&self) -> Option<&str> {
        self.columns.track.as_deref().or(self.session.data.options.track.as_deref())
    }

    /// Nanoseconds in one unit of a time that is a number, in the column `time`: what is told, what the name of the
    /// column ends with, or a second.
    #[must_use]
    pub fn unit_of(&self, time: &str) -> i64 {
        let told = self.columns.unit_ns.or(self.session.data.options.time_unit.map(|unit| unit.ns));
        told.or_else(|| unit_in_name(time)).unwrap_or(1_000_000_000)
    }

    /// How files with the columns of the session are loaded.
    pub(super) fn loading(&self) -> LoadOptions {
        let options = &self.session.data.options;
        LoadOptions {
            time: self.time().map(str::to_owned),
            missing: options.missing.clone(),
            day_first: options.day_first,
            time_format: options.time_format.clone(),
            time_zone: options.time_zone.clone(),
            ..LoadOptions::default()
        }
    }

    /// True when a check is made before a method of any channel.
    #[must_use]
    pub fn checks(&self) -> bool {
        self.session.plans.iter().any(|p| p.setup.preparation.checks_anything())
    }

    /// The columns of the channels that are judged, each once, in the order of the session.
    #[must_use]
    pub fn channels(&self) -> Vec<&str> {
        let mut found = Vec::new();
        for plan in &self.session.plans {
            add(&mut found, self.name(&plan.channel).column);
        }
        found
    }

    /// The columns that are needed: those of the channels, then those that methods and checks need beside them.
    #[must_use]
    pub fn columns(&self) -> Vec<&str> {
        let mut found = self.channels();
        for setup in self.session.plans.iter().map(|plan| &plan.setup) {
            setup.rate.iter().for_each(|rate| add(&mut found, self.name(rate).column));
            let checks = setup.preparation.checks.iter().filter(|check| check.on);
            checks.flat_map(|check| &check.channels).for_each(|name| add(&mut found, self.name(name).column));
        }
        found
    }

    /// Judges and repairs a track.
    ///
    /// # Errors
    /// [`Error::Session`] when the session does not say what to do with a channel of the track, or a decision about it
    /// fits none of its rows; what detection gives.
    pub fn judge(&self, mut rows: Rows) -> Result<Judged> {
        if u32::try_from(rows.moments.len()).is_err() {
            let what = format!("track {}: {} rows", rows.track, rows.moments.len());
            return Err(Error::usage(what, "give tracks of fewer than 2^32 rows"));
        }
        let order = rows.sort();
        let columns = self.channels();
        let plans: Vec<Plan> = columns.iter().map(|column| self.plan(column, &rows)).collect::<Result<_>>()?;
        let data = self.session.data.clone();
        let options = &data.options;
        let missing = Reading::new(options.decimal_comma.unwrap_or(false), &options.missing);
        let session = Session { data, plans, value: self.session.value, result: None };
        Judged::of(rows, session, order, (&missing, &self.prepare))
    }

    /// What is done with a column of a track.
    fn plan(&self, column: &str, rows: &Rows) -> Result<Plan> {
        let about = |at: &usize| self.name(&self.session.plans[*at].channel);
        let all: Vec<usize> = (0..self.session.plans.len()).filter(|at| about(at).column == column).collect();
        let own = all.iter().find(|at| about(at).track.is_some_and(|id| id == rows.track));
        let shared = all.iter().find(|at| about(at).track.is_none());
        let chosen = match (own.or(shared), all.first()) {
            (Some(at), _) => *at,
            // The plans of other tracks are all the same.
            (None, Some(first)) if all.iter().all(|at| self.same(*first, *at)) => *first,
            _ => return Err(self.without_plan(column, rows)),
        };
        let plan = &self.session.plans[chosen];
        let mut setup = plan.setup.clone();
        setup.rate = setup.rate.map(|rate| self.name(&rate).column.to_owned());
        for name in setup.preparation.checks.iter_mut().flat_map(|check| &mut check.channels) {
            *name = self.name(name).column.to_owned();
        }
        let decisions = match &self.decisions {
            DecisionsFor::Track(id) if about(&chosen).track.unwrap_or(id) == rows.track => {
                decisions_at(&self.path, (column, rows), &self.texts[chosen])?
            }
            _ => Decisions::default(),
        };
        Ok(Plan::new(column.to_owned(), setup, decisions))
    }

    fn same(&self, a: usize, b: usize) -> bool {
        self.session.plans[a].setup == self.session.plans[b].setup
    }

    fn without_plan(&self, column: &str, rows: &Rows) -> Error {
        let what = format!("{column}: its settings differ from track to track, and there are none for {}", rows.track);
        let help = "save a session whose settings are the same for all tracks".to_owned();
        Error::Session { path: self.path.clone(), line: None, what, help }
    }

    /// A name of the session. Only one made on several tracks has ids in its names.
    fn name<'a>(&self, channel: &'a str) -> OfSession<'a> {
        match channel.rsplit_once('@').filter(|_| self.session.data.options.track.is_some()) {
            Some((column, track)) => OfSession { column, track: Some(track) },
            None => OfSession { column: channel, track: None },
        }
    }
}

fn add<'a>(names: &mut Vec<&'a str>, name: &'a str) {
    if !names.contains(&name) {
        names.push(name);
    }
}
