//! Which line each element came from, stored as runs: in most files one entry is enough.

/// Elements that stand on consecutive lines share an entry.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LineRuns {
    /// First element of a run, and its line.
    runs: Vec<(u32, u64)>,
}

impl LineRuns {
    /// Notes the line of element `index`; elements come in order.
    #[inline]
    pub(super) fn push(&mut self, index: u32, line: u64) {
        match self.runs.last() {
            Some(&(first, start)) if start + u64::from(index - first) == line => {}
            _ => self.runs.push((index, line)),
        }
    }

    /// The line of element `index`, which was pushed.
    pub(super) fn line(&self, index: u32) -> u64 {
        match self.runs.partition_point(|&(first, _)| first <= index).checked_sub(1) {
            Some(run) => self.runs[run].1 + u64::from(index - self.runs[run].0),
            None => 0,
        }
    }

    /// Appends the runs of a part: its elements follow `elements` others, its lines `lines` others.
    pub(super) fn append(&mut self, part: &Self, elements: u32, lines: u64) {
        for &(first, line) in &part.runs {
            self.push(first + elements, line + lines);
        }
    }

    pub(super) fn shrink_to_fit(&mut self) {
        self.runs.shrink_to_fit();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_answer_like_a_full_list() {
        let lines = [3, 4, 5, 9, 10, 12, 14, 15, 16, 17, 40];
        let mut runs = LineRuns::default();
        for (index, &line) in lines.iter().enumerate() {
            runs.push(index as u32, line);
        }
        assert_eq!(runs.runs.len(), 5);
        for (index, &line) in lines.iter().enumerate() {
            assert_eq!(runs.line(index as u32), line);
        }
    }
}
