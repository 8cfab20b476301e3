//! Step 6: tetrahedra, when somebody asks for a way.

use solid::{SolidError, Tetrahedra, tetrahedralize};

use super::UnionEvent;
use super::view::View;
use crate::events::Relay;
use crate::{Map3dProbe, Maps3dError, PlanOptions, Planner};

/// The free space of a map as tetrahedra, and a planner over them.
#[derive(Debug)]
pub(super) struct Volumes {
    all: Vec<Tetrahedra>,
    /// Whether the first is that of the united map.
    pub united: bool,
    /// With the radius that it was made for.
    planner: Option<(f64, Planner)>,
}

impl Volumes {
    /// Fills the united map; where it is refused, the fans of all views stand for it. Views that stand beside
    /// the map come as fans in any case.
    ///
    /// Cost: that of [`tetrahedralize`].
    pub fn new(
        map: &solid::Polyhedron,
        views: &[View],
        probe: &mut dyn Map3dProbe,
    ) -> (Self, Result<(), SolidError>) {
        let fans = |only_aside: bool| -> Vec<Tetrahedra> {
            let wanted = views.iter().filter(|view| view.aside || !only_aside);
            // A view whose fan is refused is left out: there is nothing else that it could be.
            wanted.filter_map(|view| view.fan().ok()).collect()
        };
        match tetrahedralize(map) {
            Ok(tetrahedra) => {
                probe.emit(UnionEvent::Filled { tetrahedra: &tetrahedra });
                let mut all = vec![tetrahedra];
                all.extend(fans(true));
                (Self { all, united: true, planner: None }, Ok(()))
            }
            Err(why) => {
                let all = fans(false);
                probe.emit(UnionEvent::Fanned { why: &why, fans: all.len() });
                (Self { all, united: false, planner: None }, Err(why))
            }
        }
    }

    /// Number of tetrahedra.
    pub fn len(&self) -> usize {
        self.all.iter().map(|one| one.tetrahedra.len()).sum()
    }

    /// A planner for a ball of this radius; made, and told, once as long as the radius stays the same.
    ///
    /// # Errors
    /// As [`Planner::new`].
    pub fn planner(
        &mut self,
        radius_m: f64,
        probe: &mut Relay<'_>,
    ) -> Result<&mut Planner, Maps3dError> {
        let made = match self.planner.take() {
            Some((known_m, planner)) if known_m == radius_m => planner,
            _ => {
                let volumes: Vec<&Tetrahedra> = self.all.iter().collect();
                let options = PlanOptions { radius_m, ..PlanOptions::default() };
                let planner = Planner::new(&volumes, &options)?;
                planner.tell(probe);
                planner
            }
        };
        Ok(&mut self.planner.insert((radius_m, made)).1)
    }

    /// Memory held on the heap, bytes; without the planner, which stands no longer than the next look.
    pub fn heap_bytes(&self) -> usize {
        let of = |one: &Tetrahedra| {
            size_of_val(&one.vertices[..])
                + size_of_val(&one.tetrahedra[..])
                + size_of_val(&one.neighbours[..])
                + size_of_val(&one.boundary[..])
        };
        self.all.iter().map(of).sum()
    }
}
