//! Step 6: tetrahedra for ways, when they are asked for.

use super::UnionMap;
use super::volumes::Volumes;
use crate::Map3dProbe;

impl UnionMap {
    /// Fills the map with tetrahedra, if they are not there already; tells how many there are.
    ///
    /// Cost: that of [`solid::tetrahedralize`] after each look.
    pub fn fill(&mut self, probe: &mut dyn Map3dProbe) -> usize {
        match self.volumes.take() {
            Some(volumes) => self.volumes.insert(volumes).len(),
            None => {
                let (volumes, filled) = Volumes::new(&self.united.mesh, &self.views, probe);
                match filled {
                    Ok(()) => self.counts.fillings += 1,
                    Err(_) => self.counts.refused_fillings += 1,
                }
                self.work.tetrahedra = volumes.len();
                self.volumes.insert(volumes).len()
            }
        }
    }
}
