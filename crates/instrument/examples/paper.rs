//! Records the paper's maze with a relative map and a grid: `paper OUT.rrd [off|summary|full] [map]`.

#![allow(missing_docs, clippy::print_stdout, reason = "a tool for development")]

#[path = "../tests/support/mod.rs"]
mod support;

use instrument::Level;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let level = match args.get(2).map(String::as_str) {
        Some("off") => Level::Off,
        Some("summary") => Level::Summary,
        _ => Level::Full,
    };
    let name = args.get(3).map_or("maze", String::as_str);
    let steps = args.get(4).and_then(|n| n.parse().ok()).unwrap_or(20_000);
    if name == "inspect" {
        let mut found = instrument::inspect(std::path::Path::new(&args[1])).expect("readable");
        found.entities.sort_by_key(|entity| std::cmp::Reverse(entity.bytes));
        for entity in found.entities.iter().take(40) {
            println!("{:9} bytes {:7} rows {}", entity.bytes, entity.rows, entity.path);
        }
        println!("{:?}\n{:#?}\n{:?}", found.timelines, found.damage, found.metrics);
        for event in &found.events {
            println!("{:7} {} {} {}", event.count, event.map, event.family, event.variant);
        }
        return;
    }
    let path = std::path::Path::new(&args[1]);
    let world = worlds::paper::by_name(name).expect("a known map");
    let times = support::record(path, level, &["relative", "grid"], world, steps);
    for (map, mut of_map) in ["relative", "grid"].iter().zip(times) {
        of_map.sort();
        let at = |share: f64| of_map[((of_map.len() - 1) as f64 * share) as usize];
        println!("{map}: {} steps, median {:?}, p99 {:?}", of_map.len(), at(0.5), at(0.99));
    }
}
