//! Depth images, and what comes of them on the way to a polyhedron.

use maps3d::{DepthEvent, Hovering};
use pose::Se3;
use rerun::{DepthImage, Pinhole};

use super::ink::{Faces, Ink, placed};

/// A depth image as the camera gave it, in millimetres, under `camera/`.
pub(super) fn image(ink: &mut Ink, image: &sensing::DepthImage) {
    let (columns, rows) = (image.columns, image.rows());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "for looking")]
    let levels = image.depths_m.iter().map(|&depth_m| match depth_m.is_finite() {
        true => (depth_m * 1000.0).clamp(0.0, 65535.0) as u16,
        false => 0,
    });
    let bytes: Vec<u8> = levels.flat_map(u16::to_le_bytes).collect();
    let size = [columns as u32, rows as u32];
    let picture = DepthImage::from_data_type_and_bytes(bytes, size, rerun::ChannelDatatype::U16);
    ink.draw("camera/depth", &picture.with_meter(1000.0));
}

/// Where the camera is in a frame, and how wide it sees, at `part`.
pub(super) fn camera(
    ink: &mut Ink,
    part: &str,
    frame_from_camera: &Se3,
    image: &sensing::DepthImage,
) {
    let camera = &image.camera;
    #[expect(clippy::cast_possible_truncation, reason = "for looking")]
    let pinhole = Pinhole::from_focal_length_and_resolution(
        [camera.fx.abs() as f32, camera.fy.abs() as f32],
        [image.columns as f32, image.rows() as f32],
    );
    ink.draw(part, &placed(frame_from_camera));
    ink.draw(part, &pinhole.with_image_plane_distance(0.6));
}

/// The last view's polyhedron, in the frame of its vertex, under `belief/look`.
pub(super) fn polyhedron(ink: &mut Ink, event: &DepthEvent<'_>) {
    if let DepthEvent::Joined { polyhedron } = event {
        ink.draw("belief/look/volume", &Faces::inside_of(polyhedron).mesh());
    }
}

/// Where the last view was taken, in the frame in which the belief is drawn.
pub(super) fn place_look(ink: &mut Ink, frame_from_vertex: &Se3, vertex_from_camera: &Se3) {
    ink.draw("belief/look", &placed(&(*frame_from_vertex * *vertex_from_camera)));
}

/// One line about a step on the way from the image to the polyhedron.
pub(super) fn line(event: &DepthEvent<'_>) -> String {
    match event {
        DepthEvent::Prepared { image } => format!(
            "{} x {} pixels, {} missing",
            image.columns(),
            image.rows(),
            image.missing_count()
        ),
        DepthEvent::Triangulated { squares, .. } => {
            format!("{} faces of the grid", 2 * squares.columns() * squares.rows())
        }
        DepthEvent::Removed { contribution_m, vertices, .. } => {
            format!("{contribution_m:.4} m, {vertices} vertices left")
        }
        DepthEvent::Inserted { error_m, vertices, .. } => {
            format!("{error_m:.4} m off, {vertices} vertices now")
        }
        DepthEvent::Reached { mesh, .. }
        | DepthEvent::Thinned { mesh }
        | DepthEvent::Fitted { mesh }
        | DepthEvent::Reduced { mesh, .. } => {
            format!("{} vertices, {} faces", mesh.pixels.len(), mesh.triangles.len())
        }
        DepthEvent::Flipped { round, sides } => format!("round {round}: {sides} sides"),
        DepthEvent::Withheld { vertices, .. } => format!("{vertices} vertices came nearer"),
        DepthEvent::Labelled { labels, .. } => {
            let frontier = labels.iter().filter(|label| **label == solid::Label::Frontier).count();
            format!("{frontier} of {} faces are frontier", labels.len())
        }
        DepthEvent::Joined { polyhedron } => format!("{} faces", polyhedron.faces().len()),
    }
}

/// Whether a step is told in a run: single pixels are for recordings of one image.
pub(super) fn is_told(event: &DepthEvent<'_>) -> bool {
    !matches!(event, DepthEvent::Removed { .. } | DepthEvent::Inserted { .. })
}

/// Where the robot hovers, in words.
pub(super) fn place(hovering: &Hovering) -> String {
    let yaw = hovering.vertex_from_body.rotation.euler_angles().2.to_degrees();
    format!("vertex {}, turned by {yaw:.0} degrees", hovering.vertex)
}
