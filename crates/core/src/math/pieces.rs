//! Long passes over many values, cut into pieces that do not depend on the number of threads. Before each piece
//! somebody is asked whether to go on, so that work nobody waits for ends within a piece.

use std::convert::Infallible;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// Values in one piece: some ten to a hundred microseconds of work.
pub const PIECE: usize = 16_384;

/// Asked before each piece of a long pass; an error ends the pass, which gives it back.
pub trait Check<E>: Fn() -> Result<(), E> + Sync {}

impl<E, F: Fn() -> Result<(), E> + Sync> Check<E> for F {}

/// The check of a pass that runs to its end.
///
/// # Errors
/// None.
pub fn to_the_end() -> Result<(), Infallible> {
    Ok(())
}

/// What a pass that runs to its end gives.
pub fn certain<T>(result: Result<T, Infallible>) -> T {
    let Ok(value) = result;
    value
}

/// What `work` makes of each piece of `0 .. n`, in order; the pieces are worked on in parallel.
///
/// # Errors
/// What `check` gives.
pub fn map<R: Send, E: Send>(
    n: usize,
    check: &impl Check<E>,
    work: impl Fn(Range<usize>) -> R + Sync,
) -> Result<Vec<R>, E> {
    let made: Vec<Mutex<Option<R>>> = (0..n.div_ceil(PIECE)).map(|_| Mutex::new(None)).collect();
    in_parallel(made.len(), check, &|piece| {
        let of_piece = work(piece * PIECE..n.min((piece + 1) * PIECE));
        *made[piece].lock().unwrap_or_else(PoisonError::into_inner) = Some(of_piece);
    })?;
    Ok(made.into_iter().filter_map(|of_piece| of_piece.into_inner().unwrap_or_else(PoisonError::into_inner)).collect())
}

/// Calls `work` with `0 .. pieces`, in parallel.
///
/// The work is behind a pointer, so that the machinery of rayon is compiled once and not for each of its some fifty
/// callers: a twentieth of the program.
fn in_parallel<E: Send>(pieces: usize, check: &impl Check<E>, work: &(dyn Fn(usize) + Sync)) -> Result<(), E> {
    let refused = Mutex::new(None);
    let goes_on = |piece| match check() {
        Ok(()) => {
            work(piece);
            true
        }
        Err(e) => {
            *refused.lock().unwrap_or_else(PoisonError::into_inner) = Some(e);
            false
        }
    };
    while_it_goes_on(pieces, &goes_on);
    refused.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

fn while_it_goes_on(pieces: usize, goes_on: &(dyn Fn(usize) -> bool + Sync)) {
    // Whoever refused has kept the reason.
    let _ = (0..pieces).into_par_iter().try_for_each(|piece| goes_on(piece).then_some(()));
}

/// Hands each piece of `out` to `work`, with the index of its first value; in parallel.
///
/// # Errors
/// What `check` gives; some pieces have not been worked on then.
pub fn over<T: Send, E: Send>(
    out: &mut [T],
    check: &impl Check<E>,
    work: impl Fn(usize, &mut [T]) + Sync,
) -> Result<(), E> {
    let parts: Vec<Mutex<&mut [T]>> = out.chunks_mut(PIECE).map(Mutex::new).collect();
    in_parallel(parts.len(), check, &|piece| {
        let mut out = parts[piece].lock().unwrap_or_else(PoisonError::into_inner);
        work(piece * PIECE, &mut out);
    })
}

/// `value(0 .. n)`, in parallel.
///
/// # Errors
/// What `check` gives.
pub fn collect<T: Copy + Default + Send, E: Send>(
    n: usize,
    check: &impl Check<E>,
    value: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, E> {
    // Memory that the system hands out as zeros is first touched piece by piece.
    let mut all = vec![T::default(); n];
    over(&mut all, check, |first, out| {
        for (i, out) in out.iter_mut().enumerate() {
            *out = value(first + i);
        }
    })?;
    Ok(all)
}

/// Adds copies of `values` at the end of `all`.
///
/// # Errors
/// What `check` gives.
pub fn extend<T: Copy, E>(all: &mut Vec<T>, values: &[T], check: &impl Check<E>) -> Result<(), E> {
    all.reserve_exact(values.len());
    for piece in values.chunks(PIECE) {
        check()?;
        all.extend_from_slice(piece);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn a_pass_asks_once_for_each_piece_and_gives_every_value_its_place() {
        let n = 3 * PIECE + 5;
        let asked = AtomicUsize::new(0);
        let check = || {
            asked.fetch_add(1, Ordering::Relaxed);
            Ok::<(), ()>(())
        };
        let squares = collect(n, &check, |i| i * i).unwrap();
        assert!(squares.iter().enumerate().all(|(i, s)| *s == i * i));
        let sums = map(n, &check, |piece| piece.len()).unwrap();
        assert_eq!(sums, [PIECE, PIECE, PIECE, 5]);
        let mut twice = squares.clone();
        extend(&mut twice, &squares, &check).unwrap();
        assert_eq!((twice.len(), &twice[n..]), (2 * n, &squares[..]));
        assert_eq!(asked.into_inner(), 3 * 4);
    }

    #[test]
    fn a_refusal_ends_a_pass() {
        let no = || Err::<(), &str>("no");
        assert_eq!(map(1, &no, |_| ()), Err("no"));
        assert_eq!(collect(PIECE + 1, &no, |i| i), Err("no"));
        assert_eq!(extend(&mut Vec::new(), &[1], &no), Err("no"));
        assert_eq!(certain(collect(3, &to_the_end, |i| i)), [0, 1, 2]);
    }
}
