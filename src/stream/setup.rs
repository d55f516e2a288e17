//! Method and settings of a stream: what needs the future or the whole record is off.

use super::predict::METHODS;
use crate::cli::StreamArgs;
use crate::error::{Error, Result, one_of};
use crate::method::{Method, shared};
use crate::param::{Choice, Settings, Value};
use crate::session::{Plan as SessionPlan, Preset, Session, method_of_id, read};
use crate::track::LoadOptions;

/// How a stream is judged.
#[derive(Clone)]
pub struct Plan {
    /// The method, one that can judge from the past alone.
    pub method: &'static dyn Method,
    /// Its settings, none of which needs the future.
    pub settings: Settings,
}

/// A plan with what else was said about the stream.
pub(super) struct Planned {
    pub(super) plan: Plan,
    /// How to read the lines.
    pub(super) options: LoadOptions,
    /// What the user should know.
    pub(super) notes: Vec<String>,
}

/// What a stream needs a setting to be, and why.
const NEEDED: [(&str, Value, &str); 5] = [
    (shared::LOOK_BACK.key, Value::Switch(false), "it runs over the segment from its end"),
    (shared::NOISE_FLOOR.key, Value::Word("off"), "it is the median over the whole segment"),
    ("direction", Value::Word("forward"), "the other direction comes from the end"),
    ("test", Value::Word("component"), "a stream is one channel"),
    (shared::FLOOR.key, Value::Real(0.0), "it is the smallest step of the whole segment"),
];

/// A stream judges what it reads as it stands.
///
/// # Errors
/// [`Error::Usage`] for a channel that is prepared before its method sees it.
fn refuse_preparation(plan: &SessionPlan) -> Result<()> {
    if plan.setup.preparation.is_empty() {
        return Ok(());
    }
    Err(Error::usage(
        format!("{}: its session makes checks, or unwraps it, before the method", plan.channel),
        "a stream does neither: take them out of the session, or name the method with --method",
    ))
}

/// Method, settings and columns for `args`.
///
/// # Errors
/// [`Error::Usage`] for a method or a setting that a stream cannot have; what reading a session gives.
pub(super) fn plan(args: &StreamArgs) -> Result<Planned> {
    let mut options = args.load.options(None);
    let mut notes = Vec::new();
    let mut plan = match &args.session {
        Some(path) => {
            let session = read(path)?;
            let from = planned(&session, options.channels.first())?;
            refuse_preparation(from)?;
            if options.channels.is_empty() {
                options.channels.push(from.channel.clone());
            }
            options.time = options.time.or(session.data.options.time.clone());
            Plan { method: from.setup.method, settings: from.setup.settings.clone() }
        }
        None => {
            let method = method_of_id(args.method.as_deref().unwrap_or_default())?;
            Plan { method, settings: Preset::from(args.preset).settings(method) }
        }
    };
    let id = plan.method.about().id;
    if !METHODS.contains(&id) {
        return Err(Error::usage(
            format!("{id} needs samples that come later"),
            format!("methods for a stream: {}", METHODS.join(", ")),
        ));
    }
    if options.channels.len() > 1 {
        return Err(Error::usage("a stream is one channel", "name one with --channel"));
    }
    let saved = args.session.is_some();
    for (key, value, why) in NEEDED {
        let Some(now) = plan.settings.get(key).filter(|now| !fits(key, *now, value)) else { continue };
        plan.settings.set(id, key, value)?;
        if saved {
            notes.push(format!("{key} = {now} of the session is {value} on a stream: {why}"));
        }
    }
    if let Some(gap) = &args.max_gap {
        plan.settings.set_text(id, shared::MAX_GAP.key, gap)?;
    }
    for (key, value) in &args.set {
        plan.settings.set_text(id, key, value)?;
    }
    check(&plan, args)?;
    notes.extend(plan.method.warnings(&plan.settings));
    Ok(Planned { plan, options, notes })
}

/// The plan of a session for the named channel, or the only one.
fn planned<'a>(session: &'a Session, channel: Option<&String>) -> Result<&'a SessionPlan> {
    let names = || session.plans.iter().map(|p| p.channel.as_str()).collect::<Vec<_>>().join(", ");
    match (channel, session.plans.as_slice()) {
        (None, [only]) => Ok(only),
        (None, _) => Err(Error::usage(
            "the session has several channels, a stream is one",
            format!("name one with --channel: {}", names()),
        )),
        // A stream may name its columns otherwise than the record of the session.
        (Some(_), [only]) => Ok(only),
        (Some(name), plans) => plans.iter().find(|p| p.channel == *name).ok_or_else(|| {
            let names: Vec<&str> = plans.iter().map(|p| p.channel.as_str()).collect();
            Error::usage(format!("{name}: the session has no such channel"), one_of("channels", name, &names))
        }),
    }
}

fn fits(key: &str, now: Value, needed: Value) -> bool {
    now == needed || (key == shared::FLOOR.key && matches!(now, Value::Real(_)))
}

/// Refuses what `--set` asks for and a stream cannot do.
fn check(plan: &Plan, args: &StreamArgs) -> Result<()> {
    let (id, settings) = (plan.method.about().id, &plan.settings);
    if let Some((param, value)) = settings.iter().find(|(_, value)| matches!(value, Value::Duration(_))) {
        return Err(Error::usage(
            format!("{} = {value}: the interval of a stream is not known yet", param.key),
            format!("give {} as a number of samples: --set {}=N", param.key, param.key),
        ));
    }
    for (key, value, why) in NEEDED {
        if let Some(now) = settings.get(key)
            && !fits(key, now, value)
        {
            return Err(Error::usage(
                format!("{key} = {now} is not for a stream: {why}"),
                format!("leave it out: on a stream it is {value}"),
            ));
        }
    }
    let measured = settings.get(shared::SIGMA.key).map(|_| settings.choice(shared::SIGMA.key));
    if let Some(Choice::Word(word)) = measured {
        return Err(Error::usage(
            format!("sigma = {word}: {id} cannot measure the noise of samples that have not arrived yet"),
            "give the precision of the instrument in the channel's units: --set sigma=NUMBER; `wildpoint inspect` \
             measures it on a record",
        ));
    }
    match args.interval {
        Some(interval) if !(interval > 0.0 && interval.is_finite()) => Err(Error::usage(
            format!("--interval {interval}: not a time between samples"),
            "give seconds, for example 0.1",
        )),
        _ => Ok(()),
    }
}
