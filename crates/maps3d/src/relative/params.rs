//! What can be chosen about the relative map of space.

use std::f64::consts::FRAC_PI_2;

use sensing::Camera;

use crate::reduce::{InverseDepth, Method, ReduceOptions, Stop};
use crate::{Maps3dError, ViewOptions};

/// Parameters of the relative map of space.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativeParams {
    /// How depth images become polyhedra; reduced to at most 16,384 vertices, and joined to the camera.
    pub view: ViewOptions,
    /// Radius of the consolidation scope along the graph, metres (R in \[ISRR19\] 4.3).
    pub consolidation_radius_m: f64,
    /// What a metre of a place edge counts as when shortest paths are sought, above 0. Place edges do not drift:
    /// below 1, placement leans on them and on less odometry.
    pub place_weight: f64,
    /// By how much a volume is smaller than its polyhedron where it closes frontier of others, metres of
    /// depth: two looks from one place do not close each other's frontier.
    pub shrink_m: f64,
    /// The same at the sides of the image, pixels.
    pub inset_px: f64,
    /// A surface seen under at least this angle hides nothing, however coarse the image is, radians: the
    /// `gap_share` of the depth gaps of `view` is at least what it shows from one pixel to the next.
    pub grazing_rad: f64,
    /// Frontier so near behind an obstacle face of another view, along its rays, is closed as wall,
    /// metres; 0 for none. Reduced and drifting surfaces leave bits along walls that no volume covers.
    pub wall_closing_m: f64,
    /// What is solid in one view and lies so deep inside of what another saw to be free contradicts its
    /// placement, metres.
    pub contradiction_m: f64,
    /// A view does not close frontier about which more than this share of the evidence contradicts where it is
    /// placed; 1 closes whatever is said.
    pub contradiction_share: f64,
    /// Frontier that hangs together over less than this does not count, square metres.
    pub sliver_m2: f64,
    /// Large frontier is told as points about so far apart, metres.
    pub point_spacing_m: f64,
}

impl Default for RelativeParams {
    /// Polyhedra of 684 vertices; their faces are frontier where half of what they cover is.
    ///
    /// A large face on a wall may touch the pixels of a depth step at its rim: as frontier it would lie in
    /// no volume, ever.
    fn default() -> Self {
        let method = Method::InverseDepth(InverseDepth::default());
        let reduce = Some(ReduceOptions::new(method, Stop::Vertices(684)));
        Self {
            view: ViewOptions { reduce, frontier_share: 0.5, ..ViewOptions::default() },
            consolidation_radius_m: 12.0,
            place_weight: 1.0,
            shrink_m: 0.01,
            inset_px: 0.3,
            grazing_rad: 8f64.to_radians(),
            wall_closing_m: 0.3,
            contradiction_m: 0.3,
            contradiction_share: 0.5,
            sliver_m2: 0.05,
            point_spacing_m: 0.8,
        }
    }
}

impl RelativeParams {
    /// The options of a view through a camera.
    pub(super) fn view_through(&self, camera: &Camera) -> ViewOptions {
        let mut view = self.view.clone();
        if let Some(occlusion) = &mut view.occlusion {
            let pixel_rad = 1.0 / camera.fx.abs().min(camera.fy.abs());
            let seen = pixel_rad / self.grazing_rad.tan();
            if seen.is_finite() {
                occlusion.gap_share = occlusion.gap_share.max(seen);
            }
        }
        view
    }

    /// Checks the fields.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] with the first that is out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        self.view.check()?;
        if self.view.open {
            let expected = "0: the surface joined to the camera";
            return Err(Maps3dError::Option { option: "open", found: 1.0, expected });
        }
        for (option, found) in [
            ("consolidation_radius_m", self.consolidation_radius_m),
            ("shrink_m", self.shrink_m),
            ("inset_px", self.inset_px),
            ("wall_closing_m", self.wall_closing_m),
            ("contradiction_m", self.contradiction_m),
            ("sliver_m2", self.sliver_m2),
        ] {
            if !(0.0..=1e6).contains(&found) {
                return Err(Maps3dError::Option {
                    option,
                    found,
                    expected: "a number from 0 to 1e6",
                });
            }
        }
        if !(1e-3..=1e3).contains(&self.place_weight) {
            let (option, found) = ("place_weight", self.place_weight);
            return Err(Maps3dError::Option { option, found, expected: "from 0.001 to 1000" });
        }
        if !(0.0..1.0).contains(&self.inset_px) {
            let (option, found) = ("inset_px", self.inset_px);
            return Err(Maps3dError::Option {
                option,
                found,
                expected: "0 or more, below 1 pixel",
            });
        }
        if !(0.0..=1.0).contains(&self.contradiction_share) {
            let (option, found) = ("contradiction_share", self.contradiction_share);
            return Err(Maps3dError::Option { option, found, expected: "a share from 0 to 1" });
        }
        if !(0.0..=FRAC_PI_2).contains(&self.grazing_rad) {
            let (option, found) = ("grazing_rad", self.grazing_rad);
            return Err(Maps3dError::Option { option, found, expected: "from 0 to a right angle" });
        }
        if !(0.01..=1e6).contains(&self.point_spacing_m) {
            let (option, found) = ("point_spacing_m", self.point_spacing_m);
            return Err(Maps3dError::Option { option, found, expected: "from 0.01 to 1e6 m" });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_its_range_is_named() {
        assert!(RelativeParams::default().check().is_ok());
        type Set = fn(&mut RelativeParams, f64);
        let fields: [(&str, Set, [f64; 2], [f64; 3]); 4] = [
            ("grazing_rad", |p, x| p.grazing_rad = x, [0.0, 1.5], [-0.1, 2.0, f64::NAN]),
            (
                "contradiction_share",
                |p, x| p.contradiction_share = x,
                [0.0, 1.0],
                [-0.1, 1.1, f64::NAN],
            ),
            (
                "contradiction_m",
                |p, x| p.contradiction_m = x,
                [0.0, 3.0],
                [-0.1, 1e7, f64::INFINITY],
            ),
            ("place_weight", |p, x| p.place_weight = x, [0.001, 10.0], [0.0, 1e4, f64::NAN]),
        ];
        for (name, set, good, bad) in fields {
            for value in good {
                let mut params = RelativeParams::default();
                set(&mut params, value);
                assert!(params.check().is_ok(), "{name} {value}");
            }
            for value in bad {
                let mut params = RelativeParams::default();
                set(&mut params, value);
                let refused = params.check();
                let is_named =
                    matches!(refused, Err(Maps3dError::Option { option, .. }) if option == name);
                assert!(is_named, "{name} {value}: {refused:?}");
            }
        }
    }
}
