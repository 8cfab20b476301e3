//! Scans and how they become volumes.

use geometry::Point2;
use maps2d::volume::{LocalVolume, VolumeEvent};
use pose::Se2;
use probe::Probe;

use super::Recorder;
use super::happened::Happened;
use crate::{Family, palette};

impl Probe<VolumeEvent<'_>> for Recorder {
    fn on(&self) -> bool {
        self.inner.as_ref().is_some_and(|inner| inner.full(Family::Sensing))
    }

    fn emit(&mut self, event: VolumeEvent<'_>) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        if !inner.full(Family::Sensing) {
            return;
        }
        let now = inner.now;
        let happened = &mut inner.happened;
        let tell = |happened: &mut Happened, line: std::fmt::Arguments<'_>| {
            happened.event(Family::Sensing, event.variant(), line, &now);
        };
        match event {
            VolumeEvent::Measured { vertex, scan, anchor_from_sensor } => {
                let belief_from_sensor = inner.places.of(vertex) * anchor_from_sensor;
                let origin = Point2::from(belief_from_sensor.translation);
                let mut hits = 0;
                for (bearing_rad, reading) in scan.readings() {
                    let (range_m, colour) = match reading {
                        sensing::Reading::Hit(range_m) => (range_m, palette::HIT),
                        sensing::Reading::Miss => (scan.range_max_m, palette::MISS),
                    };
                    hits += usize::from(colour == palette::HIT);
                    let (sin, cos) = bearing_rad.sin_cos();
                    let end =
                        belief_from_sensor.transform(&Point2::new(range_m * cos, range_m * sin));
                    happened.lines.segment(&origin, &end, palette::MISS);
                    happened.points.point(&end, colour);
                }
                let (rays, misses) = (scan.len(), scan.len() - hits);
                let heading_deg = anchor_from_sensor.angle().to_degrees();
                tell(
                    happened,
                    format_args!(
                        "{rays} rays at {vertex}, heading {heading_deg:.1} deg: {hits} hits, {misses} misses"
                    ),
                );
            }
            VolumeEvent::Sampled { vertex, samples } => {
                let place = inner.places.of(vertex);
                for sample in samples.as_slice() {
                    let colour = if sample.hit { palette::HIT } else { palette::MISS };
                    happened.points.point(&place.transform(&sample.end_in_anchor), colour);
                }
                let gaps = (0..samples.len()).filter(|&i| samples.is_gap_after(i)).count();
                let count = samples.len();
                tell(
                    happened,
                    format_args!(
                        "{count} samples by bearing at {vertex}, {gaps} gaps between them"
                    ),
                );
            }
            VolumeEvent::Built { vertex, volume } => {
                draw(happened, volume, &inner.places.of(vertex));
                tell(happened, format_args!("volume of {vertex}: {}", Labels(volume)));
            }
            VolumeEvent::Merged { vertex, volume } => {
                draw(happened, volume, &inner.places.of(vertex));
                tell(happened, format_args!("scan merged into {vertex}: {}", Labels(volume)));
            }
        }
    }
}

/// The raw view polygon with its labels; occlusion edges are frontier.
fn draw(happened: &mut Happened, volume: &LocalVolume, place: &Se2) {
    for edge in &volume.obstacles {
        let (from, to) = (place.transform(&edge.from), place.transform(&edge.to));
        happened.lines.segment(&from, &to, palette::OBSTACLE);
    }
    for edge in &volume.frontier {
        let (from, to) = (place.transform(&edge.from), place.transform(&edge.to));
        happened.lines.segment(&from, &to, palette::FRONTIER);
    }
    for post in &volume.posts {
        happened.points.point(&place.transform(post), palette::OBSTACLE);
    }
}

/// What a volume consists of, in words.
struct Labels<'a>(&'a LocalVolume);

impl std::fmt::Display for Labels<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let volume = self.0;
        let frontier_m: f64 = volume.frontier.iter().map(|edge| edge.length_m()).sum();
        let obstacle_m: f64 =
            volume.obstacles.iter().map(|edge| (edge.to - edge.from).norm()).sum();
        write!(
            f,
            "{:.1} m2, {} obstacle edges ({obstacle_m:.2} m), {} frontier edges ({frontier_m:.2} m)",
            volume.polygon.area(),
            volume.obstacles.len(),
            volume.frontier.len(),
        )
    }
}
