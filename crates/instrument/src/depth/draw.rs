//! Meshes and images as the viewer takes them.

use maps3d::image::FilledImage;
use maps3d::triangulate::{FrontierSquares, ImageMesh};
use rerun::{
    Color, DepthImage, LineStrips2D, LineStrips3D, Mesh3D, Points2D, RecordingStream,
    TriangleIndices,
};
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
    // At all times: the timeline counts vertices, and the image has them all.
    stream.log_static(path, &picture.with_meter(1000.0)).map_err(refused(path))
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
    stream.log_static(path, &points).map_err(refused(path))
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

/// Faces of one colour, each with its own corners, so that light shows its slope; of a mesh too large
/// for that, with shared corners and their mean slopes.
fn faces(
    stream: &RecordingStream,
    path: &str,
    points: &[solid::Point3],
    faces: &[[u32; 3]],
    colour: Rgba,
) -> Result<(), InstrumentError> {
    const MOST: usize = 40_000;
    if faces.is_empty() {
        return stream.log(path, &rerun::Clear::flat()).map_err(refused(path));
    }
    let normal_of = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|vertex| points[vertex as usize]);
        (b - a).cross(&(c - a))
    };
    let unit =
        |normal: solid::Vector3| short(&normal.try_normalize(0.0).unwrap_or_default().into());
    let mesh = if faces.len() <= MOST {
        let corners = faces.iter().flatten().map(|&vertex| short(&points[vertex as usize]));
        let normals = faces.iter().flat_map(|face| [unit(normal_of(face)); 3]);
        Mesh3D::new(corners).with_vertex_normals(normals)
    } else {
        let mut normals = vec![solid::Vector3::zeros(); points.len()];
        for face in faces {
            for &vertex in face {
                normals[vertex as usize] += normal_of(face);
            }
        }
        let indices = faces.iter().map(|&[a, b, c]| TriangleIndices::from([a, b, c]));
        Mesh3D::new(points.iter().map(short))
            .with_vertex_normals(normals.into_iter().map(unit))
            .with_triangle_indices(indices)
    };
    let mesh = mesh.with_albedo_factor(rerun::datatypes::Rgba32(colour));
    stream.log(path, &mesh).map_err(refused(path))
}

#[expect(clippy::cast_possible_truncation, reason = "a screen shows far less than a float holds")]
fn short(p: &solid::Point3) -> [f32; 3] {
    [p.x as f32, p.y as f32, p.z as f32]
}

/// The lifted surface of a mesh, frontier apart from obstacles.
pub(super) fn surface(
    stream: &RecordingStream,
    path: &str,
    points: &[solid::Point3],
    triangles: &[[u32; 3]],
    labels: &[Label],
) -> Result<(), InstrumentError> {
    for (label, colour) in [(Label::Obstacle, OBSTACLE), (Label::Frontier, FRONTIER)] {
        let of_label = triangles.iter().zip(labels).filter(|(_, is)| **is == label);
        let of_label: Vec<[u32; 3]> = of_label.map(|(face, _)| *face).collect();
        faces(stream, &format!("{path}/{label}"), points, &of_label, colour)?;
    }
    Ok(())
}

/// Some of the edges that lead to the camera, where the polyhedron is closed: its walls, all frontier,
/// would hide what is within, and so would the edges of each pixel on the border.
pub(super) fn walls(
    stream: &RecordingStream,
    path: &str,
    polyhedron: &Polyhedron,
) -> Result<(), InstrumentError> {
    const MOST: usize = 100;
    let vertices = polyhedron.vertices();
    let origin = vertices.iter().position(|vertex| vertex.coords.norm_squared() == 0.0);
    let Some(origin) = origin.map(|at| at as u32) else { return Ok(()) };
    let at_origin = polyhedron.faces().iter().filter(|face| face.contains(&origin));
    let ends = at_origin.flat_map(|face| face.iter().filter(|&&vertex| vertex != origin).take(1));
    let ends: Vec<u32> = ends.copied().collect();
    let ends = ends.iter().step_by(ends.len().div_ceil(MOST).max(1));
    let strips = ends.map(|&vertex| [[0.0; 3], short(&vertices[vertex as usize])]);
    let lines = LineStrips3D::new(strips)
        .with_colors([Color::from_u32(FRONTIER)])
        .with_radii([rerun::Radius::new_ui_points(0.5)]);
    stream.log(format!("{path}/walls"), &lines).map_err(refused(path))
}
