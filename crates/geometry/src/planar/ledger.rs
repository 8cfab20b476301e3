//! Which parts of a frontier edge are closed, and why.

use super::Interval;

/// Parameters are kept as multiples of `2^-53`: sums and differences of them in `[0, 1]` are exact.
const GRID: f64 = (1_u64 << 53) as f64;

/// A closed stretch of a frontier edge and the reason why it was closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Closed<R> {
    /// The stretch; never empty.
    pub span: Interval,
    /// Why it is closed.
    pub reason: R,
}

/// Which parts of a frontier edge are closed, and why; everything else is open.
///
/// Closed stretches are disjoint and in order. Parameters are rounded to multiples of `2^-53` when
/// they come in, so that the open and the closed share add up to 1 exactly. An edge that is all
/// open owns no memory.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeLedger<R> {
    closed: Vec<Closed<R>>,
}

impl<R> Default for EdgeLedger<R> {
    fn default() -> Self {
        Self { closed: Vec::new() }
    }
}

impl<R: Clone> EdgeLedger<R> {
    /// An edge that is all open.
    pub fn new() -> Self {
        Self::default()
    }

    /// Closes what is open of `span` and appends the newly closed parts to `newly`, in order.
    ///
    /// What was closed keeps its first reason. A span is cut to the edge; an empty one, or one with
    /// NaN, closes nothing. O(closed stretches).
    pub fn close(&mut self, span: Interval, reason: &R, newly: &mut Vec<Interval>) {
        let span = on_grid(span);
        if span.is_empty() || span.from.is_nan() || span.to.is_nan() {
            return;
        }
        let begin = self.closed.partition_point(|c| c.span.to <= span.from);
        let count = self.closed[begin..].iter().take_while(|c| c.span.from < span.to).count();
        let first_new = newly.len();
        let mut reached = span.from;
        for c in &self.closed[begin..begin + count] {
            if reached < c.span.from {
                newly.push(Interval::new(reached, c.span.from));
            }
            reached = c.span.to;
        }
        if reached < span.to {
            newly.push(Interval::new(reached, span.to));
        }
        let added = &newly[first_new..];
        if added.is_empty() {
            return;
        }
        self.closed.extend(added.iter().map(|&span| Closed { span, reason: reason.clone() }));
        self.closed[begin..].sort_by(|a, b| a.span.from.total_cmp(&b.span.from));
    }

    /// Opens again every stretch whose reason `relied` names, and appends those stretches in order.
    ///
    /// A stretch that another volume could also close opens too: the caller closes it again with
    /// the other reason. O(closed stretches).
    pub fn reopen(&mut self, mut relied: impl FnMut(&R) -> bool, reopened: &mut Vec<Interval>) {
        self.closed.retain(|c| {
            let opens = relied(&c.reason);
            if opens {
                reopened.push(c.span);
            }
            !opens
        });
    }

    /// The maximal open stretches, in order.
    pub fn open(&self) -> impl Iterator<Item = Interval> + '_ {
        let ends = self.closed.iter().map(|c| c.span.to);
        let starts = self.closed.iter().map(|c| c.span.from);
        std::iter::once(0.0)
            .chain(ends)
            .zip(starts.chain(std::iter::once(1.0)))
            .map(|(from, to)| Interval::new(from, to))
            .filter(|open| !open.is_empty())
    }

    /// The closed stretches with their reasons, disjoint and in order.
    pub fn closed(&self) -> &[Closed<R>] {
        &self.closed
    }

    /// The reason why the edge is closed at a parameter, if it is.
    ///
    /// Stretches count as closed at their beginning and open at their end. O(log closed stretches).
    pub fn reason_at(&self, parameter: f64) -> Option<&R> {
        let after = self.closed.partition_point(|c| c.span.from <= parameter);
        let last = self.closed[..after].last()?;
        (parameter < last.span.to).then_some(&last.reason)
    }

    /// Whether nothing is open.
    pub fn is_closed(&self) -> bool {
        self.open().next().is_none()
    }

    /// Whether nothing is closed.
    pub fn is_open(&self) -> bool {
        self.closed.is_empty()
    }

    /// The open share of the edge; with [`closed_share`](Self::closed_share) exactly 1.
    pub fn open_share(&self) -> f64 {
        self.open().map(|open| open.share()).sum()
    }

    /// The closed share of the edge.
    pub fn closed_share(&self) -> f64 {
        self.closed.iter().map(|c| c.span.share()).sum()
    }
}

/// The span cut to `[0, 1]` and rounded to the grid.
fn on_grid(span: Interval) -> Interval {
    let round = |t: f64| (t.clamp(0.0, 1.0) * GRID).round() / GRID;
    Interval::new(round(span.from), round(span.to))
}
