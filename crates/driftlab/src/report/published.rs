//! What the sources print, beside what we measured.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::Deserialize;

use super::{Group, Study};
use crate::table::Cell;

/// The numbers, with their sources.
const PUBLISHED: &str = include_str!("published.toml");

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Page {
    number: Vec<Published>,
    reason: Vec<Reason>,
}

/// Why our numbers differ from published ones, as far as it is known.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Reason {
    /// Keys of a config, and the values that they must have.
    #[serde(rename = "where", default)]
    setting: BTreeMap<String, toml::Value>,
    /// The maps that it speaks of.
    maps: Vec<String>,
    /// The measured numbers that it speaks of.
    what: Vec<String>,
    /// The reason.
    text: String,
}

/// What one source tells of one setting.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Published {
    /// Work and figure.
    pub(crate) source: String,
    /// Keys of a config, and the values that they must have.
    #[serde(rename = "where")]
    setting: BTreeMap<String, toml::Value>,
    /// The maps that it speaks of.
    maps: Vec<String>,
    /// Names of measured numbers, with what was published.
    #[serde(default)]
    values: BTreeMap<String, f64>,
    /// Runs that were complete and true.
    complete: Option<u32>,
    /// Of so many.
    of: Option<u32>,
}

/// One published number beside ours.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Beside {
    /// Work and figure.
    pub(crate) source: String,
    /// What was measured, by name; `success` is the share of runs complete and true.
    pub(crate) what: String,
    /// What was published.
    pub(crate) published: f64,
    /// Our mean; `None` where no run has it.
    pub(crate) ours: Option<f64>,
    /// How many of our runs it is the mean of.
    pub(crate) runs: usize,
}

impl Beside {
    /// By how much ours is more, per cent of what was published.
    pub(crate) fn difference(&self) -> Option<f64> {
        let published = self.published;
        self.ours.filter(|_| published != 0.0).map(|ours| 100.0 * (ours - published) / published)
    }
}

fn page() -> &'static Page {
    static PAGE: OnceLock<Page> = OnceLock::new();
    PAGE.get_or_init(|| toml::from_str(PUBLISHED).unwrap_or_default())
}

fn published() -> &'static [Published] {
    &page().number
}

/// Whether a config has all these values at a group.
fn fits(setting: &BTreeMap<String, toml::Value>, study: &Study, group: &Group) -> bool {
    setting.iter().all(|(key, value)| {
        study.value(group, key).is_some_and(|ours| same(ours, &Cell::from_toml(value)))
    })
}

/// The map that steers for all others too; `None` where each steers a robot of its own.
pub(crate) fn steers<'a>(study: &'a Study, group: &'a Group) -> Option<&'a str> {
    match study.value(group, "compare.drive") {
        Some(Cell::Text(drive)) if drive != "each" => Some(drive),
        _ => None,
    }
}

impl Published {
    /// Whether it speaks of this group: what the sources tell of a map is where it steers.
    fn fits(&self, study: &Study, group: &Group) -> bool {
        self.maps.contains(&group.map)
            && steers(study, group).is_none_or(|drive| drive == group.map)
            && fits(&self.setting, study, group)
    }
}

/// Differences beyond this share want a reason, per cent of what was published.
const WANTS_REASON: f64 = 10.0;

/// The known reasons for those differences that a study shows, each once.
pub(crate) fn reasons(study: &Study) -> Vec<&'static str> {
    let shown = |reason: &Reason| {
        study.groups.iter().any(|group| {
            reason.maps.contains(&group.map)
                && fits(&reason.setting, study, group)
                && beside(study, group).iter().any(|one| {
                    reason.what.contains(&one.what)
                        && one.difference().is_none_or(|by| by.abs() > WANTS_REASON)
                })
        })
    };
    page().reason.iter().filter(|reason| shown(reason)).map(|r| r.text.as_str()).collect()
}

fn same(a: &Cell, b: &Cell) -> bool {
    match (a.number(), b.number()) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}

/// Every published number that speaks of a group, beside ours.
pub(crate) fn beside(study: &Study, group: &Group) -> Vec<Beside> {
    let mut all = Vec::new();
    for number in published().iter().filter(|number| number.fits(study, group)) {
        for (name, &value) in &number.values {
            let ours = study.measured(group, name);
            all.push(Beside {
                source: number.source.clone(),
                what: name.clone(),
                published: value,
                ours: ours.map(|mean| mean.mean),
                runs: ours.map_or(0, |mean| mean.count),
            });
        }
        if let (Some(complete), Some(of @ 1..)) = (number.complete, number.of) {
            all.push(Beside {
                source: number.source.clone(),
                what: "success".to_owned(),
                published: f64::from(complete) / f64::from(of),
                ours: group.success().map(|share| share.share()),
                runs: group.runs.len(),
            });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::group::Run;
    use super::*;

    fn study(map: &str, scale: f64) -> Study {
        let run = |seed: u64, d_max_m: f64| Run {
            seed,
            results: [
                ("d_max_m".to_owned(), d_max_m.into()),
                ("believed_complete".to_owned(), true.into()),
                ("false_completion".to_owned(), false.into()),
            ]
            .into(),
            ..Run::default()
        };
        let group = Group {
            axes: vec![("odometry.scale".to_owned(), scale.into())],
            map: map.to_owned(),
            runs: vec![run(1, 600.0), run(2, 528.0)],
        };
        let config = [
            ("world.paper.map".to_owned(), Cell::from("maze")),
            ("places.radius_m".to_owned(), Cell::Count(5)),
        ];
        Study { groups: vec![group], config: config.into(), ..Study::default() }
    }

    #[test]
    fn the_page_is_read_whole() {
        let page: Page = toml::from_str(PUBLISHED).expect("our own page");
        assert_eq!(page.number.len(), 27 + 8 + 6);
        assert_eq!(published().len(), page.number.len());
        assert!(!page.reason.is_empty());
    }

    #[test]
    fn numbers_stand_beside_the_groups_that_they_speak_of() {
        let study = study("relative", 0.5);
        let all = beside(&study, &study.groups[0]);
        let told = |what: &str, source: &str| {
            all.iter().find(|one| one.what == what && one.source.contains(source)).cloned()
        };
        let noise = told("d_max_m", "fig. 6").expect("the noise sweep has it");
        assert_eq!((noise.published, noise.ours, noise.runs), (564.0, Some(564.0), 2));
        assert_eq!(noise.difference(), Some(0.0));
        assert_eq!(told("d_exp_m", "fig. 6").map(|one| one.ours), Some(None));
        assert_eq!(told("success", "fig. 6").map(|one| one.published), Some(1.0));
        assert!(!reasons(&self::study("grid", 0.5)).is_empty(), "it is 150 % off");
        assert!(told("d_max_m", "fig. 8").is_some(), "and the radius sweep");
        assert!(
            beside(&study, &Group { map: "other".into(), ..study.groups[0].clone() }).is_empty()
        );
        let off = self::study("relative", 0.7);
        assert!(beside(&off, &off.groups[0]).is_empty());
    }
}
