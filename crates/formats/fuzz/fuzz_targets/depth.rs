//! Any bytes as a depth image or a cloud: no panic, and the size is that of what was read.
#![no_main]

use formats::depth_file::{DepthFile, DepthFileOptions, read};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // The first byte says how; the rest is the file.
    let Some((&how, bytes)) = bytes.split_first() else { return };
    let extension = [None, Some("raw"), Some("pcd"), Some("png")][usize::from(how % 4)];
    let size = (how & 4 != 0).then_some([usize::from(how >> 4) + 1, 4]);
    match read(bytes, extension, &DepthFileOptions { units_per_metre: 1000.0, size }) {
        Ok(DepthFile::Image(image)) => {
            assert_eq!(image.depths_m.len(), image.columns * image.rows);
        }
        Ok(DepthFile::Cloud(cloud)) => {
            assert_eq!(cloud.points_in_sensor.len(), cloud.columns * cloud.rows);
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
