//! Which island is placed first.

use std::cmp::Reverse;

use super::cover::Cover;

/// With more islands than this one order is enough: the last ones are small and fill what the others leave.
pub(super) const FEW: usize = 500;

/// What makes an island large.
#[derive(Clone, Copy)]
pub(super) enum Order {
    /// The longer side of its box, then its cells.
    Side,
    /// Its cells.
    Cells,
    /// Its height.
    Height,
    /// Its width.
    Width,
    /// Half the circumference of its box.
    Around,
}

/// The covers by one order, the largest first; ties by index.
pub(super) fn sorted(covers: &[Cover], order: Order) -> Vec<usize> {
    let mut places: Vec<usize> = (0..covers.len()).collect();
    places.sort_by_key(|&i| {
        let cover = &covers[i];
        let (width, height) = (cover.width() as usize, cover.height() as usize);
        let size = match order {
            Order::Side => width.max(height),
            Order::Cells => cover.cells(),
            Order::Height => height,
            Order::Width => width,
            Order::Around => width + height,
        };
        (Reverse(size), Reverse(cover.cells()), i)
    });
    places
}

/// The covers by each order, without repetitions; the first as in [`Order::Side`].
pub(super) fn all(covers: &[Cover]) -> Vec<Vec<usize>> {
    let mut orders: Vec<Vec<usize>> = Vec::new();
    for order in [Order::Side, Order::Cells, Order::Height, Order::Width, Order::Around] {
        let order = sorted(covers, order);
        if !orders.contains(&order) {
            orders.push(order);
        }
    }
    orders
}
