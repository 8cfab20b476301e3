//! How views are united, and what counts as frontier.

use posegraph::Options;
use sensing::Camera;
use solid::boolean::{COINCIDENT_M, JITTER_M};

use crate::reduce::{InverseDepth, Method, ReduceOptions, Stop};
use crate::{Maps3dError, ViewOptions};

/// What is done when places are recognised: the pose graph is optimised, and the union rebuilt where views
/// moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnionCorrection {
    /// Standard deviation of the odometry along each axis, metres per square root of a metre.
    pub sigma_translation: f64,
    /// Standard deviation of the odometry about each axis, radians per square root of a metre.
    pub sigma_rotation_rad: f64,
    /// Standard deviation of a place edge along each axis, metres.
    pub place_sigma_m: f64,
    /// Standard deviation of a place edge about each axis, radians.
    pub place_sigma_rotation_rad: f64,
    /// How the optimiser works.
    pub optimizer: Options,
}

impl Default for UnionCorrection {
    fn default() -> Self {
        Self {
            sigma_translation: 0.05,
            sigma_rotation_rad: 2.0_f64.to_radians(),
            place_sigma_m: 0.01,
            place_sigma_rotation_rad: 0.1_f64.to_radians(),
            optimizer: Options::default(),
        }
    }
}

/// How the united map is made.
#[derive(Clone, Debug, PartialEq)]
pub struct UnionParams {
    /// How a depth image becomes a polyhedron.
    pub view: ViewOptions,
    /// Vertices of a view are moved by up to this on each axis, so that no faces of two views are exactly
    /// coplanar, metres.
    pub jitter_m: f64,
    /// A surface seen under at least this angle hides nothing, however coarse the image is, radians: the
    /// `gap_share` of the depth gaps of `view` is at least what it shows from one pixel to the next.
    pub grazing_rad: f64,
    /// The surface of a view is drawn towards the camera by up to this, metres of depth, the later it came the
    /// more: a wall that is seen again then lies inside of what is free, instead of crossing it all over.
    pub step_in_m: f64,
    /// Faces nearer than this coincide, metres: the obstacle wins.
    pub coincident_m: f64,
    /// Frontier faces no farther than this behind obstacle faces of other views, along their rays, are part of
    /// the wall, metres of depth; 0 for none, 1 at most.
    pub wall_m: f64,
    /// Edges no longer than this are drawn together, metres; 0 leaves all as they are.
    pub clean_m: f64,
    /// The map is cleaned whenever it has so many times the faces that it had when it was cleaned last.
    pub clean_growth: f64,
    /// Radius of the place that the robot takes up and that is free for certain, metres; 0 for none. It joins the
    /// views of one vertex, which may have nothing but the camera in common.
    pub body_m: f64,
    /// Frontier that is still there after so many looks at it is given up; 0 never.
    pub looks_in_vain: u32,
    /// Frontier that hangs together over less does not count, square metres.
    pub sliver_m2: f64,
    /// Frontier faces are cut into pieces with no edge longer than this, metres.
    pub piece_m: f64,
    /// A piece of frontier has about one point to go to in each cube of this side, metres.
    pub point_m: f64,
    /// Frontier farther away than this is not looked at from where the robot hovers, metres.
    pub reach_m: f64,
    /// How much a way ends before the frontier that it leads to, metres.
    pub stop_short_m: f64,
    /// What is not free and nearer than this to an obstacle face is solid, metres.
    pub solid_m: f64,
    /// With a correction of the poses, or without.
    pub correction: Option<UnionCorrection>,
    /// Views that a correction moves by no more than this anywhere within `reach_m` stay where they are, metres.
    pub rebuild_m: f64,
}

impl Default for UnionParams {
    fn default() -> Self {
        let method = Method::InverseDepth(InverseDepth::default());
        let reduce = Some(ReduceOptions::new(method, Stop::Vertices(684)));
        Self {
            view: ViewOptions { reduce, frontier_share: 0.5, ..ViewOptions::default() },
            jitter_m: JITTER_M,
            grazing_rad: 8f64.to_radians(),
            step_in_m: 0.02,
            coincident_m: COINCIDENT_M,
            wall_m: 0.3,
            clean_m: 0.0,
            clean_growth: 1.5,
            body_m: 0.1,
            looks_in_vain: 6,
            sliver_m2: 0.05,
            piece_m: 0.5,
            point_m: 1.0,
            reach_m: 8.0,
            stop_short_m: 0.5,
            solid_m: 0.1,
            correction: None,
            rebuild_m: 0.02,
        }
    }
}

impl UnionParams {
    /// The options of a view through a camera.
    pub(super) fn view_through(&self, camera: &Camera) -> ViewOptions {
        let mut view = self.view.clone();
        if let Some(occlusion) = &mut view.occlusion {
            *occlusion = occlusion.for_grazing(camera, self.grazing_rad);
        }
        view
    }

    /// Checks what can be told without an image.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for what is out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        self.view.check()?;
        let wrong = |option, found, expected| Err(Maps3dError::Option { option, found, expected });
        if self.view.open {
            return wrong("open", 1.0, "views that are joined to the camera");
        }
        let lengths = [
            ("jitter_m", self.jitter_m, 1e-3),
            ("coincident_m", self.coincident_m, 1e-3),
            ("step_in_m", self.step_in_m, 1.0),
            ("wall_m", self.wall_m, 1.0),
            ("clean_m", self.clean_m, 1.0),
            ("body_m", self.body_m, 10.0),
            ("sliver_m2", self.sliver_m2, 1e6),
            ("stop_short_m", self.stop_short_m, 1e3),
            ("solid_m", self.solid_m, 10.0),
            ("rebuild_m", self.rebuild_m, 1e3),
        ];
        for (option, found, most) in lengths {
            if !(0.0..=most).contains(&found) {
                return wrong(option, found, "from 0 to a size that makes sense in a room");
            }
        }
        for (option, found) in
            [("piece_m", self.piece_m), ("point_m", self.point_m), ("reach_m", self.reach_m)]
        {
            if !(0.01..=1e3).contains(&found) {
                return wrong(option, found, "metres from 0.01 to 1000");
            }
        }
        if !(0.0..=std::f64::consts::FRAC_PI_2).contains(&self.grazing_rad) {
            return wrong("grazing_rad", self.grazing_rad, "from 0 to a quarter turn");
        }
        if !(self.clean_growth >= 1.0 && self.clean_growth.is_finite()) {
            return wrong("clean_growth", self.clean_growth, "at least 1");
        }
        if let Some(correction) = &self.correction {
            for (option, found) in [
                ("sigma_translation", correction.sigma_translation),
                ("sigma_rotation_rad", correction.sigma_rotation_rad),
                ("place_sigma_m", correction.place_sigma_m),
                ("place_sigma_rotation_rad", correction.place_sigma_rotation_rad),
            ] {
                if !(found >= 0.0 && found.is_finite()) {
                    return wrong(option, found, "from 0");
                }
            }
        }
        Ok(())
    }
}
