//! Any names and files as a folder of depth images: no panic, and frames are files of the folder.
#![no_main]

use formats::depth_folder::{self, Listing};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Files: a name up to a line feed, then the content up to a byte 0.
    let files: Vec<(String, &[u8])> = bytes
        .split(|&byte| byte == 0)
        .map(|file| {
            let end = file.iter().position(|&byte| byte == b'\n').unwrap_or(file.len());
            let (name, content) = file.split_at(end);
            (String::from_utf8_lossy(name).into_owned(), content.get(1..).unwrap_or(&[]))
        })
        .collect();
    let read = |name: &str| {
        let found = files.iter().find(|(known, _)| known == name);
        found.map(|(_, content)| content.to_vec()).ok_or(std::io::ErrorKind::NotFound.into())
    };
    let names = files.iter().map(|(name, _)| name.clone()).collect();
    match depth_folder::read(&Listing { names, read: &read }) {
        Ok(folder) => {
            assert!(!folder.frames.is_empty());
            for frame in &folder.frames {
                assert!(frame.map_from_camera.translation.iter().all(|x| x.is_finite()));
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
