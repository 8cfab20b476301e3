//! Folders of depth images with poses: made up in memory, and real ones where the data is.

mod data;

use std::collections::BTreeMap;
use std::io;

use formats::depth_folder::{DepthFolder, DepthFolderError, FolderKind, Listing, read};

fn of(files: &[(&str, &str)]) -> Result<DepthFolder, DepthFolderError> {
    let files: BTreeMap<&str, &str> = files.iter().copied().collect();
    let read_one = |name: &str| match files.get(name) {
        Some(text) => Ok(text.as_bytes().to_vec()),
        None => Err(io::Error::other("no such file")),
    };
    read(&Listing { names: files.keys().map(|name| (*name).to_owned()).collect(), read: &read_one })
}

const STILL: &str = "1 0 0 2\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

#[test]
fn a_pose_file_beside_each_image() {
    let folder = of(&[
        ("camera-intrinsics.txt", "585 0 320\n0 586 240\n0 0 1\n"),
        ("frame-000010.depth.png", ""),
        ("frame-000010.pose.txt", STILL),
        ("frame-000002.depth.png", ""),
        ("frame-000002.pose.txt", STILL),
        ("frame-000003.depth.png", ""),
        ("frame-000003.pose.txt", "nan nan nan nan\nnan nan nan nan\n1 1 1 1\n0 0 0 1\n"),
        ("frame-000004.depth.png", ""),
        ("frame-000005.depth.png", ""),
        ("frame-000005.pose.txt", ""),
        ("frame-000006.depth.png", ""),
        ("frame-000006.pose.txt", "-1.#IND000e+000 0 0 0\n0 1 0 0\n0 0 1 -inf\n0 0 0 1\n"),
        ("frame-000007.depth.png", ""),
        ("frame-000007.pose.txt", "1 0 0\n"),
        ("frame-000002.color.png", ""),
    ])
    .expect("a folder");
    assert_eq!(folder.kind, FolderKind::SevenScenes);
    let files: Vec<&str> = folder.frames.iter().map(|frame| frame.file.as_str()).collect();
    assert_eq!(files, ["frame-000002.depth.png", "frame-000010.depth.png"]);
    assert_eq!(folder.frames[0].map_from_camera.translation.x, 2.0);
    assert_eq!(folder.camera.map(|camera| (camera.fx, camera.cy)), Some((585.0, 240.0)));
    assert_eq!(folder.warnings.len(), 5, "{:?}", folder.warnings);
    assert!(folder.warnings[4].contains("frame-000007.pose.txt: line 1"), "{:?}", folder.warnings);
}

#[test]
fn images_and_poses_meet_by_time() {
    let folder = of(&[
        (
            "groundtruth.txt",
            "# t\n2.01 1 0 0 0 0 0 1\n1.99 0 0 0 0 0 0 1\n5 0 0 0 0 0 0 1\n\
          3.0 nan nan nan nan nan nan nan\n3.01 0 0 0 0 0 0 0\n6 0 0 0",
        ),
        (
            "depth.txt",
            "# depth\nnan depth/0.png\n3.0 depth/3.png\n2.0 depth/2.png\n5.01 depth/5.png\n",
        ),
        ("depth/2.png", ""),
    ])
    .expect("a folder");
    assert_eq!((folder.kind, folder.units_per_metre), (FolderKind::Tum, 5000.0));
    let files: Vec<&str> = folder.frames.iter().map(|frame| frame.file.as_str()).collect();
    assert_eq!(files, ["depth/2.png", "depth/5.png"], "nothing is near 3 s");
    assert!((folder.frames[0].map_from_camera.translation.x - 0.5).abs() < 1e-9, "between the two");
    assert_eq!(folder.warnings.len(), 3);
    assert_eq!(folder.warnings[0], "groundtruth.txt: 2 of 5 lines are no pose");
    assert!(
        folder.warnings.contains(&"depth/0.png: left out, its time in depth.txt is none".into())
    );
}

#[test]
fn images_with_numbers_meet_poses_in_order() {
    let line = "0 0 0 0 0 0 1";
    let poses = format!("1 {line}\n2 {line}\n3 nan 0 0 0 0 0 1\n");
    let folder =
        of(&[("depth_2.pgm", ""), ("depth_10.pgm", ""), ("depth_1.pgm", ""), ("pose.txt", &poses)]);
    let folder = folder.expect("a folder");
    let files: Vec<&str> = folder.frames.iter().map(|frame| frame.file.as_str()).collect();
    assert_eq!(files, ["depth_1.pgm", "depth_2.pgm"], "the third pose is none");
    let none = of(&[("1_depth.png", ""), ("2_depth.png", "")]).expect("a folder");
    assert_eq!((none.frames.len(), none.units_per_metre, none.warnings.len()), (2, 5000.0, 1));
}

#[test]
fn images_that_are_missing_leave_the_others_their_poses() {
    let poses: String = (0..4).map(|x| format!("{x} 0 0 0 0 0 1\n")).collect();
    let places = |names: &[&str]| {
        let mut files: Vec<(&str, &str)> = names.iter().map(|name| (*name, "")).collect();
        files.push(("pose.txt", &poses));
        let folder = of(&files).expect("a folder");
        let at = |frame: &formats::depth_folder::DepthFrame| frame.map_from_camera.translation.x;
        (folder.frames.iter().map(at).collect::<Vec<_>>(), folder.warnings.len())
    };
    assert_eq!(places(&["depth_0.pgm", "depth_1.pgm", "depth_3.pgm"]), (vec![0.0, 1.0, 3.0], 1));
    assert_eq!(places(&["depth_1.pgm", "depth_3.pgm", "depth_4.pgm"]), (vec![0.0, 2.0, 3.0], 1));
    // Nothing says which are missing here.
    assert_eq!(places(&["depth_7.pgm", "depth_8.pgm", "depth_9.pgm"]), (vec![0.0, 1.0, 2.0], 1));
    assert_eq!(places(&["depth_7.pgm", "depth_8.pgm", "depth_9.pgm", "depth_11.pgm"]).1, 0);
}

#[test]
fn what_is_wrong_is_told_with_its_file() {
    for (files, words) in [
        (&[("a.txt", "")][..], "found 1 files, none of them a depth image"),
        (&[("frame-1.depth.png", ""), ("frame-1.pose.txt", "1 2\n")], "frame-1.pose.txt: "),
        (&[("frame-1.depth.png", ""), ("frame-1.pose.txt", "1 0 0 0\n0 1 0 0\n")], "found 2 lines"),
        (&[("frame-1.depth.png", "")], "found no depth image with a pose"),
        (&[("depth_1.pgm", ""), ("depth_2.pgm", ""), ("pose.txt", "0 0 0 0 0 0 1\n")], "1 poses"),
        (&[("depth_1.pgm", ""), ("pose.txt", "0 0 x 0 0 0 1\n")], "pose.txt: line 1, column 5"),
        (&[("groundtruth.txt", "1 0 0 0 0 0 0 1\n"), ("depth.txt", "1\n")], "depth.txt: "),
        (
            &[
                ("camera-intrinsics.txt", "1 2\n"),
                ("frame-1.depth.png", ""),
                ("frame-1.pose.txt", STILL),
            ],
            "camera-intrinsics.txt: ",
        ),
    ] {
        let error = of(files).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn real_folders_are_found() {
    let Some(rgbd) = data::folder("rgbd") else { return };
    for (name, kind, frames, warnings) in [
        ("tsdf50", FolderKind::SevenScenes, 17, 0),
        ("slambook_ch5", FolderKind::Numbered, 5, 0),
        ("tum_fr2", FolderKind::Numbered, 2, 1),
    ] {
        let folder = rgbd.join(name);
        let names = std::fs::read_dir(&folder)
            .expect("is there")
            .filter_map(|entry| entry.ok().and_then(|entry| entry.file_name().into_string().ok()));
        let read_one = |file: &str| std::fs::read(folder.join(file));
        let found = read(&Listing { names: names.collect(), read: &read_one }).expect(name);
        assert_eq!((found.kind, found.frames.len()), (kind, frames), "{name}");
        assert_eq!(found.warnings.len(), warnings, "{name}: {:?}", found.warnings);
    }
}
