//! What of a frontier face is open still.

use geometry::planar::overlay::StepRings;

use super::grid::{self, STEPS, TWICE_AREA};

/// Set in the first coordinate of the last corner of each ring.
const LAST: u32 = 1 << 31;

/// The open part of one frontier face, on the grid of the face.
///
/// Most faces are whole or closed and hold nothing on the heap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OpenPart {
    /// `None` for the whole face; rings one after another, outer ones counter-clockwise.
    corners: Option<Box<[[u32; 2]]>>,
}

impl OpenPart {
    /// Nothing of the face.
    pub(super) fn closed() -> Self {
        Self { corners: Some(Box::default()) }
    }

    /// What rings wind around.
    pub(super) fn of(rings: &StepRings) -> Self {
        let mut corners: Vec<[u32; 2]> = Vec::with_capacity(rings.corner_count());
        for ring in rings.rings() {
            corners.extend(ring.iter().map(|corner| corner.map(|step| step as u32)));
            if let Some(last) = corners.last_mut() {
                last[0] |= LAST;
            }
        }
        Self { corners: Some(corners.into()) }
    }

    /// Whether the whole face is open.
    pub fn is_whole(&self) -> bool {
        self.corners.is_none()
    }

    /// Whether nothing is open any more.
    pub fn is_closed(&self) -> bool {
        self.corners.as_ref().is_some_and(|corners| corners.is_empty())
    }

    /// Writes the rings; outer ones counter-clockwise, each followed by its holes, clockwise.
    pub fn rings_into(&self, out: &mut StepRings) {
        let Some(corners) = &self.corners else {
            grid::whole(out);
            return;
        };
        out.clear();
        for ring in corners.split_inclusive(|corner| corner[0] & LAST != 0) {
            out.push(ring.iter().map(|&[x, y]| [(x & !LAST) as i32, y as i32]));
        }
    }

    /// The rings; see [`rings_into`](Self::rings_into).
    pub fn rings(&self) -> StepRings {
        let mut out = StepRings::new();
        self.rings_into(&mut out);
        out
    }

    /// The least box around what is open, on the grid of the face: its least and its largest corner; `None`
    /// where nothing is open.
    pub(super) fn bounds(&self) -> Option<[[i32; 2]; 2]> {
        let Some(corners) = &self.corners else { return Some([[0, 0], [STEPS, STEPS]]) };
        let places = corners.iter().map(|&[x, y]| [(x & !LAST) as i32, y as i32]);
        places.map(|place| [place, place]).reduce(|[low, high], [place, _]| {
            let axes = [0, 1];
            [axes.map(|i| low[i].min(place[i])), axes.map(|i| high[i].max(place[i]))]
        })
    }

    /// Twice its area, square steps of the grid of the face; of the whole face,
    /// [`TWICE_AREA`](super::TWICE_AREA).
    pub fn twice_area(&self) -> i64 {
        match &self.corners {
            None => TWICE_AREA,
            Some(corners) if corners.is_empty() => 0,
            Some(_) => self.rings().twice_area(),
        }
    }

    /// Its share of the face.
    pub fn share(&self) -> f64 {
        self.twice_area() as f64 / TWICE_AREA as f64
    }

    /// Memory held on the heap, bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.corners.as_ref().map_or(0, |corners| corners.len() * size_of::<[u32; 2]>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_come_back_as_they_went_in() {
        let mut rings = StepRings::new();
        rings.push([[0, 0], [900, 0], [0, 900]]);
        rings.push([[10, 10], [10, 60], [60, 10]]);
        let part = OpenPart::of(&rings);
        assert_eq!(part.rings(), rings);
        assert_eq!(part.twice_area(), 900 * 900 - 2500);
        assert!(!part.is_whole() && !part.is_closed());
        assert_eq!(part.bounds(), Some([[0, 0], [900, 900]]));
        assert!(OpenPart::closed().is_closed() && OpenPart::closed().rings().is_empty());
        assert_eq!(OpenPart::default().rings().twice_area(), TWICE_AREA);
        assert!(OpenPart::of(&StepRings::new()).is_closed());
        assert_eq!(OpenPart::closed().bounds(), None);
    }
}
