//! How one polygon meets the faces around it.

/// Counts the vertices and edges that each face shares with one polygon.
///
/// Two simple polygons that share `v` vertices and `e` edges meet in `v − e` pieces, each a vertex or a path (in none
/// when they are equal all around), so one look at the numbers tells whether a face is met properly.
pub(crate) struct Meetings {
    round: u32,
    counts: Vec<Count>,
    met: Vec<u32>,
}

#[derive(Clone, Copy, Default)]
struct Count {
    round: u32,
    vertices: u32,
    edges: u32,
}

impl Meetings {
    pub(crate) fn new(face_count: usize) -> Self {
        Self { round: 0, counts: vec![Count::default(); face_count], met: Vec::new() }
    }

    /// Forgets everything, for the next polygon among faces with indices below `face_count`.
    pub(crate) fn begin(&mut self, face_count: usize) {
        self.round += 1;
        self.met.clear();
        if self.counts.len() < face_count {
            self.counts.resize(face_count, Count::default());
        }
    }

    pub(crate) fn vertex(&mut self, face: u32) {
        self.count(face).vertices += 1;
    }

    pub(crate) fn edge(&mut self, face: u32) {
        self.count(face).edges += 1;
    }

    /// Whether every face that was met shares one vertex or one path.
    pub(crate) fn all_in_one_piece(&self) -> bool {
        self.met
            .iter()
            .map(|&face| &self.counts[face as usize])
            .all(|count| count.vertices == count.edges + 1)
    }

    fn count(&mut self, face: u32) -> &mut Count {
        let count = &mut self.counts[face as usize];
        if count.round != self.round {
            *count = Count { round: self.round, vertices: 0, edges: 0 };
            self.met.push(face);
        }
        count
    }
}

/// A set of indices that is emptied in no time.
pub(crate) struct Marks {
    round: u32,
    marks: Vec<u32>,
}

impl Marks {
    pub(crate) fn new(count: usize) -> Self {
        Self { round: 0, marks: vec![0; count] }
    }

    pub(crate) fn begin(&mut self, count: usize) {
        self.round += 1;
        if self.marks.len() < count {
            self.marks.resize(count, 0);
        }
    }

    /// Marks `index` and says whether it was not marked before.
    pub(crate) fn insert(&mut self, index: u32) -> bool {
        std::mem::replace(&mut self.marks[index as usize], self.round) != self.round
    }

    pub(crate) fn contains(&self, index: u32) -> bool {
        self.marks[index as usize] == self.round
    }
}
