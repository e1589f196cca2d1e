//! Rows by degree, the smallest first.

/// Stands for no row.
const NONE: u32 = u32::MAX;
/// Rows of this degree and above wait together.
const LARGEST: usize = 255;

/// Doubly linked lists of rows, one for each degree.
#[derive(Debug)]
pub(super) struct Queue {
    heads: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// The list that a row is in; [`u32::MAX`] when it has been taken out.
    list: Vec<u32>,
    /// No list before this one has a row.
    first: usize,
}

impl Queue {
    pub(super) fn new(degrees: &[u32]) -> Self {
        let mut queue = Self {
            heads: vec![NONE; LARGEST + 1],
            next: vec![NONE; degrees.len()],
            previous: vec![NONE; degrees.len()],
            list: vec![NONE; degrees.len()],
            first: 0,
        };
        // The last row comes first in its list, so that rows leave in their order.
        for (row, &degree) in degrees.iter().enumerate().rev() {
            queue.insert(row as u32, degree);
        }
        queue
    }

    /// A row of the smallest degree.
    pub(super) fn pop(&mut self) -> Option<u32> {
        while self.first < self.heads.len() {
            let row = self.heads[self.first];
            if row != NONE {
                self.remove(row);
                self.list[row as usize] = NONE;
                return Some(row);
            }
            self.first += 1;
        }
        None
    }

    /// Moves a row to the list of its new degree; rows that were taken out, or never were in, stay out.
    pub(super) fn change(&mut self, row: u32, degree: u32) {
        let Some(&list) = self.list.get(row as usize) else { return };
        if list != NONE && list as usize != (degree as usize).min(LARGEST) {
            self.remove(row);
            self.insert(row, degree);
        }
    }

    fn insert(&mut self, row: u32, degree: u32) {
        let list = (degree as usize).min(LARGEST);
        let head = std::mem::replace(&mut self.heads[list], row);
        self.next[row as usize] = head;
        self.previous[row as usize] = NONE;
        if head != NONE {
            self.previous[head as usize] = row;
        }
        self.list[row as usize] = list as u32;
        self.first = self.first.min(list);
    }

    fn remove(&mut self, row: u32) {
        let (next, previous) = (self.next[row as usize], self.previous[row as usize]);
        match previous {
            NONE => self.heads[self.list[row as usize] as usize] = next,
            previous => self.next[previous as usize] = next,
        }
        if next != NONE {
            self.previous[next as usize] = previous;
        }
    }
}
