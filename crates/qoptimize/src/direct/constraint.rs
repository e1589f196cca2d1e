//! What a step may not do besides flipping corners: move held vertices, or break a mirror symmetry.

use crate::qmesh::Vec2;

use super::hessian::Hessian;

/// Which directions are open to the descent. The default leaves all open.
#[derive(Clone, Debug, Default)]
pub(super) struct Constraint {
    /// Per vertex, whether it stays where it is. Empty: none does.
    pub(super) held: Vec<bool>,
    /// Per vertex of the mesh, its partner in the mirror `x ↦ −x`; a vertex on the axis is its own. Further vertices have none.
    pub(super) mirror: Vec<u32>,
}

impl Constraint {
    /// Whether there is none.
    pub(super) fn is_open(&self) -> bool {
        self.held.is_empty() && self.mirror.is_empty()
    }

    /// Takes the held vertices out of the Newton system.
    pub(super) fn restrict(&self, hessian: &mut Hessian, gradient: Vec<f64>) -> Vec<f64> {
        if self.held.is_empty() { gradient } else { hessian.fix(&self.held, gradient) }
    }

    /// Makes `direction` one that is open, to the bit; returns the Newton decrement `−g·d` along it.
    pub(super) fn project(&self, direction: &mut [Vec2], gradient: &[f64], decrement: f64) -> f64 {
        if self.is_open() {
            return decrement;
        }
        for (d, _) in direction.iter_mut().zip(&self.held).filter(|(_, held)| **held) {
            *d = Vec2::zeros();
        }
        self.reflect(direction);
        direction.iter().zip(gradient.chunks_exact(2)).map(|(d, g)| -(d.x * g[0] + d.y * g[1])).sum()
    }

    /// Replaces `values` by the mean of themselves and their mirror image, which is its own mirror image to the bit.
    pub(super) fn reflect(&self, values: &mut [Vec2]) {
        for (v, &partner) in self.mirror.iter().enumerate() {
            let w = partner as usize;
            if w >= v {
                let (a, b) = (values[v], values[w]);
                let mean = Vec2::new(0.5 * (a.x - b.x), 0.5 * (a.y + b.y));
                values[v] = mean;
                values[w] = Vec2::new(-mean.x, mean.y);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is projected is its own mirror image, held vertices stay, and the decrement is that of what is left.
    #[test]
    fn projected_directions_are_open() {
        let constraint = Constraint { held: vec![false, false, false, true], mirror: vec![1, 0, 2] };
        let mut d = vec![Vec2::new(1.0, 2.0), Vec2::new(0.3, 0.1), Vec2::new(5.0, 1.0), Vec2::new(1.0, 1.0)];
        let gradient = [1.0, 0.0, 0.0, 1.0, 0.0, 2.0, 7.0, 7.0];
        let decrement = constraint.project(&mut d, &gradient, f64::NAN);
        assert_eq!((d[0].x, d[0].y), (-d[1].x, d[1].y));
        assert_eq!((d[2].x, d[2].y, d[3]), (0.0, 1.0, Vec2::zeros()));
        assert_eq!(decrement, -(0.35 + 1.05 + 2.0));
        let before = d.clone();
        constraint.reflect(&mut d);
        assert_eq!(d, before, "projecting twice changes nothing");
    }

    #[test]
    fn without_constraints_nothing_is_touched() {
        let mut d = vec![Vec2::new(1.0, 2.0)];
        assert_eq!(Constraint::default().project(&mut d, &[1.0, 1.0], 0.25), 0.25);
        assert_eq!(d, [Vec2::new(1.0, 2.0)]);
    }
}
