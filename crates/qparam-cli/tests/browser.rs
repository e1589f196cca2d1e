//! Pages of `--report` in real headless Chromium, when there is one.
//!
//! `QPARAM_BROWSER` names a folder with `node_modules/playwright-core`; `QPARAM_CHROMIUM` the browser, else
//! `/usr/bin/chromium`. `.ci/run` sees to both. Without the first variable these tests say so and pass.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]
#![allow(
    clippy::print_stdout,
    reason = "who runs the tests is told what was skipped, and the time of the slider"
)]

mod common;

use std::path::Path;
use std::process::Command;

use common::{Folder, hill};
use qparam_cli::picture::page::{MapEntry, Page};
use qparam_cli::picture::{Canvas, Rgba};
use qparam_cli::qmesh::{Vec2, shapes};
use qparam_cli::qoptimize::{certify, measure, measure_faces};

/// Runs the script on a page; what it prints, or nothing without a browser.
fn browse(page: &Path, size: &str) -> Option<serde_json::Value> {
    let Some(modules) = std::env::var_os("QPARAM_BROWSER") else {
        println!("skipped: QPARAM_BROWSER is not set");
        return None;
    };
    let chromium = std::env::var_os("QPARAM_CHROMIUM").unwrap_or_else(|| "/usr/bin/chromium".into());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/browser/report.js");
    let output =
        Command::new("node").arg(script).arg(modules).arg(chromium).arg(page).arg(size).output().unwrap();
    let (text, complaints) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{text}\n{complaints}");
    Some(serde_json::from_str(text.trim()).unwrap())
}

/// It loads without a complaint and without a request; slider, hover, styles, keys, list and theme do what they say.
#[test]
fn a_page_can_be_used() {
    let folder = Folder::new();
    folder.write("hill.obj", hill(8));
    folder
        .qparam(&[
            "unwrap",
            "--q=0.5",
            "hill.obj",
            "-o",
            "out.obj",
            "--method",
            "direct",
            "--report",
            "page.html",
            "--report-q",
            "1,0.5,0",
        ])
        .code(0);
    browse(&folder.path("page.html"), "small");
}

/// 200 000 quads: the slider's handler is timed, and told; it is no test of the machine.
#[test]
fn a_page_of_many_quads_can_be_used() {
    let mesh = shapes::grid(447, 447);
    let positions = mesh.vertex_data(|vertex| {
        let p = mesh.position(vertex);
        let (x, y) = (p.x / 447.0, p.y / 447.0);
        qparam_cli::qmesh::Vec3::new(x, y, 0.2 * (6.0 * x).sin() * (5.0 * y).cos())
    });
    let mesh = mesh.with_positions(positions);
    let maps: Vec<_> = [1.0, 0.5, 0.0]
        .map(|q| {
            let map = |x: f64, y: f64| Vec2::new(x + 0.1 * q * y * y, y + 0.1 * (1.0 - q) * x * x);
            let uv: Vec<Vec2> = mesh
                .corners()
                .map(|corner| {
                    let p = mesh.position(mesh.vertex(corner));
                    map(p.x, p.y)
                })
                .collect();
            let distortion = measure(mesh.view(), &uv).unwrap();
            let certificate = certify(mesh.view(), &uv, 0).unwrap();
            let faces = measure_faces(mesh.view(), &uv).unwrap();
            (q, uv, distortion, certificate, faces)
        })
        .into();
    let entries: Vec<MapEntry<'_>> = maps
        .iter()
        .map(|(q, uv, distortion, certificate, faces)| MapEntry {
            q: Some(*q),
            uv,
            distortion,
            certificate,
            faces,
            causes: &[],
        })
        .collect();
    let picture = Canvas::new(8, 8, Rgba::CLEAR);
    let page = Page {
        title: "<waves> & \"hills\"",
        polygons: mesh.view(),
        face_line: &|face| face + 1,
        maps: &entries,
        chosen: 1,
        knee: Err("three maps made up for a test".to_owned()),
        notes: &["199 809 quads".to_owned()],
        settings: &serde_json::json!({ "q": 0.5, "note": "</script>" }),
        pictures: [&picture, &picture],
    };
    let folder = Folder::new();
    let html = page.html().unwrap();
    assert!(html.matches("</script>").count() == 3, "nothing of the data ends a script");
    folder.write("large.html", &html);
    if let Some(times) = browse(&folder.path("large.html"), "large") {
        println!("{} MB, slider at {} quads: {times}", html.len() / 1_000_000, mesh.face_count());
        assert!(times["handler_ms"].as_f64().unwrap() < 5000.0, "the page does not answer: {times}");
    }
}
