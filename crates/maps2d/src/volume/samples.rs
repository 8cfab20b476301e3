//! Where rays ended, in the order of their bearings around one place.

use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

use geometry::Point2;
use pose::{Se2, wrap_angle};
use sensing::{Reading, Scan};

/// The end of one ray, in the frame of its volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Bearing of the ray in the volume's frame, radians in (-π, π].
    pub bearing_rad: f64,
    /// Range, metres; the sensor's range where nothing was met.
    pub range_m: f64,
    /// Whether the ray met something within range.
    pub hit: bool,
    /// The end of the ray in the volume's frame, metres.
    pub end_in_anchor: Point2,
}

/// Bearings of arcs that differ by less are the same, radians.
const ARC_SLACK_RAD: f64 = 1e-9;

/// An arc of bearings that was looked at: from `start_rad` counter-clockwise over `span_rad`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Arc {
    start_rad: f64,
    span_rad: f64,
}

impl Arc {
    /// Whether the arc from `from_rad` over `span_rad` lies inside.
    fn holds(&self, from_rad: f64, span_rad: f64) -> bool {
        // In a full circle the start is like any other bearing.
        self.span_rad >= TAU
            || self.offset_rad(from_rad) + span_rad <= self.span_rad + ARC_SLACK_RAD
    }

    /// How far a bearing lies counter-clockwise from the start, radians; a hair before it is at it.
    fn offset_rad(&self, bearing_rad: f64) -> f64 {
        let offset = wrap_angle(bearing_rad - self.start_rad);
        if offset < -ARC_SLACK_RAD { offset + TAU } else { offset.max(0.0) }
    }
}

/// All that was seen from one place: samples by rising bearing, and which neighbours belong together.
///
/// Scans from the same place may be [added](Self::add) while the robot turns. Readings at the
/// sensor itself (up to a nanometre) bound nothing: they split the view into two, with a gap between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    samples: Vec<Sample>,
    gap_after: Vec<bool>,
    arcs: Vec<Arc>,
    /// Bearings at which something touches the sensor.
    touching_rad: Vec<f64>,
}

/// Rays closer than this in bearing are one ray, radians.
const SAME_BEARING_RAD: f64 = 1e-7;

/// What is nearer than this touches the sensor, metres.
const TOUCHING_M: f64 = 1e-9;

/// Where a ray ends. Coordinates too small for exact predicates are zero: far below the angle at
/// which two rays are one.
fn end_of_ray(range_m: f64, bearing_rad: f64) -> Point2 {
    let (sin, cos) = bearing_rad.sin_cos();
    let flushed = |c: f64| if c.abs() < 1e-90 { 0.0 } else { c };
    Point2::new(flushed(range_m * cos), flushed(range_m * sin))
}

impl Samples {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The samples by rising bearing in (-π, π].
    pub fn as_slice(&self) -> &[Sample] {
        &self.samples
    }

    /// Whether sample `i` and the next one, cyclically, do not belong to one view.
    pub fn is_gap_after(&self, i: usize) -> bool {
        self.gap_after[i]
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// Adds a scan from the same place; `anchor_from_sensor` may only turn.
    ///
    /// Where the new scan has a ray at the bearing of an old one, the new one counts.
    pub fn add(&mut self, scan: &Scan, anchor_from_sensor: &Se2) {
        self.add_where(scan, anchor_from_sensor, |_| true);
    }

    /// [`add`](Self::add), but of the rays only those whose end `tells` something new; the
    /// directions of the others still count as looked into.
    pub fn add_where(
        &mut self,
        scan: &Scan,
        anchor_from_sensor: &Se2,
        tells: impl Fn(&Point2) -> bool,
    ) {
        let turn_rad = anchor_from_sensor.angle();
        for (bearing_rad, reading) in scan.readings() {
            let bearing_rad = wrap_angle(bearing_rad + turn_rad);
            let (range_m, hit) = match reading {
                Reading::Hit(range_m) => (range_m, true),
                Reading::Miss => (scan.range_max_m, false),
            };
            let end_in_anchor = end_of_ray(range_m, bearing_rad);
            if range_m < TOUCHING_M {
                self.touching_rad.push(bearing_rad);
            } else if tells(&end_in_anchor) {
                self.samples.push(Sample { bearing_rad, range_m, hit, end_in_anchor });
            }
        }
        let span_rad = if scan.is_full_circle() { TAU } else { scan.span_rad() };
        let start_rad = wrap_angle(scan.first_bearing_rad + turn_rad);
        self.arcs.push(Arc { start_rad, span_rad });
        self.join_arcs();
        self.sort();
        self.find_gaps();
    }

    /// Arcs that overlap become one; arcs that reach round become the full circle.
    fn join_arcs(&mut self) {
        let mut joined = true;
        while joined {
            joined = false;
            'pairs: for i in 0..self.arcs.len() {
                for j in 0..self.arcs.len() {
                    if i == j {
                        continue;
                    }
                    let (a, b) = (self.arcs[i], self.arcs[j]);
                    if a.holds(b.start_rad, 0.0) {
                        // What starts in `a` and ends in `a` after going round closes the circle.
                        let reach = (a.offset_rad(b.start_rad) + b.span_rad).max(a.span_rad);
                        let span_rad = if reach >= TAU - ARC_SLACK_RAD { TAU } else { reach };
                        self.arcs[i] = Arc { start_rad: a.start_rad, span_rad };
                        self.arcs.remove(j);
                        joined = true;
                        break 'pairs;
                    }
                }
            }
        }
    }

    fn sort(&mut self) {
        // Later scans come later in the list and the sort is stable, so the last of equals is new.
        self.samples
            .sort_by(|a, b| a.bearing_rad.partial_cmp(&b.bearing_rad).unwrap_or(Ordering::Equal));
        let mut kept: Vec<Sample> = Vec::with_capacity(self.samples.len());
        for sample in self.samples.drain(..) {
            match kept.last_mut() {
                Some(last) if sample.bearing_rad - last.bearing_rad <= SAME_BEARING_RAD => {
                    *last = sample;
                }
                _ => kept.push(sample),
            }
        }
        if kept.len() > 1 {
            let around = kept[0].bearing_rad + TAU - kept[kept.len() - 1].bearing_rad;
            if around <= SAME_BEARING_RAD {
                kept.remove(0);
            }
        }
        self.samples = kept;
    }

    fn find_gaps(&mut self) {
        let n = self.samples.len();
        self.gap_after = (0..n)
            .map(|i| {
                let from_rad = self.samples[i].bearing_rad;
                let to_rad = self.samples[(i + 1) % n].bearing_rad;
                let span_rad = if i + 1 == n { to_rad + TAU - from_rad } else { to_rad - from_rad };
                let seen = self.arcs.iter().any(|arc| arc.holds(from_rad, span_rad));
                let split = self.touching_rad.iter().any(|&bearing_rad| {
                    let mut offset = wrap_angle(bearing_rad - from_rad);
                    if offset < 0.0 {
                        offset += TAU;
                    }
                    offset <= span_rad
                });
                !seen || split || span_rad >= PI
            })
            .collect();
    }
}
