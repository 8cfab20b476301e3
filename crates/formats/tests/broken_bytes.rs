//! No bytes make a reader panic, and what it accepts is what was written.

use formats::{FormatError, GrayImage, Kind, map_yaml, moving_ai, pgm, png, sniff, text};
use proptest::prelude::*;

/// Feeds bytes to every reader; each may refuse them, none may panic, and a message names a place.
fn read_all(bytes: &[u8]) {
    let _ = sniff(bytes, None);
    let errors = [
        pgm::read(bytes).err(),
        png::read(bytes).err(),
        text(bytes).err(),
        map_yaml::read(&String::from_utf8_lossy(bytes)).err(),
        moving_ai::read(&String::from_utf8_lossy(bytes)).err(),
    ];
    for error in errors.into_iter().flatten() {
        match &error {
            FormatError::Unexpected { found, expected, .. } => {
                assert!(!found.is_empty() && !expected.is_empty(), "{error}");
            }
            FormatError::TooLarge { .. } => {}
            other => panic!("a reader told of {other}"),
        }
    }
}

const YAML: &str = "image: \"map.pgm\" # here\nresolution: 0.05\norigin: [-1.0, 2, 0.0]\n\
    list:\n  - 'a'\n  - b\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n";
const TILES: &str = "type octile\nheight 3\nwidth 4\nmap\n@@@@\n@.G@\n@@SW\n";

/// Valid files of every format, small.
fn valid() -> Vec<Vec<u8>> {
    let levels: Vec<u16> = (0..60).map(|index| index * 4).collect();
    let image = GrayImage::new(10, 6, 255, levels).expect("levels fit");
    let clear = image.clone().with_transparent((0..60).map(|i| i % 7 == 0).collect());
    vec![
        pgm::write(&image),
        pgm::write_decimal(&image),
        png::write(&image).expect("encodes"),
        png::write(&clear.expect("flags fit")).expect("encodes"),
        YAML.as_bytes().to_vec(),
        TILES.as_bytes().to_vec(),
    ]
}

/// Recomputes the checksums of PNG chunks, so that mutations get past them.
fn with_checksums(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut start = 8;
    while let Some(head) = bytes.get(start..start + 4) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let end = start.saturating_add(8).saturating_add(length);
        if end.saturating_add(4) > bytes.len() {
            break;
        }
        let mut sum = u32::MAX;
        for &byte in &bytes[start + 4..end] {
            sum ^= u32::from(byte);
            for _ in 0..8 {
                sum = (sum >> 1) ^ (0xedb8_8320 & (0_u32.wrapping_sub(sum & 1)));
            }
        }
        bytes[end..end + 4].copy_from_slice(&(!sum).to_be_bytes());
        start = end + 4;
    }
    bytes
}

#[test]
fn the_valid_files_are_valid() {
    let files = valid();
    let kinds: Vec<Kind> = files.iter().map(|file| sniff(file, None)).collect();
    use Kind::{MapServerYaml, MovingAi, Pgm, Png};
    assert_eq!(kinds, [Pgm, Pgm, Png, Png, MapServerYaml, MovingAi]);
    let image = pgm::read(&files[0]).expect("P5");
    assert_eq!(pgm::read(&files[1]).expect("P2"), image);
    assert_eq!(png::read(&files[2]).expect("PNG"), image);
    assert_eq!(png::read(&files[3]).expect("PNG with alpha").levels(), image.levels());
    assert_eq!(with_checksums(files[3].clone()), files[3], "the checksum is the format's own");
    assert_eq!(map_yaml::read(YAML).expect("yaml").warnings.len(), 1);
    assert_eq!(moving_ai::read(TILES).expect("tiles").columns, 4);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        read_all(&bytes);
    }

    #[test]
    fn random_text(text in "(P5|P2|type|image:|map|[-\\[\\]{}'\":#\\\\,. \n\t0-9a-zä]){0,40}") {
        read_all(text.as_bytes());
    }

    #[test]
    fn mutated_files(
        which in 0..6_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4), 1..6),
        checksums in any::<bool>(),
    ) {
        let mut bytes = valid().swap_remove(which);
        for (index, value, action) in changes {
            if bytes.is_empty() {
                break;
            }
            let index = index.index(bytes.len());
            match action {
                0 => bytes[index] = value,
                1 => bytes[index] ^= 1 << (value % 8),
                2 => drop(bytes.remove(index)),
                _ => bytes.insert(index, value),
            }
        }
        read_all(&if checksums { with_checksums(bytes) } else { bytes });
    }

    #[test]
    fn cut_files(which in 0..6_usize, end in any::<prop::sample::Index>()) {
        let bytes = valid().swap_remove(which);
        read_all(&bytes[..end.index(bytes.len())]);
    }

    #[test]
    fn images_survive_a_round_trip(
        columns in 1..12_usize,
        rows in 1..12_usize,
        white in prop::sample::select(vec![1_u16, 9, 255, 256, 1023, 65535]),
        seed in prop::collection::vec(any::<u16>(), 144),
        clear in prop::collection::vec(any::<bool>(), 144),
    ) {
        let count = columns * rows;
        let levels = seed.iter().take(count).map(|&level| (u32::from(level) % (u32::from(white) + 1)) as u16);
        let image = GrayImage::new(columns, rows, white, levels.collect()).expect("fits");
        prop_assert_eq!(&pgm::read(&pgm::write(&image)).expect("P5"), &image);
        prop_assert_eq!(&pgm::read(&pgm::write_decimal(&image)).expect("P2"), &image);
        let clear = image.with_transparent(clear[..count].to_vec()).expect("fits");
        let back = png::read(&png::write(&clear).expect("encodes")).expect("PNG");
        prop_assert_eq!(back.transparent(), clear.transparent());
        prop_assert_eq!(back.levels_u8(), clear.levels_u8());
        if white == 255 || white == 65535 {
            prop_assert_eq!(back, clear);
        }
    }
}
