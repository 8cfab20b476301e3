//! Connected components of a graph.

/// The connected components of a graph, numbered in the order of their first vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    of: Vec<usize>,
    count: usize,
}

impl Components {
    /// Components of vertices `0..count` joined by these pairs; pairs out of range join nothing.
    pub fn new(count: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut leader: Vec<usize> = (0..count).collect();
        for (a, b) in pairs.filter(|&(a, b)| a < count && b < count) {
            let (a, b) = (find(&mut leader, a), find(&mut leader, b));
            // The smaller index leads, so that leaders come before those they lead.
            leader[a.max(b)] = a.min(b);
        }
        let mut of = vec![0; count];
        let mut components = 0;
        for vertex in 0..count {
            let first = find(&mut leader, vertex);
            of[vertex] = if first == vertex { components } else { of[first] };
            components += usize::from(first == vertex);
        }
        Self { of, count: components }
    }

    /// Number of components.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The component of each vertex.
    pub fn of(&self) -> &[usize] {
        &self.of
    }

    /// The vertices to hold, ascending: the fixed ones, and the first of each component that has
    /// none.
    pub fn anchors(&self, fixed: &[usize]) -> Vec<usize> {
        let mut has = vec![false; self.count];
        let mut held: Vec<usize> =
            fixed.iter().copied().filter(|&vertex| vertex < self.of.len()).collect();
        for &vertex in &held {
            has[self.of[vertex]] = true;
        }
        for (vertex, &component) in self.of.iter().enumerate() {
            if !has[component] {
                has[component] = true;
                held.push(vertex);
            }
        }
        held.sort_unstable();
        held.dedup();
        held
    }
}

/// The leader of a vertex; halves the way to it for the next time.
fn find(leader: &mut [usize], mut vertex: usize) -> usize {
    while leader[vertex] != vertex {
        leader[vertex] = leader[leader[vertex]];
        vertex = leader[vertex];
    }
    vertex
}
