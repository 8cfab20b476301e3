//! The graph as lines and points.

use pose::{Se2, Se3};
use rerun::{Color, EntityPath, LineStrips2D, LineStrips3D, Points2D, Points3D, RecordingStream};

use crate::InstrumentError;
use crate::columns::{Rgba, rgb};

/// Poses that can be drawn.
pub trait DrawnPose: Copy + 'static {
    /// Whether they are drawn in space.
    const IN_SPACE: bool;
    /// Where they are, metres; the height is 0 in the plane.
    fn position_m(&self) -> [f64; 3];
}

impl DrawnPose for Se2 {
    const IN_SPACE: bool = false;
    fn position_m(&self) -> [f64; 3] {
        [self.translation.x, self.translation.y, 0.0]
    }
}

impl DrawnPose for Se3 {
    const IN_SPACE: bool = true;
    fn position_m(&self) -> [f64; 3] {
        self.translation.into()
    }
}

/// What edges without influence are drawn in.
pub(super) const REJECTED: Rgba = rgb(225, 30, 200);

/// A residual, in standard deviations per degree of freedom, up to which an edge fits.
pub(super) const FITS: f64 = 1.5;

/// One from which on it is far off.
pub(super) const FAR_OFF: f64 = 30.0;

/// Grey-blue where an edge fits, over yellow to red where it is far off; logarithmic between.
pub(super) fn of_residual(sigmas: f64) -> Rgba {
    const FIT: [f64; 3] = [120.0, 140.0, 165.0];
    const STRAIN: [f64; 3] = [240.0, 190.0, 30.0];
    const OFF: [f64; 3] = [225.0, 25.0, 25.0];
    let share = (sigmas / FITS).ln() / (FAR_OFF / FITS).ln();
    // What is no number is far off, too.
    let share = if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) };
    let (from, to, share) =
        if share < 0.5 { (FIT, STRAIN, share * 2.0) } else { (STRAIN, OFF, share * 2.0 - 1.0) };
    let mix = |channel: usize| (from[channel] + share * (to[channel] - from[channel])) as u8;
    rgb(mix(0), mix(1), mix(2))
}

/// Straight lines from pose to pose, drawn together.
pub(super) struct Strokes {
    pub path: &'static str,
    pub ends: Vec<[[f64; 3]; 2]>,
    pub colours: Vec<Rgba>,
    /// Radius in screen points.
    pub points: f32,
    /// In a 2D view, what has more is drawn over what has less.
    pub order: f32,
}

fn refused(path: &str) -> impl Fn(rerun::RecordingStreamError) -> InstrumentError {
    let entity = path.to_owned();
    move |error| InstrumentError::Rows { entity: entity.clone(), reason: error.to_string() }
}

#[expect(clippy::cast_possible_truncation, reason = "a screen shows far less than a float holds")]
fn short(at: [f64; 3]) -> [f32; 3] {
    at.map(|x| x as f32)
}

impl Strokes {
    /// Sends the lines, which replace those of the iteration before.
    pub fn send(self, stream: &RecordingStream, in_space: bool) -> Result<(), InstrumentError> {
        let Self { path, ends, colours, points, order } = self;
        let colours = colours.into_iter().map(Color::from_u32);
        let radius = [rerun::Radius::new_ui_points(points)];
        let entity = EntityPath::from(path);
        let sent = if in_space {
            let strips = ends.iter().map(|ends| ends.map(short));
            let lines = LineStrips3D::new(strips).with_colors(colours).with_radii(radius);
            stream.log(entity, &lines)
        } else {
            let strips = ends.iter().map(|ends| ends.map(|at| [short(at)[0], short(at)[1]]));
            let lines = LineStrips2D::new(strips)
                .with_colors(colours)
                .with_radii(radius)
                .with_draw_order(order);
            stream.log(entity, &lines)
        };
        sent.map_err(refused(path))
    }
}

/// Sends the poses as points of one colour.
pub(super) fn send_points(
    stream: &RecordingStream,
    path: &str,
    at: impl Iterator<Item = [f64; 3]>,
    in_space: bool,
    (colour, points): (Rgba, f32),
) -> Result<(), InstrumentError> {
    let (colour, radius) = ([Color::from_u32(colour)], [rerun::Radius::new_ui_points(points)]);
    let sent = if in_space {
        let cloud = Points3D::new(at.map(short));
        stream.log(path, &cloud.with_colors(colour).with_radii(radius))
    } else {
        let cloud = Points2D::new(at.map(|at| [short(at)[0], short(at)[1]]));
        stream.log(path, &cloud.with_colors(colour).with_radii(radius).with_draw_order(20.0))
    };
    sent.map_err(refused(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_run_from_grey_over_yellow_to_red() {
        let red = |sigmas: f64| of_residual(sigmas).to_be_bytes()[0];
        let blue = |sigmas: f64| of_residual(sigmas).to_be_bytes()[2];
        assert_eq!(of_residual(0.0), of_residual(FITS));
        assert_eq!(of_residual(1e9), of_residual(f64::NAN));
        assert!(red(3.0) > red(1.0) && blue(3.0) < blue(1.0) && blue(1e9) < blue(3.0));
    }
}
