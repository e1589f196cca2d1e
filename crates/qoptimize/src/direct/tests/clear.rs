//! What is clear of itself is not touched.

use crate::Exempt;
use crate::direct::clear::FreeProblem;
use crate::direct::rest::Rest;
use crate::direct::{DescentOptions, Objective, Wishes, embed, find_start, minimize};
use crate::qmesh::{Vec2, shapes};

/// Where the free boundary is clear of itself anyway, the map is that of the bare descent, bit for bit, and the report says that
/// nothing was needed.
#[test]
fn clear_boundaries_are_left_alone() {
    for mesh in [shapes::bump(8, 0.6), shapes::ramp(0.8, 30, 3), shapes::horseshoe(0.2, 0.3, 30, 4)] {
        let (objective, options) = (Objective::default(), DescentOptions::default());
        let exempt = Exempt::find(&mesh);
        let start = find_start(&mesh, &exempt, &()).unwrap().uv;
        let mut bare = start.clone();
        let mut descent = minimize(&mesh, &mut bare, &exempt, &objective, &options, &()).unwrap();
        let rest = Rest::new(&mesh, &exempt);
        let problem =
            FreeProblem { mesh: &mesh, rest: &rest, objective: &objective, options: &options, observer: &() };
        let mut uv: Vec<Vec2> = bare.to_vec();
        let before = descent.clone();
        assert_eq!(problem.clear(&start, &mut uv, &mut descent).unwrap(), None);
        assert!(descent == before && uv == bare.to_vec());
        let (_, report) = embed(&mesh, &objective, &Wishes::default(), &options, &()).unwrap();
        assert_eq!(report.boundary_repair, None);
    }
}
