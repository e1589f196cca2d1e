//! Odd surfaces: each gets UVs, what was mended is named, and `--strict` refuses exactly what was.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{CUBE, Folder, hill, without_uv};

/// What must come out.
struct Odd {
    name: &'static str,
    text: String,
    islands: usize,
    /// A part of what the report says was mended; nothing when nothing was.
    mended: &'static str,
}

fn odd(name: &'static str, text: impl Into<String>, islands: usize, mended: &'static str) -> Odd {
    Odd { name, text: text.into(), islands, mended }
}

/// Vertices on a twisted curve, so that no faces are of no area by chance, and faces given from 1.
fn faces(faces: &[&[usize]]) -> String {
    let count = faces.iter().flat_map(|face| face.iter()).max().unwrap();
    let mut text = String::new();
    for i in 0..*count {
        let t = i as f64;
        text += &format!(
            "v {:.4} {:.4} {:.4}\n",
            (2.4 * t).cos() * (1.0 + 0.1 * t),
            (2.4 * t).sin() * (1.0 + 0.1 * t),
            0.3 * t
        );
    }
    for face in faces {
        text += &format!("f {}\n", face.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "));
    }
    text
}

/// `columns × rows` cells; `place` says where a lattice point is, `index` which vertex it is.
fn lattice(
    (columns, rows): (usize, usize),
    vertices: usize,
    place: impl Fn(usize) -> [f64; 3],
    index: impl Fn(usize, usize) -> usize,
) -> String {
    let mut text = String::new();
    for [x, y, z] in (0..vertices).map(place) {
        text += &format!("v {x:.5} {y:.5} {z:.5}\n");
    }
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let corner = |i, j| index(i, j) + 1;
        text += &format!(
            "f {} {} {} {}\n",
            corner(i, j),
            corner(i + 1, j),
            corner(i + 1, j + 1),
            corner(i, j + 1)
        );
    }
    text
}

fn grid(columns: usize, rows: usize) -> String {
    let width = columns + 1;
    lattice(
        (columns, rows),
        width * (rows + 1),
        |v| [(v % width) as f64, (v / width) as f64, 0.0],
        |i, j| j * width + i,
    )
}

/// One face around a circle.
fn polygon(corners: usize) -> String {
    let mut text = String::new();
    for (sin, cos) in (0..corners).map(|i| turn(i, corners)) {
        text += &format!("v {cos:.9} {sin:.9} 0\n");
    }
    text + "f" + &(1..=corners).map(|vertex| format!(" {vertex}")).collect::<String>() + "\n"
}

fn turn(i: usize, of: usize) -> (f64, f64) {
    (std::f64::consts::TAU * i as f64 / of as f64).sin_cos()
}

fn tube(around: usize, rows: usize) -> String {
    let place = |v: usize| {
        let (sin, cos) = turn(v % around, around);
        [cos, (v / around) as f64 * 0.7, sin]
    };
    lattice((around, rows), around * (rows + 1), place, |i, j| j * around + i % around)
}

fn torus(around: usize, rows: usize, twisted: bool) -> String {
    let place = |v: usize| {
        let ((sin, cos), (up, out)) = (turn(v % around, around), turn(v / around, rows));
        [cos * (3.0 + out), up, sin * (3.0 + out)]
    };
    lattice((around, rows), around * rows, place, |i, j| {
        let i = if twisted && j == rows { around - i % around } else { i };
        (j % rows) * around + i % around
    })
}

fn moebius(length: usize, rows: usize) -> String {
    let width = rows + 1;
    let place = |v: usize| {
        let ((sin, cos), (half_sin, half_cos)) = (turn(v / width, length), turn(v / width, 2 * length));
        let across = (v % width) as f64 / rows as f64 - 0.5;
        [cos * (1.0 + across * half_cos), across * half_sin, sin * (1.0 + across * half_cos)]
    };
    lattice((rows, length), width * length, place, |i, j| if j == length { rows - i } else { j * width + i })
}

/// `text` with the vertices of the faces for which `of` holds in reverse.
fn turned(text: &str, of: impl Fn(usize) -> bool) -> String {
    let mut face = 0;
    let line = |line: &str| {
        let Some(corners) = line.strip_prefix("f ") else { return format!("{line}\n") };
        face += 1;
        let mut corners: Vec<&str> = corners.split(' ').collect();
        if of(face - 1) {
            corners.reverse();
        }
        format!("f {}\n", corners.join(" "))
    };
    text.lines().map(line).collect()
}

/// The meshes one after the other, each with its own vertices, moved apart.
fn beside(meshes: &[String]) -> String {
    let (mut text, mut before) = (String::new(), 0);
    for (place, mesh) in meshes.iter().enumerate() {
        for line in mesh.lines() {
            if let Some(rest) = line.strip_prefix("v ") {
                let at: Vec<f64> = rest.split(' ').map(|x| x.parse().unwrap()).collect();
                text += &format!("v {} {} {}\n", at[0] + 20.0 * place as f64, at[1], at[2]);
            } else if let Some(rest) = line.strip_prefix("f ") {
                let corners = rest.split(' ').map(|x| (x.parse::<usize>().unwrap() + before).to_string());
                text += &format!("f {}\n", corners.collect::<Vec<_>>().join(" "));
            }
        }
        before += mesh.lines().filter(|line| line.starts_with("v ")).count();
    }
    text
}

/// `text` without the faces of these numbers, from 0.
fn without(text: &str, missing: &[usize]) -> String {
    let mut face = 0;
    let keep = |line: &&str| {
        if !line.starts_with("f ") {
            return true;
        }
        face += 1;
        !missing.contains(&(face - 1))
    };
    text.lines().filter(keep).map(|line| format!("{line}\n")).collect()
}

fn cases() -> Vec<Odd> {
    const EDGE: &str = "in more than two faces";
    const FAN: &str = "where fans of faces touch";
    const FLIP: &str = "against the orientation around";
    const ONE_SIDED: &str = "one side only";
    const TWICE: &str = "on the vertices of another one";
    const REPEAT: &str = "with a vertex twice";
    vec![
        // One piece, nothing to mend.
        odd("one quad", grid(1, 1), 1, ""),
        odd("one triangle", faces(&[&[1, 2, 3]]), 1, ""),
        odd("a strip", grid(9, 1), 1, ""),
        odd("triangles and n-gons among quads", faces(&[&[1, 2, 3, 4], &[2, 5, 3], &[5, 6, 7, 8, 3]]), 1, ""),
        odd("unused vertices", grid(2, 2) + "v 9 9 9\nv 9 9 9\n", 1, ""),
        odd(
            "a vertex that nobody uses in front",
            format!("v 5 5 5\n{}", grid(2, 1).replace("f ", "f -0 ").replace("-0 ", "")),
            1,
            "",
        ),
        odd("a tube", tube(8, 3), 1, ""),
        odd("a hole", without(&grid(5, 5), &[12]), 1, ""),
        odd("nine holes", without(&grid(7, 7), &[8, 10, 12, 22, 24, 26, 36, 38, 40]), 1, ""),
        odd("a closed cube", CUBE, 1, ""),
        odd("a torus", torus(10, 6, false), 1, ""),
        odd("a torus with a hole", without(&torus(10, 6, false), &[7]), 1, ""),
        odd("a tetrahedron", faces(&[&[1, 2, 3], &[1, 4, 2], &[2, 4, 3], &[3, 4, 1]]), 1, ""),
        odd("a pyramid", faces(&[&[1, 2, 3, 4], &[2, 1, 5], &[3, 2, 5], &[4, 3, 5], &[1, 4, 5]]), 1, ""),
        odd("a doublet", faces(&[&[1, 2, 3, 4], &[1, 4, 3, 5], &[1, 5, 3, 6]]), 1, ""),
        odd(
            "a face of no area",
            without(&grid(3, 3), &[]).replace("v 1.00000 1.00000", "v 2.00000 1.00000"),
            1,
            "",
        ),
        odd("a concave quad", "v 0 0 0\nv 2 0 0\nv 0.4 0.4 0\nv 0 2 0\nf 1 2 3 4\n", 1, ""),
        odd(
            "a folded quad",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 3\nv 2 0 0\nv 2 1 1\nf 1 2 3 4\nf 2 5 6 3\n",
            1,
            "",
        ),
        odd("a polygon of 5,000 corners", polygon(5000), 1, ""),
        odd(
            "a face that goes round a square 2,000 times",
            grid(1, 1) + &format!("f{}\n", " 1 2 4 3".repeat(2000)),
            2,
            REPEAT,
        ),
        odd("inside out as a whole", turned(&hill(4), |_| true), 1, ""),
        // Several pieces.
        odd("two grids", beside(&[grid(2, 2), grid(3, 1)]), 2, ""),
        odd(
            "a grid, a cube, a tube, a torus",
            beside(&[grid(2, 2), CUBE.into(), tube(6, 2), torus(8, 5, false)]),
            4,
            "",
        ),
        odd(
            "two in one place",
            beside(&[grid(2, 2)])
                + &grid(2, 2)
                    .replace("f 1 2 5 4", "f 10 11 14 13")
                    .replace("f 2 3 6 5", "f 11 12 15 14")
                    .replace("f 4 5 8 7", "f 13 14 17 16")
                    .replace("f 5 6 9 8", "f 14 15 18 17"),
            2,
            "",
        ),
        odd("fifty quads", beside(&vec![grid(1, 1); 50]), 50, ""),
        odd(
            "a huge one beside a tiny one",
            beside(&[grid(3, 3), grid(2, 2).replace(".00000", "e-4")]),
            2,
            "",
        ),
        // Not manifold.
        odd("three pages of a book", faces(&[&[1, 2, 3, 4], &[2, 1, 5, 6], &[2, 1, 7, 8]]), 3, EDGE),
        odd(
            "five pages of a book",
            faces(&[&[1, 2, 3, 4], &[2, 1, 5, 6], &[2, 1, 7, 8], &[1, 2, 9, 10], &[1, 2, 11, 12]]),
            5,
            EDGE,
        ),
        odd("a fin on a grid", grid(3, 3) + "v 1 1 1\nv 2 1 1\nf 6 7 18 17\n", 2, EDGE),
        odd(
            "a wall across a grid",
            grid(3, 2) + "v 0 1 1\nv 1 1 1\nv 2 1 1\nv 3 1 1\nf 5 6 14 13\nf 6 7 15 14\nf 7 8 16 15\n",
            3,
            EDGE,
        ),
        odd(
            "two cubes at an edge",
            faces(&[
                &[1, 4, 3, 2],
                &[5, 6, 7, 8],
                &[1, 2, 6, 5],
                &[2, 3, 7, 6],
                &[3, 4, 8, 7],
                &[4, 1, 5, 8],
                &[3, 9, 10, 11],
                &[7, 13, 12, 14],
                &[3, 7, 14, 9],
                &[9, 14, 12, 10],
                &[10, 12, 13, 11],
                &[11, 13, 7, 3],
            ]),
            2,
            EDGE,
        ),
        odd("two fans at a vertex", faces(&[&[1, 2, 3, 4], &[3, 5, 6, 7]]), 2, FAN),
        odd("three fans at a vertex", faces(&[&[1, 2, 3, 4], &[3, 5, 6, 7], &[8, 9, 3]]), 3, FAN),
        odd(
            "two cubes at a vertex",
            beside(&[CUBE.into(), CUBE.into()])
                .replace("f 9 12 11 10", "f 7 12 11 10")
                .replace("f 9 10 14 13", "f 7 10 14 13")
                .replace("f 12 9 13 16", "f 12 7 13 16"),
            2,
            FAN,
        ),
        odd("a pinched boundary", without(&grid(3, 3), &[0, 4]), 1, FAN),
        odd("holes that touch", without(&grid(4, 4), &[5, 10]), 1, FAN),
        // Orientation.
        odd("one face turned over", turned(&grid(3, 3), |f| f == 4), 1, FLIP),
        odd("every other face turned over", turned(&grid(4, 4), |f| f % 2 == 0), 1, FLIP),
        odd("a cube with a side turned in", turned(CUBE, |f| f == 2), 1, FLIP),
        odd("a turned face at a hole", turned(&without(&grid(4, 4), &[5]), |f| f == 6), 1, FLIP),
        // One side only.
        odd("a Möbius strip", moebius(9, 1), 1, ONE_SIDED),
        odd("a wide Möbius strip", moebius(14, 4), 1, ONE_SIDED),
        odd("a Klein bottle", torus(12, 8, true), 1, ONE_SIDED),
        // The same face twice.
        odd("the same face twice", grid(1, 1) + "f 1 2 4 3\n", 2, TWICE),
        odd("both sides of a face", grid(1, 1) + "f 3 4 2 1\n", 2, TWICE),
        odd(
            "a leaf with two sides",
            grid(3, 2)
                + &turned(&grid(3, 2), |_| true)
                    .lines()
                    .filter(|l| l.starts_with('f'))
                    .map(|l| format!("{l}\n"))
                    .collect::<String>(),
            2,
            TWICE,
        ),
        odd("one face of many twice", grid(3, 3) + "f 6 7 11 10\n", 2, TWICE),
        // A vertex twice in a face.
        odd("a quad with a corner twice", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 2 3\n", 1, REPEAT),
        odd("a quad on two vertices", grid(2, 2) + "f 1 2 1 2\n", 2, REPEAT),
        odd("a quad on one vertex", grid(2, 2) + "f 5 5 5 5\n", 2, REPEAT),
        odd("a bow tie on one corner", faces(&[&[1, 2, 3, 1, 4, 5]]), 1, REPEAT),
        // Everything at once.
        odd(
            "everything at once",
            beside(&[
                grid(3, 3),
                moebius(9, 2),
                torus(8, 6, false),
                turned(&grid(2, 2), |f| f == 1),
                CUBE.into(),
            ]) + "f 6 7 11 10\nf 1 1 2 3\n",
            7,
            TWICE,
        ),
    ]
}

/// Vertices, faces and their order stay; every corner gets a UV; what was mended is named; `--strict` refuses just that.
#[test]
fn every_odd_surface_gets_uvs() {
    for Odd { name, text, islands, mended } in cases() {
        let folder = Folder::new();
        folder.write("in.obj", &text);
        let run = folder.qparam(&["unwrap", "in.obj", "--method", "direct", "--json"]);
        assert_eq!(run.code, 0, "{name}: {}", run.stderr);
        let report = run.json();
        let found = &report["distortion"];
        assert_eq!(report["islands"].as_array().unwrap().len(), islands, "{name}");
        assert_eq!(found["folded_faces"], 0, "{name}");
        assert_eq!(found["mirrored_islands"], 0, "{name}");
        let output = folder.read("in_uv.obj");
        assert_eq!(without_uv(&output), without_uv(&text), "{name}: only UVs are new");
        let bare =
            |line: &&str| line.starts_with("f ") && line[2..].split(' ').any(|corner| !corner.contains('/'));
        assert_eq!(output.lines().filter(bare).count(), 0, "{name}: every corner has a UV");
        if islands > 1 {
            let uv = output.lines().filter_map(|line| line.strip_prefix("vt "));
            let inside =
                |line: &str| line.split(' ').all(|x| (0.0..=1.0).contains(&x.parse::<f64>().unwrap()));
            assert!(uv.into_iter().all(inside), "{name}: in the unit square");
        }
        let said = folder.qparam(&["unwrap", "in.obj", "--method", "direct"]).stdout;
        assert!(said.contains(mended), "{name}: {said}");
        let strict = folder.qparam(&["unwrap", "in.obj", "--strict", "--quiet", "--method", "direct"]);
        if mended.is_empty() {
            assert_eq!(strict.code, 0, "{name}: {}", strict.stderr);
        } else {
            assert_eq!(strict.code, 4, "{name}");
            assert!(strict.stderr.contains(mended), "{name}: {}", strict.stderr);
        }
    }
}

/// Without automatic seams, what cannot be flattened is refused, saying what it is.
#[test]
fn closed_surfaces_need_seams() {
    for (text, what) in [
        (CUBE.to_owned(), "closed, a sphere"),
        (torus(8, 5, false), "closed, a torus"),
        (without(&torus(8, 5, false), &[3]), "one boundary loop and 1 handle"),
    ] {
        let folder = Folder::new();
        folder.write("in.obj", &text);
        let run = folder.qparam(&["unwrap", "in.obj", "--seams", "none"]).code(4);
        assert!(run.stderr.contains(what), "{}", run.stderr);
        assert_eq!(folder.names(), ["in.obj"]);
    }
}

/// Seams from a file, between groups and materials, at creases, and where UVs in the file have them.
#[test]
fn seams_can_be_given() {
    let islands = |text: &str, seams: &[&str], more: &[(&str, &str)]| {
        let folder = Folder::new();
        folder.write("in.obj", text);
        more.iter().for_each(|(name, content)| folder.write(name, content));
        let mut arguments = vec!["unwrap", "in.obj", "--json", "-o", "out.obj"];
        arguments.extend(seams.iter().flat_map(|source| ["--seams", source]));
        let report = folder.qparam(&arguments).json();
        (
            report["islands"].as_array().unwrap().len(),
            report["seams"]["edges"].as_u64().unwrap(),
            folder.read("out.obj"),
        )
    };
    let middle = "2 6 10 14 # a polyline\n\n3 7\n7,11\n11 15\n";
    assert_eq!(islands(&grid(3, 3), &["cut.txt"], &[("cut.txt", middle)]).0, 3);
    assert_eq!(islands(CUBE, &["angle:60"], &[]).0, 6);
    assert_eq!(islands(CUBE, &["angle:100"], &[]).0, 1);
    let named =
        grid(3, 1).replace("f 1 2 6 5", "g a\nusemtl x\nf 1 2 6 5").replace("f 2 3", "usemtl y\nf 2 3");
    let named = named.replace("f 3 4", "g b\nf 3 4");
    assert_eq!(islands(&named, &["material"], &[]).1, 1);
    assert_eq!(islands(&named, &["group"], &[]).0, 2);
    assert_eq!(islands(&named, &["group", "material"], &[]).0, 3, "a union");
    // What was cut once is cut there again.
    let (count, edges, output) = islands(CUBE, &["auto"], &[]);
    assert_eq!((count, islands(&output, &["uv"], &[]).1), (1, edges));
    assert_eq!(islands(&output, &["uv", "angle:60"], &[]).0, 6, "a union");
}

#[test]
fn mistakes_about_seams_are_named() {
    let folder = Folder::new();
    folder.write("in.obj", grid(2, 2));
    folder.write("bad.txt", "1 2\n2 x\n");
    folder.write("far.txt", "1 99\n");
    folder.write("one.txt", "1\n");
    folder.write("comma.txt", "1 2\n5,\n");
    folder.write("apart.txt", "1 2 3\n\n4 5 9\n");
    folder.write("same.txt", "1 1\n");
    for (source, code, expected) in [
        ("bad.txt", 3, "bad.txt:2: `x` is no vertex of the mesh, which has 9"),
        ("far.txt", 3, "far.txt:1: `99` is no vertex of the mesh, which has 9"),
        ("one.txt", 3, "one.txt:1: a seam needs two vertices at least"),
        ("comma.txt", 3, "comma.txt:2: a seam needs two vertices at least"),
        ("apart.txt", 3, "apart.txt:3: no edge of the mesh joins the vertices 5 and 9"),
        ("same.txt", 3, "same.txt:1: no edge of the mesh joins the vertices 1 and 1"),
        ("nowhere.txt", 3, "nowhere.txt could not be read"),
        ("uv", 3, "--seams uv, but not every corner has a UV"),
        ("angle:400", 2, "expected degrees between 0 and 180"),
    ] {
        let run = folder.qparam(&["unwrap", "in.obj", "--seams", source]).code(code);
        assert!(run.stderr.contains(expected), "{source}: {}", run.stderr);
    }
    let run = folder.qparam_with(&["unwrap", "-", "--seams", "-"], grid(2, 2).as_bytes()).code(2);
    assert!(run.stderr.contains("standard input cannot be read twice"), "{}", run.stderr);
}

/// The layout is in the unit square, at its true size, or at the density that was asked for.
#[test]
fn layouts_have_the_size_that_was_asked_for() {
    let report = |more: &[&str]| {
        let folder = Folder::new();
        folder.write("in.obj", beside(&[grid(4, 2), grid(1, 1), grid(2, 5)]));
        folder.qparam(&[&["unwrap", "in.obj", "--method", "direct", "--json"], more].concat()).code(0).json()
    };
    let areas = |json: &serde_json::Value| -> Vec<f64> {
        let islands = json["islands"].as_array().unwrap();
        islands.iter().map(|island| island["uv_area"].as_f64().unwrap()).collect()
    };
    let close = |found: f64, expected: f64| (found - expected).abs() < 1e-6 * expected;
    let equal = areas(&report(&[]));
    assert!(close(equal[0] / equal[1], 8.0) && close(equal[2] / equal[1], 10.0), "{equal:?}");
    let each = areas(&report(&["--density", "per-island"]));
    assert!(close(each[0], each[1]) && close(each[2], each[1]), "{each:?}");
    let texels = report(&["--density", "256", "--resolution", "1024"]);
    assert!(areas(&texels).iter().zip([8.0, 1.0, 10.0]).all(|(&found, area)| close(found, area / 16.0)));
    assert_eq!(texels["layout"]["fitted"], false);
    let true_size = areas(&report(&["--no-pack"]));
    assert!(true_size.iter().zip([8.0, 1.0, 10.0]).all(|(&found, area)| close(found, area)), "{true_size:?}");
}
