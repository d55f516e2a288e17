//! A position that cannot be reached: a test of speed and of jump over the real distance, for all channels of the
//! position at once.

use super::islands::islands;
use super::{About, Check, Objection, Own, Subject, number, shared};
use crate::error::Error;
use crate::math::order::median_in_place;
use crate::math::sorted_window::SortedWindow;
use crate::method::{Verdict, exceeds};
use crate::param::{Kind, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// The position as one target.
#[derive(Debug)]
pub struct Position;

/// The key that says what the channels are.
pub const COORDINATES: &str = "coordinates";
/// Latitude and longitude in degrees.
pub const GEOGRAPHIC: &str = "geographic";
/// Lengths along axes at right angles.
pub const CARTESIAN: &str = "cartesian";

const SPEED: &str = "speed";
const SUSPECT_SPEED: &str = "suspect_speed";
const JUMP: &str = "jump";

/// Mean radius of the earth in metres.
const EARTH: f64 = 6_371_008.8;
/// Positions in the running median that shows how the target moves without its wild points.
const WINDOW: usize = 9;
/// The record's own limit of speed is this many times the fastest movement of that median.
const FASTER: f64 = 3.0;
/// The record's own limit of a jump is this many times the median distance from that median.
const FARTHER: f64 = 10.0;
/// This share of the movements of the median may be steps of longer patches.
const PATCHES: f64 = 0.001;

const fn own_limit(key: &'static str, help: &'static str, unit: &'static str) -> Param {
    Param {
        key,
        help,
        unit,
        kind: Kind::RealOr { words: &["record"], min: 0.0, max: 1e300 },
        default: Value::Word("record"),
        paper: None,
        matters: always,
    }
}

static PARAMS: &[Param] = &[
    Param {
        key: COORDINATES,
        help: "geographic: latitude and longitude in degrees, height in metres; cartesian: lengths of one unit",
        unit: "",
        kind: Kind::Choice(&[GEOGRAPHIC, CARTESIAN]),
        default: Value::Word(GEOGRAPHIC),
        paper: None,
        matters: always,
    },
    own_limit(SPEED, "a faster movement, and back, fails; record: three times the fastest of this track", "m/s"),
    shared::limit(SUSPECT_SPEED, "a faster movement is suspect", "m/s", 0.0),
    own_limit(JUMP, "a shorter jump is never too fast; record: ten times the usual error of this track", "m"),
    shared::LONGEST,
];

static ABOUT: About = About {
    id: "position",
    help: "positions that cannot be reached at the largest possible speed, by great-circle or straight distance",
    params: PARAMS,
    own: Own::Line,
    channels: Some((2, 3)),
};

impl Check for Position {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let fixes = Fixes::of(subject, settings.word(COORDINATES) == GEOGRAPHIC);
        let own = fixes.own_limits(stop)?;
        let jump = number(settings, JUMP).unwrap_or(own.jump);
        let longest = settings.whole(shared::LONGEST.key);
        let fail = number(settings, SPEED).unwrap_or(own.speed);
        let mut said: Vec<Option<Objection>> = vec![None; fixes.at.len()];
        // The stricter limit comes last and takes the place of what the other said.
        for (limit, beyond) in [(number(settings, SUSPECT_SPEED), Verdict::Suspect), (Some(fail), Verdict::Outlier)] {
            let Some(limit) = limit else { continue };
            let too_far = |a: usize, b: usize| {
                let distance = fixes.distance(a, b);
                exceeds(distance, jump) && exceeds(distance / fixes.seconds(a, b), limit)
            };
            for island in islands(fixes.at.len(), longest, too_far, stop)? {
                let verdict = if island.both_sides { beyond } else { Verdict::Suspect };
                let found = fixes.speed_of(&island.range);
                for fix in island.range {
                    said[fix] = Some(Objection { position: fixes.at[fix], verdict, found, limit });
                }
            }
        }
        Ok(said.into_iter().flatten().collect())
    }

    fn verify(&self, settings: &Settings) -> Result<(), Error> {
        match (number(settings, SUSPECT_SPEED), number(settings, SPEED)) {
            (Some(suspect), Some(fail)) if suspect > fail => Err(Error::usage(
                format!("position: suspect_speed = {suspect} lies beyond speed = {fail}"),
                "what is suspect begins before what fails: give suspect_speed the smaller value",
            )),
            _ => Ok(()),
        }
    }

    fn evidence(&self, o: &Objection) -> String {
        format!("a speed of {:.1} m/s, at most {:.1}", o.found, o.limit)
    }
}

/// The positions of which every coordinate is known.
struct Fixes<'a> {
    /// Positions of their samples.
    at: Vec<usize>,
    subject: &'a Subject<'a>,
    geographic: bool,
}

/// Limits from the record itself.
struct OwnLimits {
    speed: f64,
    jump: f64,
}

impl<'a> Fixes<'a> {
    fn of(subject: &'a Subject<'a>, geographic: bool) -> Self {
        let whole = |i: &usize| subject.channels.iter().all(|c| c.get(*i).is_some_and(|v| v.is_finite()));
        Self { at: (0..subject.t.len()).filter(whole).collect(), subject, geographic }
    }

    fn point(&self, fix: usize) -> [f64; 3] {
        let of = |c: usize| self.subject.channels.get(c).map_or(0.0, |values| values[self.at[fix]]);
        [of(0), of(1), of(2)]
    }

    fn seconds(&self, a: usize, b: usize) -> f64 {
        self.subject.t[self.at[b]] - self.subject.t[self.at[a]]
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        distance(self.point(a), self.point(b), self.geographic)
    }

    /// The faster of the movements into a stretch and out of it.
    fn speed_of(&self, range: &std::ops::Range<usize>) -> f64 {
        let speed = |a: usize, b: usize| self.distance(a, b) / self.seconds(a, b);
        let into = if range.start > 0 { speed(range.start - 1, range.start) } else { 0.0 };
        let out = if range.end < self.at.len() { speed(range.end - 1, range.end) } else { 0.0 };
        into.max(out)
    }

    /// How fast and how far a position can be off, from how the running median of the record moves.
    fn own_limits(&self, stop: &Stop) -> Result<OwnLimits, Stopped> {
        let n = self.at.len();
        let coordinates = self.subject.channels.iter().take(3);
        let medians: Vec<Vec<f64>> =
            coordinates.map(|values| running_median(values, &self.at, stop)).collect::<Result<_, _>>()?;
        let middle = |fix: usize| {
            let of = |c: usize| medians.get(c).map_or(0.0, |values| values[fix]);
            [of(0), of(1), of(2)]
        };
        let far = |fix: usize| distance(self.point(fix), middle(fix), self.geographic);
        let mut errors: Vec<f64> = (0..n).map(far).collect();
        let fast = |fix: usize| distance(middle(fix - 1), middle(fix), self.geographic) / self.seconds(fix - 1, fix);
        let mut speeds: Vec<f64> = (1..n).map(fast).collect();
        speeds.sort_unstable_by(f64::total_cmp);
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a count"
        )]
        let left_out = (speeds.len() as f64 * PATCHES) as usize;
        let fastest =
            speeds.len().checked_sub(1 + left_out).and_then(|i| speeds.get(i)).copied().unwrap_or(f64::INFINITY);
        let jump = if errors.is_empty() { f64::INFINITY } else { FARTHER * median_in_place(&mut errors) };
        Ok(OwnLimits { speed: FASTER * fastest, jump })
    }
}

/// The running median of the values at these positions.
fn running_median(values: &[f64], at: &[usize], stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let x: Vec<f64> = at.iter().map(|&i| values[i]).collect();
    let mut window = SortedWindow::new();
    let mut medians = Vec::with_capacity(x.len());
    for i in 0..x.len() {
        stop.check_at(i)?;
        let half = (WINDOW / 2).min(i).min(x.len() - 1 - i);
        window.move_to(&x, i - half..i + half + 1);
        medians.push(window.median());
    }
    Ok(medians)
}

/// The distance of two positions: over the sphere and up where they are geographic.
fn distance(a: [f64; 3], b: [f64; 3], geographic: bool) -> f64 {
    let up = b[2] - a[2];
    if !geographic {
        return (b[0] - a[0]).hypot(b[1] - a[1]).hypot(up);
    }
    let [north, east] = [(b[0] - a[0]).to_radians(), (b[1] - a[1]).to_radians()];
    let half = |angle: f64| (angle / 2.0).sin().powi(2);
    let h = half(north) + a[0].to_radians().cos() * b[0].to_radians().cos() * half(east);
    (2.0 * EARTH * h.clamp(0.0, 1.0).sqrt().asin()).hypot(up)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drive north-east at 10 m/s with fixes of a metre, and what the check says of it.
    fn examine(change: impl Fn(usize, &mut f64, &mut f64), pairs: &[(&str, &str)]) -> Vec<(usize, Verdict)> {
        let n = 400;
        let t: Vec<f64> = (0..n).map(|i| i as f64).collect();
        let (mut lat, mut lon) = (Vec::new(), Vec::new());
        for i in 0..n {
            // 1e-5 degree of latitude are 1.1 m.
            let wobble = 1e-5 * ((i * 7919 % 13) as f64 / 6.5 - 1.0);
            let (mut a, mut b) = (47.0 + 6e-5 * i as f64 + wobble, 8.0 + 9e-5 * i as f64 - wobble);
            change(i, &mut a, &mut b);
            lat.push(a);
            lon.push(b);
        }
        let mut settings = Settings::defaults(PARAMS);
        pairs.iter().for_each(|(key, value)| settings.set_text("position", key, value).unwrap());
        let subject = Subject { t: &t, y: &lat.clone(), period: None, channels: &[lat, lon] };
        let found = Position.examine(&subject, &settings, &Stop::never()).unwrap();
        found.iter().map(|o| (o.position, o.verdict)).collect()
    }

    #[test]
    fn a_clean_drive_is_left_alone_and_a_jump_fails_in_either_channel() {
        assert!(examine(|_, _, _| (), &[]).is_empty());
        let wild = |i: usize, lat: &mut f64, lon: &mut f64| match i {
            100 => *lat += 0.01,
            200..=203 => *lon -= 0.02,
            _ => (),
        };
        let failed: Vec<usize> = [100, 200, 201, 202, 203].to_vec();
        let said = examine(wild, &[]);
        assert_eq!(said.iter().map(|s| s.0).collect::<Vec<_>>(), failed);
        assert!(said.iter().all(|s| s.1 == Verdict::Outlier));
    }

    #[test]
    fn a_limit_that_is_told_holds_and_a_slower_one_is_suspect() {
        let slip = |i: usize, lat: &mut f64, _: &mut f64| {
            if i == 100 {
                *lat += 4e-4;
            }
        };
        assert_eq!(examine(slip, &[("speed", "30"), ("jump", "0")]), [(100, Verdict::Outlier)]);
        let pairs = [("speed", "300"), ("suspect_speed", "30"), ("jump", "0")];
        assert_eq!(examine(slip, &pairs), [(100, Verdict::Suspect)]);
        assert!(examine(slip, &[("speed", "30"), ("jump", "1000")]).is_empty());
    }

    #[test]
    fn distances_are_those_of_the_sphere_and_of_right_angles() {
        let equator = distance([0.0, 179.5, 0.0], [0.0, -179.5, 0.0], true);
        assert!((equator - EARTH.to_radians()).abs() < 1e-6, "over the date line: {equator}");
        let north = distance([60.0, 5.0, 0.0], [60.0, 6.0, 0.0], true);
        assert!((north / (EARTH.to_radians() * 0.5) - 1.0).abs() < 1e-4, "half as far at 60 degrees: {north}");
        assert!((distance([0.0, 0.0, 0.0], [2.0, 3.0, 6.0], false) - 7.0).abs() < 1e-12);
    }
}
