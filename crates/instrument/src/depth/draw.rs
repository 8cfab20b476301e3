//! Meshes and images as the viewer takes them.

use maps3d::image::FilledImage;
use maps3d::triangulate::{FrontierSquares, ImageMesh};
use rerun::{Color, DepthImage, LineStrips2D, Mesh3D, Points2D, RecordingStream, TriangleIndices};
use solid::{Label, Polyhedron};

use crate::InstrumentError;
use crate::columns::{Rgba, rgb};

/// What obstacle faces are drawn in.
pub(super) const OBSTACLE: Rgba = rgb(170, 175, 185);
/// What frontier faces are drawn in.
pub(super) const FRONTIER: Rgba = rgb(240, 140, 40);

fn refused(path: &str) -> impl Fn(rerun::RecordingStreamError) -> InstrumentError {
    let entity = path.to_owned();
    move |error| InstrumentError::Rows { entity: entity.clone(), reason: error.to_string() }
}

/// The depths as they are, in millimetres of 16 bits.
pub(super) fn image(
    stream: &RecordingStream,
    path: &str,
    image: &FilledImage,
) -> Result<(), InstrumentError> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "for looking")]
    let levels: Vec<u16> =
        image.depths_m().iter().map(|z| (z * 1000.0).min(65535.0) as u16).collect();
    let size = [image.columns() as u32, image.rows() as u32];
    let picture = DepthImage::from_data_type_and_bytes(
        levels.iter().flat_map(|level| level.to_le_bytes()).collect::<Vec<u8>>(),
        size,
        rerun::ChannelDatatype::U16,
    );
    stream.log(path, &picture.with_meter(1000.0)).map_err(refused(path))
}

/// A point for each square of pixels that holds frontier, thinned to some thousands.
pub(super) fn frontier(
    stream: &RecordingStream,
    path: &str,
    squares: &FrontierSquares,
) -> Result<(), InstrumentError> {
    const MOST: usize = 20_000;
    let held = (0..squares.rows()).flat_map(|row| {
        (0..squares.columns())
            .filter(move |&column| squares.faces(column, row).contains(&true))
            .map(move |column| [column as f32 + 1.0, row as f32 + 1.0])
    });
    let held: Vec<[f32; 2]> = held.collect();
    let step = held.len().div_ceil(MOST).max(1);
    let points = Points2D::new(held.into_iter().step_by(step))
        .with_colors([Color::from_u32(FRONTIER)])
        .with_radii([rerun::Radius::new_ui_points(1.0)]);
    stream.log(path, &points).map_err(refused(path))
}

/// The edges of a mesh over the image; none where there would be too many to look at.
pub(super) fn edges(
    stream: &RecordingStream,
    path: &str,
    mesh: &ImageMesh,
) -> Result<(), InstrumentError> {
    const MOST: usize = 25_000;
    let mut strips: Vec<[[f32; 2]; 2]> = Vec::new();
    if mesh.triangles.len() < MOST {
        for &[a, b, c] in &mesh.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                // Each edge once; on the border there is one face only.
                let [from, to] = [p, q].map(|v| mesh.pixels[v as usize].map(f32::from));
                let on_border = from[0] == to[0] && (from[0] == 0.0 || p > q)
                    || from[1] == to[1] && (from[1] == 0.0 || p > q);
                if p < q || on_border {
                    // Pixel centres of the viewer lie at halves.
                    strips.push([from.map(|x| x + 0.5), to.map(|x| x + 0.5)]);
                }
            }
        }
    }
    let lines = LineStrips2D::new(strips)
        .with_colors([Color::from_u32(rgb(30, 220, 255))])
        .with_radii([rerun::Radius::new_ui_points(0.4)]);
    stream.log(path, &lines).map_err(refused(path))
}

/// Faces of one colour.
fn faces(
    stream: &RecordingStream,
    path: &str,
    points: &[[f32; 3]],
    faces: impl Iterator<Item = [u32; 3]>,
    colour: Rgba,
) -> Result<(), InstrumentError> {
    let faces: Vec<TriangleIndices> =
        faces.map(|[a, b, c]| TriangleIndices::from([a, b, c])).collect();
    if faces.is_empty() {
        return stream.log(path, &rerun::Clear::flat()).map_err(refused(path));
    }
    let mesh = Mesh3D::new(points.iter().copied())
        .with_triangle_indices(faces)
        .with_albedo_factor(rerun::datatypes::Rgba32(colour));
    stream.log(path, &mesh).map_err(refused(path))
}

#[expect(clippy::cast_possible_truncation, reason = "a screen shows far less than a float holds")]
fn short(p: &solid::Point3) -> [f32; 3] {
    [p.x as f32, p.y as f32, p.z as f32]
}

/// The lifted surface of a mesh, not labelled yet.
pub(super) fn surface(
    stream: &RecordingStream,
    path: &str,
    image: &FilledImage,
    mesh: &ImageMesh,
) -> Result<(), InstrumentError> {
    let points: Vec<[f32; 3]> = mesh.points_in_camera(image.camera()).iter().map(short).collect();
    faces(stream, path, &points, mesh.triangles.iter().copied(), OBSTACLE)
}

/// The polyhedron, frontier apart from obstacles.
pub(super) fn polyhedron(
    stream: &RecordingStream,
    path: &str,
    polyhedron: &Polyhedron,
) -> Result<(), InstrumentError> {
    let points: Vec<[f32; 3]> = polyhedron.vertices().iter().map(short).collect();
    for (label, colour) in [(Label::Obstacle, OBSTACLE), (Label::Frontier, FRONTIER)] {
        let of_label = polyhedron.faces().iter().zip(polyhedron.labels());
        let of_label = of_label.filter(|(_, is)| **is == label).map(|(face, _)| *face);
        faces(stream, &format!("{path}/{label}"), &points, of_label, colour)?;
    }
    Ok(())
}
