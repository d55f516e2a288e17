//! A method as a check of another one: what it flags, the next one does not see.

use std::sync::LazyLock;

use super::{About, Check, Objection, Own, Subject};
use crate::error::Error;
use crate::math::circle::Circle;
use crate::method::{METHODS, Method, Verdict, judge_channel};
use crate::param::Settings;
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// A method that makes a check.
struct ByMethod {
    method: &'static dyn Method,
    about: &'static About,
}

/// Every method that judges a channel by itself.
static ALL: LazyLock<Vec<ByMethod>> = LazyLock::new(|| {
    let alone = METHODS.iter().copied().filter(|method| !method.about().needs_rate);
    let by = |method: &'static dyn Method| {
        let of = method.about();
        let about = About { id: of.id, help: of.name, params: of.params, own: Own::Line, channels: None };
        // A few of them, made once: they last as long as the program.
        ByMethod { method, about: Box::leak(Box::new(about)) }
    };
    alone.map(by).collect()
});

/// The check that the method with this id makes.
pub(super) fn find(id: &str) -> Option<&'static dyn Check> {
    ALL.iter().find(|by| by.about.id == id).map(|by| by as &dyn Check)
}

impl Check for ByMethod {
    fn about(&self) -> &'static About {
        self.about
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let circle = subject.period.map(|period| Circle::of(subject.y, None, period, &|| stop.check())).transpose()?;
        let y = circle.as_ref().map_or(subject.y, |circle| &circle.unwrapped);
        let judged = judge_channel(self.method, &Series::new(subject.t, y), None, settings, stop)?;
        let objects = |(position, verdict): (usize, &Verdict)| {
            matches!(verdict, Verdict::Outlier | Verdict::Suspect).then(|| Objection {
                position,
                verdict: *verdict,
                found: (y[position] - judged.expected[position]).abs(),
                limit: judged.tolerance[position],
            })
        };
        Ok(judged.verdict.iter().enumerate().filter_map(objects).collect())
    }

    fn verify(&self, _: &Settings) -> Result<(), Error> {
        Ok(())
    }

    fn evidence(&self, o: &Objection) -> String {
        format!("off by {:.6}, tolerance {:.6}", o.found, o.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_method_objects_to_what_it_flags() {
        let t: Vec<f64> = (0..200).map(f64::from).collect();
        let mut y: Vec<f64> = t.iter().map(|t| (t * 0.1).sin() + (t * 7919.0 % 13.0) * 0.01).collect();
        y[90] += 20.0;
        let check = super::super::find("hampel").unwrap();
        let subject = Subject { t: &t, y: &y, period: None, channels: &[] };
        let found = check.examine(&subject, &Settings::defaults(check.about().params), &Stop::never()).unwrap();
        assert!(found.iter().any(|o| o.position == 90 && o.verdict == Verdict::Outlier));
        assert!(found.len() < 5 && check.evidence(&found[0]).contains("tolerance"));
        assert!(super::super::find("matched").is_err(), "it needs a rate channel");
    }
}
