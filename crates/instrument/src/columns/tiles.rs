//! A plane of cells as small images, of which only those that changed are sent.

use std::collections::BTreeMap;
use std::sync::Arc;

use geometry::{Point2, Vector2};
use rerun::external::arrow::array::{ListArray, UInt8Array};
use rerun::external::arrow::buffer::{OffsetBuffer, ScalarBuffer};
use rerun::external::arrow::datatypes::{DataType, Field};
use rerun::{EntityPath, RecordingStream, SegmentationImage, Transform3D};

use super::send::Column;
use super::{Now, Times, fixed, send};
use crate::InstrumentError;

/// Cells along each side of a tile.
const SIDE: usize = 32;

struct Tile {
    path: EntityPath,
    cells: Vec<u8>,
    dirty: bool,
    times: Times,
    rows: Vec<u8>,
    /// Whether it was said where the tile lies and how it looks.
    placed: bool,
}

impl Tile {
    fn new(parent: &str, (column, row): (i64, i64)) -> Self {
        Self {
            path: format!("{parent}/{column}_{row}").into(),
            cells: vec![0; SIDE * SIDE],
            dirty: false,
            times: Times::default(),
            rows: Vec::new(),
            placed: false,
        }
    }
}

/// Cells of a plane with a class each, anywhere; row 0 of a tile is its lowest.
pub(crate) struct Tiles {
    path: String,
    /// Width and height of a cell.
    cell_m: Vector2,
    origin: Point2,
    opacity: f32,
    draw_order: f32,
    tiles: BTreeMap<(i64, i64), Tile>,
}

impl Tiles {
    /// No cell yet; `origin` is the lower-left corner of cell (0, 0) in the parent's frame.
    pub fn new(path: &str, cell_m: Vector2, origin: Point2, opacity: f32, draw_order: f32) -> Self {
        let path = path.to_owned();
        Self { path, cell_m, origin, opacity, draw_order, tiles: BTreeMap::new() }
    }

    /// Gives a cell a class.
    pub fn set(&mut self, column: i64, row: i64, class: u8) {
        let side = SIDE as i64;
        let key = (column.div_euclid(side), row.div_euclid(side));
        let parent = &self.path;
        let tile = self.tiles.entry(key).or_insert_with(|| Tile::new(parent, key));
        let (x, y) = (column.rem_euclid(side) as usize, row.rem_euclid(side) as usize);
        let cell = &mut tile.cells[y * SIDE + x];
        tile.dirty |= *cell != class;
        *cell = class;
    }

    /// The class of a cell; 0 where none was given.
    pub fn get(&self, column: i64, row: i64) -> u8 {
        let side = SIDE as i64;
        let key = (column.div_euclid(side), row.div_euclid(side));
        let (x, y) = (column.rem_euclid(side) as usize, row.rem_euclid(side) as usize);
        self.tiles.get(&key).map_or(0, |tile| tile.cells[y * SIDE + x])
    }

    /// Gives every cell class 0.
    pub fn clear(&mut self) {
        for tile in self.tiles.values_mut() {
            tile.dirty |= tile.cells.iter().any(|&class| class != 0);
            tile.cells.fill(0);
        }
    }

    /// Ends the row of every tile that changed.
    pub fn end_row(&mut self, now: &Now) {
        for tile in self.tiles.values_mut().filter(|tile| tile.dirty) {
            tile.rows.extend_from_slice(&tile.cells);
            tile.times.push(now);
            tile.dirty = false;
        }
    }

    /// Size of what is held, bytes.
    pub fn held_bytes(&self) -> usize {
        self.tiles.values().map(|tile| tile.rows.len()).sum()
    }

    /// Sends what is held.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        for (key, tile) in &mut self.tiles {
            let rows = tile.times.len();
            if rows == 0 {
                continue;
            }
            if !std::mem::replace(&mut tile.placed, true) {
                let extent_m = self.cell_m * SIDE as f64;
                let corner =
                    self.origin + Vector2::new(key.0 as f64, key.1 as f64).component_mul(&extent_m);
                let place = Transform3D::from_translation([corner.x as f32, corner.y as f32, 0.0])
                    .with_scale([self.cell_m.x as f32, self.cell_m.y as f32, 1.0]);
                fixed(stream, &tile.path, &place)?;
                let format = rerun::datatypes::ImageFormat::segmentation(
                    [SIDE as u32, SIDE as u32],
                    rerun::ChannelDatatype::U8,
                );
                let look = SegmentationImage::update_fields()
                    .with_format(format)
                    .with_opacity(self.opacity)
                    .with_draw_order(self.draw_order);
                fixed(stream, &tile.path, &look)?;
            }
            let item = Arc::new(Field::new("item", DataType::UInt8, false));
            let ends: Vec<i32> = (0..=rows).map(|row| (row * SIDE * SIDE) as i32).collect();
            let offsets = OffsetBuffer::new(ScalarBuffer::from(ends));
            let bytes = Arc::new(UInt8Array::from(std::mem::take(&mut tile.rows)));
            let column = Column {
                descriptor: SegmentationImage::descriptor_buffer(),
                instances: Arc::new(ListArray::new(item, offsets, bytes, None)),
                lengths: vec![1; rows],
            };
            send(stream, &tile.path, &mut tile.times, [column])?;
        }
        Ok(())
    }
}
