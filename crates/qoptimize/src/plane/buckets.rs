//! Items sorted into buckets by a small integer key: linear time, stable, and flat in memory.

use rayon::prelude::*;

/// The items `0..n`, grouped by key.
pub(crate) struct Buckets {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Buckets {
    /// A counting sort of the items by `keys`, all below `count`.
    pub(crate) fn new(keys: &[u32], count: usize) -> Self {
        let mut start = vec![0_u32; count + 1];
        for &key in keys {
            start[key as usize + 1] += 1;
        }
        for i in 0..count {
            start[i + 1] += start[i];
        }
        let mut next = start.clone();
        let mut items = vec![0; keys.len()];
        for (item, &key) in keys.iter().enumerate() {
            let place = &mut next[key as usize];
            items[*place as usize] = item as u32;
            *place += 1;
        }
        Self { start, items }
    }

    /// Sorts each bucket by `key`; equal items stay in the order of their numbers.
    pub(crate) fn sort_each<K: Ord>(&mut self, key: impl Fn(u32) -> K + Sync) {
        const BUCKETS_PER_TASK: usize = 1 << 14;
        let count = self.start.len() - 1;
        let mut tasks = Vec::with_capacity(count / BUCKETS_PER_TASK + 1);
        let mut rest = self.items.as_mut_slice();
        for low in (0..count).step_by(BUCKETS_PER_TASK) {
            let starts = &self.start[low..=(low + BUCKETS_PER_TASK).min(count)];
            let (here, after) = rest.split_at_mut((starts[starts.len() - 1] - starts[0]) as usize);
            rest = after;
            tasks.push((starts, here));
        }
        tasks.into_par_iter().for_each(|(starts, items)| {
            for range in starts.windows(2) {
                let bucket = &mut items[(range[0] - starts[0]) as usize..(range[1] - starts[0]) as usize];
                if bucket.len() > 1 {
                    bucket.sort_unstable_by_key(|&item| (key(item), item));
                }
            }
        });
    }

    /// The buckets that are not empty, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.start
            .windows(2)
            .filter(|range| range[0] < range[1])
            .map(|range| &self.items[range[0] as usize..range[1] as usize])
    }
}
