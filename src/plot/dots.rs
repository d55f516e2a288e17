//! A raster of dots, two by four to a cell, and lines on it.

use super::scale::DOTS_PER_ROW;

/// Columns of dots in a cell.
pub(crate) const DOTS_PER_COLUMN: usize = 2;

/// Bits of the braille pattern, by column and row of the dot in its cell.
const BITS: [[u8; DOTS_PER_ROW]; DOTS_PER_COLUMN] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

/// Dots of a plot of `width` by `height` cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Dots {
    width: usize,
    height: usize,
    cells: Vec<u8>,
}

impl Dots {
    pub(crate) fn new(width: u16, height: u16) -> Self {
        let (width, height) = (usize::from(width), usize::from(height));
        Self { width, height, cells: vec![0; width * height] }
    }

    /// Rows of dots.
    fn rows(&self) -> i32 {
        (self.height * DOTS_PER_ROW) as i32
    }

    /// Columns of dots.
    fn columns(&self) -> i32 {
        (self.width * DOTS_PER_COLUMN) as i32
    }

    /// Lights a dot; one outside the plot is passed over.
    #[inline]
    pub(crate) fn set(&mut self, column: i32, row: i32) {
        if column >= 0 && row >= 0 && column < self.columns() && row < self.rows() {
            let (column, row) = (column as usize, row as usize);
            let cell = row / DOTS_PER_ROW * self.width + column / DOTS_PER_COLUMN;
            self.cells[cell] |= BITS[column % DOTS_PER_COLUMN][row % DOTS_PER_ROW];
        }
    }

    /// Lights a column of dots between two rows, both included.
    pub(crate) fn fill(&mut self, column: i32, top: i32, bottom: i32) {
        for row in top.max(0)..=bottom.min(self.rows() - 1) {
            self.set(column, row);
        }
    }

    /// The pattern of a cell; 0 outside the plot.
    #[inline]
    pub(crate) fn mask(&self, column: usize, row: usize) -> u8 {
        if column >= self.width {
            return 0;
        }
        self.cells.get(row * self.width + column).copied().unwrap_or(0)
    }

    /// A straight line between two points, given in columns and rows of dots, ends included. It may reach out of the
    /// plot as far as it likes.
    pub(crate) fn line(&mut self, from: (f64, f64), to: (f64, f64)) {
        let last = (f64::from(self.columns()), f64::from(self.rows()));
        let Some((from, to)) = clipped(from, to, last) else { return };
        let (mut x, mut y) = (from.0.floor() as i32, from.1.floor() as i32);
        let (x1, y1) = (to.0.floor() as i32, to.1.floor() as i32);
        let (dx, dy) = ((x1 - x).abs(), -(y1 - y).abs());
        let (step_x, step_y) = ((x1 - x).signum(), (y1 - y).signum());
        let mut error = dx + dy;
        loop {
            self.set(x, y);
            if x == x1 && y == y1 {
                return;
            }
            // Bresenham's algorithm with one error term for both axes.
            let twice = 2 * error;
            if twice >= dy {
                error += dy;
                x += step_x;
            }
            if twice <= dx {
                error += dx;
                y += step_y;
            }
        }
    }
}

/// The part of a line within a box from (-1, -1) to `last` (Liang and Barsky, ACM TOG 3, 1984); none when it misses
/// it or an end is not a number.
fn clipped(from: (f64, f64), to: (f64, f64), last: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
    // Far enough out to keep slopes, near enough for their differences to be finite.
    let bounded = |v: f64| v.clamp(-1e15, 1e15);
    let (from, to) = ((bounded(from.0), bounded(from.1)), (bounded(to.0), bounded(to.1)));
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    if dx.is_nan() || dy.is_nan() {
        return None;
    }
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let sides = [(-dx, from.0 + 1.0), (dx, last.0 - from.0), (-dy, from.1 + 1.0), (dy, last.1 - from.1)];
    for (step, room) in sides {
        if step == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if step < 0.0 {
            enter = enter.max(room / step);
        } else {
            leave = leave.min(room / step);
        }
    }
    let at = |share: f64| (from.0 + dx * share, from.1 + dy * share);
    let end = if leave < 1.0 { at(leave) } else { to };
    (enter <= leave).then(|| (at(enter), end))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn lit(dots: &Dots) -> Vec<(i32, i32)> {
        let mut lit = Vec::new();
        for column in 0..dots.columns() {
            for row in 0..dots.rows() {
                let mask = dots.mask(column as usize / 2, row as usize / 4);
                if mask & BITS[column as usize % 2][row as usize % 4] != 0 {
                    lit.push((column, row));
                }
            }
        }
        lit
    }

    #[test]
    fn a_line_of_slope_one_half_takes_two_dots_a_row() {
        let mut dots = Dots::new(4, 1);
        dots.line((0.5, 0.5), (7.5, 3.5));
        let rows: Vec<i32> = lit(&dots).iter().map(|dot| dot.1).collect();
        assert_eq!(rows, [0, 0, 1, 1, 2, 2, 3, 3]);
    }

    #[test]
    fn dots_outside_are_passed_over() {
        let mut dots = Dots::new(2, 1);
        [(-1, 0), (0, -1), (4, 0), (0, 4)].iter().for_each(|&(c, r)| dots.set(c, r));
        dots.fill(1, -9, 0);
        assert_eq!(lit(&dots), [(1, 0)]);
        assert_eq!((dots.mask(2, 0), dots.mask(0, 7)), (0, 0));
    }

    proptest! {
        #[test]
        fn lines_are_connected_and_keep_close_to_the_segment(
            x0 in -50.0..90.0_f64, y0 in -50.0..90.0_f64, x1 in -50.0..90.0_f64, y1 in -50.0..90.0_f64,
        ) {
            let mut dots = Dots::new(20, 10);
            dots.line((x0, y0), (x1, y1));
            let (dx, dy) = (x1 - x0, y1 - y0);
            for &(column, row) in &lit(&dots) {
                let cross = (f64::from(column) + 0.5 - x0) * dy - (f64::from(row) + 0.5 - y0) * dx;
                prop_assert!(cross.abs() <= 1.6 * dx.hypot(dy), "dot {} {} is off the line", column, row);
            }
            // An end in the plot is lit.
            if (0.0..40.0).contains(&x1) && (0.0..40.0).contains(&y1) {
                prop_assert!(lit(&dots).contains(&(x1.floor() as i32, y1.floor() as i32)));
            }
        }

        #[test]
        fn any_ends_are_safe(a in any::<f64>(), b in any::<f64>(), c in any::<f64>(), d in any::<f64>()) {
            Dots::new(5, 5).line((a, b), (c, d));
            Dots::new(0, 0).line((a, b), (c, d));
        }
    }
}
