//! One volume with what has become of its frontier.

use geometry::Point2;
use geometry::planar::{EdgeLedger, Interval, point_segment_distance};

use probe::VertexId;

use super::chains::chains;
use super::{Chain, Closing};
use crate::volume::{LocalVolume, Samples};

/// A sliver that is held counts until it is shorter than this share of the length of a sliver.
const HELD_SHARE: f64 = 0.1;

/// An open part of a frontier edge, anchor frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenPart {
    /// Index into [`LocalVolume::frontier`].
    pub edge: usize,
    /// Where it starts.
    pub from: Point2,
    /// Where it ends.
    pub to: Point2,
}

/// A volume of the map, its ledgers, and what they come to.
#[derive(Clone, Debug)]
pub struct VolumeState {
    /// The geometry; replaced as a whole when a scan from the same place is merged in.
    pub volume: LocalVolume,
    /// Everything that was seen from the place.
    pub samples: Samples,
    /// For each frontier edge, which parts are closed and why.
    pub ledgers: Vec<EdgeLedger<Closing>>,
    /// The open parts that hang together.
    pub chains: Vec<Chain>,
    /// The same open parts by edge: where they are, and nothing else, for comparisons to run over.
    pub(super) open: Vec<OpenPart>,
    /// A disc around all that is open, anchor frame: centre and radius, metres.
    pub open_disc: (Point2, f64),
    /// Length of the chains that count, metres.
    pub open_m: f64,
    /// Length of the chains that do not, metres.
    pub sliver_m: f64,
    /// Length closed as unreachable, metres.
    pub unreachable_m: f64,
    /// Whether it closed frontier of another volume that counted.
    pub closed_others: bool,
    /// The volumes of whose frontier it closed parts, ascending.
    pub closed_in: Vec<VertexId>,
    /// A volume of whose frontier more would count without it, as found last.
    pub missed_by: Option<VertexId>,
    /// Whether it is out of later comparisons.
    pub retired: bool,
    /// How many volumes came into its scope since it last closed frontier that counted.
    pub idle_scans: u32,
    /// Whether it no longer accounts for frontier of others, because some of its own cannot be
    /// reached from it: what it sees there has to be looked at from elsewhere.
    pub blocked: bool,
    /// Places where a sliver counts, because with slivers of other volumes it is none; anchor frame.
    pub held: Vec<Point2>,
    /// Places that could not be reached, with the radius around them; anchor frame, metres.
    pub given_up: Vec<(Point2, f64)>,
}

impl VolumeState {
    pub(crate) fn new(volume: LocalVolume, samples: Samples, sliver_m: f64) -> Self {
        let ledgers = vec![EdgeLedger::new(); volume.frontier.len()];
        let mut state = Self {
            volume,
            samples,
            ledgers,
            chains: Vec::new(),
            open: Vec::new(),
            open_disc: (Point2::origin(), 0.0),
            open_m: 0.0,
            sliver_m: 0.0,
            unreachable_m: 0.0,
            closed_others: false,
            closed_in: Vec::new(),
            missed_by: None,
            retired: false,
            idle_scans: 0,
            blocked: false,
            held: Vec::new(),
            given_up: Vec::new(),
        };
        state.measure(sliver_m);
        state
    }

    /// Whether frontier is left that counts.
    pub fn counts(&self) -> bool {
        self.open_m > 0.0
    }

    /// Whether it could be retired: it has no say any more, neither by frontier that counts nor by
    /// places that could not be reached.
    pub(crate) fn is_spent(&self) -> bool {
        !self.retired && !self.counts() && self.given_up.is_empty()
    }

    /// Whether any frontier is open, slivers included.
    pub fn has_open(&self) -> bool {
        !self.chains.is_empty()
    }

    /// Measures the ledgers anew.
    pub(crate) fn measure(&mut self, sliver_m: f64) {
        self.chains = chains(&self.volume, &self.ledgers);
        self.open.clear();
        for (edge, ledger) in self.ledgers.iter().enumerate() {
            let frontier = &self.volume.frontier[edge];
            let at = |span: Interval| (frontier.at(span.from), frontier.at(span.to));
            let parts = ledger.open().map(at).map(|(from, to)| OpenPart { edge, from, to });
            self.open.extend(parts);
        }
        self.open_disc = self.disc_around_open();
        self.open_m = 0.0;
        self.sliver_m = 0.0;
        for chain in &mut self.chains {
            let held = || self.held.iter().any(|at| is_near(chain, &self.volume, at, sliver_m));
            chain.counts =
                chain.length_m >= sliver_m || (chain.length_m >= HELD_SHARE * sliver_m && held());
            if chain.counts {
                self.open_m += chain.length_m;
            } else {
                self.sliver_m += chain.length_m;
            }
        }
        self.unreachable_m = 0.0;
        for (edge, ledger) in self.volume.frontier.iter().zip(&self.ledgers) {
            for closed in ledger.closed() {
                if closed.reason.cause == super::Cause::Unreachable {
                    self.unreachable_m += closed.span.share() * edge.length_m();
                }
            }
        }
    }

    fn disc_around_open(&self) -> (Point2, f64) {
        let segments = self.chains.iter().flat_map(|chain| chain.segments(&self.volume));
        disc_around(segments.flat_map(|(from, to)| [from, to]))
    }

    /// The chains that count.
    pub fn counting_chains(&self) -> impl Iterator<Item = &Chain> {
        self.chains.iter().filter(|chain| chain.counts)
    }

    /// Memory held on the heap, bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let closings: usize = self.ledgers.iter().map(|ledger| ledger.closed().len()).sum();
        self.volume.heap_bytes()
            + self.closed_in.capacity() * size_of::<VertexId>()
            + self.samples.len() * (size_of::<crate::volume::Sample>() + 1)
            + self.open.capacity() * size_of::<OpenPart>()
            + self.ledgers.len() * size_of::<EdgeLedger<Closing>>()
            + closings * size_of::<geometry::planar::Closed<Closing>>()
            + self
                .chains
                .iter()
                .map(|c| c.parts.len() * size_of::<super::ChainPart>())
                .sum::<usize>()
    }
}

/// A disc around points, of no extent around none: centre and radius, metres.
pub(super) fn disc_around(points: impl Iterator<Item = Point2> + Clone) -> (Point2, f64) {
    let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
    for point in points.clone() {
        low = low.inf(&point);
        high = high.sup(&point);
    }
    if low.x > high.x {
        return (Point2::origin(), 0.0);
    }
    let centre = Point2::from((low.coords + high.coords) * 0.5);
    let radius_m = points.map(|point| (point - centre).norm()).fold(0.0, f64::max);
    (centre, radius_m)
}

/// Whether a chain lies about where a sliver is held.
fn is_near(chain: &Chain, volume: &LocalVolume, at: &Point2, sliver_m: f64) -> bool {
    chain
        .segments(volume)
        .any(|(from, to)| point_segment_distance(at, &from, &to) <= 0.5 * sliver_m)
}
