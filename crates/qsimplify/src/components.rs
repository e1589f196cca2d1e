//! Which elements hang together.

/// Sets of indices that merge.
pub(crate) struct Components {
    parent: Vec<u32>,
}

impl Components {
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    /// The smallest index of the set that `index` is in.
    pub(crate) fn root(&mut self, mut index: u32) -> u32 {
        while self.parent[index as usize] != index {
            let grandparent = self.parent[self.parent[index as usize] as usize];
            self.parent[index as usize] = grandparent;
            index = grandparent;
        }
        index
    }

    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// Whether each index is in a set with one of `anchors`.
    pub(crate) fn with_any(&mut self, anchors: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut anchored = vec![false; self.parent.len()];
        for anchor in anchors {
            anchored[self.root(anchor) as usize] = true;
        }
        (0..self.parent.len() as u32).map(|i| anchored[self.root(i) as usize]).collect()
    }
}
