//! Which elements hang together: union-find.

/// Sets of indices that merge.
///
/// ```
/// let mut sets = qmesh::Components::new(4);
/// assert!(sets.join(3, 1) && sets.join(1, 2) && !sets.join(2, 3));
/// assert_eq!([0, 1, 2, 3].map(|index| sets.root(index)), [0, 1, 1, 1]);
/// assert_eq!(sets.numbered(), (vec![0, 1, 1, 1], 2));
/// ```
#[derive(Clone, Debug)]
pub struct Components {
    parent: Vec<u32>,
}

impl Components {
    /// Each of the indices below `count`, which has to be below 2³², in a set of its own.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    /// The smallest index of the set that `index` is in.
    ///
    /// # Panics
    /// When there is no such index.
    pub fn root(&mut self, mut index: u32) -> u32 {
        while self.parent[index as usize] != index {
            let grandparent = self.parent[self.parent[index as usize] as usize];
            self.parent[index as usize] = grandparent;
            index = grandparent;
        }
        index
    }

    /// Merges the sets of two indices, and says whether they were two.
    ///
    /// # Panics
    /// As [`Components::root`].
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// Whether each index is in a set with one of `anchors`.
    ///
    /// # Panics
    /// As [`Components::root`].
    pub fn with_any(&mut self, anchors: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut anchored = vec![false; self.parent.len()];
        for anchor in anchors {
            anchored[self.root(anchor) as usize] = true;
        }
        (0..self.parent.len() as u32).map(|i| anchored[self.root(i) as usize]).collect()
    }

    /// The number of the set that each index is in, in the order of their smallest indices, and how many sets there are.
    #[must_use]
    pub fn numbered(mut self) -> (Vec<u32>, usize) {
        let mut count = 0;
        let mut number = vec![0; self.parent.len()];
        for index in 0..number.len() as u32 {
            let root = self.root(index);
            number[index as usize] = if root == index { count } else { number[root as usize] };
            count += u32::from(root == index);
        }
        (number, count as usize)
    }
}
