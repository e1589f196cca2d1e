//! `qparam render` and `qparam layout`: pictures as files, and what is refused.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use std::path::PathBuf;

use common::{CUBE, Folder, flat_with_uv, hill};

/// Bytes of a picture with its size; every pixel as RGBA.
fn pixels(file: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
    decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    (info.width, info.height, bytes)
}

/// Compares with the picture of this name in `tests/pictures`, or puts it there when `QPARAM_UPDATE_PICTURES` is set.
///
/// Tolerance, since last digits differ between machines: the mean difference of a byte is at most 1, and at most one
/// pixel in a hundred differs by more than 24.
#[track_caller]
fn assert_picture(name: &str, file: &[u8]) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/pictures").join(name);
    if std::env::var_os("QPARAM_UPDATE_PICTURES").is_some() {
        std::fs::write(&path, file).unwrap();
    }
    let expected = std::fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let ((width, height, found), (w, h, expected)) = (pixels(file), pixels(&expected));
    assert_eq!((width, height), (w, h), "{name}");
    let differences: Vec<u8> = found.iter().zip(&expected).map(|(a, b)| a.abs_diff(*b)).collect();
    let mean = differences.iter().map(|&d| f64::from(d)).sum::<f64>() / differences.len() as f64;
    let far = differences.chunks_exact(4).filter(|pixel| pixel.iter().any(|&d| d > 24)).count();
    assert!(
        mean <= 1.0 && far * 100 <= (width * height) as usize,
        "{name}: mean {mean}, {far} pixels far off"
    );
}

/// A small dome with UVs that shrink towards one side, in two islands.
fn dome() -> String {
    let n = 8;
    let mut text = String::new();
    for row in 0..=n {
        for column in 0..=n {
            let (x, y) = (column as f64 / n as f64 - 0.5, row as f64 / n as f64 - 0.5);
            text += &format!("v {x:.5} {y:.5} {:.5}\n", 0.6 * (-6.0 * (x * x + y * y)).exp());
            for side in 0..2 {
                let u = (x + 0.5) * (0.6 + 0.4 * y) * 0.9 + 0.08 * f64::from(side);
                text += &format!("vt {u:.5} {:.5}\n", y + 0.5);
            }
        }
    }
    for row in 0..n {
        for column in 0..n {
            let first = row * (n + 1) + column + 1;
            let side = usize::from(column >= n / 2);
            let corner = |v: usize| format!("{v}/{}", 2 * v - 1 + side);
            let corners = [first, first + 1, first + n + 2, first + n + 1].map(corner);
            text += &format!("f {}\n", corners.join(" "));
        }
    }
    text
}

#[test]
fn every_style_has_its_picture() {
    let folder = Folder::new();
    folder.write("in.obj", dome());
    for style in ["checker", "heat-angle", "heat-area", "heat-stretch", "islands", "wire", "material"] {
        let size = if style.starts_with("heat") { "200x120" } else { "120x100" };
        let run = folder.qparam(&[
            "render", "in.obj", "-o", "out.png", "--style", style, "--size", size, "--checks", "80",
        ]);
        run.code(0);
        assert_picture(&format!("render-{style}.png"), &std::fs::read(folder.path("out.png")).unwrap());
    }
    let sheet = ["--view", "front", "--view", "top", "--view", "-1,0.2,0.4", "--background", "#202830"];
    let run = folder.qparam(
        &[
            &[
                "render", "in.obj", "-o", "out.png", "--size", "300x100", "--seams", "--edges", "--checks",
                "50",
            ],
            &sheet[..],
        ]
        .concat(),
    );
    run.code(0);
    assert_picture("render-sheet.png", &std::fs::read(folder.path("out.png")).unwrap());
    for style in ["islands", "heat-area"] {
        let arguments =
            ["layout", "in.obj", "-o", "out.png", "--size", "200x150", "--texels", "16", "--style", style];
        folder.qparam(&arguments).code(0);
        assert_picture(&format!("layout-{style}.png"), &std::fs::read(folder.path("out.png")).unwrap());
    }
}

/// An SVG has every face once, each run of seams once with two sides, and the scale that explains the colours.
#[test]
fn a_layout_in_vectors_is_complete() {
    let folder = Folder::new();
    folder.write("in.obj", dome());
    folder.qparam(&["layout", "in.obj", "-o", "out.svg", "--style", "heat-area"]).code(0);
    let text = folder.read("out.svg");
    let faces = text.split("<g id=\"faces\"").nth(1).unwrap().split("</g>").next().unwrap();
    assert_eq!(faces.matches('M').count(), 64);
    assert!(text.contains("<title>seam 1: 8 edges, each on two sides</title>"));
    assert!(text.contains("<title>boundary</title>") && text.contains("id=\"legend\""));
    folder.qparam(&["layout", "in.obj", "-o", "out.svg", "--no-seams", "--no-edges"]).code(0);
    assert!(!folder.read("out.svg").contains("seam") && !folder.read("out.svg").contains("legend"));
}

/// Without UVs there is a picture of the faces, and an error that says so for everything else.
#[test]
fn without_uvs_only_the_faces_can_be_seen() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    folder.qparam(&["render", "cube.obj", "-o", "cube.png", "--style", "wire", "--size", "64x64"]).code(0);
    assert_eq!(pixels(&std::fs::read(folder.path("cube.png")).unwrap()).0, 64);
    folder.qparam(&["render", "cube.obj", "-o", "m.png", "--style", "material", "--quiet"]).code(0);
    let checker = folder.qparam(&["render", "cube.obj", "-o", "no.png"]).code(3);
    let layout = folder.qparam(&["layout", "cube.obj", "-o", "no.png"]).code(3);
    let seams = folder.qparam(&["render", "cube.obj", "-o", "no.png", "--style", "wire", "--seams"]).code(3);
    insta::assert_snapshot!([checker.stderr, layout.stderr, seams.stderr].join("\n"));
    assert_eq!(folder.names(), ["cube.obj", "cube.png", "m.png"]);
}

/// Colours and images of materials are found beside the file; what is missing is said, and shown in clay.
#[test]
fn materials_are_looked_up_beside_the_file() {
    let folder = Folder::new();
    let obj = flat_with_uv(2).replacen("f ", "mtllib my stuff.mtl\nusemtl red\nf ", 1).replacen(
        "\nf 4",
        "\nusemtl none\nf 4",
        1,
    );
    folder.write("in.obj", &obj);
    let arguments = [
        "render",
        "in.obj",
        "-o",
        "out.png",
        "--style",
        "material",
        "--view",
        "front",
        "--size",
        "60x60",
        "--orthographic",
    ];
    let run = folder.qparam(&arguments).code(0);
    assert!(run.stderr.contains("my stuff.mtl: "), "{}", run.stderr);
    folder.write("my stuff.mtl", "newmtl red\nKd 1 0 0\nmap_Kd gone.png\n");
    let run = folder.qparam(&arguments).code(0);
    assert!(
        run.stderr.contains("gone.png: ") && run.stderr.contains("has the material none"),
        "{}",
        run.stderr
    );
    let (_, _, bytes) = pixels(&std::fs::read(folder.path("out.png")).unwrap());
    let pixel = |x: usize, y: usize| &bytes[(y * 60 + x) * 4..][..3];
    let [below, above] = [pixel(20, 45), pixel(20, 15)];
    assert!(below[0] > 150 && below[1] == 0, "the lower faces are red: {below:?}");
    assert!(above[1] > 100, "the upper ones have no known material: {above:?}");
}

/// Bad usage is explained, and nothing is left behind or replaced.
#[test]
fn bad_pictures_are_refused() {
    let folder = Folder::new();
    folder.write("in.obj", flat_with_uv(2));
    folder.write("hill.obj", hill(2));
    folder.write("no.png", "GIF89a");
    let before = folder.names();
    let mut text = String::new();
    for arguments in [
        &["render", "in.obj", "-o", "in.obj"][..],
        &["render", "in.obj", "-o", "out.png", "--size", "1200"],
        &["render", "in.obj", "-o", "out.png", "--view", "0,0,0"],
        &["render", "in.obj", "-o", "out.png", "--range", "0,5"],
        &["render", "in.obj", "-o", "out.png", "--style", "heat-area", "--range", "0,5"],
        &["render", "in.obj", "-o", "out.png", "--texture", "no.png"],
        &["render", "in.obj", "-o", "out.png", "--background", "mauve"],
        &["render", "-", "-o", "out.png", "--texture", "-"],
        &["layout", "in.obj", "-o", "nowhere/out.svg"],
        &["layout", "in.obj", "-o", "out.svg", "--texels", "-1"],
    ] {
        let run = folder.qparam(arguments);
        text += &format!("$ qparam {}\n{}exit code {}\n\n", arguments.join(" "), run.stderr, run.code);
    }
    insta::assert_snapshot!(text);
    assert_eq!(folder.names(), before);
    assert_eq!(folder.read("in.obj"), flat_with_uv(2));
}

/// `-o -` gives the picture alone; the message goes to standard error.
#[test]
fn pictures_go_to_standard_output() {
    let folder = Folder::new();
    let command = folder
        .command(&["render", "-", "-o", "-", "--size", "32x32"])
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn();
    let mut child = command.unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), flat_with_uv(2).as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(pixels(&output.stdout).0, 32);
    assert!(String::from_utf8_lossy(&output.stderr).contains("<stdout>: 32 × 32 pixels, 4 faces"));
}
