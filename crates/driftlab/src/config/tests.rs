//! Loading as a whole: merging, origins, messages.

use std::path::Path;

use super::*;

const MAZE: &str = "schema = 1\nseed = 7\n[world.paper]\nmap = \"maze\"\n[map.relative]\n";

fn load(text: &str, sets: &[&str]) -> Result<Loaded, String> {
    let overrides = Overrides { sets: sets.iter().map(|&set| set.into()).collect(), world: None };
    Loaded::from_text(Path::new("dir/a.toml"), text, &overrides).map_err(|error| error.to_string())
}

fn message(text: &str, sets: &[&str]) -> String {
    load(text, sets).map(|loaded| loaded.config).unwrap_err()
}

#[test]
fn every_value_remembers_who_gave_it() {
    let loaded = load(MAZE, &["odometry.scale=0.5", "map.grid.cell_m = 2"]).unwrap();
    assert_eq!(loaded.config.odometry.scale, 0.5);
    assert_eq!(loaded.config.map.keys(), ["relative", "grid"]);
    assert_eq!(loaded.config.name, "a");
    assert_eq!(loaded.origin("seed").to_string(), "dir/a.toml:2");
    assert_eq!(loaded.origin("odometry.scale").to_string(), "--set odometry.scale=0.5");
    assert_eq!(loaded.origin("sensor.rays"), Origin::Default);
}

#[test]
fn the_first_comment_is_what_the_file_says_about_itself() {
    let text = format!("#:schema x.json\n\n# A maze.\n#\n# It winds.\n\n# not this\n{MAZE}");
    assert_eq!(load(&text, &[]).unwrap().header(), "A maze.\n\nIt winds.");
    assert_eq!(load(MAZE, &[]).unwrap().header(), "");
}

#[test]
fn the_resolved_text_means_the_same() {
    let loaded = load(MAZE, &["planner.survey={}", "sensor.fov_deg=360"]).unwrap();
    let again = load(&resolved_toml(&loaded), &[]).unwrap();
    assert_eq!(again.config, loaded.config);
    assert_eq!(load(&plain_toml(&loaded.config).unwrap(), &[]).unwrap().config, loaded.config);
}

#[test]
fn the_defaults_page_is_a_config_of_defaults() {
    let loaded = load(&defaults_toml(), &[]).unwrap();
    let mut expected = Config { name: "defaults".into(), ..Config::default() };
    expected.world = Some(World::Paper(PaperWorld::default()));
    expected.map.relative = Some(RelativeMap::default());
    assert_eq!(loaded.config, expected);
    // Every commented table is right too: uncomment one at a time.
    let page = defaults_toml();
    let tables: Vec<&str> = page.split("\n\n").filter(|block| block.contains("\n# [")).collect();
    assert!(tables.len() >= 10, "{}", tables.len());
    for block in tables {
        let body = block[block.find("\n# [").unwrap() + 1..].lines();
        let live = body.filter_map(|line| {
            line.strip_prefix("# ").filter(|l| l.starts_with('[') || l.contains(" = "))
        });
        let live = live.collect::<Vec<_>>().join("\n");
        let others = match live.split(['.', ']']).next() {
            Some("[world") => "[map.grid]",
            Some("[world3d") => "[map3d.relative]",
            Some("[map3d") => "[world3d.rooms]",
            Some("[camera" | "[planner3d" | "[metrics3d") => "[world3d.rooms]\n[map3d.relative]",
            _ => "[world.paper]\n[map.relative]",
        };
        load(&format!("{live}\n{others}"), &[]).unwrap_or_else(|error| panic!("{error}\n{live}"));
    }
}

#[test]
fn a_map_file_replaces_world_and_start_but_keeps_what_fits_it() {
    let text =
        "[start]\nx_m = 3\n[world.image]\nfile = \"old.png\"\nresolution_m = 0.1\n[map.grid]\n";
    let overrides = Overrides { sets: vec![], world: Some(("/maps/new.pgm".into(), "image")) };
    let loaded = Loaded::from_text(Path::new("a.toml"), text, &overrides).unwrap();
    let image =
        ImageWorld { file: "/maps/new.pgm".into(), resolution_m: 0.1, ..ImageWorld::default() };
    assert_eq!(loaded.config.world, Some(World::Image(image)));
    assert_eq!(loaded.config.start, None);
    assert_eq!(loaded.origin("world.image.file").to_string(), "--world /maps/new.pgm");
    assert_eq!(loaded.origin("world.image.resolution_m").to_string(), "a.toml:5");
    let overrides = Overrides { sets: vec![], world: Some(("m.map".into(), "moving_ai")) };
    let loaded = Loaded::from_text(Path::new("a.toml"), text, &overrides).unwrap();
    assert!(matches!(loaded.config.world, Some(World::MovingAi(_))), "{:?}", loaded.config.world);
}

#[test]
fn a_grid_replaces_the_side_of_a_cell_and_the_other_way_round() {
    let grid = format!("{MAZE}[metrics]\ngrid = [25, 20]\n");
    let loaded = load(&grid, &[]).unwrap();
    assert_eq!((loaded.config.metrics.grid, loaded.config.metrics.cell_m), (Some([25, 20]), None));
    assert_eq!(load(&resolved_toml(&loaded), &[]).unwrap().config, loaded.config);
    let loaded = load(&grid, &["metrics.cell_m=0.5"]).unwrap();
    assert_eq!((loaded.config.metrics.grid, loaded.config.metrics.cell_m), (None, Some(0.5)));
    let loaded = load(&format!("{MAZE}[metrics]\ncell_m = 2\n"), &["metrics.grid=[3, 4]"]).unwrap();
    assert_eq!((loaded.config.metrics.grid, loaded.config.metrics.cell_m), (Some([3, 4]), None));
}

#[test]
fn axes_are_in_the_order_of_the_alphabet_however_they_are_written() {
    let quoted = "[sweep]\naxes = { \"start_jitter_m\" = [1], \"odometry.scale\" = [0.0, 1] }\n";
    let dotted = "[sweep.axes]\nodometry.scale = [0.0, 1]\nstart_jitter_m = [1]\n";
    for text in [quoted, dotted] {
        let loaded = load(&format!("{MAZE}{text}"), &["sweep.seeds=3"]).unwrap();
        let sweep = loaded.config.sweep.as_ref().unwrap();
        let axes: Vec<_> = sweep.axes.iter().map(|(key, values)| (key, values.len())).collect();
        assert_eq!((sweep.seeds, axes), (3, vec![("odometry.scale", 2), ("start_jitter_m", 1)]));
        let again = load(&plain_toml(&loaded.config).unwrap(), &[]).unwrap();
        assert_eq!(again.config, loaded.config);
    }
}

#[test]
fn a_combination_is_a_config_of_its_own_and_its_mistakes_are_told_at_the_axis() {
    let text = format!("{MAZE}[sweep.axes]\n\"odometry.scale\" = [0.5, -1]\n");
    let loaded = load(&text, &["seed=7"]).unwrap();
    let one = loaded.with(&["odometry.scale = 0.5".into()]).unwrap();
    assert_eq!((one.config.odometry.scale, one.config.seed), (0.5, 7));
    assert_eq!((one.config.sweep, &loaded.config.sweep.is_some()), (None, &true));
    let error = loaded.with(&["odometry.scale = -1".into()]).unwrap_err().to_string();
    assert!(error.starts_with("dir/a.toml:7:20: found -1.0 for `odometry.scale`"), "{error}");
}

#[test]
fn files_are_relative_to_the_config() {
    let text = "[world.image]\nfile = \"floor.png\"\n[map.grid]\n";
    let loaded = Loaded::from_text(Path::new("/etc/a.toml"), text, &Overrides::default()).unwrap();
    let Some(World::Image(image)) = loaded.anchored().world else { panic!("no image") };
    assert_eq!(image.file, Path::new("/etc/floor.png"));
}

macro_rules! assert_page {
    ($page:expr) => {
        insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!($page) })
    };
}

/// Inputs with the message that each gets, as one page to read.
fn page(cases: &[(&str, &[&str])]) -> String {
    let mut page = String::new();
    for (text, sets) in cases {
        let shown = if sets.is_empty() { text.to_string() } else { format!("{sets:?}") };
        page.push_str(&format!("{}\n--> {}\n\n", shown.trim_end(), message(text, sets)));
    }
    page
}

#[test]
fn each_mistake_gets_one_message_at_its_place() {
    let with = |more: &str| format!("{MAZE}{more}");
    let (range, nan) =
        (with("[sensor]\nrays = 1\nfov_deg = 400\n"), with("[odometry]\nscale = nan\n"));
    let two = with("[world.maze]\ncolumns = 3\n");
    let no_seeds = with("[sweep]\nseeds = 0\n");
    let no_list = with("[sweep.axes]\nodometry.scale = 1\n");
    let seed_axis = with("[sweep.axes]\nseed = [1, 2]\n");
    let no_value = with("[sweep]\naxes = { \"odometry.scale\" = [] }\n");
    let twice = with("[sweep]\naxes = { \"odometry.scale\" = [1, 0.5, 1.0] }\n");
    let drive = with("[compare]\ndrive = \"grid\"\n");
    let both = with("[metrics]\ncell_m = 1\ngrid = [25, 20]\n");
    let no_rows = with("[metrics]\ngrid = [25, 0]\n");
    assert_page!(page(&[
        ("seed = 1\n[sensor]\nfov = 90\n", &[]),
        ("[sensor]\nrange_m = \"far\"\n", &[]),
        ("[sensor]\nrays = 5.5\n", &[]),
        ("[sensor]\nrays = -3\n", &[]),
        ("[record]\nlevel = \"loud\"\n", &[]),
        ("[record]\nlevel = 3\n", &[]),
        ("[record.every]\nplaner = 3\n", &[]),
        ("sensor = 3\n", &[]),
        (&range, &[]),
        (&nan, &[]),
        (&two, &[]),
        ("[world]\n[map.grid]\n", &[]),
        ("[world.lake]\n", &[]),
        ("world = \"maze\"\n", &[]),
        ("[world]\nmaze = 3\n", &[]),
        ("map.relative = true\n", &[]),
        ("[map.grid]\n", &[]),
        ("[world.paper]\n", &[]),
        ("[world.image]\nresolution_m = 0.1\n", &[]),
        (&no_seeds, &[]),
        (&no_list, &[]),
        (&no_value, &[]),
        (&twice, &[]),
        (&seed_axis, &[]),
        (&drive, &[]),
        (&both, &[]),
        ("[metrics]\ngrid = [25, 20, 1]\n", &[]),
        (&no_rows, &[]),
        ("schema = 2\nmaps = 3\n", &[]),
        ("start = [5, 6, 90]\n[world.paper]\n[map.grid]\n", &[]),
        ("[[sensor]]\nrays = 9\n[world.paper]\n[map.grid]\n", &[]),
        ("[world]\npaper = [\"open\"]\n[map.grid]\n", &[]),
        ("[world.polygons]\nblocks = [[[-1, 2], [3, 2], [3, 3]]]\n[map.grid]\n", &[]),
        ("seed = \n", &[]),
        ("seed = 1\nseed = 2\n", &[]),
        ("seed = 99999999999999999999\n", &[]),
        ("[sensor\n", &[]),
        ("name = \"../x\"\n[world.paper]\n[map.grid]\n", &[]),
        ("[world.polygons]\noutline = [[0, 0], [1, 0]]\n[map.grid]", &[]),
        ("[world.polygons]\noutline = [[0, 0, 1]]\n", &[]),
        ("[world.corridor]\nheight_m = 4\n[map.grid]\n", &[]),
    ]));
}

#[test]
fn each_mistake_of_the_command_line_gets_one_message_too() {
    assert_page!(page(&[
        (MAZE, &["odometry.scal=2"]),
        (MAZE, &["odometry.scale=-2"]),
        (MAZE, &["record.level=off"]),
        (MAZE, &["odometry.scale"]),
        (MAZE, &[""]),
        (MAZE, &["sensor=3"]),
        (MAZE, &["world.maze.rows=0"]),
        (MAZE, &["robot.radius_m=1e9"]),
        (MAZE, &["sensor.range_m=1e-300"]),
        (MAZE, &["planner.rapid.step_m=1e-300"]),
        (MAZE, &["metrics.cell_m=1e300"]),
        (MAZE, &["map.relative.wall_closing_m=1e300"]),
        (MAZE, &["map.relative.wall_closing_m=11"]),
        (MAZE, &["map.grid.cell_m=1e-7"]),
        (MAZE, &["map.grid.cell_m=1e-3"]),
        (MAZE, &["start.x_m=1e300"]),
        ("[world.paper]\n[map.relative]\n[robot]\nradius_m = 10.5\n", &[]),
    ]));
}
