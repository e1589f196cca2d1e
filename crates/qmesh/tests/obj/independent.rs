//! `tobj`, a reader by others, agrees on faces and UVs wherever it can read a file at all.

use qmesh::obj::{ObjDocument, write_obj};
use qmesh::{Vec2, Vec3, shapes};

use crate::trimmings::some_uv;

type Corner = (Vec3, Option<Vec2>);

/// The faces of a file, each as its corners' positions and UVs.
fn faces_by_tobj(text: &[u8]) -> Vec<Vec<Corner>> {
    let options = tobj::LoadOptions { triangulate: false, single_index: false, ..Default::default() };
    let no_materials = |_: &std::path::Path| Ok((Vec::new(), Default::default()));
    let (models, _) = tobj::load_obj_buf(&mut &text[..], &options, no_materials).expect("readable by tobj");
    let mut faces = Vec::new();
    for mesh in models.into_iter().map(|model| model.mesh) {
        let corner = |i: usize| {
            let v = 3 * mesh.indices[i] as usize;
            let position = Vec3::new(mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]);
            let uv = mesh.texcoord_indices.get(i).map(|&t| 2 * t as usize);
            (position, uv.map(|t| Vec2::new(mesh.texcoords[t], mesh.texcoords[t + 1])))
        };
        let count = mesh.indices.len();
        let arities =
            if mesh.face_arities.is_empty() { vec![3; count / 3] } else { mesh.face_arities.clone() };
        let mut start = 0;
        for arity in arities {
            faces.push((start..start + arity as usize).map(corner).collect());
            start += arity as usize;
        }
    }
    faces
}

fn faces_by_us(text: &[u8]) -> Vec<Vec<Corner>> {
    let document = ObjDocument::parse(text.to_vec()).expect("readable by us");
    let view = document.view();
    let corner = |c: usize| {
        let uv = document.corner_texture(c).map(|texture| document.texture_coordinates()[texture as usize]);
        (view.positions[view.corner_vertex[c] as usize], uv)
    };
    (0..view.face_count()).map(|face| view.corners(face).map(corner).collect()).collect()
}

pub(crate) fn assert_same_faces(name: &str, text: &[u8]) {
    let (ours, theirs) = (faces_by_us(text), faces_by_tobj(text));
    assert_eq!(ours.len(), theirs.len(), "{name}: number of faces");
    for (face, (ours, theirs)) in ours.iter().zip(&theirs).enumerate() {
        assert_eq!(ours, theirs, "{name}: face {face}");
    }
}

#[test]
fn two_readers_agree_on_meshes_from_formulas() {
    for (name, mesh) in
        [("grid", shapes::grid(7, 4)), ("torus", shapes::torus(6, 5)), ("cap", shapes::cap(4, 1.0))]
    {
        let mut plain = Vec::new();
        write_obj(&mut plain, mesh.view(), None).expect("writing to memory");
        assert_same_faces(name, &plain);

        let uv = some_uv(mesh.corner_count(), 3);
        let mut with_uv = Vec::new();
        write_obj(&mut with_uv, mesh.view(), Some(&uv)).expect("writing to memory");
        assert_same_faces(name, &with_uv);

        let mut rewritten = Vec::new();
        let document = ObjDocument::parse(plain).expect("readable by us");
        document.write_with_uv(&mut rewritten, &uv).expect("writing to memory");
        assert_same_faces(name, &rewritten);
        assert_eq!(faces_by_us(&rewritten), faces_by_us(&with_uv), "{name}");
        assert_eq!(rewritten, with_uv, "{name}: both writers say the same in the same words");
    }
}

#[test]
fn two_readers_agree_on_corner_forms() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 -1.5e-3\nvn 0 0 1\n";
    let with_uv = format!("{vertices}vt 0 0\nvt 1 0.1\n");
    // tobj wants one form in a group, and no `vt` in a file that does not use them: every face stands alone.
    for (elements, face) in [
        (&with_uv[..], "f 1/1 2/2 3/1 4/2"),
        (&with_uv, "f -4/-2/-1 -3/-1/-1 -2/1/1"),
        (vertices, "f 1//1 2//1 3//1"),
        (vertices, "f 4 3 2 1"),
    ] {
        assert_same_faces(face, format!("{elements}{face}\n").as_bytes());
    }
}
