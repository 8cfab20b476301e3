//! Depth images and organised clouds that others wrote, where a folder of test data is at hand: read,
//! made into polyhedra, and held against an independent computation.

mod data;

use std::fs;
use std::path::{Path, PathBuf};

use formats::depth_file::{DepthFile, DepthFileOptions, read};
use maps3d::image::{CloudOptions, depth_image_of};
use maps3d::reduce::{InverseDepth, Method, ReduceOptions, Stop};
use maps3d::triangulate::check_planar;
use maps3d::{ViewOptions, polyhedron};
use sensing::{Camera, DepthImage};

/// The image of a file, and for a cloud its points.
fn image(path: &Path, camera: Camera, units_per_metre: f64) -> (DepthImage, Option<Vec<[f32; 3]>>) {
    let bytes = fs::read(path).expect("readable");
    let options = DepthFileOptions { units_per_metre, size: None };
    let extension = path.extension().and_then(|e| e.to_str());
    match read(&bytes, extension, &options).unwrap_or_else(|e| panic!("{}: {e}", path.display())) {
        DepthFile::Image(pixels) => {
            (DepthImage::new(pixels.columns, camera, pixels.depths_m), None)
        }
        DepthFile::Cloud(cloud) => {
            let points = cloud.points_in_sensor;
            let image = depth_image_of(cloud.columns, &points, None, &CloudOptions::default());
            (image.unwrap_or_else(|e| panic!("{}: {e}", path.display())), Some(points))
        }
    }
}

/// Distance of a point from a triangle, by the nearest of inside, sides and corners.
fn distance(p: &solid::Point3, [a, b, c]: [&solid::Point3; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(from, to)| (*to - *from).cross(&(p - *from)).dot(&normal) >= 0.0);
    if inside {
        return (p - a).dot(&normal).abs() / normal.norm();
    }
    [(a, b), (b, c), (c, a)]
        .iter()
        .map(|(from, to)| {
            let side = *to - *from;
            let along = ((p - *from).dot(&side) / side.norm_squared()).clamp(0.0, 1.0);
            (p - (*from + side * along)).norm()
        })
        .fold(f64::INFINITY, f64::min)
}

fn hold(path: &Path, camera: Camera, units_per_metre: f64) {
    let name = path.display();
    let (image, points) = image(path, camera, units_per_metre);
    // Before reduction: every valid point lies on a face that has its pixel as a corner.
    let whole = polyhedron(&image, &ViewOptions::default()).expect("valid");
    let solid = &whole.polyhedron;
    assert!(solid.volume_m3() > 0.0, "{name}");
    assert_eq!(solid.labels().len(), solid.faces().len());
    let mut face_of = vec![u32::MAX; solid.vertices().len()];
    for (face, corners) in solid.faces().iter().enumerate() {
        for &corner in corners {
            face_of[corner as usize] = face as u32;
        }
    }
    let mut worst: f64 = 0.0;
    for (index, &depth_m) in image.depths_m.iter().enumerate() {
        if !(depth_m.is_finite() && depth_m > 0.0) {
            continue;
        }
        let point = match &points {
            Some(points) => {
                let [x, y, z] = points[index].map(f64::from);
                solid::Point3::new(x, y, z)
            }
            None => {
                let (column, row) =
                    ((index % image.columns) as f64, (index / image.columns) as f64);
                let Camera { fx, fy, cx, cy } = image.camera;
                let z = f64::from(depth_m);
                solid::Point3::new((column - cx) / fx * z, (row - cy) / fy * z, z)
            }
        };
        let corners = solid.corners(face_of[index] as usize);
        worst = worst.max(distance(&point, corners));
    }
    assert!(worst <= 1e-3, "{name}: a point lies {worst} m off the surface");
    // Reduced: closed, 2-manifold, outward, without self-intersection by an exact scan.
    let method = Method::InverseDepth(InverseDepth::default());
    let reduce = Some(ReduceOptions::new(method, Stop::Vertices(684)));
    let made =
        polyhedron(&image, &ViewOptions { reduce, ..ViewOptions::default() }).expect("valid");
    check_planar(&made.mesh, made.image.columns(), made.image.rows()).expect("planar");
    let validity = solid::check(&made.polyhedron);
    assert!(validity.is_valid(), "{name}: {:?}", validity.defects.first());
    assert!(made.polyhedron.volume_m3() > 0.0, "{name}");
}

#[test]
fn depth_images_of_seven_scenes() {
    let Some(folder) = data::folder("rgbd") else { return };
    let mut files: Vec<PathBuf> = fs::read_dir(folder.join("tsdf50"))
        .expect("listed")
        .map(|entry| entry.expect("listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "png"))
        .collect();
    files.sort();
    assert_eq!(files.len(), 17);
    for file in files {
        hold(&file, Camera::new(585.0, 585.0, 320.0, 240.0), 1000.0);
    }
}

#[test]
fn depth_images_as_pgm_and_png() {
    let Some(folder) = data::folder("rgbd") else { return };
    for index in 1..=5 {
        let file = folder.join(format!("slambook_ch5/depth_{index}.pgm"));
        hold(&file, Camera::new(518.0, 519.0, 325.5, 253.5), 1000.0);
    }
    for index in 1..=2 {
        let file = folder.join(format!("tum_fr2/{index}_depth.png"));
        hold(&file, Camera::new(520.9, 521.0, 325.1, 249.7), 5000.0);
    }
}

#[test]
fn organised_clouds() {
    let Some(folder) = data::folder("clouds") else { return };
    for name in [
        "office1.pcd",
        "table_scene_mug_stereo_textured.pcd",
        "capture0001.pcd",
        "capture0002.pcd",
        "capture0003.pcd",
    ] {
        hold(&folder.join(name), Camera::new(1.0, 1.0, 0.0, 0.0), 1.0);
    }
}

#[test]
fn clouds_without_an_image_are_told_apart() {
    let Some(folder) = data::folder("clouds") else { return };
    for (name, count) in [("bun0.pcd", 397), ("fragment.pcd", 113_662)] {
        let bytes = fs::read(folder.join(name)).expect("readable");
        let options = DepthFileOptions { units_per_metre: 1.0, size: None };
        let Ok(DepthFile::Cloud(cloud)) = read(&bytes, Some("pcd"), &options) else {
            panic!("{name}: no cloud")
        };
        assert_eq!((cloud.columns, cloud.rows), (count, 1), "{name}");
        assert!(cloud.points_in_sensor.iter().flatten().all(|x| x.is_finite()), "{name}");
        let points = &cloud.points_in_sensor;
        let refused = depth_image_of(cloud.columns, points, None, &CloudOptions::default());
        assert!(matches!(refused, Err(maps3d::Maps3dError::NotOrganised { .. })), "{name}");
    }
}
