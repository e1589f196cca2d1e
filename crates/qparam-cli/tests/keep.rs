//! `--keep-uv`: what is kept stays to the last digit, and the rest meets it.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use std::collections::HashMap;

use common::Folder;

const SIDE: usize = 8;

/// A bent sheet of 8 × 8 quads; those of the first `kept` columns are in the group `sleeve` and have UVs at `place`, the others none.
fn sheet(kept: usize, place: impl Fn(f64, f64) -> [f64; 2]) -> String {
    let mut text = String::new();
    for (row, column) in (0..=SIDE).flat_map(|row| (0..=SIDE).map(move |column| (row, column))) {
        let (x, y) = (column as f64, row as f64);
        let [u, v] = place(x, y);
        text += &format!("v {x} {y} {}\nvt {u} {v}\n", (0.5 * x).sin() + 0.3 * (0.7 * y).cos());
    }
    for is_kept in [true, false] {
        text += if is_kept { "g sleeve left\n" } else { "g rest\nusemtl cloth\n" };
        for (row, column) in (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column))) {
            let first = row * (SIDE + 1) + column + 1;
            let corners = [first, first + 1, first + SIDE + 2, first + SIDE + 1];
            let corner = |v: usize| if is_kept { format!(" {v}/{v}") } else { format!(" {v}") };
            if (column < kept) == is_kept {
                text += &format!("f{}\n", corners.map(corner).concat());
            }
        }
    }
    text
}

/// Vertex and UV of each corner, with the group of its face.
fn corners(text: &str) -> Vec<(String, usize, [f64; 2])> {
    let (mut group, mut table, mut found) = (String::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "g" => group = words[1..].join(" "),
            "vt" => table.push([words[1], words[2]].map(|x| x.parse::<f64>().unwrap())),
            "f" => found.extend(words[1..].iter().map(|corner| {
                let (vertex, uv) = corner.split_once('/').unwrap();
                (group.clone(), vertex.parse().unwrap(), table[uv.parse::<usize>().unwrap() - 1])
            })),
            _ => {}
        }
    }
    found
}

/// UVs that are kept are the same numbers; where the rest touches them it has the same UVs; all in one island, certified.
#[test]
fn kept_uvs_stay_and_the_rest_meets_them() {
    let flat = |x: f64, y: f64| [0.1 + 0.051 * x, 0.2 + 0.047 * y];
    let turned = |x: f64, y: f64| [0.7 - 0.06 * y + 0.01 * x, 0.1 + 0.055 * x];
    for (name, text) in [("as it lies", sheet(3, flat)), ("turned, bent and scaled", sheet(4, turned))] {
        for group in ["sleeve", "sleeve left"] {
            let folder = Folder::new();
            folder.write("in.obj", &text);
            let json = folder.qparam(&["unwrap", "in.obj", "--keep-uv", group, "--json"]).code(0).json();
            assert_eq!(json["islands"].as_array().unwrap().len(), 1, "{name}");
            let output = folder.read("in_uv.obj");
            let place = if name == "as it lies" { &flat as &dyn Fn(f64, f64) -> [f64; 2] } else { &turned };
            let mut at: HashMap<usize, [f64; 2]> = HashMap::new();
            for (group, vertex, uv) in corners(&output) {
                let (x, y) = ((vertex - 1) % (SIDE + 1), (vertex - 1) / (SIDE + 1));
                if group == "sleeve left" {
                    assert_eq!(uv, place(x as f64, y as f64), "{name}: vertex {vertex} stays");
                }
                assert_eq!(*at.entry(vertex).or_insert(uv), uv, "{name}: no seam at vertex {vertex}");
            }
        }
    }
}

/// Islands without kept UVs lie above those with, clear of them, at the same density.
#[test]
fn other_islands_lie_above() {
    let folder = Folder::new();
    let apart = "g patch\nv 20 0 0\nv 24 0 0\nv 24 3 0\nv 20 3 0\nf -4 -3 -2 -1\n";
    folder.write("in.obj", sheet(SIDE, |x, y| [0.1 * x, 0.1 * y]) + apart);
    folder.qparam(&["unwrap", "in.obj", "--keep-uv", "sleeve"]).code(0);
    let output = folder.read("in_uv.obj").replace("f -4/", "f 82/").replace(" -3/", " 83/");
    let output = output.replace(" -2/", " 84/").replace(" -1/", " 85/");
    let patch: Vec<[f64; 2]> =
        corners(&output).into_iter().filter(|corner| corner.0 == "patch").map(|corner| corner.2).collect();
    assert_eq!(patch.len(), 4);
    assert!(patch.iter().all(|uv| uv[1] > 0.8), "{patch:?}");
    let side = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    // The sheet is bent: a little longer than its UVs, and so are those of the patch at the mean density.
    let ratio = side(patch[0], patch[1]) / 4.0;
    assert!((0.085..0.1).contains(&ratio), "{ratio}");
    assert!((side(patch[1], patch[2]) / 3.0 / ratio - 1.0).abs() < 1e-6);
}

#[test]
fn mistakes_about_kept_uvs_are_named() {
    let good = sheet(3, |x, y| [0.1 * x, 0.1 * y]);
    let cases: [(&str, &str, &[&str], i32, &str); 7] = [
        (
            "an unknown group",
            &good,
            &["--keep-uv", "collar"],
            3,
            "no face is in a group, object or material `collar`",
        ),
        (
            "and which there are",
            &good,
            &["--keep-uv", "collar"],
            3,
            "groups: sleeve left, rest; materials: cloth",
        ),
        (
            "no UVs",
            &good,
            &["--keep-uv", "rest"],
            3,
            "40 faces of the faces to keep without UVs, first face 25 (line",
        ),
        (
            "a method that cannot",
            &good,
            &["--keep-uv", "sleeve", "--method", "paper"],
            2,
            "this method cannot hold UVs",
        ),
        ("further cuts", &good, &["--keep-uv", "sleeve", "--max-stretch", "2"], 2, "cannot be used with"),
        ("pins", &good, &["--keep-uv", "sleeve", "--pin", "1=0,0"], 2, "cannot be used with"),
        (
            "mirrored",
            &sheet(3, |x, y| [-0.1 * x, 0.1 * y]),
            &["--keep-uv", "sleeve"],
            5,
            "face 1 (line 164) cannot keep its UVs: it is turned over in the plane",
        ),
    ];
    for (name, text, more, code, expected) in cases {
        let folder = Folder::new();
        folder.write("in.obj", text);
        let run = folder.qparam(&[&["unwrap", "in.obj"], more].concat()).code(code);
        assert!(run.stderr.contains(expected), "{name}: {}", run.stderr);
        assert_eq!(folder.names(), ["in.obj"], "{name}");
    }
}
