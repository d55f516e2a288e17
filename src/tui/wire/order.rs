//! In which order cells are put: what a frame changes is a few cells here and there, and half of its bytes are the ways
//! between them.

use super::encode::Put;
use super::moves::{At, step};
use super::pen::{PLAIN, Pen, change};
use super::shown::Shown;

/// Stretches of cells up to which a short way is looked for: the search takes their square. A frame of more is mostly
/// text.
const MOST: usize = 160;

/// How much a change of look counts beside a move when the next stretch is chosen. What changes the look early comes
/// back for the rest later: more than its own bytes. Which serves best differs from frame to frame.
const WEIGHTS: [usize; 3] = [1, 2, 8];

/// Stretches that are moved together when a way is made shorter.
const TOGETHER: usize = 3;

/// Passes of shortening; most ways are as short as they get after three.
const PASSES: usize = 6;

/// Orders to choose from: row by row, look by look, and short ways from stretch to stretch.
pub(super) fn orders<'a>(puts: &[Put<'a>], shown: &Shown) -> Vec<Vec<Put<'a>>> {
    let looks = looks(puts);
    let mut by_look = puts.to_vec();
    by_look.sort_by_key(|put| looks.iter().position(|look| *look == put.pen));
    let mut all = vec![puts.to_vec(), by_look];
    let stretches = stretches(puts);
    if (3..=MOST).contains(&stretches.len()) {
        let ways = Ways::between(&stretches, &looks, shown);
        all.extend(WEIGHTS.map(|weight| {
            let order = ways.shortened(ways.nearest(weight));
            order.into_iter().flat_map(|at| stretches[at]).copied().collect()
        }));
    }
    all
}

/// The looks there are, the plain one first: it needs no attributes at all.
fn looks(puts: &[Put<'_>]) -> Vec<Pen> {
    let mut looks = vec![PLAIN];
    for put in puts {
        if !looks.contains(&put.pen) {
            looks.push(put.pen);
        }
    }
    looks
}

/// Cells beside each other that look the same.
fn stretches<'p, 'a>(puts: &'p [Put<'a>]) -> Vec<&'p [Put<'a>]> {
    puts.chunk_by(|a, b| a.pen == b.pen && a.y == b.y && a.end(0).x == b.x).collect()
}

/// Bytes from each of some places to each.
struct Ways {
    places: usize,
    /// Of the move; row by row, one for each place that one comes from. The last row is the start, the last column the
    /// end.
    moves: Vec<usize>,
    /// Of the change of look, likewise.
    changes: Vec<usize>,
}

impl Ways {
    fn between(stretches: &[&[Put<'_>]], looks: &[Pen], shown: &Shown) -> Self {
        let places = stretches.len();
        let index = |pen: Pen| looks.iter().position(|look| *look == pen).unwrap_or(0);
        let of_looks: Vec<Vec<usize>> =
            looks.iter().map(|from| looks.iter().map(|to| bytes(*from, *to)).collect()).collect();
        // A cursor that is in doubt before a stretch is seldom so after it: the way to it has settled that.
        let after = |stretch: &[Put<'_>]| stretch.iter().fold(0, |doubt, put| put.end(doubt).doubt);
        let mut ways = Self { places, moves: Vec::new(), changes: Vec::new() };
        let mut way = String::new();
        let starts = stretches.iter().map(|s| (index(s[0].pen), s.last().map(|put| put.end(after(&s[..s.len() - 1])))));
        for (look, at) in starts.chain([(0, None::<At>)]) {
            for to in stretches {
                way.clear();
                step(&mut way, at, (to[0].x, to[0].y), looks[look], shown);
                ways.moves.push(way.len());
                ways.changes.push(of_looks[look][index(to[0].pen)]);
            }
            ways.moves.push(0);
            ways.changes.push(of_looks[look][0]);
        }
        ways
    }

    /// From a place, or the start, to a place, or the end.
    fn bytes(&self, from: Option<usize>, to: Option<usize>) -> usize {
        let at = self.at(from, to);
        self.moves[at] + self.changes[at]
    }

    fn at(&self, from: Option<usize>, to: Option<usize>) -> usize {
        from.unwrap_or(self.places) * (self.places + 1) + to.unwrap_or(self.places)
    }

    /// From each place to the nearest one that is left.
    fn nearest(&self, weight: usize) -> Vec<usize> {
        let mut left: Vec<usize> = (0..self.places).collect();
        let mut order: Vec<usize> = Vec::with_capacity(self.places);
        while !left.is_empty() {
            let far = |to: usize| {
                let at = self.at(order.last().copied(), Some(to));
                self.moves[at] + weight * self.changes[at]
            };
            let Some(next) = (0..left.len()).min_by_key(|&i| far(left[i])) else { break };
            order.push(left.remove(next));
        }
        order
    }

    /// The order with places, up to three together, moved to where that makes the way shorter.
    fn shortened(&self, mut order: Vec<usize>) -> Vec<usize> {
        for _ in 0..PASSES {
            let mut better = false;
            for length in 1..=TOGETHER {
                for from in 0..=order.len().saturating_sub(length) {
                    better |= self.moved(&mut order, from, length);
                }
            }
            if !better {
                break;
            }
        }
        order
    }

    /// Moves the places from `from` on to where they cost least; true when that is elsewhere.
    fn moved(&self, order: &mut Vec<usize>, from: usize, length: usize) -> bool {
        let at = |order: &[usize], i: Option<usize>| i.and_then(|i| order.get(i).copied());
        let detour = |before: Option<usize>, part: &[usize], after: Option<usize>| {
            self.bytes(before, part.first().copied()) + self.bytes(part.last().copied(), after)
        };
        let part: Vec<usize> = order.splice(from..from + length, []).collect();
        let cost = |order: &[usize], gap: usize| {
            let (before, after) = (at(order, gap.checked_sub(1)), at(order, Some(gap)));
            detour(before, &part, after) as isize - self.bytes(before, after) as isize
        };
        let here = cost(order, from);
        let best = (0..=order.len()).min_by_key(|gap| (cost(order, *gap), gap.abs_diff(from))).unwrap_or(from);
        let better = cost(order, best) < here;
        let to = if better { best } else { from };
        order.splice(to..to, part);
        better
    }
}

fn bytes(from: Pen, to: Pen) -> usize {
    let mut out = String::new();
    if from != to {
        change(&mut out, from, to);
    }
    out.len()
}
