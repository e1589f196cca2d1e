//! `qparam unwrap --report`: what the page holds. How it works in a browser: `browser.rs`.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{Folder, hill};

fn meta(page: &str) -> serde_json::Value {
    let start = page.split("id=\"meta\">").nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

/// Every q that was asked for and the one of the file are on the page, with their measures, certificates and worst faces;
/// what it says of the chosen map is what the report says.
#[test]
fn a_page_holds_the_whole_series() {
    let folder = Folder::new();
    folder.write("hill.obj", hill(5));
    let arguments = [
        "unwrap",
        "hill.obj",
        "--method",
        "direct",
        "--q",
        "0.4",
        "--report",
        "page.html",
        "--report-q",
        "0,1,0.4,1",
    ];
    let json = folder.qparam(&[&arguments[..], &["--json"]].concat()).code(0).json();
    let page = folder.read("page.html");
    let meta = meta(&page);
    let q: Vec<f64> = meta["maps"].as_array().unwrap().iter().map(|map| map["q"].as_f64().unwrap()).collect();
    assert_eq!(q, [1.0, 0.4, 0.0]);
    assert_eq!((&meta["chosen"], &meta["title"]), (&1.into(), &"hill.obj".into()));
    assert_eq!(meta["maps"][1]["distortion"], json["distortion"]);
    let mut settings = meta["settings"].clone();
    assert_eq!(settings.as_object_mut().unwrap().remove("layout").as_ref(), Some(&json["layout_options"]));
    assert_eq!(settings, json["options"]);
    for map in meta["maps"].as_array().unwrap() {
        assert_eq!((&map["holds"], &map["certificate"]), (&true.into(), &"holds".into()));
        let worst = map["worst"].as_array().unwrap();
        assert!(worst.len() == 12 && worst[0]["line"].as_u64().unwrap() > 36);
        assert!(worst.iter().all(|face| !face["cause"].as_str().unwrap().is_empty()));
    }
    assert_eq!((&meta["shape"]["faces"], &meta["shape"]["points"]), (&25.into(), &36.into()));
    assert!(!page.contains("https:") && !page.contains("http:"), "nothing is looked up elsewhere");
    // The same for any number of threads.
    folder.qparam(&[&arguments[..], &["--threads", "2", "--quiet"]].concat()).code(0);
    assert!(folder.read("page.html") == page);
}

/// A closed surface is cut open, and its seams are on the page in pairs.
#[test]
fn seams_are_on_the_page() {
    let folder = Folder::new();
    folder.write("cube.obj", common::CUBE);
    folder.qparam(&["unwrap", "cube.obj", "--report", "page.html", "--report-q", "1", "--quiet"]).code(0);
    let meta = meta(&folder.read("page.html"));
    let (edges, seams) = (meta["shape"]["edges"].as_u64().unwrap(), meta["shape"]["seams"].as_u64().unwrap());
    assert!(edges > 0 && edges % 2 == 0 && seams > 0, "{edges} sides of {seams} seams");
    assert!(meta["shape"]["points"].as_u64().unwrap() > 8);
}

/// A method that does not ask for q has one map.
#[test]
fn without_q_there_is_one_map() {
    let folder = Folder::new();
    folder.write("hill.obj", hill(4));
    folder
        .qparam(&["unwrap", "hill.obj", "--method", "harmonic", "--report", "page.html", "--quiet"])
        .code(0);
    let meta = meta(&folder.read("page.html"));
    assert_eq!(
        (meta["maps"].as_array().unwrap().len(), &meta["maps"][0]["q"]),
        (1, &serde_json::Value::Null)
    );
}

#[test]
fn pages_that_would_be_lost_are_refused() {
    let folder = Folder::new();
    folder.write("hill.obj", hill(2));
    let mut text = String::new();
    for arguments in [
        &["--report", "hill.obj"][..],
        &["--report", "out.obj", "-o", "out.obj"],
        &["--report", "-"],
        &["--report", "nowhere/page.html"],
        &["--report-q", "1,0"],
        &["--report", "page.html", "--report-q", "1,2"],
    ] {
        let run = folder.qparam(&[&["unwrap", "hill.obj"], arguments].concat());
        text += &format!(
            "$ qparam unwrap hill.obj {}\n{}exit code {}\n\n",
            arguments.join(" "),
            run.stderr,
            run.code
        );
    }
    insta::assert_snapshot!(text);
    assert_eq!(folder.names(), ["hill.obj"]);
    assert_eq!(folder.read("hill.obj"), hill(2));
}
