//! Faces that run against their neighbours: the UVs of a file are judged as `unwrap` judges its own, with these faces turned over.

use qoptimize::atlas::consistent;
use qoptimize::qmesh::{PolygonView, Polygons, Vec2};
use qoptimize::{Certificate, MeasureError, certify};

use crate::table::counted;

/// The polygons of a file with their UVs, as they are judged.
pub(crate) enum Judged<'a> {
    /// As the file has them.
    AsGiven(PolygonView<'a>, &'a [Vec2]),
    /// With some faces turned over.
    Turned(Polygons, Vec<Vec2>, Vec<u32>),
}

impl<'a> Judged<'a> {
    /// Certifies the UVs: as they are, and where that fails and faces run against their neighbours, with these turned over.
    pub(crate) fn certify(
        polygons: PolygonView<'a>,
        uv: &'a [Vec2],
        limit: usize,
    ) -> Result<(Self, Certificate), MeasureError> {
        let given = certify(polygons, uv, limit)?;
        if !given.holds
            && let Ok((turned, turned_uv, faces)) = consistent(polygons, uv)
            && !faces.is_empty()
        {
            let certificate = certify(turned.view(), &turned_uv, limit)?;
            return Ok((Self::Turned(turned, turned_uv, faces), certificate));
        }
        Ok((Self::AsGiven(polygons, uv), given))
    }

    pub(crate) fn view(&self) -> PolygonView<'_> {
        match self {
            Self::AsGiven(polygons, _) => *polygons,
            Self::Turned(polygons, ..) => polygons.view(),
        }
    }

    pub(crate) fn uv(&self) -> &[Vec2] {
        match self {
            Self::AsGiven(_, uv) => uv,
            Self::Turned(_, uv, _) => uv,
        }
    }

    /// The faces that were turned over, ascending.
    pub(crate) fn turned_faces(self) -> Vec<u32> {
        match self {
            Self::AsGiven(..) => Vec::new(),
            Self::Turned(_, _, faces) => faces,
        }
    }
}

/// What to tell people about turned faces, if there are any.
pub(crate) fn note(turned: &[u32]) -> Option<String> {
    let first = turned.first()?;
    let others = if turned.len() > 1 { " and others" } else { "" };
    Some(format!(
        "{} against the orientation around: turned over for this (face {}{others})",
        counted(turned.len(), "face"),
        first + 1
    ))
}
