//! Meshes as data: their polygons are stored, the connectivity is built again when they are loaded.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::Vec3;
use crate::mesh::QuadMesh;
use crate::polygons::Polygons;

/// Plain fields without tricks, so that formats that do not describe themselves can store a mesh too.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Stored {
    positions: Vec<Vec3>,
    face_start: Vec<u32>,
    corner_vertex: Vec<u32>,
    /// Nothing when the mesh uses all vertices of its source.
    source: Option<Source>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Source {
    vertices: Vec<u32>,
    vertex_count: usize,
}

impl Serialize for QuadMesh {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let vertex_count = self.source_vertex_count;
        Stored {
            positions: self.positions.to_vec(),
            face_start: self.face_start.clone(),
            corner_vertex: self.corner_vertex.clone(),
            source: self.source_vertex.clone().map(|vertices| Source { vertices, vertex_count }),
        }
        .serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for QuadMesh {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Stored { positions, face_start, corner_vertex, source } = Stored::deserialize(deserializer)?;
        let stored_count = positions.len();
        let polygons = Polygons { positions, face_start, corner_vertex };
        let mut mesh = Self::build(polygons).map_err(D::Error::custom)?;
        if let Some(source) = source {
            if !source.fits(stored_count) {
                return Err(D::Error::custom("the source vertices do not fit the vertices"));
            }
            let there = mesh.vertices().map(|v| source.vertices[mesh.source_vertex(v) as usize]).collect();
            mesh.source_vertex = Some(there);
            mesh.source_vertex_count = source.vertex_count;
        }
        Ok(mesh)
    }
}

impl Source {
    fn fits(&self, stored_count: usize) -> bool {
        // Several vertices of a chart may have the same source, and centres of filled holes come last.
        self.vertices.len() == stored_count
            && self.vertices.iter().all(|&source| (source as usize) < self.vertex_count)
    }
}
