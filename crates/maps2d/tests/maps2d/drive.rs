//! A robot without noise that jumps about in a room, and maps that are fed what it sees.

use maps2d::relative::{RelativeMap, RelativeParams};
use maps2d::{ExplorationMap, MapProbe, Standing};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, Off, VertexId};
use proptest::prelude::*;
use proptest::sample::Index;

use super::room::{Room, Sensor, rooms, sensors};

/// One thing that the robot does or is told; indices pick among what there is at that time.
#[derive(Clone, Debug)]
pub enum Op {
    /// Goes to a place in the room, recognises some old vertices there, and scans.
    Go { x: f64, y: f64, heading_rad: f64, places: Vec<Index> },
    /// Turns on the spot and scans.
    Turn { angle_rad: f64 },
    /// Goes back to an old vertex, arrives turned, and scans.
    Return { vertex: Index, angle_rad: f64 },
    /// A place edge between old vertices arrives late.
    Link { a: Index, b: Index },
    /// A place edge is taken back.
    Withdraw { edge: Index },
}

/// A room, a sensor, and what happens.
#[derive(Clone, Debug)]
pub struct Story {
    pub room: Room,
    pub sensor: Sensor,
    pub ops: Vec<Op>,
}

/// How often each kind of thing happens.
#[derive(Clone, Copy, Debug)]
pub struct Mix {
    pub turns: u32,
    pub links: u32,
    pub withdrawals: u32,
}

pub fn stories(mix: Mix, length: std::ops::Range<usize>) -> impl Strategy<Value = Story> {
    let angle = || -3.1..3.1_f64;
    let go = (0.0..1.0_f64, 0.0..1.0_f64, angle(), prop::collection::vec(any::<Index>(), 0..3))
        .prop_map(|(x, y, heading_rad, places)| Op::Go { x, y, heading_rad, places });
    let turn = angle().prop_map(|angle_rad| Op::Turn { angle_rad });
    let back =
        (any::<Index>(), angle()).prop_map(|(vertex, angle_rad)| Op::Return { vertex, angle_rad });
    let link = (any::<Index>(), any::<Index>()).prop_map(|(a, b)| Op::Link { a, b });
    let withdraw = any::<Index>().prop_map(|edge| Op::Withdraw { edge });
    let op = prop_oneof![
        8 => go,
        mix.turns => turn,
        mix.turns => back,
        mix.links => link,
        mix.withdrawals => withdraw,
    ];
    (rooms(), sensors(), prop::collection::vec(op, length)).prop_map(|(room, sensor, ops)| Story {
        room,
        sensor,
        ops,
    })
}

/// What an op came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Done {
    Nothing,
    Founded(VertexId),
    Rescanned(VertexId),
    Linked(EdgeId),
    Withdrew(EdgeId),
}

/// The robot, what it knows, and the truth.
pub struct Drive {
    pub room: Room,
    pub sensor: Sensor,
    pub graph: PoseGraph,
    pub world_from_vertex: Vec<Se2>,
    pub standing: Standing,
    pub place_edges: Vec<EdgeId>,
}

impl Drive {
    pub fn new(room: &Room, sensor: &Sensor) -> Self {
        Self {
            room: room.clone(),
            sensor: sensor.clone(),
            graph: PoseGraph::new(),
            world_from_vertex: Vec::new(),
            standing: Standing { vertex: VertexId(0), vertex_from_body: Se2::identity() },
            place_edges: Vec::new(),
        }
    }

    pub fn world_from(&self, vertex: VertexId) -> Se2 {
        self.world_from_vertex[vertex.0 as usize]
    }

    /// Tells every map what the op brings.
    pub fn act(&mut self, op: &Op, maps: &mut [&mut dyn ExplorationMap]) -> Done {
        self.act_with(op, maps, &mut Off)
    }

    pub fn act_with(
        &mut self,
        op: &Op,
        maps: &mut [&mut dyn ExplorationMap],
        probe: &mut dyn MapProbe,
    ) -> Done {
        let n = self.world_from_vertex.len();
        match op {
            Op::Go { x, y, heading_rad, places } => {
                let (x, y) = (x * self.room.width_m, y * self.room.height_m);
                let places: Vec<usize> =
                    places.iter().filter(|_| n > 0).map(|place| place.index(n)).collect();
                self.go(&Se2::new(x, y, *heading_rad), &places, maps, probe)
            }
            _ if n == 0 => Done::Nothing,
            Op::Turn { angle_rad } => {
                self.standing.vertex_from_body =
                    self.standing.vertex_from_body * Se2::from_angle(*angle_rad);
                self.look(maps, probe);
                Done::Rescanned(self.standing.vertex)
            }
            Op::Return { vertex, angle_rad } => {
                self.standing.vertex = VertexId(vertex.index(n) as u32);
                self.standing.vertex_from_body = Se2::from_angle(*angle_rad);
                self.look(maps, probe);
                Done::Rescanned(self.standing.vertex)
            }
            Op::Link { a, b } => {
                let Some(edge) = self.add_place(a.index(n), b.index(n)) else {
                    return Done::Nothing;
                };
                for map in maps {
                    map.edges_added(&self.graph, &[edge], &mut *probe);
                }
                Done::Linked(edge)
            }
            Op::Withdraw { edge } => {
                if self.place_edges.is_empty() {
                    return Done::Nothing;
                }
                let edge = self.place_edges.swap_remove(edge.index(self.place_edges.len()));
                self.graph.withdraw(edge).unwrap();
                for map in maps {
                    map.edge_withdrawn(&self.graph, edge, &mut *probe);
                }
                Done::Withdrew(edge)
            }
        }
    }

    /// Founds a vertex at a pose, if the robot can stand there.
    pub fn go(
        &mut self,
        world_from_body: &Se2,
        places: &[usize],
        maps: &mut [&mut dyn ExplorationMap],
        probe: &mut dyn MapProbe,
    ) -> Done {
        if !self.room.is_free(&world_from_body.translation.into()) {
            return Done::Nothing;
        }
        let vertex = self.graph.add_vertex();
        self.world_from_vertex.push(*world_from_body);
        let mut edges: Vec<EdgeId> = Vec::new();
        if vertex.0 > 0 {
            let before = self.standing.vertex;
            let step = self.world_from(before).inverse_mul(world_from_body);
            edges.push(self.graph.add_edge(before, vertex, step, EdgeKind::Odometry).unwrap());
        }
        for &place in places {
            edges.extend(self.add_place(place, vertex.0 as usize));
        }
        self.standing = Standing { vertex, vertex_from_body: Se2::identity() };
        for map in maps.iter_mut() {
            map.edges_added(&self.graph, &edges, &mut *probe);
        }
        self.look(maps, probe);
        Done::Founded(vertex)
    }

    fn add_place(&mut self, a: usize, b: usize) -> Option<EdgeId> {
        let a_from_b = self.world_from_vertex[a].inverse_mul(&self.world_from_vertex[b]);
        let (a, b) = (VertexId(a as u32), VertexId(b as u32));
        let edge = self.graph.add_edge(a, b, a_from_b, EdgeKind::Place).ok()?;
        self.place_edges.push(edge);
        Some(edge)
    }

    /// Scans where the robot stands.
    pub fn look(&mut self, maps: &mut [&mut dyn ExplorationMap], probe: &mut dyn MapProbe) {
        let world_from_body =
            self.world_from(self.standing.vertex) * self.standing.vertex_from_body;
        let scan = self.room.scan(&world_from_body, &self.sensor);
        for map in maps {
            map.scanned(&self.standing, &scan, &mut *probe);
        }
    }
}

/// Parameters with a small scope, so that it matters, and everything else as given.
pub fn params() -> impl Strategy<Value = RelativeParams> {
    let radius = prop_oneof![Just(4.0), Just(8.0), Just(1e3)];
    let wall = prop_oneof![Just(0.0), Just(0.3)];
    let sliver = prop_oneof![Just(0.0), Just(0.4)];
    let gap = prop_oneof![Just(0.3), Just(1.0)];
    let idle = prop_oneof![Just(2), Just(5), Just(40)];
    let weight = prop_oneof![3 => Just(1.0), 1 => Just(0.3)];
    (radius, wall, sliver, gap, any::<bool>(), idle, weight).prop_map(
        |(radius_m, wall_m, sliver_m, gap, retire, idle_scans, place_weight)| {
            let mut params = RelativeParams {
                consolidation_radius_m: radius_m,
                place_weight,
                wall_closing_m: wall_m,
                sliver_m,
                retire,
                idle_scans,
                ..RelativeParams::default()
            };
            params.volume.occlusion_gap_m = gap;
            params
        },
    )
}

/// Tells a story to one map from the beginning; `each` looks at the map after every op.
pub fn tell(
    story: &Story,
    params: RelativeParams,
    mut each: impl FnMut(&Drive, &RelativeMap, Done) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    let mut drive = Drive::new(&story.room, &story.sensor);
    let mut map = RelativeMap::new(params);
    for op in &story.ops {
        let done = drive.act(op, &mut [&mut map]);
        if done != Done::Nothing {
            each(&drive, &map, done)?;
        }
    }
    Ok(())
}
