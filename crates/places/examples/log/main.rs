//! What place recognition makes of a raw log, and what that costs: held against published relations and
//! corrected poses; with the maps that are named, fed as `driftlab replay` feeds them.
//!
//! ```text
//! cargo run --release -p places --example log -- [LOG] [CORRECTED|-] [RELATIONS|-] [MAP,MAP,..]
//! ```
//!
//! Without arguments: the raw log of the Intel Research Lab, and the relative map.
#![expect(clippy::print_stdout, reason = "a program")]

mod clock;
mod judge;
mod maps;

use std::path::PathBuf;

use clock::Cost;
use formats::laser::{LoggedScan, read, relations};
use maps::Fed;
use places::{Driven, PlaceParams, Recognizer, Verdict};

fn data(name: &str) -> PathBuf {
    let named = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    named.unwrap_or(beside).join("laser").join(name)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut file = |default: &str| match arguments.next() {
        Some(name) if name == "-" => None,
        Some(name) => Some(PathBuf::from(name)),
        None => Some(data(default)),
    };
    let log = file("intel_gfs.json.gz").ok_or("a log")?;
    let corrected = file("intel_corrected.json.gz");
    let relations_file = file("intel.relations");
    let names = arguments.next().unwrap_or_else(|| "relative".to_owned());
    let scans = read(&std::fs::read(log)?)?.scans;

    let params = PlaceParams::default();
    let mut recognizer = Recognizer::new(params);
    let mut fed = Fed::new(&names)?;
    let mut kept = Vec::new();
    let (mut of_places, mut of_both) = (Vec::new(), Vec::new());
    let mut driven = Driven::default();
    let mut last: Option<&LoggedScan> = None;
    let (mut proposed, mut gated) = (0, Vec::new());
    for scan in &scans {
        if let Some(last) = last {
            let step = last.odom_from_sensor.inverse_mul(&scan.odom_from_sensor);
            driven.last_from_new = driven.last_from_new * step;
            driven.distance_m += step.distance();
            driven.turned_rad += step.angle().abs();
        }
        let first = last.is_none();
        last = Some(scan);
        if !first && !params.keyframes.is_due(&driven.last_from_new) {
            continue;
        }
        let own = scan.scan.clone();
        let (added, places) = Cost::of(|| recognizer.add(own, &driven));
        let of_maps = fed.keyframe(&scan.scan, &driven, &added, &recognizer);
        of_places.push(places);
        of_both.push(places + of_maps);
        proposed += added.proposed;
        gated.push(added.gated as f64);
        kept.push(scan);
        driven = Driven::default();
    }
    let (settled, settling) = Cost::of(|| recognizer.settled());
    println!(
        "scans {}, keyframes {}, driven {:.0} m, gated {:.0}, proposed {proposed}, accepted {}, rejected at the end {}",
        scans.len(),
        kept.len(),
        recognizer.keyframes().last().map_or(0.0, |k| k.travelled_m),
        gated.iter().sum::<f64>(),
        recognizer.closures().len(),
        settled.rejected.len()
    );
    for (verdict, count) in Verdict::ALL.iter().zip(recognizer.tally().verdicts) {
        print!("{} {count}, ", verdict.name());
    }
    println!("untracked {}", recognizer.tally().untracked);
    clock::tell("places", &of_places);
    clock::tell("places and the first map", &of_both);
    fed.tell();
    let tenth = (gated.len() / 10).max(1);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    println!(
        "candidates, mean: first tenth {:.1}, last {:.1}; settling {:.0} ms; {} bytes per keyframe",
        mean(&gated[..tenth]),
        mean(&gated[gated.len() - tenth..]),
        settling.cpu_ms,
        recognizer.bytes() / kept.len().max(1),
    );

    let judged = judge::Judged { params: &params, recognizer: &recognizer, kept: &kept };
    if let Some(file) = corrected {
        judged.against_poses(&read(&std::fs::read(file)?)?.scans);
    }
    if let Some(file) = relations_file {
        judged.against_relations(&relations::read(&std::fs::read(file)?)?, &settled);
    }
    Ok(())
}
