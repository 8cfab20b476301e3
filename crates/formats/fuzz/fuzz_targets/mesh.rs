//! Any bytes as a mesh of any format: no panic, and what is accepted reads back equal.
#![no_main]

use formats::mesh::{read, write_obj, write_off, write_ply, write_ply_ascii, write_stl};
use libfuzzer_sys::fuzz_target;
use solid::mesh::weld;
use solid::validity::check_topology;

fuzz_target!(|bytes: &[u8]| {
    for extension in [None, Some("obj"), Some("off"), Some("stl"), Some("node"), Some("poly"), Some("smesh")] {
        let Ok(file) = read(bytes, extension, None) else { continue };
        let mesh = &file.mesh;
        let _ = check_topology(&weld(mesh).mesh);
        assert_eq!(file.facet_of.len(), mesh.faces().len());
        for written in [write_ply(mesh), write_ply_ascii(mesh)] {
            assert_eq!(&read(&written, None, None).expect("it was written").mesh, mesh);
        }
        let bare = mesh.clone().without_origins();
        let written = write_off(&bare);
        assert_eq!(read(&written, None, None).expect("it was written").mesh, bare);
        if !bare.vertices().is_empty() {
            assert_eq!(read(&write_obj(&bare), Some("obj"), None).expect("it was written").mesh, bare);
        }
        let _ = read(&write_stl(&bare), Some("stl"), None);
    }
});
