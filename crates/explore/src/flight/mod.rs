//! Exploration of space: a flying robot with a depth camera, and a map of [`maps3d`] that steers it.
//!
//! The camera sees a pyramid. Its four sides are frontier, and so is what hides behind edges and what is too
//! far to read. Turning on the spot closes the left and the right side; what is above and below must be seen
//! from elsewhere, because the robot can only turn about the vertical. One step is the first of these that
//! applies:
//!
//! 0. **Go on.** A way along the graph that was begun is followed leg by leg; a flight that was planned for
//!    its end is made.
//! 1. **Turn and look** (`aim.rs`), while some yaw brings frontier into view that nobody looked at from
//!    here: what the robot came for, and what the views of this vertex leave open. Turning costs no distance
//!    and no drift, so all looks of one vertex are exact to each other.
//! 2. **Go and look** (`viewpoint.rs`). Places that are free in the views of this vertex are scored by the
//!    area of its frontier that they have in view: across the frontier into the unknown, within the field of
//!    view, near enough, with nothing in between, and not looked at from there before. The score is that
//!    area over one metre more than the flight. The best whose straight flight keeps clear of all that is
//!    solid and of all that was not seen from here is flown to; it becomes a vertex. Near to surfaces the
//!    depth images themselves are asked beside the map: reduced polyhedra are a few centimetres off. A flight
//!    is judged by the views of the vertex where it starts, and by nothing else: they know no drift. Where no
//!    place will do, the views of vertices nearby are tried in the same way.
//!    Before it flies, the robot looks that way, if nobody looked 30 degrees to both sides of it from here: noise
//!    may have pushed it to a wall that it never saw. Above and below it has no eyes (`leave.rs`): there it is held
//!    against what others saw that the first half metre meets nothing solid, and that the body keeps the widest
//!    margin from it or gets no nearer to it. Noise may have pushed it against an edge, and then it touches
//!    that edge when it climbs however little.
//! 3. **Put off** (`later.rs`). Frontier that no place has in view now waits: often looks from elsewhere close
//!    it, or lead to a place that has it in view. When nothing else is left a new round begins. What comes again is
//!    held against all views that are well placed to it, before anything is flown for it: along the way with the least
//!    odometry, not along the shortest. Then more vertices are tried, those nearest to the frontier first; and where it cannot be looked at from any of
//!    them, it is *approached*: the robot flies to where it is nearer to it, along a straight way that it saw
//!    to be free, and goes on from there. Where that is not possible either, places are *believed* to have it in
//!    view: the line of sight is free by the views near in the graph, whoever took them, and the place may be a
//!    vertex itself, where turning is enough. Nothing is flown for before such a place is known.
//!    What has been looked at once, so that a depth was read in its direction, is not looked at again: it was
//!    closed by that look, or it is not where the robot took it to be.
//! 4. **Go elsewhere** (`act.rs`, `ways.rs`). With no frontier left here, the map names the way along the graph to the
//!    nearest vertex with some, and the robot repeats it. Whenever it sets out to somewhere that is not straight from
//!    here, a place to look from that begins at another vertex or a vertex with frontier, the map is also asked for a way
//!    through the views between, whoever took them. What comes of it is a choice, [`Ways`]: it is told and counted; or
//!    it is flown where it is clearly shorter, bend by bend, each leg looked at first and judged as any flight (2), and at
//!    the first refusal the rest is repeated along the graph.
//! 5. **Give up.** A round in which nobody looked at anything is followed by the last one. What is left is held
//!    against those views once more, doubtful or not. Frontier that still counts is given up: as `Unreachable`
//!    where none of the places above was ever found for it; as `Hidden` where it was looked at and something
//!    solid stands before it, by that look or by at least three views and none that says otherwise; else as
//!    `NothingNew`. The first two are told apart from what is ignored. All hold for the place relative to its
//!    vertex. In maps with one global frame frontier belongs to no vertex, and is given up at once.
//! 6. **Done.** No frontier counts any more: `Complete`.
//!
//! Why it ends: turns at one place are bounded by `looks_at_a_place`; flights for one piece of frontier by
//! `tries`, and to one after a depth was read there; visits to one vertex by `visits_in_vain`, until the second
//! round; rounds within a step, because each puts something off or
//! gives it up. What ends every run for certain is `max_steps`.

mod act;
mod aim;
mod events;
mod explorer;
mod later;
mod leave;
mod memory;
mod motion;
mod nearby;
mod panorama;
mod params;
mod viewpoint;
mod ways;

pub use events::{FlightEvent, FlightGiveUp, FlightProbe};
pub use explorer::{FlightExplorer, FlightReport};
pub use memory::Target;
pub use params::FlightParams;
pub use ways::{Ways, WaysTally};
