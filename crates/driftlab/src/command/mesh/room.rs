//! `driftlab mesh room`: a made-up depth image, to try the others on.

use anyhow::anyhow;
use formats::depth::to_levels;
use formats::{DepthPixels, FormatError, GrayImage, pgm, png};
use sensing::Camera;
use serde_json::json;
use worlds::DepthRoom;

use super::super::failure::Failure;
use super::super::files::{free, write_whole};
use super::super::out::Out;
use super::args::RoomArgs;
use super::depth_input::UNITS_PER_METRE;

pub(super) fn room(args: &RoomArgs, out: &Out) -> Result<(), Failure> {
    let extension = args.output.extension().and_then(|extension| extension.to_str());
    let encode: fn(&GrayImage) -> Result<Vec<u8>, FormatError> =
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("png") => png::write,
            Some("pgm") => |image| Ok(pgm::write(image)),
            _ => {
                return Err(Failure::Input(anyhow!(
                    "{}: found no known extension, expected .png or .pgm",
                    args.output.display()
                )));
            }
        };
    free(&args.output, args.force)?;
    let [columns, rows] = args.size;
    if [columns, rows].iter().any(|side| !(2..=4096).contains(side)) {
        return Err(Failure::Input(anyhow!(
            "--size: found {columns},{rows}, expected 2 to 4096 each way"
        )));
    }
    // Every speck would make frontier of the large faces that lie on it.
    let room =
        DepthRoom { columns, rows, seed: args.seed, speckle_share: 0.0, ..Default::default() };
    let depth = DepthPixels { columns, rows, depths_m: room.image().depths_m };
    let bytes = to_levels(&depth, UNITS_PER_METRE).and_then(|levels| encode(&levels));
    write_whole(&args.output, &bytes.map_err(Failure::work)?)?;
    let Camera { fx, fy, cx, cy } = room.camera();
    let camera = format!("{fx},{fy},{cx},{cy}");
    let file = args.output.display().to_string();
    let text = format!("{file}: {columns} x {rows} pixels; --camera {camera}\n");
    let json = json!({
        "file": file, "columns": columns, "rows": rows, "camera": camera,
        "depth_scale": UNITS_PER_METRE, "seed": args.seed,
    });
    out.result(&json, &text)
}
