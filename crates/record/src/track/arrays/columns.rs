//! Columns of a table: values of an array, with what they mean.

use super::super::Aside;
use super::super::facts::{ColumnFacts, Decimals};
use super::array::{Array, Fills};
use super::attributes::Attributes;
use super::cf_time::{Stamp, Told};
use super::scalar::{Kind, Scalar};

/// A column.
#[derive(Debug, Clone)]
pub(super) struct Column {
    pub(super) name: String,
    /// The stored bytes that it is in.
    pub(super) place: usize,
    /// Where its first value begins in them.
    pub(super) offset: usize,
    /// Bytes from a value to the next.
    pub(super) step: usize,
    /// How many values it has.
    pub(super) rows: u64,
    pub(super) kind: Kind,
    pub(super) meaning: Meaning,
    /// Values that stand for none.
    fills: Vec<Scalar>,
    unit: String,
    flag: bool,
}

/// What the numbers of a column mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meaning {
    /// Themselves.
    Plain,
    /// Moments, to this many decimals of a second.
    Moment { stamp: Stamp, digits: u32 },
    /// Numbers that were made smaller.
    Scaled(Scale),
}

/// How numbers were made smaller: multiplied by a factor and moved by an offset they are what was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    /// Factor and offset in units of this many decimals.
    Exact { factor: i128, offset: i128, decimals: u32 },
    /// As numbers of 32 or 64 bits.
    Float { factor: f64, offset: f64, single: bool },
}

impl Scale {
    fn of(attributes: &Attributes, kind: &Kind) -> Option<Self> {
        let number = |name: &str| attributes.numbers(name).first().copied();
        let (factor, offset) = (number("scale_factor"), number("add_offset"));
        if !kind.is_number() || factor.is_none() && offset.is_none() {
            return None;
        }
        let (factor, offset) = (factor.unwrap_or(Scalar::Int(1)), offset.unwrap_or(Scalar::Int(0)));
        if factor.as_f64().to_bits() == 1.0_f64.to_bits() && offset.as_f64() == 0.0 {
            return None;
        }
        if let (true, Some((factor, of_factor)), Some((offset, of_offset))) =
            (kind.is_whole(), decimal(&factor.text()), decimal(&offset.text()))
        {
            let decimals = of_factor.max(of_offset);
            let unit = |own: u32| 10_i128.pow(decimals - own);
            return Some(Self::Exact { factor: factor * unit(of_factor), offset: offset * unit(of_offset), decimals });
        }
        let single = matches!((factor, offset), (Scalar::F32(_), Scalar::F32(_) | Scalar::Int(_)));
        Some(Self::Float { factor: factor.as_f64(), offset: offset.as_f64(), single })
    }
}

/// A short number as whole units of this many decimals; none where it has more than nine.
fn decimal(text: &str) -> Option<(i128, u32)> {
    let (digits, power) = text.split_once('e').map_or(Some((text, 0)), |(d, p)| Some((d, p.parse::<i32>().ok()?)))?;
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let decimals = i32::try_from(part.len()).ok()? - power;
    let number: i128 = format!("{whole}{part}").parse().ok().filter(|n: &i128| n.abs() < 1_000_000_000_000)?;
    match decimals {
        0..=9 => Some((number, decimals.unsigned_abs())),
        -9..=-1 => Some((number * 10_i128.pow(decimals.unsigned_abs()), 0)),
        _ => None,
    }
}

/// What NetCDF writes where nothing was written, for a kind of numbers.
fn unwritten(kind: &Kind) -> Option<Scalar> {
    Some(match kind {
        Kind::Int { size: 2, signed: true, .. } => Scalar::Int(-32_767),
        Kind::Int { size: 4, signed: true, .. } => Scalar::Int(-2_147_483_647),
        Kind::Int { size: 8, signed: true, .. } => Scalar::Int(-9_223_372_036_854_775_806),
        Kind::Int { size: 2, signed: false, .. } => Scalar::Int(65_535),
        Kind::Int { size: 4, signed: false, .. } => Scalar::Int(4_294_967_295),
        Kind::Int { size: 8, signed: false, .. } => Scalar::Int(18_446_744_073_709_551_614),
        Kind::Float { size: 4 | 8, .. } => Scalar::F64(9.969_209_968_386_869e36),
        _ => return None,
    })
}

/// Why the numbers of a time are no moments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NoMoments {
    pub(super) name: String,
    pub(super) units: String,
}

impl Column {
    /// The values of `array` from `offset` on, a row each; with a word where it counts time in a way that has no dates.
    pub(super) fn of(
        array: &Array,
        (name, offset): (String, usize),
        (step, rows): (usize, u64),
        fills: Fills,
    ) -> (Self, Option<NoMoments>) {
        let about = &array.attributes;
        let units = about.unit();
        let mut kind = array.kind.clone();
        if let (Kind::Int { signed, .. }, Some("true" | "True")) = (&mut kind, about.text("_Unsigned")) {
            *signed = false;
        }
        let told = array.stamp.map_or_else(|| Stamp::of(units, about.text("calendar")), Told::Moments);
        let meaning = match told {
            Told::Moments(stamp) if kind.is_number() => Meaning::Moment { stamp, digits: 9 },
            _ => Scale::of(about, &kind).map_or(Meaning::Plain, Meaning::Scaled),
        };
        let no_moments = (told == Told::Elsewhere).then(|| NoMoments { name: name.clone(), units: units.to_owned() });
        let mut markers = about.numbers("_FillValue").to_vec();
        markers.extend_from_slice(about.numbers("missing_value"));
        if fills == Fills::NetCdf && !about.has("_FillValue") {
            markers.extend(unwritten(&kind));
        }
        let unit = if matches!(meaning, Meaning::Moment { .. }) { String::new() } else { units.to_owned() };
        let flag = about.is_flag();
        let column = Self { name, place: array.place, offset, step, rows, kind, meaning, fills: markers, unit, flag };
        (column, no_moments)
    }

    /// The bytes of the value in a row, and of all that follows it.
    pub(super) fn bytes<'b>(&self, stored: &'b [u8], row: u64) -> Option<&'b [u8]> {
        let at = usize::try_from(row).ok().filter(|_| row < self.rows)?.checked_mul(self.step)?;
        stored.get(self.offset.checked_add(at)?..)
    }

    /// The number in a row; none where there is no value.
    pub(super) fn number(&self, stored: &[u8], row: u64) -> Option<Scalar> {
        let value = self.kind.number(self.bytes(stored, row)?)?;
        (!self.fills.iter().any(|fill| fill.marks(value))).then_some(value)
    }

    /// True for numbers of 64 bits that mean nothing but themselves.
    pub(super) fn is_plain_double(&self) -> bool {
        self.meaning == Meaning::Plain && matches!(self.kind, Kind::Float { size: 8, .. })
    }

    /// What is known of it without its values.
    pub(super) fn facts(&self) -> ColumnFacts {
        let decimals = match (self.meaning, &self.kind) {
            (Meaning::Scaled(Scale::Exact { decimals, .. }), _) => Decimals::So(decimals as usize),
            (Meaning::Plain, Kind::Int { .. }) => Decimals::So(0),
            (Meaning::Plain | Meaning::Scaled(_), Kind::Float { .. } | Kind::Int { .. }) => Decimals::AsNeeded,
            _ => Decimals::AsShown,
        };
        let unit = Some(self.unit.clone()).filter(|unit| !unit.is_empty());
        ColumnFacts { unit, decimals, aside: self.flag.then_some(Aside::Quality) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::attributes::Attribute;
    use super::*;

    fn scale(factor: Scalar, offset: Scalar) -> Option<Scale> {
        let about = [("scale_factor", factor), ("add_offset", offset)];
        let about = about.map(|(name, value)| (name.to_owned(), Attribute::Numbers(vec![value])));
        Scale::of(&Attributes(about.to_vec()), &Kind::Int { size: 2, signed: true, big: false })
    }

    #[test]
    fn short_factors_are_exact() {
        assert_eq!(
            scale(Scalar::F32(0.01), Scalar::F64(273.15)),
            Some(Scale::Exact { factor: 1, offset: 27_315, decimals: 2 })
        );
        assert_eq!(
            scale(Scalar::F64(1e-4), Scalar::Int(20)),
            Some(Scale::Exact { factor: 1, offset: 200_000, decimals: 4 })
        );
        assert_eq!(scale(Scalar::F64(1.0), Scalar::F64(0.0)), None);
        let odd = scale(Scalar::F64(0.001_525_902_189_669_64), Scalar::F64(0.0));
        assert!(matches!(odd, Some(Scale::Float { single: false, .. })), "{odd:?}");
    }
}
