//! `fixtures/`: quad meshes from formulas as OBJ files, written byte for byte the same on every machine.
//!
//! Coordinates are rounded to six decimals. Every file opens with the call and the formula that made it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use qparam_cli::qmesh::{FaceId, QuadMesh, Vec3, shapes};

/// One mesh, and what the files say about it.
struct Fixture {
    name: &'static str,
    call: &'static str,
    formula: &'static str,
    mesh: QuadMesh,
    /// The OBJ group of a face around this point; the faces of a group are written together, in the order of this list.
    groups: &'static [&'static str],
    group: fn(Vec3) -> usize,
}

/// A mesh in one group that is named like its file.
macro_rules! fixture {
    ($name:ident, $formula:literal, $mesh:expr) => {
        Fixture {
            name: stringify!($name),
            call: stringify!($mesh),
            formula: $formula,
            mesh: $mesh,
            groups: &[stringify!($name)],
            group: |_| 0,
        }
    };
}

fn fixtures() -> Result<Vec<Fixture>, String> {
    use shapes::*;
    let two_components = disjoint_union(&bump(12, 0.5), &cap(3, 1.2)).map_err(|error| error.to_string())?;
    Ok(vec![
        fixture!(grid, "unit squares in the plane z = 0", grid(8, 6)),
        fixture!(jittered, "the grid, its inner vertices moved at random", jittered_grid(12, 9, 0.2, 1)),
        fixture!(graded, "a flat grid, each row and column 1.25 times the last", graded_grid(12, 9, 1.25)),
        fixture!(disk, "a flat unit disk: a square block inside rings", disk(5)),
        fixture!(bump, "z = 0.5 exp(-(x^2 + y^2) / (2 * 0.3^2))", bump(20, 0.5)),
        fixture!(
            nose,
            "z = 0.9 exp(-(x / 0.15)^2 / 2) exp(-(y / w)^2 / 2), w = 0.45 where y > 0, else 0.12",
            nose(24)
        ),
        fixture!(saddle, "z = (x^2 - y^2) / 2", saddle(16)),
        fixture!(cap, "the unit sphere, up to 2.6 radians from its pole", cap(5, 2.6)),
        fixture!(cylinder_strip, "a rectangle rolled up by 4.5 radians", cylinder_strip(24, 12, 4.5)),
        fixture!(finger, "a tube of radius 1 with a hemisphere at its end", finger(2, 30)),
        Fixture {
            groups: &["forehead", "eyes", "nose", "mouth", "cheeks"],
            group: face_group,
            ..fixture!(face, "ellipsoids and capsules, melted together", face(3))
        },
        Fixture {
            groups: &["skull", "face", "ears", "neck"],
            group: head_group,
            ..fixture!(head, "ellipsoids and capsules, melted together", head(2))
        },
        fixture!(cylinder, "radius 1, height 2", cylinder(24, 8)),
        fixture!(torus, "radii 1 and 0.4", torus(24, 12)),
        fixture!(sphere, "the unit sphere, a cube blown up", sphere(8)),
        Fixture {
            call: "disjoint_union(&bump(12, 0.5), &cap(3, 1.2))",
            ..fixture!(two_components, "a bump and a cap, side by side", two_components)
        },
    ])
}

fn face_group(p: Vec3) -> usize {
    let off = p.x.abs();
    match p.y {
        y if y > 0.16 => 0,
        y if y > -0.13 && (0.12..0.5).contains(&off) => 1,
        y if y > -0.54 && off < 0.19 => 2,
        y if (-0.86..-0.6).contains(&y) && off < 0.3 => 3,
        _ => 4,
    }
}

fn head_group(p: Vec3) -> usize {
    match p {
        _ if p.y < -1.16 || (p.y < -0.5 && p.z < 0.04 - 0.5 * (p.y + 0.5)) => 3,
        _ if p.x.abs() > 0.64 && (-0.45..0.18).contains(&p.y) && p.z.abs() < 0.35 => 2,
        _ if p.z > 0.25 && p.y < 0.35 => 1,
        _ => 0,
    }
}

/// Writes the fixtures, or compares them with what is there (`--check`).
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err("the only argument is --check".to_owned()),
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("fixtures");
    let files = files(&fixtures()?)?;
    let surplus = surplus(&folder, &files).map_err(|error| format!("fixtures/: {error}"))?;
    if check { compare(&folder, &files, &surplus) } else { write(&folder, &files, &surplus) }
}

/// Names and contents of all files.
fn files(fixtures: &[Fixture]) -> Result<Vec<(String, String)>, String> {
    let mut files: Vec<(String, String)> = Vec::new();
    for fixture in fixtures {
        files.push((format!("{}.obj", fixture.name), obj(fixture)?));
    }
    files.push(("README.md".to_owned(), readme(fixtures)));
    // Line ends are part of the bytes that are compared.
    files.push((".gitattributes".to_owned(), "* -text\n".to_owned()));
    Ok(files)
}

/// Files in the folder that no formula makes any more.
fn surplus(folder: &Path, files: &[(String, String)]) -> io::Result<Vec<PathBuf>> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries?,
    };
    let mut surplus = Vec::new();
    for entry in entries {
        let entry = entry?;
        let name = entry.file_name();
        // The tables of `cargo xtask sweep`.
        if name == "tables" {
            continue;
        }
        if !files.iter().any(|(known, _)| name.to_str() == Some(known)) {
            surplus.push(entry.path());
        }
    }
    surplus.sort();
    Ok(surplus)
}

fn compare(folder: &Path, files: &[(String, String)], surplus: &[PathBuf]) -> Result<(), String> {
    let mut complaints = Vec::new();
    for (name, expected) in files {
        match fs::read(folder.join(name)) {
            Ok(found) if found == expected.as_bytes() => {}
            Ok(found) => {
                let line = 1 + found
                    .split(|&b| b == b'\n')
                    .zip(expected.split('\n'))
                    .take_while(|(a, b)| *a == b.as_bytes())
                    .count();
                complaints.push(format!("fixtures/{name} differs from its formula, first in line {line}"));
            }
            Err(error) => complaints.push(format!("fixtures/{name}: {error}")),
        }
    }
    for path in surplus {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        complaints.push(format!("fixtures/{name} is made by no formula"));
    }
    if complaints.is_empty() {
        println!("fixtures/: all {} files are as their formulas say", files.len());
        return Ok(());
    }
    Err(format!("{}\n`cargo xtask fixtures` writes them anew", complaints.join("\n")))
}

fn write(folder: &Path, files: &[(String, String)], surplus: &[PathBuf]) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("fixtures/: {error}"))?;
    for (name, text) in files {
        fs::write(folder.join(name), text).map_err(|error| format!("fixtures/{name}: {error}"))?;
    }
    let bytes: usize = files.iter().map(|(_, text)| text.len()).sum();
    println!("fixtures/: {} files, {} KB", files.len(), bytes.div_ceil(1000));
    for path in surplus {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        println!("fixtures/{name} is made by no formula: remove it");
    }
    Ok(())
}

/// The OBJ text of a fixture.
fn obj(fixture: &Fixture) -> Result<String, String> {
    let mesh = &fixture.mesh;
    let mut text = format!(
        "# qmesh::shapes::{}\n# {}\n# {}\n# made by `cargo xtask fixtures`\no {}\n",
        fixture.call,
        fixture.formula,
        summary(mesh),
        fixture.name
    );
    for position in mesh.positions().iter() {
        text.push('v');
        position.iter().for_each(|&coordinate| push_coordinate(&mut text, coordinate));
        text.push('\n');
    }
    let group = |face: FaceId| {
        let corners: Vec<Vec3> = mesh.face_vertices(face).map(|v| mesh.position(v)).collect();
        (fixture.group)(corners.iter().sum::<Vec3>() / corners.len() as f64)
    };
    let mut faces: Vec<(usize, FaceId)> = mesh.faces().map(|face| (group(face), face)).collect();
    faces.sort();
    text.push_str("s 1\n");
    let mut current = None;
    for (group, face) in faces {
        if current.replace(group) != Some(group) {
            let name =
                fixture.groups.get(group).ok_or_else(|| format!("{}: no group {group}", fixture.name))?;
            let _ = writeln!(text, "g {name}");
        }
        text.push('f');
        for vertex in mesh.face_vertices(face) {
            let _ = write!(text, " {}", vertex.0 + 1);
        }
        text.push('\n');
    }
    Ok(text)
}

/// A space and a number with at most six decimals, none of them a trailing zero, and never `-0`.
fn push_coordinate(text: &mut String, coordinate: f64) {
    let digits = format!("{coordinate:.6}");
    let short = digits.trim_end_matches('0').trim_end_matches('.');
    text.push(' ');
    text.push_str(if short == "-0" { "0" } else { short });
}

fn summary(mesh: &QuadMesh) -> String {
    format!("{} vertices, {} quads: {}", mesh.vertex_count(), mesh.face_count(), topology(mesh))
}

/// The kind of surface, in words.
fn topology(mesh: &QuadMesh) -> String {
    let found = mesh.topology();
    match (found.components, found.boundary_loops, found.genus) {
        (1, 1, 0) => "a disk".to_owned(),
        (1, 2, 0) => "an annulus".to_owned(),
        (1, 0, genus) => format!("closed, genus {genus}"),
        (components, loops, genus) => {
            format!("{components} components, {loops} boundary loops, genus {genus}")
        }
    }
}

fn readme(fixtures: &[Fixture]) -> String {
    let mut text = String::from(
        "# Fixtures\n\nQuad meshes from formulas, written by `cargo xtask fixtures` with coordinates rounded to six \
         decimals; `cargo xtask fixtures --check`\nfails when a file here is not what its formula gives. The \
         formulas are in `crates/qmesh/src/shapes/`.\n\n\
         | file | call in `qmesh::shapes` | what it is | vertices | quads | topology |\n\
         | --- | --- | --- | ---: | ---: | --- |\n",
    );
    for fixture in fixtures {
        let Fixture { name, call, formula, mesh, .. } = fixture;
        let (vertices, quads, topology) = (mesh.vertex_count(), mesh.face_count(), topology(mesh));
        let _ = writeln!(text, "| {name}.obj | `{call}` | {formula} | {vertices} | {quads} | {topology} |");
    }
    text.push_str("\n`head.obj` and `face.obj` carry OBJ groups for their parts.\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use qparam_cli::qmesh::obj::ObjDocument;

    /// Rounding to six decimals breaks no mesh: what is read back has the same faces, each with its area.
    #[test]
    fn every_fixture_reads_back_as_its_mesh() {
        for fixture in fixtures().unwrap() {
            let text = obj(&fixture).unwrap();
            assert!(!text.contains("-0 ") && !text.contains("-0\n"), "{}: a negative zero", fixture.name);
            let mesh = QuadMesh::build(ObjDocument::parse(text.into_bytes()).unwrap().polygons()).unwrap();
            assert_eq!(mesh.topology(), fixture.mesh.topology(), "{}", fixture.name);
            assert_eq!(mesh.face_count(), fixture.mesh.face_count(), "{}", fixture.name);
            for (read, made) in mesh.positions().iter().zip(fixture.mesh.positions().iter()) {
                assert!((read - made).amax() <= 0.5000001e-6, "{}", fixture.name);
            }
        }
    }

    #[test]
    fn coordinates_are_short_and_never_negative_zero() {
        let mut text = String::new();
        for coordinate in [0.0, -0.0, -1e-9, 1.0, -0.25, 1.0 / 3.0, 1e-6, 10.0, -20.0] {
            push_coordinate(&mut text, coordinate);
        }
        assert_eq!(text, " 0 0 0 1 -0.25 0.333333 0.000001 10 -20");
    }

    #[test]
    fn the_check_names_what_differs() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let files = [("Cargo.toml".to_owned(), "[package]\nnam".to_owned())];
        let message = compare(folder, &files, &[folder.join("old.obj")]).unwrap_err();
        assert!(
            message.contains("fixtures/Cargo.toml differs from its formula, first in line 2"),
            "{message}"
        );
        assert!(message.contains("fixtures/old.obj is made by no formula"), "{message}");
    }

    /// The surface of the head is in four parts, the face in five, and none is empty.
    #[test]
    fn every_group_has_faces() {
        for fixture in fixtures().unwrap() {
            let text = obj(&fixture).unwrap();
            for group in fixture.groups {
                assert!(text.contains(&format!("\ng {group}\n")), "{}: {group}", fixture.name);
            }
        }
    }
}
