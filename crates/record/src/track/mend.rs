//! Moments that do not go forward as they are: records with the newest row first, single wild stamps, clocks that begin
//! again, hours that come twice.

use super::calendar::DAY;
use super::multi_track::NOBODY;
use super::order::{UNREADABLE, increasing};
use super::time::Zone;

/// What was done to the moments of a record.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Mended {
    /// True when the newest row stands first.
    pub(crate) newest_first: bool,
    /// Rows whose stamp is wild, in the order of the file.
    pub(crate) wild: Vec<usize>,
    /// How often a counter began again.
    pub(crate) wraps: usize,
    /// Rows of an hour that came a second time.
    pub(crate) repeated_hour: usize,
    /// How often times go on from an hour before, as clocks show that are set back.
    pub(crate) set_back: usize,
}

/// What is known of the moments besides themselves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct About<'a> {
    /// Times of day: a step back is midnight.
    pub(crate) clock: bool,
    /// After how much the counter of the file begins again, where it may.
    pub(crate) wrap: Option<i64>,
    /// The zone of local clocks.
    pub(crate) zone: Option<&'a Zone>,
    /// For each row its target.
    pub(crate) of_row: Option<&'a [u32]>,
}

/// A stamp after this many usual steps, with rows after it that go on from before it, is a wild one.
const FAR: i64 = 8;
/// A run of wild stamps is no longer than this; more rows are the record.
const LONGEST: usize = 64;

/// Mends `moments`, one for each row; wild ones become unreadable.
pub(crate) fn mend(moments: &mut [i64], about: About<'_>) -> Mended {
    let mut mended = Mended::default();
    if goes_forward(moments, about.of_row) {
        far_ends(moments, about, &mut mended);
        return mended;
    }
    let groups = groups(moments, about.of_row);
    let (forward, back) = groups.iter().fold((0, 0), |(f, b), g| {
        let steps = |up: bool| {
            g.windows(2)
                .filter(|w| if up { moments[w[1]] > moments[w[0]] } else { moments[w[1]] < moments[w[0]] })
                .count()
        };
        (f + steps(true), b + steps(false))
    });
    mended.newest_first = back > 2 * forward && back > 1;
    for mut rows in groups {
        if mended.newest_first {
            rows.reverse();
        }
        if let Some(span) = about.wrap {
            mended.wraps += unwrap(moments, &rows, span);
        }
        if let Some(zone) = about.zone {
            mended.repeated_hour += repeated_hours(moments, &rows, zone);
        } else if !about.clock {
            mended.set_back += set_back(moments, &rows);
        }
        if !about.clock {
            drop_wild(moments, &rows, &mut mended.wild);
        }
    }
    mended.wild.sort_unstable();
    mended
}

/// True where every moment is after the one before, or equal to it: nearly every record.
fn goes_forward(moments: &[i64], of_row: Option<&[u32]>) -> bool {
    if of_row.is_none() && increasing(moments) {
        return true;
    }
    let mut last = i64::MIN;
    let mut fits = |moment: &i64| {
        let forward = *moment >= last;
        last = *moment;
        forward
    };
    of_row.is_none() && moments.iter().filter(|m| **m != UNREADABLE).all(&mut fits)
}

/// The rows with a readable moment of each target, in the order of the file.
fn groups(moments: &[i64], of_row: Option<&[u32]>) -> Vec<Vec<usize>> {
    let readable = |row: &usize| moments[*row] != UNREADABLE;
    let Some(of_row) = of_row else { return vec![(0..moments.len()).filter(readable).collect()] };
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (row, target) in of_row.iter().enumerate().filter(|(row, t)| **t != NOBODY && readable(row)) {
        let target = *target as usize;
        if groups.len() <= target {
            groups.resize(target + 1, Vec::new());
        }
        groups[target].push(row);
    }
    groups
}

/// How often a step is an hour less than usual.
fn set_back(moments: &[i64], rows: &[usize]) -> usize {
    const HOUR: i64 = DAY / 24;
    let usual = usual_step(moments, rows);
    let back = |w: &&[usize]| moments[w[1]].saturating_sub(moments[w[0]]) == usual - HOUR;
    if usual > 0 && usual < HOUR { rows.windows(2).filter(back).count() } else { 0 }
}

/// The usual size of steps, in nanoseconds.
fn usual_step(moments: &[i64], rows: &[usize]) -> i64 {
    // A part of a long record tells as much as the whole.
    let stride = (rows.len() / 10_000).max(1);
    let steps = rows.windows(2).step_by(stride).map(|w| moments[w[1]].saturating_sub(moments[w[0]]).saturating_abs());
    let mut steps: Vec<i64> = steps.filter(|s| *s > 0).collect();
    steps.sort_unstable();
    steps.get(steps.len() / 2).copied().unwrap_or(0)
}

/// Makes stamps unreadable that lie far ahead, and after which more rows go on from before them; and those that lie
/// before all others.
fn drop_wild(moments: &mut [i64], rows: &[usize], wild: &mut Vec<usize>) {
    let step = usual_step(moments, rows);
    // The rows that go forward so far.
    let mut kept: Vec<usize> = Vec::with_capacity(rows.len());
    for (place, &row) in rows.iter().enumerate() {
        let now = moments[row];
        while let Some(&last) = kept.last().filter(|last| moments[**last] > now) {
            // How many of the last rows lie after this one, and how many rows go on from here below them.
            let run = kept.iter().rev().take(LONGEST + 1).take_while(|r| moments[**r] > now).count();
            if run > LONGEST {
                break;
            }
            let before = kept.len().checked_sub(run + 1).map(|at| moments[kept[at]]);
            let begin = moments[kept[kept.len() - run]];
            let far = before.is_none_or(|b| begin.saturating_sub(b) > FAR.saturating_mul(step))
                && begin.saturating_sub(now) > FAR.saturating_mul(step);
            let close = before.is_some_and(|b| now >= b && now.saturating_sub(b) <= FAR.saturating_mul(step));
            let follow = following(moments, &rows[place..], begin, run + 3);
            if before.is_some_and(|b| now < b) || follow < run || !(far && (follow > run || close) || follow >= run + 3)
            {
                break;
            }
            let _ = last;
            for _ in 0..run {
                if let Some(row) = kept.pop() {
                    moments[row] = UNREADABLE;
                    wild.push(row);
                }
            }
        }
        if kept.last().is_none_or(|last| moments[*last] <= now) {
            kept.push(row);
        }
    }
}

/// How many of the next rows, up to `most`, go forward from the first and stay below `limit`.
fn following(moments: &[i64], rows: &[usize], limit: i64, most: usize) -> usize {
    let mut last = i64::MIN;
    let mut count = 0;
    for &row in rows.iter().take(4 * most + 16) {
        let now = moments[row];
        if now >= last && now < limit {
            (last, count) = (now, count + 1);
            if count == most {
                break;
            }
        } else if now >= limit && count < most {
            // The record has come to the stamp in question.
            break;
        }
    }
    count
}

/// A first or last stamp that lies further away from all others than a hundred times the time they take together.
fn far_ends(moments: &mut [i64], about: About<'_>, mended: &mut Mended) {
    if about.clock || about.of_row.is_some() || moments.len() < 20 {
        return;
    }
    let first = moments.iter().position(|m| *m != UNREADABLE);
    let last = moments.iter().rposition(|m| *m != UNREADABLE);
    let (Some(first), Some(last)) = (first, last) else { return };
    let second = moments[first + 1..].iter().position(|m| *m != UNREADABLE).map(|at| first + 1 + at);
    let but_last = moments[..last].iter().rposition(|m| *m != UNREADABLE);
    let (Some(second), Some(but_last)) = (second, but_last) else { return };
    if but_last <= second {
        return;
    }
    let inner = moments[but_last].saturating_sub(moments[second]);
    let far = |gap: i64| inner > 0 && gap > inner.saturating_mul(100) && gap > DAY;
    for (row, gap) in [
        (first, moments[second].saturating_sub(moments[first])),
        (last, moments[last].saturating_sub(moments[but_last])),
    ] {
        if far(gap) {
            moments[row] = UNREADABLE;
            mended.wild.push(row);
        }
    }
}

/// Adds `span` from where a counter begins again: from near its end to near its zero, and going on from there.
fn unwrap(moments: &mut [i64], rows: &[usize], span: i64) -> usize {
    let (mut passed, mut wraps) = (0_i64, 0);
    let mut before: Option<(i64, i64)> = None;
    for &row in rows {
        let now = moments[row];
        if let Some((last, but_last)) = before {
            let near = |value: i64, edge: i64| value.saturating_sub(edge).saturating_abs() <= span / 16;
            let follows = last.saturating_sub(but_last).saturating_abs() <= span / 16;
            if now < last && near(last, span) && near(now, 0) && follows {
                passed = passed.saturating_add(span);
                wraps += 1;
            }
        }
        before = Some((now, before.map_or(now, |b| b.0)));
        moments[row] = now.saturating_add(passed);
    }
    wraps
}

/// Takes an hour that comes twice, where clocks are set back, for the second one where time goes back otherwise.
fn repeated_hours(moments: &mut [i64], rows: &[usize], zone: &Zone) -> usize {
    let mut count = 0;
    for at in 1..rows.len() {
        let (last, now) = (moments[rows[at - 1]], moments[rows[at]]);
        if now <= last
            && let Some(later) = zone.repeated(now)
            && later > last
        {
            moments[rows[at]] = later;
            count += 1;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::super::calendar::SECOND;
    use super::*;

    const PLAIN: About<'_> = About { clock: false, wrap: None, zone: None, of_row: None };

    fn seconds(s: &[i64]) -> Vec<i64> {
        s.iter().map(|s| s * SECOND).collect()
    }

    fn mended(s: &[i64]) -> (Vec<usize>, bool) {
        let mut moments = seconds(s);
        let mended = mend(&mut moments, PLAIN);
        (mended.wild, mended.newest_first)
    }

    #[test]
    fn one_wild_stamp_is_the_wild_one_wherever_it_stands() {
        for place in 0..30 {
            for wild in [1_000_000_000, -1_000_000_000] {
                let mut s: Vec<i64> = (100..130).collect();
                s[place] = wild;
                let mut moments = seconds(&s);
                mend(&mut moments, PLAIN);
                let ordered = super::super::order::order(
                    super::super::order::Moments::Exact(moments),
                    false,
                    None,
                    super::super::Wanted::always(),
                );
                let lost = ordered.seconds.iter().filter(|s| s.is_nan()).count();
                assert_eq!(lost, 1, "{wild} at {place}");
            }
        }
    }

    #[test]
    fn rows_that_are_late_stay_late_and_a_record_that_goes_on_is_not_wild() {
        assert_eq!(mended(&[1, 2, 3, 3, 2, 4, 5, 6]).0, Vec::<usize>::new());
        assert_eq!(mended(&[1, 2, 3, 1000, 1001, 1002, 1003, 1004]).0, Vec::<usize>::new());
    }

    #[test]
    fn the_newest_row_may_stand_first() {
        assert_eq!(mended(&[9, 8, 7, 6, 5, 4]), (vec![], true));
        let (wild, newest) = mended(&[19, 18, 17, 90_000, 15, 14, 13, 12, 11]);
        assert_eq!((wild, newest), (vec![3], true));
    }

    #[test]
    fn counters_begin_again() {
        let span = 1_i64 << 32;
        let ms = 1_000_000;
        let mut moments: Vec<i64> = (0..20).map(|i| ((span - 500 + 100 * i) % span) * ms).collect();
        let about = About { wrap: Some(span * ms), ..PLAIN };
        assert_eq!(mend(&mut moments, about).wraps, 1);
        assert!(moments.windows(2).all(|w| w[1] - w[0] == 100 * ms));
    }

    #[test]
    fn an_hour_that_comes_twice_is_told_apart() {
        let zone = Zone::find("Europe/Berlin").unwrap();
        // 2021-10-31, from 1:00 to 4:00 of local clocks, each half hour; 2:00 and 2:30 come twice.
        let midnight = 18_931 * DAY;
        let half = 1800 * SECOND;
        let clock = [2, 3, 4, 5, 4, 5, 6, 7, 8].map(|h| zone.utc(midnight + h * half).unwrap());
        let mut moments = clock.to_vec();
        let about = About { zone: Some(&zone), ..PLAIN };
        assert_eq!(mend(&mut moments, about).repeated_hour, 2);
        assert!(moments.windows(2).all(|w| w[1] - w[0] == half));
    }
}
