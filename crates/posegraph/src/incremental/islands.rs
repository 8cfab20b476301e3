//! Which vertices hang together, and who holds each island where it is.

/// Connected components that grow together.
#[derive(Clone, Debug, Default)]
pub(super) struct Islands {
    island_of: Vec<usize>,
    /// Vertices of each island; empty where it has joined another. The first is held.
    members: Vec<Vec<usize>>,
}

/// Two islands that have become one.
pub(super) struct Joined {
    /// The vertex that was held and is free now.
    pub freed: usize,
    /// The vertices of the island that joined the other.
    pub newcomers: Vec<usize>,
}

impl Islands {
    /// Adds a vertex as an island of its own.
    pub fn push(&mut self) {
        self.island_of.push(self.members.len());
        self.members.push(vec![self.island_of.len() - 1]);
    }

    /// Whether a vertex holds its island.
    pub fn is_held(&self, vertex: usize) -> bool {
        self.members[self.island_of[vertex]][0] == vertex
    }

    /// Whether two vertices hang together.
    pub fn together(&self, a: usize, b: usize) -> bool {
        self.island_of[a] == self.island_of[b]
    }

    /// Whether `a` is on the island with the older anchor.
    pub fn is_older(&self, a: usize, b: usize) -> bool {
        self.members[self.island_of[a]][0] < self.members[self.island_of[b]][0]
    }

    /// Joins the islands of two vertices; the older anchor goes on holding.
    pub fn join(&mut self, older: usize, younger: usize) -> Joined {
        let (older, younger) = (self.island_of[older], self.island_of[younger]);
        let newcomers = std::mem::take(&mut self.members[younger]);
        for &vertex in &newcomers {
            self.island_of[vertex] = older;
        }
        self.members[older].extend_from_slice(&newcomers);
        Joined { freed: newcomers[0], newcomers }
    }

    /// Finds the islands anew after an edge is gone; `reached` tells who still hangs together with
    /// `vertex`. Returns the vertex that is held from now on, where the island came apart.
    pub fn part(&mut self, vertex: usize, reached: &[bool]) -> Option<usize> {
        let island = self.island_of[vertex];
        let anchor = self.members[island][0];
        let stays = reached[anchor];
        let (kept, gone): (Vec<usize>, Vec<usize>) =
            self.members[island].iter().partition(|&&member| reached[member] == stays);
        let mut gone = gone;
        gone.sort_unstable();
        let &first = gone.first()?;
        for &member in &gone {
            self.island_of[member] = self.members.len();
        }
        self.members[island] = kept;
        self.members.push(gone);
        Some(first)
    }
}
