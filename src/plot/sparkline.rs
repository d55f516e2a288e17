//! A whole record in a few columns: its level in each, and the flag in it that needs the analyst most.

use super::FlagState;

/// One column of a [`Sparkline`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SparkColumn {
    /// Middle of the samples that are kept, from 0 at the lowest of the record to 1 at the highest; none where there
    /// are none.
    pub level: Option<f32>,
    /// Of the flags in the column, the one that needs the analyst most.
    pub flag: Option<FlagState>,
}

/// A record in columns of equal time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sparkline {
    columns: Vec<SparkColumn>,
}

/// Least and greatest kept value of a column.
#[derive(Debug, Clone, Copy)]
struct Extremes {
    low: f64,
    high: f64,
}

impl Extremes {
    const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn add(&mut self, value: f64) {
        (self.low, self.high) = (self.low.min(value), self.high.max(value));
    }

    fn middle(self) -> Option<f64> {
        (self.low <= self.high).then_some(0.5 * self.low + 0.5 * self.high)
    }
}

impl Sparkline {
    /// The samples `y` at the increasing times `t` in `count` columns. `flags` has the positions of flagged samples with
    /// their states; where `hidden` is true, a sample is an outlier and does not set the level.
    #[must_use]
    pub fn of(t: &[f64], y: &[f64], hidden: &[bool], flags: &[(u32, FlagState)], count: usize) -> Self {
        let (Some(&first), Some(&last)) = (t.first(), t.last()) else { return Self::default() };
        let width = if last > first { (last - first) / count as f64 } else { 1.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the number of columns")]
        let column = |at: usize| (((t[at] - first) / width) as usize).min(count.saturating_sub(1));
        let mut extremes = vec![Extremes::NONE; count];
        let mut all = Extremes::NONE;
        for (at, value) in y.iter().enumerate().filter(|(at, _)| !hidden.get(*at).copied().unwrap_or(false)) {
            extremes[column(at)].add(*value);
            all.add(*value);
        }
        let span = all.high - all.low;
        #[expect(clippy::cast_possible_truncation, reason = "a height on the screen")]
        let level = |middle: f64| if span > 0.0 { ((middle - all.low) / span) as f32 } else { 0.5 };
        let mut columns: Vec<SparkColumn> =
            extremes.iter().map(|e| SparkColumn { level: e.middle().map(level), flag: None }).collect();
        for (position, state) in flags.iter().filter(|(position, _)| (*position as usize) < t.len()) {
            let flag = &mut columns[column(*position as usize)].flag;
            *flag = most_urgent(*flag, Some(*state));
        }
        Self { columns }
    }

    /// The same in `width` columns, if it has more.
    #[must_use]
    pub fn columns(&self, width: usize) -> Vec<SparkColumn> {
        let count = self.columns.len();
        if width == 0 || count <= width {
            return self.columns.clone();
        }
        (0..width).map(|at| merged(&self.columns[at * count / width..(at + 1) * count / width])).collect()
    }
}

fn merged(columns: &[SparkColumn]) -> SparkColumn {
    let levels: Vec<f32> = columns.iter().filter_map(|c| c.level).collect();
    let level = (!levels.is_empty()).then(|| levels.iter().sum::<f32>() / levels.len() as f32);
    SparkColumn { level, flag: columns.iter().map(|c| c.flag).fold(None, most_urgent) }
}

fn most_urgent(a: Option<FlagState>, b: Option<FlagState>) -> Option<FlagState> {
    FlagState::BY_URGENCY.into_iter().find(|state| a == Some(*state) || b == Some(*state))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_ramp_with_a_gap_rises_and_leaves_its_gap_empty() {
        // Ten samples a second apart, of which the third and fourth are lost; the last is an outlier.
        let t = [0.0, 1.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let y = [0.0, 1.0, 4.0, 5.0, 6.0, 7.0, 8.0, 900.0];
        let hidden = [false, false, false, false, false, false, false, true];
        let line = Sparkline::of(&t, &y, &hidden, &[(7, FlagState::Unreviewed)], 9);
        let levels: Vec<Option<f32>> = line.columns.iter().map(|c| c.level).collect();
        let expected =
            [0.0, 1.0, f32::NAN, f32::NAN, 4.0, 5.0, 6.0, 7.0, 8.0].map(|v| (!v.is_nan()).then_some(v / 8.0));
        assert_eq!(levels, expected);
        assert_eq!(line.columns[8].flag, Some(FlagState::Unreviewed));
        assert!(line.columns[..8].iter().all(|c| c.flag.is_none()));
        assert_eq!(
            line.columns(3).iter().map(|c| c.level).collect::<Vec<_>>(),
            [Some(0.0625), Some(0.5625), Some(0.875)]
        );
    }

    proptest! {
        /// No flag is hidden at any width, and the most urgent of a column is the one that is shown.
        #[test]
        fn no_flag_is_hidden(
            steps in proptest::collection::vec(0.001..100.0_f64, 1..200),
            picked in proptest::collection::vec((0_u32..200, 0_usize..5), 0..30),
            width in 1_usize..80,
        ) {
            let t: Vec<f64> = steps.iter().scan(0.0, |sum, step| { *sum += step; Some(*sum) }).collect();
            let flags: Vec<(u32, FlagState)> =
                picked.into_iter().filter(|(p, _)| (*p as usize) < t.len()).map(|(p, s)| (p, FlagState::ALL[s])).collect();
            let line = Sparkline::of(&t, &t, &vec![false; t.len()], &flags, 64);
            let shown = line.columns(width);
            prop_assert!(shown.len() <= width.max(1));
            let urgency = |state: FlagState| FlagState::BY_URGENCY.iter().position(|s| *s == state);
            let most = flags.iter().map(|(_, state)| *state).min_by_key(|state| urgency(*state));
            prop_assert_eq!(shown.iter().filter_map(|c| c.flag).min_by_key(|state| urgency(*state)), most);
            // One flag alone marks one column.
            for flag in &flags {
                let alone = Sparkline::of(&t, &t, &vec![false; t.len()], &[*flag], 64).columns(width);
                prop_assert_eq!(alone.iter().filter(|c| c.flag == Some(flag.1)).count(), 1);
            }
        }
    }
}
