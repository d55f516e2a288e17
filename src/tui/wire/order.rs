//! In which order cells are put: what a frame changes is a few cells here and there, and half of its bytes are the ways
//! between them.

use super::encode::Put;
use super::moves::{At, step};
use super::pen::{PLAIN, Pen, change};
use super::shown::Shown;

/// Stretches of cells up to which ways are looked for: the search takes their square. A frame of more is mostly text.
const MOST: usize = 160;

/// How much a change of look counts beside a move when the next stretch is chosen. What changes the look early comes
/// back for the rest later: more than its own bytes. Which serves best differs from frame to frame.
const WEIGHTS: [usize; 3] = [1, 2, 8];

/// Orders to choose from: row by row, look by look, and from each stretch to the one that is reached by the fewest
/// bytes.
pub(super) fn orders<'a>(puts: &[Put<'a>], shown: &Shown) -> Vec<Vec<Put<'a>>> {
    let by_row = puts.to_vec();
    let looks = looks(puts);
    let mut by_look = puts.to_vec();
    by_look.sort_by_key(|put| looks.iter().position(|look| *look == put.pen));
    let mut all = vec![by_row, by_look];
    let stretches = stretches(puts);
    if (3..=MOST).contains(&stretches.len()) {
        let changes = changes(&looks);
        let nearest = WEIGHTS.map(|weight| nearest(&stretches, &looks, &changes, weight, shown));
        all.extend(nearest.map(|order| order.into_iter().flatten().copied().collect()));
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

/// Bytes of the change from one look (the row) to another.
fn changes(looks: &[Pen]) -> Vec<Vec<usize>> {
    let bytes = |from: &Pen, to: &Pen| {
        let mut out = String::new();
        if from != to {
            change(&mut out, *from, *to);
        }
        out.len()
    };
    looks.iter().map(|from| looks.iter().map(|to| bytes(from, to)).collect()).collect()
}

/// Cells beside each other that look the same.
fn stretches<'p, 'a>(puts: &'p [Put<'a>]) -> Vec<&'p [Put<'a>]> {
    puts.chunk_by(|a, b| a.pen == b.pen && a.y == b.y && a.end(0).x == b.x).collect()
}

/// From each stretch to the nearest one that is left.
fn nearest<'p, 'a>(
    stretches: &[&'p [Put<'a>]],
    looks: &[Pen],
    changes: &[Vec<usize>],
    weight: usize,
    shown: &Shown,
) -> Vec<&'p [Put<'a>]> {
    let look = |pen: Pen| looks.iter().position(|look| *look == pen).unwrap_or(0);
    let mut left: Vec<(usize, &[Put<'_>])> = stretches.iter().map(|s| (look(s[0].pen), *s)).collect();
    let mut order = Vec::with_capacity(left.len());
    let (mut at, mut pen) = (None::<At>, 0);
    let mut way = String::new();
    while !left.is_empty() {
        let bytes = |way: &mut String, &(look, stretch): &(usize, &[Put<'_>])| {
            way.clear();
            step(way, at, (stretch[0].x, stretch[0].y), looks[pen], shown);
            way.len() + weight * changes[pen][look]
        };
        let costs = left.iter().map(|next| bytes(&mut way, next));
        let Some((next, _)) = costs.enumerate().min_by_key(|(_, cost)| *cost) else { break };
        let (look, stretch) = left.remove(next);
        way.clear();
        let doubt = step(&mut way, at, (stretch[0].x, stretch[0].y), looks[pen], shown);
        at = Some(stretch.iter().fold(At { x: 0, y: 0, doubt }, |at, put| put.end(at.doubt)));
        pen = look;
        order.push(stretch);
    }
    order
}
