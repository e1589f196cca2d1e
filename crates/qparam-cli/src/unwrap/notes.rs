//! What is said of options that have no effect.

use crate::args::UnwrapArgs;
use crate::choices::{BoundaryChoice, MethodChoice, RuleChoice};

/// Options that were typed though nothing reads them.
pub(super) fn notes(arguments: &UnwrapArgs, typed: &[String]) -> Vec<String> {
    const PAPER_ONLY: &[&str] = &[
        "rule",
        "remove-fraction",
        "remove-below",
        "curvature",
        "area",
        "side",
        "exponent",
        "weights",
        "mixing",
        "no-overlap-removal",
        "lambda1",
        "lambda2",
        "order",
        "max-moves",
    ];
    const REMOVAL: &[&str] = &["remove-fraction", "remove-below", "curvature", "area", "side"];
    let method = arguments.map.method;
    let minimises = matches!(method, MethodChoice::Direct | MethodChoice::Conformal);
    let unread = |name: &str| {
        if name == "q" && method != MethodChoice::Paper && !minimises {
            return Some("only paper, direct and conformal read it");
        }
        if !minimises && ["shape", "angle-term", "max-steps", "relative-decrease"].contains(&name) {
            return Some("the method minimises no energy");
        }
        if method == MethodChoice::Conformal && ["shape", "angle-term"].contains(&name) {
            return Some("only direct reads it");
        }
        if minimises && ["backend", "residual-bound", "max-iterations"].contains(&name) {
            return Some("Newton systems have solvers of their own");
        }
        if method != MethodChoice::Paper && PAPER_ONLY.contains(&name) {
            return Some("the method is not `paper`");
        }
        let shape = !matches!(arguments.map.boundary, BoundaryChoice::Auto | BoundaryChoice::Free);
        if method == MethodChoice::Lscm && name == "boundary" && shape {
            return Some("the boundary of lscm is free");
        }
        if method == MethodChoice::Paper && arguments.map.rule == RuleChoice::None {
            return (REMOVAL.contains(&name) || ["q", "weights", "mixing"].contains(&name))
                .then_some("--rule none removes no vertex");
        }
        let overlaps = ["lambda1", "lambda2", "order", "max-moves"];
        (arguments.map.no_overlap_removal && overlaps.contains(&name))
            .then_some("overlaps are left as they are")
    };
    typed.iter().filter_map(|name| Some(format!("--{name} has no effect: {}", unread(name)?))).collect()
}
