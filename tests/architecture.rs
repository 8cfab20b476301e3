//! The house stands as `crates/README.md` says: levels, libraries, files, words.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const MAX_LINES: usize = 800;
const PAGE: &str = "crates/README.md";

/// One line of the table of levels.
#[derive(Clone, Debug)]
struct Row {
    level: u32,
    may_import_worlds: bool,
}

/// A crate as cargo sees it: what its code, not its tests, depends on.
#[derive(Clone, Debug)]
struct Package {
    name: String,
    dependencies: Vec<String>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The cells of the table whose first header is `header`, without the two header lines.
fn table(page: &str, header: &str) -> Vec<Vec<String>> {
    let start = format!("| {header} |");
    let lines = page.lines().skip_while(|line| !line.starts_with(&start)).skip(2);
    let rows = lines.take_while(|line| line.starts_with('|'));
    rows.map(|line| {
        let cells = line.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().replace('`', "")).collect()
    })
    .collect()
}

fn levels(page: &str) -> BTreeMap<String, Row> {
    let rows = table(page, "crate").into_iter().map(|cells| {
        let [name, level, may_import, _] = cells.as_slice() else {
            panic!("{PAGE}: a line of the table of levels has not four cells: {cells:?}");
        };
        let level = level.parse().unwrap_or_else(|_| panic!("{PAGE}: {name}: level {level}?"));
        (name.clone(), Row { level, may_import_worlds: may_import.ends_with("and worlds") })
    });
    rows.collect()
}

/// Each guarded library, or start of a name with `*`, and the crates that may use it.
fn guarded(page: &str) -> Vec<(String, Vec<String>)> {
    let rows = table(page, "library").into_iter();
    rows.map(|cells| {
        (cells[0].clone(), cells[1].split(',').map(|name| name.trim().to_owned()).collect())
    })
    .collect()
}

/// Asks cargo, without network, for the crates of the workspace.
fn packages() -> Vec<Package> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--offline", "--format-version", "1", "--no-deps"])
        .current_dir(root())
        .output()
        .expect("cargo runs this test, so it can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("cargo metadata writes JSON");
    let packages = metadata["packages"].as_array().expect("metadata has packages");
    let text = |value: &serde_json::Value| value.as_str().expect("a name is text").to_owned();
    packages
        .iter()
        .map(|package| {
            let all = package["dependencies"].as_array().expect("a package has dependencies");
            let of_code = all.iter().filter(|dependency| dependency["kind"] != "dev");
            Package {
                name: text(&package["name"]),
                dependencies: of_code.map(|dependency| text(&dependency["name"])).collect(),
            }
        })
        .collect()
}

fn check_table(levels: &BTreeMap<String, Row>, packages: &[Package]) -> Vec<String> {
    let built: BTreeSet<&String> = packages.iter().map(|package| &package.name).collect();
    let missing = built.iter().filter(|name| !levels.contains_key(**name));
    let missing = missing.map(|name| format!("{name}: in the workspace, not in {PAGE}"));
    let gone = levels.keys().filter(|name| !built.contains(name));
    missing.chain(gone.map(|name| format!("{name}: in {PAGE}, not in the workspace"))).collect()
}

fn check_levels(levels: &BTreeMap<String, Row>, packages: &[Package]) -> Vec<String> {
    let mut broken = Vec::new();
    for package in packages {
        let Some(own) = levels.get(&package.name) else { continue };
        for dependency in &package.dependencies {
            let Some(other) = levels.get(dependency) else { continue };
            let edge = format!("{} -> {dependency}", package.name);
            if other.level >= own.level {
                broken.push(format!(
                    "{edge}: level {} may not import level {}",
                    own.level, other.level
                ));
            }
            if dependency == "worlds" && !own.may_import_worlds {
                broken.push(format!("{edge}: {} may not know the truth", package.name));
            }
        }
    }
    broken
}

fn check_libraries(guarded: &[(String, Vec<String>)], packages: &[Package]) -> Vec<String> {
    let mut broken = Vec::new();
    for package in packages {
        for dependency in &package.dependencies {
            for (library, users) in guarded {
                let is_it = match library.strip_suffix('*') {
                    Some(start) => dependency.starts_with(start),
                    None => dependency == library,
                };
                if is_it && !users.contains(&package.name) {
                    broken.push(format!(
                        "{} -> {dependency}: only {} may use it",
                        package.name,
                        users.join(", ")
                    ));
                }
            }
        }
    }
    broken
}

/// All files below `folder` with one of the endings, in order.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        for entry in entries {
            let path = entry.expect("a folder that opens can be listed").path();
            if path.is_dir() && path.file_name().is_some_and(|name| name != "target") {
                folders.push(path);
            } else if path.extension().is_some_and(|end| endings.iter().any(|e| *e == end)) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn sources(endings: &[&str]) -> Vec<PathBuf> {
    ["crates", "tests"].iter().flat_map(|folder| files(&root().join(folder), endings)).collect()
}

/// The keys of the form `[Name12]` in `text`. Documentation escapes the brackets, so that no link
/// is made of them.
fn citations(text: &str) -> BTreeSet<String> {
    let inside = text.split('[').skip(1).filter_map(|rest| rest.split_once(']'));
    let is_key = |key: &&str| {
        let letters = key.trim_end_matches(|c: char| c.is_ascii_digit());
        key.len() == letters.len() + 2
            && letters.starts_with(|c: char| c.is_ascii_uppercase())
            // Longer ones are types: [AtomicU64].
            && (3..=5).contains(&letters.len())
            && letters.chars().all(|c| c.is_ascii_alphabetic())
    };
    inside.map(|(key, _)| key.trim_end_matches('\\')).filter(is_key).map(str::to_owned).collect()
}

#[track_caller]
fn assert_none(broken: Vec<String>) {
    assert!(broken.is_empty(), "\n{}\n", broken.join("\n"));
}

#[test]
fn the_table_of_levels_lists_every_crate() {
    assert_none(check_table(&levels(&read(&root().join(PAGE))), &packages()));
}

#[test]
fn imports_point_down_and_truth_stays_locked_up() {
    assert_none(check_levels(&levels(&read(&root().join(PAGE))), &packages()));
}

#[test]
fn guarded_libraries_are_used_where_they_may_be() {
    let guarded = guarded(&read(&root().join(PAGE)));
    assert!(guarded.iter().any(|(library, _)| library == "rerun"), "the table was not found");
    assert_none(check_libraries(&guarded, &packages()));
}

#[test]
fn no_source_file_is_too_long() {
    let files = sources(&["rs"]);
    assert!(files.len() > 50, "only {} source files were found", files.len());
    let lengths = files.iter().map(|path| (path, read(path).lines().count()));
    let long = lengths.filter(|(_, lines)| *lines > MAX_LINES);
    let say = |(path, lines): (&PathBuf, usize)| {
        format!("{}: {lines} lines, at most {MAX_LINES}", path.display())
    };
    assert_none(long.map(say).collect());
}

#[test]
fn every_crate_has_a_readme_that_is_its_first_page() {
    let mut broken = Vec::new();
    for (name, row) in levels(&read(&root().join(PAGE))) {
        let folder = root().join("crates").join(&name);
        let readme = fs::read_to_string(folder.join("README.md")).unwrap_or_default();
        if !readme.starts_with(&format!("# {name}\n")) {
            broken.push(format!("{name}: README.md does not open with its name"));
        }
        let level = format!("*Level {}", row.level);
        if !readme.lines().any(|line| line.starts_with(&level)) {
            broken.push(format!("{name}: README.md does not say \"{level}\""));
        }
        let lib = fs::read_to_string(folder.join("src/lib.rs")).unwrap_or_default();
        if !lib.contains("#![doc = include_str!(\"../README.md\")]") {
            broken.push(format!("{name}: src/lib.rs does not include README.md"));
        }
    }
    assert_none(broken);
}

#[test]
fn every_source_that_is_cited_is_listed() {
    let page = read(&root().join(PAGE));
    let references = page.split("## References").nth(1).expect("the page ends with references");
    let known = citations(references);
    let mut broken = Vec::new();
    for path in sources(&["rs", "md"]) {
        for key in citations(&read(&path)).difference(&known) {
            // The two made-up keys of the test below.
            if !["Abc12", "Name12"].contains(&key.as_str()) {
                broken.push(format!("{}: [{key}] is not in {PAGE}", path.display()));
            }
        }
    }
    assert_none(broken);
}

#[test]
fn no_file_names_a_place_on_one_machine() {
    let own_file = root().join("tests/architecture.rs");
    let mut broken = Vec::new();
    for path in sources(&["rs", "md", "toml"]).into_iter().filter(|path| *path != own_file) {
        for (number, line) in read(&path).lines().enumerate() {
            if ["/home/", "/root/", "/Users/"].iter().any(|place| line.contains(place)) {
                broken.push(format!("{}:{}: {line}", path.display(), number + 1));
            }
        }
    }
    assert_none(broken);
}

#[test]
fn broken_houses_are_noticed() {
    let page = "\
| crate | level | may import | what |
|---|---|---|---|
| `low` | 0 | lower levels | |
| `worlds` | 1 | lower levels | |
| `high` | 2 | lower levels, not `worlds` | |
| `judge` | 2 | lower levels and `worlds` | |

| library | only in | why |
|---|---|---|
| `view` | `judge`, `high` | |
| `ray*` | `low` | |
";
    let package = |name: &str, dependencies: &[&str]| Package {
        name: name.to_owned(),
        dependencies: dependencies.iter().map(|&name| name.to_owned()).collect(),
    };
    let levels = levels(page);
    let sound = [
        package("low", &["ray2d"]),
        package("worlds", &["low"]),
        package("high", &["low", "view"]),
        package("judge", &["worlds", "low", "view"]),
    ];
    assert_none(check_table(&levels, &sound));
    assert_none(check_levels(&levels, &sound));
    assert_none(check_libraries(&guarded(page), &sound));

    let broken = [
        package("low", &["high", "view"]),
        package("high", &["judge", "worlds", "ray3d"]),
        package("judge", &[]),
        package("shed", &[]),
    ];
    let expected = [
        "shed: in the workspace, not in crates/README.md",
        "worlds: in crates/README.md, not in the workspace",
    ];
    assert_eq!(check_table(&levels, &broken), expected);
    let expected = [
        "low -> high: level 0 may not import level 2",
        "high -> judge: level 2 may not import level 2",
        "high -> worlds: high may not know the truth",
    ];
    assert_eq!(check_levels(&levels, &broken), expected);
    let expected =
        ["low -> view: only judge, high may use it", "high -> ray3d: only low may use it"];
    assert_eq!(check_libraries(&guarded(page), &broken), expected);

    let cited =
        citations("\\[Abc12\\] 4, `[Xy1]`, [u32], [Name12], [ISRR19, Zie18], a[i], [AbC123]");
    assert_eq!(cited.into_iter().collect::<Vec<_>>(), ["Abc12", "Name12"]);
}
