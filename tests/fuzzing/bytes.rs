//! Structured values from arbitrary bytes; zeros where the bytes end.

/// Bytes that are taken from the front.
pub(super) struct Bytes<'a>(pub(super) &'a [u8]);

impl Bytes<'_> {
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    pub(super) fn word(&mut self) -> u64 {
        (0..8).fold(0, |word, i| word | u64::from(self.byte()) << (8 * i))
    }

    pub(super) fn below(&mut self, limit: usize) -> usize {
        if limit < 2 { 0 } else { self.byte() as usize % limit }
    }

    /// A whole number of the range, near its lower end three times out of four: large windows over few samples all
    /// say the same.
    pub(super) fn whole(&mut self, min: i64, max: i64) -> i64 {
        let shape = self.byte();
        let low = i64::from(self.byte());
        match shape % 8 {
            0 => max,
            1 => min.saturating_add((self.word() >> 1) as i64 % (max.saturating_sub(min)).max(1)).clamp(min, max),
            _ => min.saturating_add(low % 32).clamp(min, max),
        }
    }

    /// A number of the range: its ends, between them, or on a scale of powers.
    pub(super) fn real(&mut self, min: f64, max: f64) -> f64 {
        let part = f64::from(self.byte()) / 255.0;
        let value = match self.below(5) {
            0 => min,
            1 => max,
            2 => min + (max - min) * part,
            3 => min.max(1e-12) * 10_f64.powf(part * 12.0),
            _ => part * 10.0,
        };
        if value.is_finite() { value.clamp(min, max) } else { min }
    }

    /// Any double, often one of those that break things.
    pub(super) fn double(&mut self) -> f64 {
        const NASTY: [f64; 16] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            f64::MAX,
            f64::MIN,
            1e308,
            -1e308,
            f64::MIN_POSITIVE,
            5e-324,
            -5e-324,
            1e-300,
            1e16,
            4_503_599_627_370_497.0,
            f64::NAN,
            f64::EPSILON,
        ];
        match self.byte() {
            shape @ 0..=31 => NASTY[usize::from(shape) % NASTY.len()],
            32..=63 => f64::from_bits(self.word()),
            _ => f64::from(self.byte() as i8),
        }
    }
}
