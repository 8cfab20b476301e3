//! What is said of every mesh.

use serde_json::{Value, json};
use solid::{Label, Polyhedron, Validity, check};

use super::super::graph::numbers::shown;

/// Defects that are told; a mesh may have thousands.
const MOST: usize = 20;

/// A mesh, measured and checked.
pub(super) struct Told<'a> {
    mesh: &'a Polyhedron,
    pub validity: Validity,
}

impl<'a> Told<'a> {
    pub fn of(mesh: &'a Polyhedron) -> Self {
        Self::known(mesh, check(mesh))
    }

    /// A mesh of which it is known how valid it is.
    pub fn known(mesh: &'a Polyhedron, validity: Validity) -> Self {
        Self { mesh, validity }
    }

    fn count(&self, label: Label) -> usize {
        self.mesh.labels().iter().filter(|&&is| is == label).count()
    }

    pub fn json(&self) -> Value {
        let (mesh, validity, area) = (self.mesh, &self.validity, self.mesh.area_by_label());
        let defects: Vec<String> =
            validity.defects.iter().take(MOST).map(ToString::to_string).collect();
        json!({
            "vertices": mesh.vertices().len(),
            "faces": mesh.faces().len(),
            "obstacle_faces": self.count(Label::Obstacle),
            "frontier_faces": self.count(Label::Frontier),
            "closed": validity.closed,
            "oriented": validity.oriented,
            "manifold": validity.manifold,
            "self_intersecting": validity.self_intersecting,
            "defects_total": validity.defects.len(),
            "defects": defects,
            "volume_m3": mesh.volume_m3(),
            "area_by_label_m2": { "obstacle": area.obstacle_m2, "frontier": area.frontier_m2 },
        })
    }

    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let (mesh, validity, area) = (self.mesh, &self.validity, self.mesh.area_by_label());
        let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
        let mut rows = vec![
            ("vertices", mesh.vertices().len().to_string()),
            (
                "faces",
                format!(
                    "{}: {} obstacle, {} frontier",
                    mesh.faces().len(),
                    self.count(Label::Obstacle),
                    self.count(Label::Frontier)
                ),
            ),
            ("closed", yes(validity.closed)),
            ("oriented", yes(validity.oriented)),
            ("2-manifold", yes(validity.manifold)),
            ("self-intersecting", yes(validity.self_intersecting)),
            ("volume", format!("{} m3", shown(mesh.volume_m3()))),
            (
                "area",
                format!(
                    "{} m2 obstacle, {} m2 frontier",
                    shown(area.obstacle_m2),
                    shown(area.frontier_m2)
                ),
            ),
        ];
        rows.extend(validity.defects.iter().take(MOST).map(|defect| ("wrong", defect.to_string())));
        if validity.defects.len() > MOST {
            rows.push(("", format!("and {} more", validity.defects.len() - MOST)));
        }
        rows
    }
}
