//! The words of the command line for the choices of the libraries.

use clap::ValueEnum;
use qoptimize::qcurv::VertexArea;
use qoptimize::qembed::{Mixing, Weights};
use qoptimize::qmesh::obj::UvPrecision;
use qoptimize::qsimplify::{CurvatureMeasure, RemovalRule, RemovedSide};
use qoptimize::qsolve::Backend;
use qoptimize::{AngleTerm, Method, MoveOrder, Preset};

/// Mirrors a library enum with help texts for its values.
macro_rules! choices {
    ($($name:ident => $target:ident { $($(#[$doc:meta])* $variant:ident),+ $(,)? })+) => {$(
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        pub(crate) enum $name { $($(#[$doc])* $variant),+ }

        impl From<$name> for $target {
            fn from(choice: $name) -> Self {
                match choice { $($name::$variant => Self::$variant),+ }
            }
        }
    )+};
}

choices! {
    MethodChoice => Method {
        /// Angle and area errors themselves, minimised over maps that cannot fold, with a free boundary
        Direct,
        /// The paper's stages: simplify, embed, bring the removed vertices back, remove overlaps
        Paper,
        /// Angle and area energies of the classical family, minimised in the same way
        Conformal,
        /// Tutte 1963: every edge pulls alike
        Uniform,
        /// Floater 2003: mean value weights
        MeanValue,
        /// Eck et al. 1995: cotangent weights
        Harmonic,
        /// Lévy et al. 2002: least squares conformal, free boundary
        Lscm,
    }
    PresetChoice => Preset {
        /// The default: angles, areas and stretch alike (q 0.6, shape 1)
        Balanced,
        /// Angles above all (method conformal, q 1)
        Conformal,
        /// As rigid as possible (q 0.95, shape 1)
        ArapLike,
        /// One texel density everywhere (q 0.5, shape 0.5)
        EvenTexels,
        /// Least symmetric Dirichlet energy: cloth, peeling, remeshing (q 0.5, shape 10)
        LeastStretch,
        /// Eqs. 13 and 14 themselves: coarse meshes only (q 0.5, shape 0.1, angle term paper)
        PaperErrors,
    }
    RuleChoice => RemovalRule {
        /// Remove only while the graph stays 3-connected
        Guarded,
        /// Remove, then join the neighbours in a ring
        Ring,
        /// Embed the full graph, keep the positions of the kept vertices only
        Carrier,
        /// Remove as the paper prints it, guarding nothing
        Naive,
        /// Remove every interior vertex
        All,
        /// Remove nothing (q has no effect)
        None,
    }
    MeasureChoice => CurvatureMeasure {
        /// |K| of Eq. 2, times total area / 4π: free of units
        Normalized,
        /// |K̄| of Eq. 1
        Integrated,
    }
    AreaChoice => VertexArea {
        /// The Voronoi cell of the vertex (Eqs. 3 and 4, corrected)
        Voronoi,
        /// The sum of the adjacent faces' areas, as the text under Eq. 2 says
        FaceSum,
    }
    SideChoice => RemovedSide {
        /// Low curvature goes, as the paper's text says
        Low,
        /// High curvature goes, as step 3 of section 2.1 is printed
        High,
    }
    WeightsChoice => Weights {
        /// Star angles with the printed quarter and half: always positive
        Star4,
        /// Star angles, plain cotangents: exact on flat meshes, may be negative
        Star1,
        /// Quad-corner angles as printed
        Printed,
    }
    MixingChoice => Mixing {
        /// Each family divided by its sum at the vertex: free of units
        RowNormalized,
        /// Added as printed: depends on the unit of length
        Raw,
    }
    OrderChoice => MoveOrder {
        /// Largest σ of Eq. 12 first
        WorstFirst,
        /// In the order in which they were found
        FirstCome,
    }
    AngleChoice => AngleTerm {
        /// log²(θ/φ): well-posed on fine meshes
        Log,
        /// (θ/φ − 1)², Eq. 13 itself: for coarse meshes
        Paper,
    }
    PrecisionChoice => UvPrecision {
        /// Every digit of double precision
        #[value(name = "f64")]
        Double,
        /// Rounded to single precision, as engines read them, mended where that turns faces over, and certified as rounded
        #[value(name = "f32")]
        Single,
    }
    BackendChoice => Backend {
        /// Direct for systems of moderate size, multigrid or iterative above
        Auto,
        /// Sparse factorization
        Direct,
        /// Krylov iterations
        Iterative,
        /// Krylov iterations with a multigrid preconditioner
        Multigrid,
    }
}

impl PresetChoice {
    /// The options that it sets, and their values as one would type them.
    pub(crate) fn arguments(self) -> [(&'static str, String); 4] {
        let preset = Preset::from(self);
        let method = if preset.method() == Method::Conformal { "conformal" } else { "direct" };
        let angle_term = if preset.angle_term() == AngleTerm::Paper { "paper" } else { "log" };
        [
            ("method", method.to_owned()),
            ("q", preset.q().to_string()),
            ("shape", preset.shape().to_string()),
            ("angle-term", angle_term.to_owned()),
        ]
    }
}

/// Where the boundary goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BoundaryChoice {
    /// Free for direct, conformal and lscm, the circle for the others
    Auto,
    /// Wherever the energy is least, clear of itself (direct, conformal, lscm)
    Free,
    /// The unit circle, by arc length
    Circle,
    /// The unit square
    Square,
    /// The best-fit plane; refused when the boundary folds there
    Projection,
    /// The positions in the file of --boundary-uv
    Fixed,
}
