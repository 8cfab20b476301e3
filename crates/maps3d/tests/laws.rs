//! What holds for every depth image: planarity, closedness, labels, orientation, Euler's formula.

mod common;

use common::{adversarial, camera, cases, options_of};
use maps3d::image::{FilledImage, PrepareOptions, prepare};
use maps3d::quality::measure;
use maps3d::reduce::{Method, ReduceOptions, Stop, reduce};
use maps3d::triangulate::{FrontierSquares, Occlusion, check_planar, grid, label};
use maps3d::view::{StarView, validity, volume_m3};
use maps3d::{Maps3dError, ViewOptions, polyhedron};
use nalgebra::Point3;
use proptest::prelude::*;
use sensing::DepthImage;
use solid::Label;

/// Closed, every edge once in each direction, Euler's formula of a sphere, positive volume.
fn is_closed_sphere(made: &maps3d::Made) -> Result<(), TestCaseError> {
    let solid = &made.polyhedron;
    let mut edges: Vec<(u32, u32)> =
        solid.faces().iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
    let count = edges.len();
    edges.sort_unstable();
    edges.dedup();
    prop_assert_eq!(edges.len(), count, "no edge has two faces on one side");
    prop_assert!(edges.iter().all(|&(a, b)| edges.binary_search(&(b, a)).is_ok()), "closed");
    let (v, e, f) = (solid.vertices().len(), count / 2, solid.faces().len());
    prop_assert_eq!(v + f, e + 2, "Euler");
    // Faces look outward: seen from the camera, which is a vertex, each tetrahedron is positive.
    for face in 0..f {
        let [a, b, c] = solid.corners(face).map(|corner| corner.coords);
        prop_assert!(a.dot(&b.cross(&c)) >= 0.0, "face {} looks inward", face);
    }
    let volume_m3 = volume_m3(&made.mesh, made.image.camera());
    prop_assert!(volume_m3 > 0.0);
    if ratio(&made.image) < 1e3 {
        let general = solid.volume_m3();
        prop_assert!((general - volume_m3).abs() <= 1e-6 * volume_m3, "{general} {volume_m3}");
    }
    prop_assert_eq!(solid.labels().len(), f);
    Ok(())
}

/// How many times as far as the nearest depth the farthest is.
fn ratio(image: &FilledImage) -> f64 {
    let depths = image.depths_m().iter().map(|&z| f64::from(z));
    let (near, far) = depths.fold((f64::MAX, 0.0), |(n, f): (f64, f64), z| (n.min(z), f.max(z)));
    far / near
}

/// What rounding of inverse depths amounts to in metres, at most.
fn rounding_m(image: &FilledImage) -> f64 {
    let far = image.depths_m().iter().copied().fold(0.0, f32::max);
    1e-13 * ratio(image) * f64::from(far)
}

/// One test for each reduction and way of ending: a thousand images each, so that none takes long.
macro_rules! laws {
    ($($name:ident: $picks:expr, $bounds:expr, $stop:expr;)*) => {
        proptest! {
            #![proptest_config(cases(1000))]
            $(
                #[test]
                fn $name(image in adversarial(), pick in $picks, bound in $bounds) {
                    every_law(&image, pick, $stop(bound))?;
                }
            )*
        }
    };
}

laws! {
    centroid_to_a_count: 0..4_usize, 4..60_usize, Stop::Vertices;
    least_squares_to_a_count: 4..8_usize, 4..60_usize, Stop::Vertices;
    vertical_least_squares_to_a_count: 8..12_usize, 4..60_usize, Stop::Vertices;
    quadrics_to_a_count: 12..16_usize, 4..60_usize, Stop::Vertices;
    insertion_to_a_count: 16..17_usize, 4..80_usize, Stop::Vertices;
    centroid_to_a_bound: 0..4_usize, 1e-6..3.0_f64, Stop::Error;
    least_squares_to_a_bound: 4..8_usize, 1e-6..3.0_f64, Stop::Error;
    vertical_least_squares_to_a_bound: 8..12_usize, 1e-6..3.0_f64, Stop::Error;
    quadrics_to_a_bound: 12..16_usize, 1e-6..3.0_f64, Stop::Error;
    insertion_to_a_bound: 16..18_usize, 1e-6..2.0_f64, Stop::Error;
}

fn every_law(image: &DepthImage, pick: usize, stop: Stop) -> Result<(), TestCaseError> {
    let (mut options, conservative_m) = options_of(pick, stop);
    options.conservative_m = conservative_m;
    let view = ViewOptions { reduce: Some(options.clone()), ..Default::default() };
    let made = match polyhedron(image, &view) {
        Ok(made) => made,
        Err(other) => return Err(TestCaseError::fail(other.to_string())),
    };
    let (columns, rows) = (made.image.columns(), made.image.rows());
    prop_assert_eq!(check_planar(&made.mesh, columns, rows), Ok(()));
    is_closed_sphere(&made)?;
    // Vertices are pixels of the image, each once.
    let mut pixels = made.mesh.pixels.clone();
    pixels.sort_unstable();
    pixels.dedup();
    prop_assert_eq!(pixels.len(), made.mesh.pixels.len());
    if let Stop::Vertices(count) = stop {
        prop_assert!(made.mesh.pixels.len() <= count.max(4));
    }
    // A face with a missing pixel on it is frontier, whether or not that pixel is a vertex.
    for (&triangle, &label) in made.mesh.triangles.iter().zip(&made.labels) {
        let missing = triangle
            .iter()
            .any(|&v| made.image.is_missing(made.image.index(made.mesh.pixels[v as usize])));
        prop_assert!(!missing || label == Label::Frontier);
    }
    let quality = measure(&made.image, &made.mesh);
    prop_assert_eq!(quality.uncovered_share, 0.0);
    if let Some(bound_m) = conservative_m {
        let slack = rounding_m(&made.image);
        prop_assert!(quality.outside_max_m <= bound_m + slack, "{}", quality.outside_max_m);
    }
    if let (Method::InverseDepth(_), Stop::Error(bound), None) =
        (&options.method, stop, conservative_m)
    {
        let slack = rounding_m(&made.image);
        prop_assert!(quality.plane.max_m <= bound + slack, "{} {bound}", quality.plane.max_m);
    }
    let faults = solid::check(&made.polyhedron);
    prop_assert!(faults.is_valid(), "{:?}", faults.defects);
    prop_assert_eq!(validity(&made.image, &made.mesh, &made.polyhedron), faults);
    Ok(())
}

proptest! {
    #![proptest_config(cases(500))]

    #[test]
    fn a_line_of_pixels_keeps_every_law(
        depths in prop::collection::vec(prop_oneof![9 => 0.3..9.0_f64, 1 => Just(f64::NAN)], 1..40),
        upright in any::<bool>(),
        pick in 0..18_usize,
        count in 4..30_usize,
    ) {
        let depths: Vec<f32> = depths.into_iter().map(|z| z as f32).collect();
        let columns = if upright { 1 } else { depths.len() };
        let image = DepthImage::new(columns, camera(columns), depths);
        every_law(&image, pick, Stop::Vertices(count))?;
        every_law(&image, pick, Stop::Error(0.05))?;
        // Before reduction, every point that was measured lies on the surface.
        let made = polyhedron(&image, &ViewOptions::default()).expect("a line");
        let view = StarView::new(made.mesh, made.labels, *made.image.camera());
        for (at, &depth_m) in image.depths_m.iter().enumerate().filter(|(_, z)| z.is_finite()) {
            let along = [(at % columns) as f64, (at / columns) as f64];
            let point = image.camera.point_in_camera(along[0], along[1], f64::from(depth_m));
            // On whole and half pixels, but for rounding, which may lead outside.
            let place = made.image.camera().pixel_of(&point).expect("ahead");
            let place = place.map(|at| (2.0 * at).round() / 2.0);
            let there = view.depth_at(place).expect("within");
            prop_assert!((there - f64::from(depth_m)).abs() < 1e-9, "{there} {depth_m}");
        }
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn the_full_grid_holds_every_point(image in adversarial()) {
        let Ok(filled) = prepare(&image, &PrepareOptions::default()) else { return Ok(()) };
        let quality = measure(&filled, &grid(&filled));
        let largest = filled.depths_m().iter().copied().fold(0.0, f32::max);
        prop_assert!(quality.plane.max_m <= 1e-6 * f64::from(largest));
        prop_assert!(quality.outside_max_m <= rounding_m(&filled));
    }

    #[test]
    fn membership_by_direction_is_membership(
        image in adversarial(),
        count in 4..40_usize,
        places in prop::collection::vec((-0.2..1.2, -0.2..1.2, 0.01..3.0_f64), 40),
    ) {
        let stop = Stop::Vertices(count);
        let reduction = ReduceOptions::new(options_of(16, stop).0.method, stop);
        let Ok(filled) = prepare(&image, &PrepareOptions::default()) else { return Ok(()) };
        let mesh = reduce(&filled, &reduction).expect("valid options");
        let labels = label(&mesh, &FrontierSquares::of(&filled, None), 0.0);
        let view = StarView::new(mesh.clone(), labels, *filled.camera());
        for (x, y, share) in places {
            let (w, h) = ((filled.columns() - 1) as f64, (filled.rows() - 1) as f64);
            let place = [x * w, y * h];
            let face = view.face_at(place);
            let inside = (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y);
            prop_assert_eq!(face.is_some(), inside);
            let Some(depth_m) = view.depth_at(place) else { continue };
            // By a look at all faces.
            let all: Vec<f64> = mesh.triangles.iter().filter_map(|&t| {
                let [a, b, c] = mesh.corner_pixels(t).map(|p| p.map(f64::from));
                let turn = |p: [f64; 2], q: [f64; 2]| {
                    (q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0])
                };
                let within = turn(a, b).min(turn(b, c)).min(turn(c, a)) >= -1e-9;
                let [base, per_column, per_row] = mesh.inverse_depth_plane(t);
                within.then(|| 1.0 / (base + per_column * place[0] + per_row * place[1]))
            }).collect();
            prop_assert!(all.iter().any(|d| (d - depth_m).abs() <= 1e-6 * depth_m), "{all:?}");
            let point = filled.camera().point_in_camera(place[0], place[1], depth_m * share);
            prop_assert_eq!(view.contains(&point), share <= 1.0 + 1e-12);
            prop_assert!(!view.contains(&Point3::from(-point.coords)));
        }
    }

    #[test]
    fn a_probe_changes_nothing(image in adversarial(), pick in 0..18_usize, count in 4..50_usize) {
        let (mut options, conservative_m) = options_of(pick, Stop::Vertices(count));
        options.conservative_m = conservative_m;
        options.ladder = vec![30, 20, 10];
        let view = ViewOptions { reduce: Some(options), ..Default::default() };
        let Ok(plain) = polyhedron(&image, &view) else { return Ok(()) };
        let mut seen: Vec<Seen> = Vec::new();
        let watched = maps3d::polyhedron_with(&image, &view, &mut seen).expect("as before");
        prop_assert_eq!(&plain.mesh, &watched.mesh);
        prop_assert_eq!(&plain.polyhedron, &watched.polyhedron);
        prop_assert!(matches!(seen.last(), Some(Seen("Joined"))));
        let again = polyhedron(&image, &view).expect("as before");
        prop_assert_eq!(again.polyhedron, plain.polyhedron);
    }
}

struct Seen(&'static str);

impl From<maps3d::DepthEvent<'_>> for Seen {
    fn from(event: maps3d::DepthEvent<'_>) -> Self {
        Self(event.variant())
    }
}

#[test]
fn a_flat_wall_costs_two_faces_at_any_angle() {
    for slant in [0.0, 0.3, 0.9, 0.99] {
        let camera = camera(60);
        let depths = (0..60 * 40)
            .map(|i| {
                let [x, _] = camera.slope_of((i % 60) as f64, (i / 60) as f64);
                // The plane z = 2 + slant / (1 - slant) x, met from the side.
                let rise: f64 = slant / (1.0 - slant);
                (2.0 / (1.0 - rise * x).max(0.02)) as f32
            })
            .collect::<Vec<f32>>();
        let depths: Vec<f32> = depths.iter().map(|&z| z.min(50.0)).collect();
        let image = DepthImage::new(60, camera, depths);
        let image = prepare(&image, &PrepareOptions::default()).expect("valid");
        if slant < 0.9 {
            let stop = Stop::Error(0.001);
            let method = options_of(17, stop).0.method;
            let mesh = reduce(&image, &ReduceOptions::new(method, stop)).expect("valid");
            assert_eq!(mesh.triangles.len(), 2, "{slant}");
        }
    }
}

#[test]
fn an_open_surface_has_no_faces_to_the_camera() {
    let image = DepthImage::new(6, camera(6), vec![2.0; 30]);
    let open = ViewOptions { open: true, ..Default::default() };
    let made = polyhedron(&image, &open).expect("valid");
    assert_eq!(made.polyhedron.faces().len(), 5 * 4 * 2);
    assert_eq!(made.polyhedron.vertices().len(), 30);
    let closed = polyhedron(&image, &ViewOptions::default()).expect("valid");
    assert_eq!(closed.polyhedron.faces().len(), 40 + 18);
    // A pyramid with the image as its base.
    let [x, y] = [5.0 / image.camera.fx * 2.0, 4.0 / image.camera.fy * 2.0];
    assert!((closed.polyhedron.volume_m3() - x * y * 2.0 / 3.0).abs() < 1e-12);
    let gap = Occlusion { gap_m: -1.0, gap_share: 0.0 };
    let broken = ViewOptions { occlusion: Some(gap), ..Default::default() };
    assert!(matches!(polyhedron(&image, &broken), Err(Maps3dError::Option { .. })));
}
