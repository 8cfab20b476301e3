//! What is true: the place, the robot in it, and what was really seen.

use geometry::Point2;
use metrics::{Coverage, Witness};
use rerun::{LineStrips2D, RecordingStream};
use worlds::World2d;

use crate::InstrumentError;
use crate::columns::{Growing, Lines, Now, Tiles, fixed};
use crate::palette;

/// Rows of `truth/..`.
pub(super) struct Truth {
    name: String,
    cells: Option<Tiles>,
    columns: usize,
    fresh: Vec<usize>,
    path: Growing<Lines>,
    robot: Lines,
    view: Lines,
    last: Option<Point2>,
}

impl Truth {
    pub fn new(name: &str) -> Self {
        let path = format!("{name}/truth/path");
        Self {
            name: name.to_owned(),
            cells: None,
            columns: 1,
            fresh: Vec::new(),
            path: Growing::new(move |part| Lines::new(format!("{path}/{part}"), -0.8, 5.0)),
            robot: Lines::new(format!("{name}/truth/robot"), -1.6, 40.0),
            view: Lines::new(format!("{name}/truth/view"), -1.2, 30.0),
            last: None,
        }
    }

    /// Draws what does not change: walls, and the cells that count.
    pub fn place(
        &mut self,
        stream: &RecordingStream,
        world: &World2d,
        coverage: &Coverage,
    ) -> Result<(), InstrumentError> {
        let walls = world.obstacles().iter().map(|(a, b)| [[a.x, a.y], [b.x, b.y]]);
        let walls = walls.map(|line| line.map(|point| point.map(|v| v as f32)));
        let drawing = LineStrips2D::new(walls)
            .with_radii([rerun::Radius::new_ui_points(1.2)])
            .with_colors([rerun::Color::from_u32(palette::TRUE_WALL)])
            .with_draw_order(4.0);
        fixed(stream, &format!("{}/truth/walls", self.name).into(), &drawing)?;

        let (columns, rows) = coverage.size();
        self.columns = columns.max(1);
        let cell_m = coverage.cell_m();
        let mut cells =
            Tiles::new(&format!("{}/truth/cells", self.name), cell_m, world.bounds().0, 1.0, -20.0);
        for index in (0..columns * rows).filter(|&index| coverage.counts(index)) {
            let (column, row) = self.cell(index);
            let seen = coverage.first_seen_m(index).is_some();
            cells.set(column, row, if seen { palette::CELL_SEEN } else { palette::CELL_UNSEEN });
        }
        self.cells = Some(cells);
        Ok(())
    }

    fn cell(&self, index: usize) -> (i64, i64) {
        ((index % self.columns) as i64, (index / self.columns) as i64)
    }

    /// Takes over the truth at the end of a step.
    pub fn step(&mut self, witness: &Witness, newly_seen: &[usize]) {
        let fresh = std::mem::replace(&mut self.fresh, newly_seen.to_vec());
        let old: Vec<_> = fresh.into_iter().map(|index| self.cell(index)).collect();
        let new: Vec<_> = newly_seen.iter().map(|&index| self.cell(index)).collect();
        if let Some(cells) = &mut self.cells {
            old.into_iter().for_each(|(x, y)| cells.set(x, y, palette::CELL_SEEN));
            new.into_iter().for_each(|(x, y)| cells.set(x, y, palette::CELL_NEW));
        }
        let at = Point2::from(witness.world_from_body().translation);
        if let Some(last) = self.last.replace(at)
            && last != at
        {
            self.path.push(&last, &at, palette::TRUE_PATH);
        }
    }

    /// Draws the truth as it is now.
    pub fn end_step(&mut self, witness: &Witness, now: &Now) {
        super::draw_robot(&mut self.robot, &witness.world_from_body());
        self.robot.end_row(now);
        let view = witness.view();
        let from = Point2::from(view.world_from_sensor.translation);
        if !view.ends_in_world.is_empty() {
            let ends = view.ends_in_world.iter().copied();
            if view.full_circle {
                self.view
                    .strip(ends.chain(view.ends_in_world.first().copied()), palette::TRUE_VIEW);
            } else {
                self.view.strip([from].into_iter().chain(ends).chain([from]), palette::TRUE_VIEW);
            }
        }
        self.view.end_row(now);
        self.path.end_row(now);
        if let Some(cells) = &mut self.cells {
            cells.end_row(now);
        }
    }

    pub fn held_bytes(&self) -> usize {
        self.path.held_bytes()
            + self.view.held_bytes()
            + self.cells.as_ref().map_or(0, Tiles::held_bytes)
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.path.send(stream)?;
        self.robot.send(stream)?;
        self.view.send(stream)?;
        match &mut self.cells {
            Some(cells) => cells.send(stream),
            None => Ok(()),
        }
    }
}
