//! From space to the picture: where the camera stands, and a frame that fits by itself.

use std::fmt;
use std::str::FromStr;

use qoptimize::qmesh::{Vec2, Vec3};

/// Which axis of the file points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// The model looks along +z; what most OBJ files have.
    #[default]
    Y,
    /// The model looks along −y, as in Blender and in CAD.
    Z,
}

/// From where the model is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// The model looks into the camera.
    Front,
    /// From behind.
    Back,
    /// From the left side of the picture that `Front` gives.
    Left,
    /// From the right side of the picture that `Front` gives.
    Right,
    /// From above, the front towards the lower edge.
    Top,
    /// From below, the front towards the upper edge.
    Bottom,
    /// From the front, somewhat from the right and from above.
    ThreeQuarter,
    /// From the model to the camera, in the axes of the file; not zero.
    From(Vec3),
}

impl View {
    const NAMES: [(&'static str, Self); 7] = [
        ("front", Self::Front),
        ("back", Self::Back),
        ("left", Self::Left),
        ("right", Self::Right),
        ("top", Self::Top),
        ("bottom", Self::Bottom),
        ("three-quarter", Self::ThreeQuarter),
    ];

    /// From the model to the camera, and a direction that is upright in the picture.
    fn directions(self, up: UpAxis) -> [Vec3; 2] {
        // Right, up, front of the model in the axes of the file.
        let [right, above, front] = match up {
            UpAxis::Y => [Vec3::x(), Vec3::y(), Vec3::z()],
            UpAxis::Z => [Vec3::x(), Vec3::z(), -Vec3::y()],
        };
        match self {
            Self::Front => [front, above],
            Self::Back => [-front, above],
            Self::Left => [-right, above],
            Self::Right => [right, above],
            Self::Top => [above, -front],
            Self::Bottom => [-above, front],
            Self::ThreeQuarter => [front * 1.0 + right * 0.7 + above * 0.35, above],
            Self::From(towards) => {
                let towards = towards / towards.amax();
                let is_steep = towards.cross(&above).norm() < 1e-6 * towards.norm();
                [towards, if is_steep { -front } else { above }]
            }
        }
    }
}

impl FromStr for View {
    type Err = String;

    /// A name, or three numbers `X,Y,Z` from the model to the camera.
    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, view)) = Self::NAMES.iter().find(|(name, _)| *name == text) {
            return Ok(*view);
        }
        let numbers: Vec<f64> = text.split(',').filter_map(|number| number.trim().parse().ok()).collect();
        match *numbers.as_slice() {
            [x, y, z] if text.split(',').count() == 3 => {
                let towards = Vec3::new(x, y, z);
                let length = towards.amax();
                if length > 0.0 && towards.iter().all(|x| x.is_finite()) {
                    Ok(Self::From(towards))
                } else {
                    Err("the direction to the camera must be finite and not 0,0,0".into())
                }
            }
            _ => Err("expected front, back, left, right, top, bottom, three-quarter or X,Y,Z".into()),
        }
    }
}

impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match Self::NAMES.iter().find(|(_, view)| view == self) {
            Some((name, _)) => f.write_str(name),
            None => match self {
                Self::From(v) => write!(f, "{},{},{}", v.x, v.y, v.z),
                _ => Ok(()),
            },
        }
    }
}

/// How distance makes things smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Not at all.
    Orthographic,
    /// As for an eye; the narrower side of the picture spans this angle in degrees, between 1 and 120.
    Perspective(f64),
}

/// A vertex in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// In pixels from the upper left corner, `y` down.
    pub(super) place: Vec2,
    /// Larger is nearer; affine along straight lines of the picture.
    pub(super) nearness: f64,
    /// What attributes are divided by before they are affine in the picture: 1/depth, or 1 without perspective.
    pub(super) inverse_depth: f64,
}

/// A camera that has all of a model in its frame.
#[derive(Clone, Debug)]
pub(super) struct Camera {
    /// Right, up and back (from the model to the camera), orthonormal.
    pub(super) axes: [Vec3; 3],
    center: Vec2,
    /// Distance of the camera from the origin along `back`; without perspective 0.
    distance: f64,
    /// Pixels per unit of length (at depth 1).
    focal: f64,
    middle: Vec2,
    is_perspective: bool,
}

/// Space around the model, as a share of the picture's narrower side.
const MARGIN: f64 = 0.04;

impl Camera {
    /// Frames `positions`, whose size is near one, in a picture of this many pixels.
    pub(super) fn framing(
        positions: &[Vec3],
        view: View,
        up: UpAxis,
        projection: Projection,
        size: [usize; 2],
    ) -> Self {
        let [towards, upright] = view.directions(up);
        let back = towards.normalize();
        let right = upright.cross(&back).normalize();
        let axes = [right, back.cross(&right), back];
        let eye = positions.iter().map(|p| Vec3::from(axes.map(|axis| axis.dot(p))));
        let size = Vec2::new(size[0] as f64, size[1] as f64);
        let inner = size - Vec2::repeat(2.0 * MARGIN * size.min());
        let middle = size / 2.0;
        match projection {
            Projection::Orthographic => {
                let (low, high) = bounds(eye.map(|p| p.xy()));
                let extent = (high - low).map(|x| x.max(1e-9));
                let focal = (inner.x / extent.x).min(inner.y / extent.y);
                let center = (low + high) / 2.0;
                Self { axes, center, distance: 0.0, focal, middle, is_perspective: false }
            }
            Projection::Perspective(degrees) => {
                let focal = size.min() / 2.0 / (degrees.clamp(1.0, 120.0).to_radians() / 2.0).tan();
                // How far the frame reaches to each side at depth 1.
                let reach = inner / (2.0 * focal);
                // The frame's four sides are planes: each vertex is inside when x ± reach·z stays below a bound, so the
                // largest of each sum tells where the camera has to stand.
                let low =
                    eye.clone().map(|p| p.xy() - reach * p.z).fold(Vec2::repeat(f64::MAX), |a, b| a.inf(&b));
                let high =
                    eye.clone().map(|p| p.xy() + reach * p.z).fold(Vec2::repeat(f64::MIN), |a, b| a.sup(&b));
                let span = (high - low).component_div(&(reach * 2.0));
                let nearest = eye.map(|p| p.z).fold(f64::MIN, f64::max);
                // At least a tenth of the model's size away, or needles that point at the camera would pierce it.
                let distance = span.max().max(nearest + 0.1);
                let center = (high + low) / 2.0;
                Self { axes, center, distance, focal, middle, is_perspective: true }
            }
        }
    }

    /// Looks straight at the plane: `middle` of it is seen at pixel `center`, at so many pixels a unit.
    pub(super) fn flat(middle: Vec2, focal: f64, center: Vec2) -> Self {
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        Self { axes, center: middle, distance: 0.0, focal, middle: center, is_perspective: false }
    }

    /// Where a position is in the picture.
    pub(super) fn see(&self, position: &Vec3) -> Seen {
        let [x, y, z] = self.axes.map(|axis| axis.dot(position));
        let inverse_depth = if self.is_perspective { 1.0 / (self.distance - z) } else { 1.0 };
        let flat = (Vec2::new(x, y) - self.center) * (self.focal * inverse_depth);
        let nearness = if self.is_perspective { inverse_depth } else { z };
        Seen { place: self.middle + Vec2::new(flat.x, -flat.y), nearness, inverse_depth }
    }

    /// From a position to the camera, of length 1.
    pub(super) fn towards(&self, position: &Vec3) -> Vec3 {
        let [right, up, back] = self.axes;
        if !self.is_perspective {
            return back;
        }
        (right * self.center.x + up * self.center.y + back * self.distance - position).normalize()
    }
}

fn bounds(points: impl Iterator<Item = Vec2>) -> (Vec2, Vec2) {
    let start = (Vec2::repeat(f64::MAX), Vec2::repeat(f64::MIN));
    points.fold(start, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Vec<Vec3> {
        let side = |bit: usize| bit as f64 - 0.5;
        (0..8).map(|i| Vec3::new(side(i & 1), side(i >> 1 & 1), side(i >> 2))).collect()
    }

    /// Whatever the view: everything is in the frame, and something touches its margin.
    #[test]
    fn the_frame_fits() {
        let views: Vec<View> = View::NAMES.iter().map(|(_, view)| *view).collect();
        for view in [views, vec![View::From(Vec3::new(0.1, -3.0, 0.2))]].concat() {
            for projection in [Projection::Orthographic, Projection::Perspective(30.0)] {
                for up in [UpAxis::Y, UpAxis::Z] {
                    let camera = Camera::framing(&cube(), view, up, projection, [400, 300]);
                    let (low, high) = bounds(cube().iter().map(|p| camera.see(p).place));
                    let margin = MARGIN * 300.0 - 1e-9;
                    assert!(low.min() >= margin && high.x <= 400.0 - margin && high.y <= 300.0 - margin);
                    let fills_width = (high.x - low.x - 400.0 + 2.0 * MARGIN * 300.0).abs() < 1e-6;
                    let fills_height = (high.y - low.y - 300.0 + 2.0 * MARGIN * 300.0).abs() < 1e-6;
                    assert!(fills_width || fills_height, "{view} {projection:?}: {low} {high}");
                }
            }
        }
    }

    /// In front of the model its left and right are those of the picture, and nothing is mirrored in any view.
    #[test]
    fn no_view_is_mirrored() {
        for (_, view) in View::NAMES {
            for up in [UpAxis::Y, UpAxis::Z] {
                let [right, above, back] =
                    Camera::framing(&cube(), view, up, Projection::Orthographic, [100, 100]).axes;
                assert!((right.cross(&above) - back).norm() < 1e-12, "{view}");
            }
        }
        let front = Camera::framing(&cube(), View::Front, UpAxis::Y, Projection::Orthographic, [100, 100]);
        assert!(front.see(&Vec3::x()).place.x > 50.0 && front.see(&Vec3::y()).place.y < 50.0);
        assert!(front.see(&Vec3::z()).nearness > front.see(&-Vec3::z()).nearness);
    }

    #[test]
    fn views_are_named_or_given_as_directions() {
        for (name, view) in View::NAMES {
            assert_eq!((name.parse(), view.to_string()), (Ok(view), name.to_owned()));
        }
        assert_eq!("1,-2,0.5".parse(), Ok(View::From(Vec3::new(1.0, -2.0, 0.5))));
        for text in ["", "0,0,0", "1,2", "1,2,x", "1,2,3,x", "nan,0,1", "above"] {
            assert!(text.parse::<View>().is_err(), "{text}");
        }
    }
}
