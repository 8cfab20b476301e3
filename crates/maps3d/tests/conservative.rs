//! The one-sided bound against rays: both surfaces as triangles of space, met by rays, and nothing of
//! what the crate knows about them.

mod common;

use common::{cases, options_of};
use maps3d::image::{FilledImage, PrepareOptions, prepare};
use maps3d::quality::measure;
use maps3d::reduce::{Method, ReduceOptions, Stop, outside_max_m, reduce};
use maps3d::triangulate::{ImageMesh, grid};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;
use sensing::{Camera, DepthImage};
use worlds::DepthRoom;

/// What rounding makes of a ray that meets a face nearly along it, metres.
const ROUNDING_M: f64 = 1e-9;

/// A triangle of the image, and its plane in space.
struct Face {
    corners: [[f64; 2]; 3],
    normal: Vector3<f64>,
    offset: f64,
}

fn faces_of(image: &FilledImage, mesh: &ImageMesh) -> Vec<Face> {
    let points = mesh.points_in_camera(image.camera());
    let face = |&triangle: &[u32; 3]| {
        let [a, b, c]: [Point3<f64>; 3] = triangle.map(|v| points[v as usize]);
        let normal = (b - a).cross(&(c - a));
        let corners = triangle.map(|v| mesh.pixels[v as usize].map(f64::from));
        Face { corners, normal, offset: normal.dot(&a.coords) }
    };
    mesh.triangles.iter().map(face).collect()
}

/// How far the mesh is beyond the measured surface, on the ray of a place of the image.
fn beyond_m(camera: &Camera, mesh: &Face, measured: &Face, [column, row]: [f64; 2]) -> f64 {
    let ray = camera.point_in_camera(column, row, 1.0).coords.normalize();
    let along_m = |face: &Face| face.offset / face.normal.dot(&ray);
    along_m(mesh) - along_m(measured)
}

/// What two triangles of the image have in common: one is cut along the sides of the other.
fn common_piece(a: &[[f64; 2]; 3], b: &[[f64; 2]; 3]) -> Vec<[f64; 2]> {
    let mut piece = a.to_vec();
    for side in 0..3 {
        let [p, q] = [b[side], b[(side + 1) % 3]];
        let inside = |r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        let mut kept = Vec::new();
        for (i, &here) in piece.iter().enumerate() {
            let next = piece[(i + 1) % piece.len()];
            let (at_here, at_next) = (inside(here), inside(next));
            if at_here >= 0.0 {
                kept.push(here);
            }
            if (at_here > 0.0 && at_next < 0.0) || (at_here < 0.0 && at_next > 0.0) {
                kept.push(mixed(here, next, at_here / (at_here - at_next)));
            }
        }
        piece = kept;
    }
    piece
}

fn mixed(a: [f64; 2], b: [f64; 2], share: f64) -> [f64; 2] {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

/// The largest distance on a piece, if it is above `known_m`: by `dense` rays each way, and a search
/// around the best of them where that comes at least half as far.
fn largest_m(piece: &[[f64; 2]], dense: usize, known_m: f64, at: impl Fn([f64; 2]) -> f64) -> f64 {
    let mut best = (known_m, piece[0]);
    let mut sampled = (f64::NEG_INFINITY, piece[0]);
    let look = |place: [f64; 2], best: &mut (f64, [f64; 2])| {
        let found = at(place);
        if found > best.0 {
            *best = (found, place);
        }
    };
    let shares = || (0..=dense).map(|i| i as f64 / dense as f64);
    for fan in 1..piece.len() - 1 {
        for opposite in shares().map(|share| mixed(piece[fan], piece[fan + 1], share)) {
            shares().for_each(|share| look(mixed(piece[0], opposite, share), &mut sampled));
        }
    }
    if sampled.0 < 0.5 * known_m || sampled.0 <= 0.0 {
        return known_m;
    }
    // Towards each corner by smaller and smaller steps: they never leave what is convex.
    let mut step = 0.5;
    for _ in 0..80 {
        let before = sampled.0;
        for &corner in piece {
            look(mixed(sampled.1, corner, step), &mut sampled);
        }
        if sampled.0 <= before {
            step /= 2.0;
        }
    }
    look(sampled.1, &mut best);
    // Along each side, which such steps from inside reach slowly.
    for (i, &from) in piece.iter().enumerate() {
        let to = piece[(i + 1) % piece.len()];
        let of = |share: f64| at(mixed(from, to, share));
        let start = shares().map(|share| (of(share), share)).max_by(|p, q| p.0.total_cmp(&q.0));
        let start = start.expect("some").1;
        let reach = 1.0 / dense as f64;
        let (mut low, mut high) = ((start - reach).max(0.0), (start + reach).min(1.0));
        while high - low > 1e-7 {
            let third = (high - low) / 3.0;
            if of(low + third) < of(high - third) { low += third } else { high -= third }
        }
        look(mixed(from, to, 0.5 * (low + high)), &mut best);
    }
    best.0
}

/// Whether the boxes around two triangles of the image share inner points.
fn near(a: &[[f64; 2]; 3], b: &[[f64; 2]; 3]) -> bool {
    (0..2).all(|axis| {
        let range = |t: &[[f64; 2]; 3]| {
            let at = t.map(|corner| corner[axis]);
            (at[0].min(at[1]).min(at[2]), at[0].max(at[1]).max(at[2]))
        };
        let ((a_low, a_high), (b_low, b_high)) = (range(a), range(b));
        a_low < b_high && b_low < a_high
    })
}

/// How far a mesh is beyond the measured surface at most, by rays through every common piece.
fn farthest_m(image: &FilledImage, mesh: &ImageMesh, dense: usize) -> f64 {
    let measured = faces_of(image, &grid(image));
    let mut most = 0.0_f64;
    for face in faces_of(image, mesh) {
        for other in measured.iter().filter(|other| near(&face.corners, &other.corners)) {
            let piece = common_piece(&face.corners, &other.corners);
            if piece.len() >= 3 {
                let at = |place| beyond_m(image.camera(), &face, other, place);
                most = largest_m(&piece, dense, most, at);
            }
        }
    }
    most
}

/// Few pixels with deep steps, wide views: noise, two depths at random, a step between two walls.
fn stepped() -> impl Strategy<Value = DepthImage> {
    (2..9_usize, 2..7_usize, 0..3_u8, 0.3..2.0_f64).prop_flat_map(|(columns, rows, kind, focus)| {
        prop::collection::vec(0.0..1.0_f64, columns * rows).prop_map(move |noise| {
            let f = columns.max(rows) as f64 * focus;
            let camera = Camera::new(f, f, columns as f64 / 2.0, rows as f64 / 2.0);
            let depth = |(i, noise): (usize, f64)| match kind {
                0 => 0.5 + 6.5 * noise,
                1 if noise < 0.5 => 1.0,
                1 => 7.0,
                _ if 2 * (i % columns) < columns => 1.0 + 0.04 * (noise - 0.5),
                _ => 6.0 + 0.04 * (noise - 0.5),
            };
            let depths = noise.into_iter().enumerate().map(|at| depth(at) as f32).collect();
            DepthImage::new(columns, camera, depths)
        })
    })
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn no_ray_finds_more_and_one_finds_as_much(
        image in stepped(), pick in 0..17_usize, count in 4..20_usize,
    ) {
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        let options = options_of(pick, Stop::Vertices(count)).0;
        let mesh = reduce(&image, &options).expect("valid");
        let told_m = outside_max_m(&image, &mesh);
        let by_rays_m = farthest_m(&image, &mesh, 8);
        prop_assert!(by_rays_m <= told_m + ROUNDING_M, "{by_rays_m} {told_m}");
        prop_assert!(told_m <= by_rays_m * (1.0 + 1e-6) + ROUNDING_M, "{by_rays_m} {told_m}");
    }

    #[test]
    fn the_bound_holds_along_every_ray(
        image in stepped(),
        pick in 0..17_usize,
        count in 4..20_usize,
        bound_m in prop::sample::select(vec![0.0, 0.01, 0.05, 0.2, 1.0]),
    ) {
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        let mut options = options_of(pick, Stop::Vertices(count)).0;
        let free = reduce(&image, &options).expect("valid");
        options.conservative_m = Some(bound_m);
        let mesh = reduce(&image, &options).expect("valid");
        let told_m = outside_max_m(&image, &mesh);
        prop_assert!(told_m <= bound_m + ROUNDING_M, "{told_m} of {bound_m}");
        let by_rays_m = farthest_m(&image, &mesh, 8);
        prop_assert!(by_rays_m <= bound_m + ROUNDING_M, "{by_rays_m} of {bound_m}");
        // Only nearer, only as much as is needed: what held already is left alone.
        prop_assert_eq!(&mesh.pixels, &free.pixels);
        prop_assert!(mesh.depths_m.iter().zip(&free.depths_m).all(|(with, without)| with <= without));
        if outside_max_m(&image, &free) <= 0.999 * bound_m * nearest_stretch(&image) {
            prop_assert_eq!(mesh, free);
        }
    }
}

/// The least share of the bound that is made use of: stretches of rays are taken as long as their
/// longer end.
fn nearest_stretch(image: &FilledImage) -> f64 {
    let camera = image.camera();
    // On one pixel, or its diagonal, the length of the ray to depth 1 grows by no more than this.
    let step = (1.0 / (camera.fx * camera.fx) + 1.0 / (camera.fy * camera.fy)).sqrt();
    1.0 / (1.0 + step)
}

#[test]
fn a_step_inside_one_square_holds_the_bound() {
    // One near pixel of four: the difference of depths is largest inside of the square.
    for method in Method::NAMES {
        let camera = Camera::new(2.0, 2.0, 1.0, 1.0);
        let image = DepthImage::new(2, camera, vec![1.0, 7.0, 7.0, 7.0]);
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        let method = Method::named(method, Default::default()).expect("a name");
        let options = ReduceOptions {
            conservative_m: Some(0.01),
            ..ReduceOptions::new(method, Stop::Vertices(4))
        };
        let mesh = reduce(&image, &options).expect("valid");
        let by_rays_m = farthest_m(&image, &mesh, 40);
        assert!(by_rays_m <= 0.01 + ROUNDING_M, "{method:?}: {by_rays_m}");
        let told_m = outside_max_m(&image, &mesh);
        assert!(by_rays_m <= told_m + ROUNDING_M && told_m <= 0.01, "{method:?}: {told_m}");
    }
}

#[test]
fn a_frame_of_usual_size_holds_the_bound_along_two_million_rays() {
    let image = prepare(&DepthRoom::default().image(), &PrepareOptions::default()).expect("valid");
    let method = Method::named("inverse-depth", Default::default()).expect("a name");
    let mut options = ReduceOptions::new(method, Stop::Vertices(684));
    let free = reduce(&image, &options).expect("valid");
    options.conservative_m = Some(0.05);
    let held = reduce(&image, &options).expect("valid");
    let by_rays_m = [&free, &held].map(|mesh| sampled_m(&image, mesh));
    let told_m = [&free, &held].map(|mesh| measure(&image, mesh).outside_max_m);
    assert!(by_rays_m[0] > 0.1, "{by_rays_m:?}: a frame that needs the bound");
    for (by_rays_m, told_m) in by_rays_m.into_iter().zip(told_m) {
        assert!(
            by_rays_m <= told_m + ROUNDING_M && told_m < 1.01 * by_rays_m + 1e-3,
            "{by_rays_m} {told_m}"
        );
    }
    assert!(told_m[1] <= 0.05, "{told_m:?}");
}

/// The largest distance along rays through pixels and three places inside of each face of the grid.
fn sampled_m(image: &FilledImage, mesh: &ImageMesh) -> f64 {
    let measured = faces_of(image, &grid(image));
    let mut most = 0.0_f64;
    for face in faces_of(image, mesh) {
        let [a, b, c] = face.corners;
        let range = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]);
            low as usize..a[axis].max(b[axis]).max(c[axis]) as usize
        };
        let turn = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        for row in range(1) {
            for column in range(0) {
                let first = 2 * (row * (image.columns() - 1) + column);
                for other in &measured[first..first + 2] {
                    let [p, q, r] = other.corners;
                    for place in [
                        p,
                        mixed(p, mixed(q, r, 0.5), 2.0 / 3.0),
                        mixed(q, mixed(r, p, 0.3), 0.2),
                        mixed(r, mixed(p, q, 0.1), 0.1),
                    ] {
                        let inside = [turn(a, b, place), turn(b, c, place), turn(c, a, place)];
                        if inside.iter().all(|&turn| turn >= 0.0) {
                            most = most.max(beyond_m(image.camera(), &face, other, place));
                        }
                    }
                }
            }
        }
    }
    most
}
