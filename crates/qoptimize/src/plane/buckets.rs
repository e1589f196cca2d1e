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
        // Two places ahead, so that the starts, moved on while items find their places, end up where they belong.
        let mut start = vec![0_u32; count + 2];
        for &key in keys {
            start[key as usize + 2] += 1;
        }
        for i in 2..count + 2 {
            start[i] += start[i - 1];
        }
        let mut items = vec![0; keys.len()];
        for (item, &key) in keys.iter().enumerate() {
            let place = &mut start[key as usize + 1];
            items[*place as usize] = item as u32;
            *place += 1;
        }
        start.pop();
        Self { start, items }
    }

    /// Sorts each bucket by `key` and hands `visit` every run of items with equal keys, which are in the order of their numbers. Buckets are
    /// visited in parallel, so many at a time; what is found there comes back in their order.
    pub(crate) fn runs<K: Ord, R: Default + Send>(
        mut self,
        key: impl Fn(u32) -> K + Sync,
        visit: impl Fn(&mut R, &[u32]) + Sync,
    ) -> Vec<R> {
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
        let work = |(starts, items): (&[u32], &mut [u32])| {
            let mut found = R::default();
            for range in starts.windows(2) {
                let bucket = &mut items[(range[0] - starts[0]) as usize..(range[1] - starts[0]) as usize];
                if bucket.len() > 1 {
                    bucket.sort_unstable_by_key(|&item| (key(item), item));
                }
                bucket.chunk_by(|&a, &b| key(a) == key(b)).for_each(|run| visit(&mut found, run));
            }
            found
        };
        tasks.into_par_iter().map(work).collect()
    }
}
