//! Map files that others wrote, where a folder of test data is at hand.

mod data;

use std::fs;

use formats::{GrayImage, Kind, map_yaml, moving_ai, pgm, png, sniff, text};

fn image(bytes: &[u8]) -> GrayImage {
    match sniff(bytes, None) {
        Kind::Pgm => pgm::read(bytes).expect("PGM"),
        Kind::Png => png::read(bytes).expect("PNG"),
        other => panic!("no image: {other:?}"),
    }
}

/// File, columns, rows, and counts of some levels as other programs count them.
type Known<'a> = (&'a str, usize, usize, &'a [(u16, usize)]);

#[test]
fn images_have_the_known_levels() {
    let Some(maps) = data::folder("maps") else { return };
    let known: [Known; 12] = [
        ("stage/cave.png", 500, 500, &[(255, 244_730), (0, 5270)]),
        ("stage/hospital_section.png", 1086, 443, &[(255, 463_940), (0, 17158)]),
        ("stage/autolab.png", 809, 689, &[(255, 533_216), (0, 24185)]),
        ("stage/simple_rooms.png", 400, 300, &[(255, 83184), (0, 36816)]),
        ("stage/SRI-AIC-kwing.png", 856, 293, &[(128, 175_651), (255, 59425), (0, 15732)]),
        ("nav2/depot.pgm", 604, 307, &[(254, 170_587), (205, 8894), (0, 5947)]),
        ("nav2/tb3_sandbox.pgm", 384, 384, &[(205, 138_683), (254, 7903), (0, 870)]),
        ("willow/willow-full.pgm", 584, 526, &[(205, 146_586), (254, 111_359), (253, 1253)]),
        ("aws_house/map.pgm", 500, 500, &[(205, 183_537), (254, 63021), (0, 3442)]),
        ("dungeon/img_10000.png", 640, 480, &[(195, 78592), (203, 256)]),
        ("dungeon/img_10001.png", 640, 480, &[(195, 91904), (203, 256)]),
        ("dungeon/img_10002.png", 640, 480, &[(195, 73472), (203, 256)]),
    ];
    for (name, columns, rows, counts) in known {
        let image = image(&fs::read(maps.join(name)).expect(name));
        assert_eq!((image.columns(), image.rows(), image.white()), (columns, rows, 255), "{name}");
        for &(level, count) in counts {
            let found = image.levels().iter().filter(|&&other| other == level).count();
            assert_eq!(found, count, "{name}, level {level}");
        }
    }
}

#[test]
fn yaml_files_name_their_images() {
    let Some(maps) = data::folder("maps") else { return };
    let known = [
        ("aws_house/map.yaml", "map.pgm", [-12.5, -12.5, 0.0], 0.196),
        ("nav2/depot.yaml", "depot.pgm", [0.0; 3], 0.25),
        ("nav2/tb3_sandbox.yaml", "tb3_sandbox.pgm", [-10.0, -10.0, 0.0], 0.196),
    ];
    for (name, image, origin, free_thresh) in known {
        let bytes = fs::read(maps.join(name)).expect(name);
        assert_eq!(sniff(&bytes, None), Kind::MapServerYaml, "{name}");
        let map = map_yaml::read(text(&bytes).expect("UTF-8")).expect(name);
        assert_eq!((map.image.as_str(), map.origin, map.free_thresh), (image, origin, free_thresh));
        assert_eq!((map.resolution_m, map.occupied_thresh, map.negate), (0.05, 0.65, false));
        assert!(map.warnings.is_empty(), "{name}: {:?}", map.warnings);
    }
}

#[test]
fn moving_ai_arena() {
    let Some(maps) = data::folder("maps") else { return };
    let bytes = fs::read(maps.join("movingai/arena.map")).expect("arena");
    assert_eq!(sniff(&bytes, None), Kind::MovingAi);
    let map = moving_ai::read(text(&bytes).expect("UTF-8")).expect("arena");
    assert_eq!((map.columns, map.rows), (49, 49));
    assert_eq!(map.blocked().iter().filter(|&&blocked| blocked).count(), 347);
}
