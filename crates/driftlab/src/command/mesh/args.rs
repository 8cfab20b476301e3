//! What can be typed after `driftlab mesh`.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum};
use serde_json::Value;

use super::super::failure::Failure;
use super::super::files::{apart, free};
use super::depth_args::{DepthArgs, DepthFileArgs, numbers};
use super::output::Target;
use super::plan::{AlgorithmName, HeuristicName};

#[derive(Debug, Args)]
pub(in crate::command) struct MeshArgs {
    #[command(subcommand)]
    pub(super) command: MeshCommand,
}

#[derive(Debug, Subcommand)]
pub(super) enum MeshCommand {
    /// Tell what a mesh holds, and how valid it is
    #[command(
        long_about = "Tell what a mesh holds, and how valid it is.\n\n\
            Reads PLY, OBJ, STL, OFF and TetGen's .node, .poly and .smesh, told by content where it \
            can be. Says whether the mesh is closed, oriented, a 2-manifold and free of \
            self-intersections, and what is wrong where: edges, vertices, and faces that meet. \
            Self-intersection is decided exactly.",
        after_help = "Examples:\n  \
            driftlab mesh info view.ply\n  \
            driftlab mesh info part.stl --json"
    )]
    Info(InfoArgs),
    /// Fill a closed mesh with tetrahedra that keep its faces
    #[command(
        long_about = "Fill a closed mesh with tetrahedra that keep its faces.\n\n\
            Every face and its label stay; vertices do not move. Points are added inside only, and only \
            where flips do not do. A complex with hole points, or --enclosed, fills all that cannot be \
            reached from outside; otherwise what is behind an odd number of faces. Input that is open or \
            meets itself is refused, naming the faces.",
        after_help = "Examples:\n  \
            driftlab mesh tetrahedralize map.ply -o map.vtk\n  \
            driftlab mesh tetrahedralize part.stl --json\n  \
            driftlab mesh tetrahedralize view.ply --record view.rrd"
    )]
    Tetrahedralize(TetrahedralizeArgs),
    /// Unite, intersect or subtract two closed meshes
    #[command(
        long_about = "Unite, intersect or subtract two closed meshes.\n\n\
            Both must be closed 2-manifolds, oriented outward. Faces keep their labels; where a frontier \
            face coincides with an obstacle face, looking the same way, that part of it becomes obstacle: \
            the face is cut along the border. Where faces of A and B are coplanar to rounding, as after a \
            turn, and the result would intersect itself or be of another volume or area by it, the faces \
            of B are moved first, outwards, for an intersection inwards, by 1e-12 of the largest \
            coordinate, by up to 1e-8 m where that does not do. --jitter moves them by 1e-8 m in any \
            case. jitter_m in the JSON says by how much they were moved.",
        after_help = "Examples:\n  \
            driftlab mesh boolean union a.ply b.ply -o both.ply\n  \
            driftlab mesh boolean difference part.stl tool.stl --record cut.rrd\n  \
            driftlab mesh boolean intersection a.off b.off --json"
    )]
    Boolean(BooleanArgs),
    /// Make the local volume of a depth image: a small, closed, labelled polyhedron
    #[command(
        allow_negative_numbers = true,
        long_about = "Make the local volume of a depth image: a small, closed, labelled polyhedron.\n\n\
            The image is cropped, its gaps are filled at the far distance, it is triangulated, \
            reduced, labelled and joined to the camera. Faces are obstacle or frontier: over missing \
            data, across depth gaps, and towards the camera. Distances are those of the measured \
            points from the plane of their face, and along their rays. --json tells vertices, faces, \
            obstacle_faces, frontier_faces, closed, oriented, manifold, self_intersecting, defects, \
            volume_m3, area_by_label_m2, rms_m, p95_m, max_m, along_rays, uncovered_share, \
            outside_max_m (how far the surface reaches beyond the measured one), and secs_read, \
            secs_triangulate, secs_reduce, secs_polyhedron.",
        after_help = "Examples:\n  \
            driftlab mesh polyhedron depth.png --camera 576,578,319.5,239.5 --vertices 684 -o view.ply\n  \
            driftlab mesh polyhedron depth.png --depth-scale 5000 --reduce least-squares --vertices 113\n  \
            driftlab mesh polyhedron office.pcd --error 0.02 --conservative 0.05 --json\n  \
            driftlab mesh polyhedron depth.png --vertices 113 --ladder 10306,2060,684 --record a.rrd"
    )]
    Polyhedron(PolyhedronArgs),
    /// Reduce one depth image further and further by several methods, in one recording
    #[command(
        allow_negative_numbers = true,
        long_about = "Reduce one depth image further and further by several methods, in one recording.\n\n\
            The config says how the image is made ready, which methods reduce it, and at which numbers \
            of vertices each is shown and measured. Without an image, a made-up room is looked at; what \
            is wrong with its camera stands in the config too. In the recording, drag the timeline \
            `vertices`.",
        after_help = "Examples:\n  \
            driftlab mesh ladder configs/depth/room.toml\n  \
            driftlab mesh ladder configs/depth/figure_6_2.toml depth.png --camera 576,578,319.5,239.5\n  \
            driftlab mesh ladder configs/depth/room.toml --record /tmp/room.rrd --json"
    )]
    Ladder(LadderArgs),
    /// Make up the depth image of a room with boxes, to try the others on
    #[command(
        long_about = "Make up the depth image of a room with boxes, to try the others on.\n\n\
            Grey of 16 bits, in millimetres, 0 where nothing is seen; with noise of 0.3 % of the depth \
            and a round patch without readings. Tells the camera that saw it.",
        after_help = "Examples:\n  \
            driftlab mesh room -o depth.png\n  \
            driftlab mesh room --size 320,240 --seed 7 -o small.pgm --json"
    )]
    Room(RoomArgs),
    /// Find a path through the inside of a mesh, to a point or to the nearest frontier
    #[command(
        allow_negative_numbers = true,
        long_about = "Find a path through the inside of a mesh, to a point or to the nearest frontier.\n\n\
            The mesh is filled with tetrahedra. Their dual graph is searched; frontier faces have nodes of \
            their own, several where they are large. Then the path is shortened inside of its corridor by \
            second-order cone programmes, clear of obstacle faces by the radius, and verified by an exact \
            walk. Where a corridor is too narrow, the next is tried. --json tells found, clear, way_m \
            (through the nodes), path_m, shortened_share, path, expansions, programmes, tetrahedra, and \
            secs_read, secs_tetrahedralize, secs_graph, secs_prepare, secs_plan.",
        after_help = "Examples:\n  \
            driftlab mesh plan map.ply --from 0,0,1.2\n  \
            driftlab mesh plan map.ply --from 0,0,1.2 --to 4,2,1 --radius 0.2 --record plan.rrd\n  \
            driftlab mesh plan map.ply --from 0,0,1.2 --to 4,2,1 --algorithm dijkstra --json"
    )]
    Plan(PlanArgs),
    /// Take faces out of a mesh, within an error
    #[command(
        long_about = "Take faces out of a mesh, within an error.\n\n\
            Vertices are drawn into their neighbours, the cheapest first. Topology, labels and borders \
            between labels stay, and no faces meet that did not meet before. The error is the distance \
            of the mesh's vertices from the result; it is measured and told.",
        after_help = "Examples:\n  \
            driftlab mesh reduce map.ply --error 0.02 -o small.ply\n  \
            driftlab mesh reduce scan.stl --error 0.5 --faces 2000 --record reduce.rrd"
    )]
    Reduce(ReduceArgs),
}

#[derive(Debug, Args)]
pub(super) struct LadderArgs {
    /// The config: a TOML file
    pub(super) config: PathBuf,
    /// The depth image, as of `polyhedron`; without one, the config's room
    pub(super) depth: Option<PathBuf>,
    #[command(flatten)]
    pub(super) file: DepthFileArgs,
    /// Where the recording goes [default: recordings/ and the config's name]
    #[arg(long, value_name = "FILE.rrd")]
    pub(super) record: Option<PathBuf>,
    /// Replace files that are there already
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
pub(super) struct RoomArgs {
    /// Where the image goes: .png or .pgm
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: PathBuf,
    /// Columns and rows
    #[arg(
        long,
        value_name = "COLUMNS,ROWS",
        value_parser = numbers::<usize, 2>,
        default_value = "640,480"
    )]
    pub(super) size: [usize; 2],
    /// The noise's seed
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) seed: u32,
    /// Replace files that are there already
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
pub(super) struct ReduceArgs {
    /// The mesh: PLY, OBJ, STL, OFF, .node, .poly or .smesh
    pub(super) file: PathBuf,
    #[command(flatten)]
    pub(super) input: MeshInput,
    /// No vertex of the mesh may be farther than this from the result, metres
    #[arg(long, value_name = "M", default_value_t = 0.01)]
    pub(super) error: f64,
    /// Stop at this many faces
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) faces: usize,
    #[command(flatten)]
    pub(super) output: OutputArgs,
}

/// What is made of two meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum OperationName {
    /// What is in A or in B
    Union,
    /// What is in A and in B
    Intersection,
    /// What is in A and not in B
    Difference,
    /// What is in exactly one of them
    SymmetricDifference,
}

#[derive(Debug, Args)]
pub(super) struct BooleanArgs {
    /// What to make of them
    pub(super) operation: OperationName,
    /// The first mesh
    pub(super) a: PathBuf,
    /// The second mesh
    pub(super) b: PathBuf,
    #[command(flatten)]
    pub(super) input: MeshInput,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    /// Know for each face of the result from which face of A or B it comes (PLY)
    #[arg(long)]
    pub(super) origins: bool,
    /// Draw edges no longer than this together in the end, metres; drops origins
    #[arg(long, value_name = "M", default_value_t = 0.0)]
    pub(super) clean: f64,
    /// Move the faces of B by 1e-8 m, or more where that leaves self-intersections
    #[arg(long)]
    pub(super) jitter: bool,
    /// What part of the jitter is by chance depends on this
    #[arg(long, value_name = "N", default_value_t = 1, requires = "jitter")]
    pub(super) seed: u64,
}

/// Where a mesh and a recording go.
#[derive(Debug, Args)]
pub(super) struct OutputArgs {
    /// Where to write the result: .ply, .obj, .stl or .off
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    pub(super) recording: RecordArgs,
}

impl OutputArgs {
    /// The file for the mesh, if one is asked for; nothing is in the way of it or of the recording.
    pub(super) fn target(&self, inputs: &[&Path]) -> Result<Option<Target>, Failure> {
        let force = self.recording.force;
        let target = self.output.as_deref().map(|path| Target::new(path, force)).transpose()?;
        self.recording.check(inputs.iter().copied().chain(self.output.as_deref()))?;
        Ok(target)
    }

    /// Tells where things went.
    pub(super) fn tell(&self, json: &mut Value) {
        json["output"] = shown(self.output.as_deref());
        json["recording"] = shown(self.recording.record.as_deref());
    }
}

/// Where a recording goes, and what may be replaced.
#[derive(Debug, Args)]
pub(super) struct RecordArgs {
    /// Record every step for the Rerun viewer
    #[arg(long, value_name = "FILE.rrd")]
    pub(super) record: Option<PathBuf>,
    /// Replace files that are there already
    #[arg(long)]
    pub(super) force: bool,
}

impl RecordArgs {
    /// Sees that nothing is in the way, nor one of the other files.
    pub(super) fn check<'a>(
        &self,
        others: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), Failure> {
        let Some(record) = &self.record else { return Ok(()) };
        apart(record, others)?;
        free(record, self.force)
    }
}

/// A path as JSON; null where there is none.
pub(super) fn shown(path: Option<&Path>) -> Value {
    path.map(|path| path.display().to_string()).into()
}

/// A mesh to read.
#[derive(Debug, Args)]
pub(super) struct MeshInput {
    /// Make vertices at exactly the same place one; triangles of STL always are
    #[arg(long)]
    pub(super) weld: bool,
}

#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// The mesh: PLY, OBJ, STL, OFF, .node, .poly or .smesh
    pub(super) file: PathBuf,
    #[command(flatten)]
    pub(super) input: MeshInput,
}

#[derive(Debug, Args)]
pub(super) struct PolyhedronArgs {
    #[command(flatten)]
    pub(super) depth: DepthArgs,
    #[command(flatten)]
    pub(super) output: OutputArgs,
}

#[derive(Debug, Args)]
pub(super) struct PlanArgs {
    /// The mesh: PLY, OBJ, STL, OFF, .node, .poly or .smesh
    pub(super) file: PathBuf,
    #[command(flatten)]
    pub(super) input: MeshInput,
    /// Where the path starts, metres
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_parser = numbers::<f64, 3>,
        allow_hyphen_values = true
    )]
    pub(super) from: [f64; 3],
    /// Where it ends, metres [default: at the nearest frontier]
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_parser = numbers::<f64, 3>,
        allow_hyphen_values = true
    )]
    pub(super) to: Option<[f64; 3]>,
    /// The robot is a ball of this radius, metres
    #[arg(long, value_name = "M", default_value_t = 0.0)]
    pub(super) radius: f64,
    /// How the graph is searched
    #[arg(long, value_name = "NAME", default_value = "astar")]
    pub(super) algorithm: AlgorithmName,
    /// What A* takes for the cost that is left at least
    #[arg(long, value_name = "NAME", default_value = "landmarks")]
    pub(super) heuristic: HeuristicName,
    /// Points of a frontier face lie no farther apart than this, metres
    #[arg(long, value_name = "M", default_value_t = 1.0)]
    pub(super) spacing: f64,
    /// Smaller frontier faces are no goals, square metres
    #[arg(long, value_name = "M2", default_value_t = 0.0)]
    pub(super) least_area: f64,
    /// Leave the path as it leads through the nodes
    #[arg(long)]
    pub(super) no_shorten: bool,
    #[command(flatten)]
    pub(super) recording: RecordArgs,
}

#[derive(Debug, Args)]
pub(super) struct TetrahedralizeArgs {
    /// The mesh: PLY, OBJ, STL, OFF, .node, .poly or .smesh
    ///
    /// Points without faces get the Delaunay tetrahedra of all that they span. Boundary markers of .poly and
    /// .smesh are no labels: every face is an obstacle.
    pub(super) file: PathBuf,
    #[command(flatten)]
    pub(super) input: MeshInput,
    /// Where to write the tetrahedra: .vtk or .mesh (MEDIT)
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    /// Fill all that cannot be reached from outside without passing a face
    #[arg(long)]
    pub(super) enclosed: bool,
    #[command(flatten)]
    pub(super) recording: RecordArgs,
}
