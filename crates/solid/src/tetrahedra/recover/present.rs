//! Which segments and facets are there already.

use crate::tetrahedra::flips::Work;

impl Work {
    /// Holds every segment that is an edge of the mesh; returns the others, ascending. O(n).
    pub(crate) fn hold_present_segments(&mut self) -> Vec<u32> {
        for t in 0..self.mesh.tets.len() as u32 {
            let tet = self.mesh.tet(t);
            if !tet.is_live() || tet.is_ghost() {
                continue;
            }
            for i in 0..4 {
                for j in i + 1..4 {
                    if let Some(id) = self.must.segment(tet.v[i], tet.v[j]) {
                        self.must.segments[id as usize].held = true;
                    }
                }
            }
        }
        self.missing_segments()
    }

    /// The segments that are not held, ascending.
    pub(crate) fn missing_segments(&self) -> Vec<u32> {
        let segments = self.must.segments.iter().enumerate();
        segments.filter(|(_, s)| s.live && !s.held).map(|(i, _)| i as u32).collect()
    }

    /// Holds every facet that is a face of the mesh, from now on; returns the others, ascending. O(n).
    pub(crate) fn hold_present_facets(&mut self) -> Vec<u32> {
        self.must.guard_facets = true;
        for t in 0..self.mesh.tets.len() as u32 {
            let tet = *self.mesh.tet(t);
            if !tet.is_live() || tet.is_ghost() {
                continue;
            }
            for f in 0..4 {
                if tet.n[f] >> 2 > t {
                    let [a, b, c] = tet.face(f);
                    if let Some(id) = self.must.facet(a, b, c) {
                        self.must.facets[id as usize].held = true;
                    }
                }
            }
        }
        self.missing_facets()
    }

    /// The facets that are not held, ascending.
    pub(crate) fn missing_facets(&self) -> Vec<u32> {
        let facets = self.must.facets.iter().enumerate();
        facets.filter(|(_, f)| f.live && !f.held).map(|(i, _)| i as u32).collect()
    }
}
