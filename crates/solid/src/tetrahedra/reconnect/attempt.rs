//! Taking a region out and putting it together anew.

use super::cavity::Region;
use crate::tetrahedra::flips::Work;

impl Work {
    /// Fills the region of `region` anew so that nothing passes the segments and facets that have all
    /// their ends in it, held or `wanted`, and `without` is no vertex any more. False, with nothing
    /// changed, where `steps` steps of search do not find a way.
    pub(crate) fn reconnect(
        &mut self,
        region: &Region,
        wanted_segments: &[[u32; 2]],
        wanted_facets: &[[u32; 3]],
        without: Option<u32>,
        steps: u32,
    ) -> bool {
        let vertices = &region.vertices;
        if vertices.len() > 60 {
            return false;
        }
        let local = |v: u32| vertices.iter().position(|&w| w == v).map(|i| i as u8);
        let epoch = self.mesh.next_epoch();
        for &t in &region.tets {
            self.mesh.stamp[t as usize] = epoch;
        }
        let mut surface = Vec::new();
        for &t in &region.tets {
            let tet = *self.mesh.tet(t);
            for f in 0..4 {
                let [a, b, c] = tet.face(f);
                let outer = self.mesh.stamp[(tet.n[f] >> 2) as usize] != epoch;
                if let (true, Some(a), Some(b), Some(c)) = (outer, local(a), local(b), local(c)) {
                    surface.push([a, b, c]);
                }
            }
        }
        let mut segments = Vec::new();
        let mut facets = Vec::new();
        for i in 0..vertices.len() {
            for j in i + 1..vertices.len() {
                let Some(id) = self.must.segment(vertices[i], vertices[j]) else { continue };
                let segment = &self.must.segments[id as usize];
                if segment.held {
                    segments.push([i as u8, j as u8]);
                }
                if !self.must.guard_facets {
                    continue;
                }
                for &facet in &segment.faces {
                    let facet = &self.must.facets[facet as usize];
                    let [a, b, c] = facet.corners;
                    if let (true, Some(a), Some(b), Some(c)) =
                        (facet.held, local(a), local(b), local(c))
                    {
                        facets.push([a, b, c]);
                    }
                }
            }
        }
        for &[a, b] in wanted_segments {
            if let (Some(a), Some(b)) = (local(a), local(b)) {
                segments.push([a, b]);
            }
        }
        for &[a, b, c] in wanted_facets {
            if let (Some(a), Some(b), Some(c)) = (local(a), local(b), local(c)) {
                facets.push([a, b, c]);
            }
        }
        let usable = vertices.iter().map(|&v| Some(v) != without).collect();
        let mut search = std::mem::take(&mut self.search);
        self.blamed.clear();
        search.even = self.even;
        search.signs.fill(&self.mesh, vertices);
        search.prepare(&surface, &segments, &facets, usable);
        let new: Option<Vec<[u32; 4]>> = search
            .run(steps)
            .map(|made| made.iter().map(|tet| tet.map(|i| vertices[i as usize])).collect());
        self.search = search;
        let Some(new) = new else {
            self.blamed = self.most_blamed(region, &surface);
            return false;
        };
        let all_kept =
            vertices.iter().all(|&v| Some(v) == without || new.iter().any(|tet| tet.contains(&v)));
        all_kept && self.exchange(&region.tets, &new)
    }

    /// The tetrahedra beyond the faces of the region's surface for which most often no apex was found.
    fn most_blamed(&self, region: &Region, surface: &[[u8; 3]]) -> Vec<u32> {
        let most = surface.iter().map(|&face| self.search.blame(face)).max().unwrap_or(0);
        let mut beyond = Vec::new();
        if most == 0 {
            return beyond;
        }
        let epoch = self.mesh.epoch;
        for &t in &region.tets {
            let tet = self.mesh.tet(t);
            for f in 0..4 {
                let other = tet.n[f] >> 2;
                if self.mesh.stamp[other as usize] == epoch || self.mesh.tet(other).is_ghost() {
                    continue;
                }
                let corners = tet.face(f);
                let [a, b, c] = corners
                    .map(|v| region.vertices.iter().position(|&w| w == v).unwrap_or(0) as u8);
                if self.search.blame([a, b, c]) == most
                    && !beyond.contains(&other)
                    && !self.must.holds_face(corners[0], corners[1], corners[2])
                {
                    beyond.push(other);
                }
            }
        }
        beyond
    }
}
