//! Extremes of any range of samples in logarithmic time.
//!
//! Level 0 holds the extremes of blocks of 64 samples, each further level those of 8 nodes below. A trace of 10^7
//! samples is so reduced to the columns of a screen in well under a millisecond, and no extreme is ever lost.

use std::ops::Range;

use rayon::prelude::*;

use crate::stop::{Stop, Stopped};

/// Samples in a block of the lowest level.
pub(crate) const BLOCK: usize = 64;
/// Nodes of one level under a node of the next.
const FAN_OUT: usize = 8;

/// The lowest and highest of some values; empty when `low > high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The lowest value.
    pub low: f64,
    /// The highest value.
    pub high: f64,
}

impl Span {
    /// The span of no values.
    pub const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// The span of one value; that of NaN is empty in every union.
    #[must_use]
    #[inline]
    pub fn at(value: f64) -> Self {
        Self { low: value, high: value }
    }

    /// True when it holds no value.
    #[must_use]
    #[inline]
    pub fn is_empty(self) -> bool {
        // Written so that a NaN end counts as empty too.
        self.low.is_nan() || self.high.is_nan() || self.low > self.high
    }

    /// The span over both. NaN ends are passed over.
    #[must_use]
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self {
            low: if other.low < self.low { other.low } else { self.low },
            high: if other.high > self.high { other.high } else { self.high },
        }
    }
}

/// Looks at values of a pyramid and says which parts are worth a closer look.
pub(crate) trait Visitor {
    /// Is any value of a node with these extremes still of interest?
    fn enter(&mut self, span: Span) -> bool;
    /// The same for a node of the lowest level, of which a visitor may know more.
    fn enter_block(&mut self, block: usize, span: Span) -> bool;
    /// A position of a node that was entered, or of one that lies only partly in the range.
    fn visit(&mut self, position: usize);
}

/// Extremes of a list of values (or of spans), level by level. It does not hold the values: they are read again at
/// the ends of a range, through the closure it was built with.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pyramid {
    len: usize,
    levels: Vec<Vec<Span>>,
}

impl Pyramid {
    /// The pyramid over the values of `y` that are not hidden.
    #[must_use]
    pub fn build(y: &[f64], is_hidden: impl Fn(usize) -> bool + Sync) -> Self {
        Self::build_spans(y.len(), kept(y, is_hidden))
    }

    /// Rebuilds what depends on the positions of `range`, whose values or hiding have changed.
    pub fn update(&mut self, y: &[f64], is_hidden: impl Fn(usize) -> bool, range: Range<usize>) {
        self.update_spans(kept(y, is_hidden), range);
    }

    /// Lowest and highest value of `range` that is not hidden; none when all are (or are NaN).
    #[must_use]
    pub fn min_max(&self, y: &[f64], is_hidden: impl Fn(usize) -> bool, range: Range<usize>) -> Option<(f64, f64)> {
        let span = self.span_over(kept(y, is_hidden), range.start..range.end.min(y.len()));
        (!span.is_empty()).then_some((span.low, span.high))
    }

    /// The pyramid over `len` spans; [`Span::EMPTY`] where there is no value.
    #[must_use]
    pub fn build_spans(len: usize, span: impl Fn(usize) -> Span + Sync) -> Self {
        // Nobody stops it: it is always there.
        Self::build_spans_unless(len, span, &Stop::never()).unwrap_or_default()
    }

    /// [`Pyramid::build_spans`] that may be abandoned.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for it any more.
    pub fn build_spans_unless(len: usize, span: impl Fn(usize) -> Span + Sync, stop: &Stop) -> Result<Self, Stopped> {
        Self::build_blocks(len, |block| block.fold(Span::EMPTY, |all, i| all.union(span(i))), stop)
    }

    /// The pyramid over `len` spans, of which `over_range` gives the union over a range.
    pub(super) fn build_blocks(
        len: usize,
        over_range: impl Fn(Range<usize>) -> Span + Sync,
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        /// Blocks in one piece of parallel work.
        const PIECE: usize = 256;
        let mut pyramid = Self { len, levels: Vec::new() };
        let mut nodes = vec![Span::EMPTY; len.div_ceil(BLOCK)];
        nodes.par_chunks_mut(PIECE).enumerate().try_for_each(|(piece, nodes)| {
            stop.check()?;
            for (node, span) in (piece * PIECE..).zip(nodes) {
                *span = over_range(node * BLOCK..len.min((node + 1) * BLOCK));
            }
            Ok(())
        })?;
        while !nodes.is_empty() {
            stop.check()?;
            let next: Vec<Span> = nodes.chunks(FAN_OUT).map(over).collect();
            let at_top = nodes.len() <= FAN_OUT;
            pyramid.levels.push(nodes);
            if at_top {
                break;
            }
            nodes = next;
        }
        Ok(pyramid)
    }

    /// Rebuilds what depends on the positions of `range`.
    pub fn update_spans(&mut self, span: impl Fn(usize) -> Span, range: Range<usize>) {
        let end = range.end.min(self.len);
        if range.start >= end {
            return;
        }
        let (mut first, mut last) = (range.start / BLOCK, (end - 1) / BLOCK);
        for level in 0..self.levels.len() {
            let (below, here) = self.levels.split_at_mut(level);
            for node in first..=last {
                here[0][node] = match below.last() {
                    None => block_span(node, self.len, &span),
                    Some(below) => over(&below[node * FAN_OUT..below.len().min((node + 1) * FAN_OUT)]),
                };
            }
            (first, last) = (first / FAN_OUT, last / FAN_OUT);
        }
    }

    /// The span over `range`, cut to the pyramid's length.
    #[must_use]
    pub fn span_over(&self, span: impl Fn(usize) -> Span, range: Range<usize>) -> Span {
        let end = range.end.min(self.len);
        let scan = |range: Range<usize>| range.fold(Span::EMPTY, |all, i| all.union(span(i)));
        let (first, last) = (range.start.div_ceil(BLOCK), end / BLOCK);
        if first >= last {
            return scan(range.start..end);
        }
        scan(range.start..first * BLOCK).union(scan(last * BLOCK..end)).union(self.over_nodes(0, first, last))
    }

    fn over_nodes(&self, mut level: usize, mut first: usize, mut last: usize) -> Span {
        let mut all = Span::EMPTY;
        while let Some(nodes) = self.levels.get(level) {
            let (up_first, up_last) = (first.div_ceil(FAN_OUT), last / FAN_OUT);
            if level + 1 == self.levels.len() || up_first >= up_last {
                return all.union(over(&nodes[first..last]));
            }
            all = all.union(over(&nodes[first..up_first * FAN_OUT])).union(over(&nodes[up_last * FAN_OUT..last]));
            (level, first, last) = (level + 1, up_first, up_last);
        }
        all
    }

    /// Shows a visitor the positions of `range`, from the coarse nodes down.
    pub(crate) fn walk(&self, range: Range<usize>, visitor: &mut impl Visitor) {
        let range = range.start..range.end.min(self.len);
        if let Some(top) = self.levels.len().checked_sub(1) {
            let size = node_size(top);
            for node in range.start / size..range.end.div_ceil(size) {
                self.walk_node(top, node, &range, visitor);
            }
        }
    }

    fn walk_node(&self, level: usize, node: usize, range: &Range<usize>, visitor: &mut impl Visitor) {
        let size = node_size(level);
        let (start, end) = (node * size, ((node + 1) * size).min(self.len));
        if start >= range.end || end <= range.start {
            return;
        }
        let whole = range.start <= start && end <= range.end;
        let span = self.levels[level][node];
        let wanted = !whole || if level == 0 { visitor.enter_block(node, span) } else { visitor.enter(span) };
        if !wanted {
            return;
        }
        if level == 0 {
            (start.max(range.start)..end.min(range.end)).for_each(|position| visitor.visit(position));
            return;
        }
        for child in node * FAN_OUT..self.levels[level - 1].len().min((node + 1) * FAN_OUT) {
            self.walk_node(level - 1, child, range, visitor);
        }
    }

    /// How many values it was built over.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// True when it was built over nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
}

fn node_size(level: usize) -> usize {
    (0..level).fold(BLOCK, |size, _| size * FAN_OUT)
}

fn kept<'a, F: Fn(usize) -> bool + 'a>(y: &'a [f64], is_hidden: F) -> impl Fn(usize) -> Span + use<'a, F> {
    move |i| if is_hidden(i) { Span::EMPTY } else { Span::at(y[i]) }
}

#[inline]
fn block_span(node: usize, len: usize, span: &impl Fn(usize) -> Span) -> Span {
    (node * BLOCK..((node + 1) * BLOCK).min(len)).fold(Span::EMPTY, |all, i| all.union(span(i)))
}

fn over(nodes: &[Span]) -> Span {
    nodes.iter().fold(Span::EMPTY, |all, &node| all.union(node))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn scan(y: &[f64], hidden: &[bool], range: Range<usize>) -> Option<(f64, f64)> {
        let kept: Vec<f64> = range.filter(|&i| !hidden[i] && !y[i].is_nan()).map(|i| y[i]).collect();
        let low = kept.iter().copied().reduce(f64::min)?;
        Some((low, kept.iter().copied().reduce(f64::max)?))
    }

    struct Seen(Vec<usize>);

    impl Visitor for Seen {
        fn enter(&mut self, _: Span) -> bool {
            true
        }

        fn enter_block(&mut self, _: usize, _: Span) -> bool {
            true
        }

        fn visit(&mut self, position: usize) {
            self.0.push(position);
        }
    }

    fn samples() -> impl Strategy<Value = (Vec<f64>, Vec<bool>, usize, usize)> {
        (0_usize..2000).prop_flat_map(|n| {
            let value = prop_oneof![9 => -1e3..1e3, 1 => Just(f64::NAN), 1 => Just(f64::INFINITY)];
            let lists = (prop::collection::vec(value, n), prop::collection::vec(prop::bool::weighted(0.3), n));
            (lists, 0..=n, 0..=n).prop_map(|((y, hidden), a, b)| (y, hidden, a.min(b), a.max(b)))
        })
    }

    proptest! {
        #[test]
        fn extremes_are_those_of_a_plain_scan((y, hidden, a, b) in samples()) {
            let pyramid = Pyramid::build(&y, |i| hidden[i]);
            prop_assert_eq!(pyramid.min_max(&y, |i| hidden[i], a..b), scan(&y, &hidden, a..b));
        }

        #[test]
        fn an_update_of_what_changed_is_a_rebuild((y, mut hidden, a, b) in samples(), value in -2e3..2e3) {
            let mut pyramid = Pyramid::build(&y, |i| hidden[i]);
            let mut y = y;
            for i in a..b {
                y[i] = if i % 3 == 0 { value } else { y[i] };
                hidden[i] = !hidden[i];
            }
            pyramid.update(&y, |i| hidden[i], a..b);
            prop_assert_eq!(pyramid, Pyramid::build(&y, |i| hidden[i]));
        }

        #[test]
        fn a_walk_without_exits_visits_every_position_once((y, _, a, b) in samples()) {
            let pyramid = Pyramid::build(&y, |_| false);
            let mut seen = Seen(Vec::new());
            pyramid.walk(a..b, &mut seen);
            prop_assert_eq!(seen.0, (a..b).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_million_samples_have_five_levels_and_cut_ranges_are_safe() {
        let y: Vec<f64> = (0..1_000_000_u32).map(f64::from).collect();
        let pyramid = Pyramid::build(&y, |i| i == 999_999);
        assert_eq!(pyramid.levels.iter().map(Vec::len).collect::<Vec<_>>(), [15_625, 1954, 245, 31, 4]);
        assert_eq!(pyramid.min_max(&y, |i| i == 999_999, 63..usize::MAX), Some((63.0, 999_998.0)));
        assert_eq!(pyramid.min_max(&y, |_| false, 7..7), None);
        assert_eq!(Pyramid::build(&[], |_| false).min_max(&[], |_| false, 0..5), None);
    }
}
