//! The tables of a config as the algorithms want them: plain parameters, radians.

use explore::{ExploreParams, Policy, RapidParams};
use maps2d::active::ActiveAreaParams;
use maps2d::correction::CorrectionParams;
use maps2d::extended::ExtendedParams;
use maps2d::grid::GridParams;
use maps2d::polygons::{CorrectedPolygonsParams, OpenParams};
use maps2d::relative::{Certainty, RelativeParams};
use maps2d::volume::{OcclusionRule, Options, VolumeParams};
use metrics::{CellShape, CoverageParams};
use worlds::generate::{
    CavesParams, CorridorParams, MazeParams, PillarShape, PillarsParams, RoomsParams,
};
use worlds::{DriveParams, OdometryParams, PlaceParams, RobotParams, SensorParams};

use super::{
    CavesWorld, Config, CorridorWorld, GridMap, MazeWorld, Metrics, Occlusion, Odometry, Pillar,
    PillarsWorld, Places, Planner, Robot, RoomsWorld, Rule, Sensor, Twisted,
};

impl From<&Config> for RobotParams {
    fn from(config: &Config) -> Self {
        Self {
            sensor: (&config.sensor).into(),
            odometry: (&config.odometry).into(),
            places: (&config.places).into(),
            drive: (&config.robot).into(),
        }
    }
}

impl From<&Sensor> for SensorParams {
    fn from(sensor: &Sensor) -> Self {
        Self {
            fov_rad: sensor.fov_deg.to_radians(),
            range_m: sensor.range_m,
            rays: sensor.rays as usize,
            range_sigma_m: sensor.range_sigma_m,
        }
    }
}

impl From<&Odometry> for OdometryParams {
    fn from(odometry: &Odometry) -> Self {
        Self {
            sigma_translation: odometry.sigma_translation,
            sigma_rotation_rad: odometry.sigma_rotation.to_radians(),
            scale: odometry.scale,
            bias_translation: odometry.bias_translation,
            bias_rotation_rad: odometry.bias_rotation.to_radians(),
        }
    }
}

impl From<&Places> for PlaceParams {
    fn from(places: &Places) -> Self {
        Self {
            enabled: places.enabled,
            radius_m: places.radius_m,
            exclude_factor: places.exclude_factor,
            recall: places.recall,
            false_positive_rate: places.false_positive_rate,
            sigma_translation_m: places.sigma_translation_m,
            sigma_rotation_rad: places.sigma_rotation_deg.to_radians(),
            max_matches: (places.max_matches > 0).then_some(places.max_matches as usize),
        }
    }
}

impl From<&Robot> for DriveParams {
    fn from(robot: &Robot) -> Self {
        Self {
            robot_radius_m: robot.radius_m,
            repeat_sigma_m: robot.repeat_sigma_m,
            repeat_sigma_rotation_rad: robot.repeat_sigma_deg.to_radians(),
            snap_radius_m: (robot.snap_radius_m > 0.0).then_some(robot.snap_radius_m),
        }
    }
}

impl From<&Metrics> for CoverageParams {
    fn from(metrics: &Metrics) -> Self {
        let rule = match metrics.rule {
            Rule::Rays => metrics::Rule::Rays,
            Rule::View => metrics::Rule::View,
        };
        let cells = match (metrics.grid, metrics.cell_m) {
            (Some([columns, rows]), _) => {
                CellShape::Grid { columns: columns as usize, rows: rows as usize }
            }
            (None, Some(side_m)) => CellShape::Square { side_m },
            (None, None) => CoverageParams::default().cells,
        };
        Self { cells, rule }
    }
}

impl Config {
    /// The parameters of the relative map, if it is built.
    ///
    /// Where certainty is asked for, if only at the last look, the robot knows how noisy its wheels are.
    pub fn relative_params(&self) -> Option<RelativeParams> {
        let map = self.map.relative.as_ref()?;
        let occlusion = match map.occlusion {
            Occlusion::Range => OcclusionRule::Range,
            Occlusion::ForwardSigned => OcclusionRule::ForwardSigned,
        };
        let asked = map.certainty_sigmas > 0.0 || map.last_look_sigmas > 0.0;
        let known = self.odometry.scale * f64::from(u8::from(asked));
        Some(RelativeParams {
            volume: VolumeParams {
                occlusion_gap_m: map.occlusion_gap_m,
                strict_margin_m: map.strict_margin_m,
                options: Options {
                    occlusion,
                    insert_occlusion_vertex: map.insert_occlusion_vertex,
                    thin_m: map.thin_m,
                },
            },
            consolidation_radius_m: map.consolidation_radius_m,
            place_weight: map.place_weight,
            wall_closing_m: map.wall_closing_m,
            sliver_m: map.sliver_m,
            certainty: Certainty {
                sigmas: map.certainty_sigmas,
                sigma_translation: known * self.odometry.sigma_translation,
                sigma_rotation_rad: known * self.odometry.sigma_rotation.to_radians(),
            },
            last_look_sigmas: map.last_look_sigmas,
            retire: map.retire,
            idle_scans: RelativeParams::default().idle_scans,
        })
    }
}

impl From<&GridMap> for GridParams {
    fn from(map: &GridMap) -> Self {
        let volume =
            VolumeParams { occlusion_gap_m: map.occlusion_gap_m, ..VolumeParams::default() };
        Self { cell_m: map.cell_m, cell_margin: map.cell_margin, volume }
    }
}

impl Config {
    /// The parameters of the corrected grid, if it is built: the grid's, and the optimiser's.
    pub fn grid_corrected_params(&self) -> Option<(GridParams, CorrectionParams)> {
        let map = self.map.grid_corrected.as_ref()?;
        let volume =
            VolumeParams { occlusion_gap_m: map.occlusion_gap_m, ..VolumeParams::default() };
        let grid = GridParams { cell_m: map.cell_m, cell_margin: map.cell_margin, volume };
        Some((grid, self.correction_params(map.place_sigma_m, map.place_sigma_deg)))
    }

    /// The parameters of the united polygons, if they are built.
    pub fn corrected_polygons_params(&self) -> Option<CorrectedPolygonsParams> {
        let map = self.map.corrected_polygons.as_ref()?;
        Some(CorrectedPolygonsParams {
            volume: VolumeParams {
                occlusion_gap_m: map.occlusion_gap_m,
                ..VolumeParams::default()
            },
            open: OpenParams { wall_closing_m: map.wall_closing_m, sliver_m: map.sliver_m },
            correction: self.correction_params(map.place_sigma_m, map.place_sigma_deg),
        })
    }

    /// The parameters of the active area, if it is built.
    pub fn active_area_params(&self) -> Option<ActiveAreaParams> {
        let map = self.map.active_area.as_ref()?;
        Some(ActiveAreaParams {
            volume: VolumeParams {
                occlusion_gap_m: map.occlusion_gap_m,
                strict_margin_m: map.strict_margin_m,
                ..VolumeParams::default()
            },
            open: OpenParams { wall_closing_m: map.wall_closing_m, sliver_m: map.sliver_m },
            correction: self.correction_params(map.place_sigma_m, map.place_sigma_deg),
            area_edges: map.area_edges as usize,
            keep_intersections: map.keep_intersections,
            twisted: match map.twisted {
                Twisted::Flip => maps2d::active::Twisted::Flip,
                Twisted::Remove => maps2d::active::Twisted::Remove,
            },
        })
    }

    /// The parameters of the extended polygon, if it is built.
    pub fn extended_params(&self) -> Option<ExtendedParams> {
        let map = self.map.extended.as_ref()?;
        let occlusion = match map.occlusion {
            Occlusion::Range => OcclusionRule::Range,
            Occlusion::ForwardSigned => OcclusionRule::ForwardSigned,
        };
        let insert_occlusion_vertex = map.insert_occlusion_vertex;
        let options = Options { occlusion, insert_occlusion_vertex, thin_m: map.thin_m };
        let (occlusion_gap_m, strict_margin_m) = (map.occlusion_gap_m, map.strict_margin_m);
        let volume = VolumeParams { occlusion_gap_m, strict_margin_m, options };
        Some(ExtendedParams { volume, wall_closing_m: map.wall_closing_m })
    }

    /// What is told of the noise of edges that are exported.
    pub fn edge_noise(&self) -> CorrectionParams {
        let told = CorrectionParams::default();
        self.correction_params(told.place_sigma_m, told.place_sigma_rotation_rad.to_degrees())
    }

    /// What an optimiser is told of the noise: that of the wheels as the data sheet has it, without
    /// the experiment's scale.
    fn correction_params(&self, place_sigma_m: f64, place_sigma_deg: f64) -> CorrectionParams {
        CorrectionParams {
            sigma_translation: self.odometry.sigma_translation,
            sigma_rotation_rad: self.odometry.sigma_rotation.to_radians(),
            place_sigma_m,
            place_sigma_rotation_rad: place_sigma_deg.to_radians(),
            ..CorrectionParams::default()
        }
    }
}

impl From<&Config> for ExploreParams {
    fn from(config: &Config) -> Self {
        // The policy plans for the body's middle: it keeps the radius away from walls as well.
        let body_radius_m = config.robot.radius_m;
        let for_body = |mut params: RapidParams| {
            params.clearances_m.iter_mut().for_each(|clearance_m| *clearance_m += body_radius_m);
            RapidParams { body_radius_m, ..params }
        };
        let policy = match &config.planner {
            Planner::Rapid(planner) => Policy::Rapid(for_body(planner.into())),
            Planner::Survey(planner) => Policy::Survey(for_body(planner.into())),
        };
        Self { policy, max_steps: u64::from(config.max_steps) }
    }
}

impl From<&CorridorWorld> for CorridorParams {
    fn from(world: &CorridorWorld) -> Self {
        let CorridorWorld { width_m, height_m, corridor_m } = *world;
        Self { width_m, height_m, corridor_m }
    }
}

impl From<&RoomsWorld> for RoomsParams {
    fn from(world: &RoomsWorld) -> Self {
        Self {
            columns: world.columns as usize,
            rows: world.rows as usize,
            room_min_m: world.room_min_m,
            room_max_m: world.room_max_m,
            door_m: world.door_m,
            wall_m: world.wall_m,
            extra_doors: world.extra_doors,
            cell_m: world.cell_m,
            seed: world.seed,
        }
    }
}

impl From<&MazeWorld> for MazeParams {
    fn from(world: &MazeWorld) -> Self {
        Self {
            columns: world.columns as usize,
            rows: world.rows as usize,
            corridor_m: world.corridor_m,
            wall_m: world.wall_m,
            loops: world.loops,
            cell_m: world.cell_m,
            seed: world.seed,
        }
    }
}

impl From<&PillarsWorld> for PillarsParams {
    fn from(world: &PillarsWorld) -> Self {
        let shape = match world.shape {
            Pillar::Square => PillarShape::Square,
            Pillar::Turned => PillarShape::Turned,
            Pillar::Round => PillarShape::Round,
            Pillar::Mixed => PillarShape::Mixed,
        };
        Self {
            width_m: world.width_m,
            height_m: world.height_m,
            count: world.count as usize,
            size_min_m: world.size_min_m,
            size_max_m: world.size_max_m,
            gap_m: world.gap_m,
            shape,
            seed: world.seed,
        }
    }
}

impl From<&CavesWorld> for CavesParams {
    fn from(world: &CavesWorld) -> Self {
        Self {
            width_m: world.width_m,
            height_m: world.height_m,
            solid_share: world.solid_share,
            rounds: world.rounds as usize,
            cell_m: world.cell_m,
            seed: world.seed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{
        ActiveAreaMap, CorrectedPolygonsMap, ExtendedMap, GridCorrectedMap, RelativeMap,
    };
    use super::*;

    #[test]
    fn the_defaults_here_are_the_defaults_below() {
        assert_eq!(RobotParams::from(&Config::default()), RobotParams::default());
        assert_eq!(CoverageParams::from(&Metrics::default()), CoverageParams::default());
        let trusting = RelativeMap { last_look_sigmas: 0.0, ..RelativeMap::default() };
        let plain = RelativeParams { last_look_sigmas: 0.0, ..RelativeParams::default() };
        assert_eq!(with_relative(trusting).relative_params(), Some(plain));
        let looks = RelativeMap::default().last_look_sigmas;
        assert_eq!(looks, RelativeParams::default().last_look_sigmas);
        assert_eq!(GridParams::from(&GridMap::default()), GridParams::default());
        let mut config = Config::default();
        config.map.grid_corrected = Some(GridCorrectedMap::default());
        let defaults = (GridParams::default(), CorrectionParams::default());
        assert_eq!(config.grid_corrected_params(), Some(defaults));
        config.map.corrected_polygons = Some(CorrectedPolygonsMap::default());
        let defaults = CorrectedPolygonsParams::default();
        assert_eq!(config.corrected_polygons_params(), Some(defaults));
        config.map.active_area = Some(ActiveAreaMap::default());
        assert_eq!(config.active_area_params(), Some(ActiveAreaParams::default()));
        config.map.extended = Some(ExtendedMap::default());
        assert_eq!(config.extended_params(), Some(ExtendedParams::default()));
        assert_eq!(ExploreParams::from(&Config::default()), ExploreParams::default());
        assert_eq!(CorridorParams::from(&CorridorWorld::default()), CorridorParams::default());
        assert_eq!(RoomsParams::from(&RoomsWorld::default()), RoomsParams::default());
        assert_eq!(MazeParams::from(&MazeWorld::default()), MazeParams::default());
        assert_eq!(PillarsParams::from(&PillarsWorld::default()), PillarsParams::default());
        assert_eq!(CavesParams::from(&CavesWorld::default()), CavesParams::default());
    }

    fn with_relative(map: RelativeMap) -> Config {
        let mut config = Config::default();
        config.odometry.scale = 0.5;
        config.map.relative = Some(map);
        config
    }

    #[test]
    fn certainty_knows_the_noise_of_the_wheels() {
        // Known for the last look as well, where none is asked for before.
        for sigmas in [0.0, 2.0] {
            let map = RelativeMap { certainty_sigmas: sigmas, ..RelativeMap::default() };
            let certainty = with_relative(map).relative_params().map(|params| params.certainty);
            let expected = Certainty {
                sigmas,
                sigma_translation: 0.05,
                sigma_rotation_rad: 2.5_f64.to_radians(),
            };
            assert_eq!(certainty, Some(expected));
        }
    }

    #[test]
    fn a_grid_takes_the_place_of_the_side_of_a_cell() {
        let metrics = Metrics { cell_m: None, grid: Some([25, 20]), ..Metrics::default() };
        let cells = CellShape::Grid { columns: 25, rows: 20 };
        assert_eq!(CoverageParams::from(&metrics).cells, cells);
    }

    #[test]
    fn degrees_end_here() {
        let odometry = Odometry { bias_rotation: 180.0, ..Odometry::default() };
        assert_eq!(OdometryParams::from(&odometry).bias_rotation_rad, std::f64::consts::PI);
        let places = Places { sigma_rotation_deg: 90.0, max_matches: 2, ..Places::default() };
        let params = PlaceParams::from(&places);
        assert_eq!(params.sigma_rotation_rad, std::f64::consts::FRAC_PI_2);
        assert_eq!(params.max_matches, Some(2));
    }
}
