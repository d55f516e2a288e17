//! What to inject, as it is typed.

use std::str::FromStr;

use super::{Amount, Patches, Span, Step};

impl FromStr for Amount {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let wanted = || format!("`{text}`: expected a number of samples (20) or a share of them (1%)");
        match text.trim().strip_suffix('%') {
            Some(part) => match part.trim().parse::<f64>() {
                Ok(p) if (0.0..=50.0).contains(&p) => Ok(Self::Part(p / 100.0)),
                _ => Err(format!("`{text}`: expected 0% to 50%")),
            },
            None => text.trim().parse().map(Self::Count).map_err(|_| wanted()),
        }
    }
}

impl FromStr for Patches {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let parsed = text.split_once('x').and_then(|(count, length)| {
            let (shortest, longest) = length.split_once("..").unwrap_or((length, length));
            let number = |s: &str| s.trim().parse::<usize>().ok();
            Some(Self { count: number(count)?, shortest: number(shortest)?, longest: number(longest)? })
        });
        parsed.filter(|p| 2 <= p.shortest && p.shortest <= p.longest).ok_or_else(|| {
            format!("`{text}`: expected COUNTxLENGTH or COUNTxLOW..HIGH, for example 5x3..8, lengths from 2")
        })
    }
}

impl FromStr for Span {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let (low, high) = text.split_once("..").unwrap_or((text, text));
        let number = |s: &str| s.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        match (number(low), number(high)) {
            (Some(low), Some(high)) if 0.0 < low && low <= high => Ok(Self { low, high }),
            _ => Err(format!("`{text}`: expected LOW..HIGH above 0, for example 5..20")),
        }
    }
}

impl FromStr for Step {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let (size, at) = match text.split_once('@') {
            Some((size, at)) => (size, Some(at)),
            None => (text, None),
        };
        let number = |s: &str| s.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        let at = at.map(|at| number(at).filter(|s| *s >= 0.0));
        match (number(size), at) {
            (Some(size), None) if size != 0.0 => Ok(Self { size, at: None }),
            (Some(size), Some(Some(at))) if size != 0.0 => Ok(Self { size, at: Some(at) }),
            _ => Err(format!("`{text}`: expected SIZE or SIZE@SECONDS, for example 10@1239.5")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_are_read_from_text() {
        assert_eq!("1.5%".parse(), Ok(Amount::Part(0.015)));
        assert_eq!("20".parse(), Ok(Amount::Count(20)));
        assert_eq!("5x3..8".parse(), Ok(Patches { count: 5, shortest: 3, longest: 8 }));
        assert_eq!("2x4".parse(), Ok(Patches { count: 2, shortest: 4, longest: 4 }));
        assert_eq!("5..20".parse(), Ok(Span { low: 5.0, high: 20.0 }));
        assert_eq!("-10@12.5".parse(), Ok(Step { size: -10.0, at: Some(12.5) }));
        assert!("80%".parse::<Amount>().is_err() && "x".parse::<Amount>().is_err());
        assert!("5x1".parse::<Patches>().is_err() && "5".parse::<Patches>().is_err());
        assert!("0..3".parse::<Span>().is_err() && "5..2".parse::<Span>().is_err() && "nan".parse::<Span>().is_err());
        assert!("0".parse::<Step>().is_err() && "3@x".parse::<Step>().is_err());
    }
}
