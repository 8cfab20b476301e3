//! What a file is, told by its content first.

use crate::pose_graph::{self, GraphFormat};
use crate::tum;

/// What a file seems to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A map_server YAML file, which names an image.
    MapServerYaml,
    /// A Netpbm grey map, `P2` or `P5`.
    Pgm,
    /// A PNG image.
    Png,
    /// A MovingAI grid map.
    MovingAi,
    /// A pose graph in g2o's dialect.
    G2o,
    /// A pose graph in TORO's dialect.
    Toro,
    /// A trajectory of TUM's benchmark.
    Tum,
    /// A TOML file.
    Toml,
    /// None of these.
    Unknown,
}

/// The bytes at the start that are looked at.
const LOOKED_AT: usize = 1 << 16;

/// Tells what the bytes hold; the extension (without dot) decides only where the content does not.
pub fn sniff(bytes: &[u8], extension: Option<&str>) -> Kind {
    by_content(bytes).or_else(|| by_extension(extension)).unwrap_or(Kind::Unknown)
}

fn by_content(bytes: &[u8]) -> Option<Kind> {
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return Some(Kind::Png);
    }
    if let [b'P', b'2' | b'5', next, ..] = bytes
        && (next.is_ascii_whitespace() || *next == b'#')
    {
        return Some(Kind::Pgm);
    }
    let start = &bytes[..bytes.len().min(LOOKED_AT)];
    let head = String::from_utf8_lossy(start);
    let head = head.trim_start_matches('\u{feff}');
    let lines: Vec<&str> = head
        .lines()
        .map(|line| line.split_once('#').map_or(line, |(before, _)| before).trim_end())
        .filter(|line| !line.is_empty())
        .collect();
    if is_moving_ai(&lines) {
        return Some(Kind::MovingAi);
    }
    let has_key = |key: &str| {
        lines.iter().any(|line| {
            let line = line.trim_start_matches(['"', '\'']);
            let rest = line.strip_prefix(key).map(|rest| rest.trim_start_matches(['"', '\'']));
            rest.is_some_and(|rest| rest.trim_start().starts_with(':'))
        })
    };
    if has_key("image") && has_key("resolution") {
        return Some(Kind::MapServerYaml);
    }
    match pose_graph::first_tag(start) {
        Some((GraphFormat::G2o, _)) => return Some(Kind::G2o),
        Some((GraphFormat::Toro, _)) => return Some(Kind::Toro),
        None if tum::looks_like(start) => return Some(Kind::Tum),
        None => {}
    }
    is_toml(&lines).then_some(Kind::Toml)
}

/// Header keys up to `map`, at least one with its value.
fn is_moving_ai(lines: &[&str]) -> bool {
    let header = lines.iter().take_while(|line| line.trim() != "map");
    let mut keys = 0;
    for line in header.take(4) {
        let mut words = line.split_whitespace();
        match (words.next(), words.next()) {
            (Some("type"), Some(kind)) if kind.starts_with(char::is_alphabetic) => keys += 1,
            (Some("height" | "width"), Some(size)) if size.parse::<u64>().is_ok() => keys += 1,
            _ => return false,
        }
    }
    keys > 0
}

/// Its first line is a table or an assignment to a bare or quoted key.
fn is_toml(lines: &[&str]) -> bool {
    let Some(line) = lines.first().map(|line| line.trim()) else { return false };
    let is_key = |key: &str| {
        let symbol = |c: char| c.is_ascii_alphanumeric() || "_-.\"' ".contains(c);
        !key.trim().is_empty() && key.chars().all(symbol)
    };
    let table = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    match (table, line.split_once('=')) {
        (Some(name), _) => is_key(name.trim_start_matches('[').trim_end_matches(']')),
        (None, Some((key, value))) => is_key(key) && !value.trim().is_empty(),
        (None, None) => false,
    }
}

fn by_extension(extension: Option<&str>) -> Option<Kind> {
    match extension?.to_ascii_lowercase().as_str() {
        "yaml" | "yml" => Some(Kind::MapServerYaml),
        "pgm" => Some(Kind::Pgm),
        "png" => Some(Kind::Png),
        "map" => Some(Kind::MovingAi),
        "g2o" => Some(Kind::G2o),
        "graph" | "toro" => Some(Kind::Toro),
        "tum" => Some(Kind::Tum),
        "toml" => Some(Kind::Toml),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_wins_over_the_name() {
        let cases: [(&[u8], Kind); 16] = [
            (b"\x89PNG\r\n\x1a\n....", Kind::Png),
            (b"P5\n# x\n3 2", Kind::Pgm),
            (b"P2 3 2", Kind::Pgm),
            (b"P5x", Kind::Unknown),
            (b"type octile\nheight 49\nwidth 49\nmap\n", Kind::MovingAi),
            (b"height 3\r\nwidth 3\r\n", Kind::MovingAi),
            (b"# map\nimage: a.pgm\nresolution: 0.05\n", Kind::MapServerYaml),
            (b"resolution : 1\n\"image\": a.pgm", Kind::MapServerYaml),
            (b"image: a.pgm\n", Kind::Unknown),
            (b"# experiment\nschema = 1\n[world.paper]\n", Kind::Toml),
            (b"[world]\nx = 1\n", Kind::Toml),
            (b"# g\nPARAMS x\nVERTEX_SE2 0 0 0 0\n", Kind::G2o),
            (b"EDGE3 0 1 ", Kind::Toro),
            (b"# stamp\n1.5 0 0 0 0 0 0 1\n", Kind::Tum),
            (b"1.5 0 0 0 0 0 0 1 2\n", Kind::Unknown),
            (b"\xff\xfe\x00", Kind::Unknown),
        ];
        for (bytes, kind) in cases {
            assert_eq!(sniff(bytes, None), kind, "{}", String::from_utf8_lossy(bytes));
            let expected = if kind == Kind::Unknown { Kind::MovingAi } else { kind };
            assert_eq!(sniff(bytes, Some("MAP")), expected);
        }
        assert_eq!(sniff(b"", Some("yml")), Kind::MapServerYaml);
        assert_eq!(sniff(b"", None), Kind::Unknown);
    }
}
