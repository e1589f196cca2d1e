//! Faults on purpose: interrupted wherever the work can be, too little memory, few threads, two runs at once.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{CUBE, Folder, hill, interrupted};
use qparam_cli::{Exit, Interrupt};

/// Interrupted at every place that looks for it: code 130 and not a file more than before, or the whole file. Never a part of one.
#[test]
fn an_interruption_at_any_moment_leaves_all_or_nothing() {
    let cases: [(&str, String, &[&str]); 4] = [
        ("a hill", hill(4), &[]),
        ("a cube", CUBE.to_owned(), &["--max-stretch", "1.1"]),
        ("the paper's method", hill(4), &["--method", "paper"]),
        (
            "two islands",
            CUBE.to_owned() + "v 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nf 9 10 11 12\n",
            &["--threads", "1"],
        ),
    ];
    for (name, text, more) in cases {
        let mut stops = 0;
        for looks in 0.. {
            let folder = Folder::new();
            folder.write("in.obj", &text);
            folder.write("out.obj", "old");
            let [input, output] = ["in.obj", "out.obj"].map(|file| folder.path(file).display().to_string());
            let arguments = [&["unwrap", &input, "-o", &output], more].concat();
            let run = interrupted(&arguments, b"", &Interrupt::after_looks(looks));
            assert_eq!(folder.names(), ["in.obj", "out.obj"], "{name}, look {looks}");
            assert_eq!(folder.read("in.obj"), text, "{name}, look {looks}");
            if run.exit == Exit::Done {
                assert_eq!(
                    folder.read("out.obj").matches("f ").count(),
                    text.matches("f ").count(),
                    "{name}"
                );
                break;
            }
            assert_eq!(run.exit, Exit::Interrupted, "{name}, look {looks}: {}", run.stderr);
            assert_eq!(folder.read("out.obj"), "old", "{name}, look {looks}");
            stops += 1;
        }
        assert!(stops > 10, "{name}: only {stops} places look for an interruption");
    }
}

/// With a page and a simplified mesh beside the UVs: three files or none.
#[test]
fn an_interruption_leaves_all_files_or_none() {
    let mut stops = 0;
    // The first looks are those of the maps; what comes last is what matters here.
    for looks in (0..).step_by(7) {
        let folder = Folder::new();
        folder.write("in.obj", hill(4));
        let [input, output, page, simplified] = ["in.obj", "out.obj", "page.html", "simplified.obj"]
            .map(|file| folder.path(file).display().to_string());
        let arguments = [
            &["unwrap", "--method=paper", &input, "-o", &output][..],
            &["--report", &page, "--report-q", "0.5", "--simplified", &simplified],
        ]
        .concat();
        let run = interrupted(&arguments, b"", &Interrupt::after_looks(looks));
        if run.exit != Exit::Interrupted {
            assert!([Exit::Done, Exit::Invalid].contains(&run.exit), "{}", run.stderr);
            assert_eq!(folder.names(), ["in.obj", "out.obj", "page.html", "simplified.obj"]);
            break;
        }
        assert_eq!(folder.names(), ["in.obj"], "look {looks}");
        stops += 1;
    }
    assert!(stops > 3, "only {stops} interruptions");
}

/// A limit that is over before the work begins: code 9, and no file; of two islands there are the convex starts, code 8, and the report
/// says so. A limit that is never reached changes nothing.
#[test]
fn a_time_limit_leaves_the_best_map_so_far_or_none() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    folder.write("two.obj", CUBE.to_owned() + "v 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nf 9 10 11 12\n");
    let run = folder.qparam(&["unwrap", "in.obj", "--time-limit", "0", "--json"]).code(9);
    assert_eq!(run.json()["exit_code"], 9);
    assert!(run.stderr.contains("the time limit was over before there was a map"), "{}", run.stderr);
    assert_eq!(folder.names(), ["in.obj", "two.obj"]);

    let run = folder.qparam(&["unwrap", "two.obj", "--time-limit", "0", "--json"]).code(8);
    let report = run.json();
    assert_eq!((&report["stopped_by_time"], &report["valid"]), (&true.into(), &true.into()));
    assert!(report["islands"][0]["fallback"].as_str().is_some_and(|why| why.contains("time was up")));
    assert!(run.stderr.contains("the time limit ended the work"), "{}", run.stderr);
    folder.qparam(&["check", "two_uv.obj"]).code(0);

    let report = folder.qparam(&["unwrap", "in.obj", "-o", "a.obj", "--json"]).code(0).json();
    assert_eq!(report["stopped_by_time"], false);
    assert!(report["peak_memory_bytes"].as_u64().is_none_or(|bytes| bytes > 1 << 20));
    for limit in ["1e9", "1e300"] {
        folder.qparam(&["unwrap", "in.obj", "-o", "b.obj", "--time-limit", limit]).code(0);
        assert_eq!(folder.read("a.obj"), folder.read("b.obj"));
    }
}

/// With less and less memory: a result that is whole, or the process ends without one. Never half a file.
#[cfg(target_os = "linux")]
#[test]
fn too_little_memory_leaves_all_or_nothing() {
    let folder = Folder::new();
    folder.write("in.obj", hill(60));
    let (mut done, mut failed) = (0, 0);
    for kilobytes in [20_000, 40_000, 60_000, 80_000, 120_000, 200_000, 400_000, 2_000_000] {
        let program = env!("CARGO_BIN_EXE_qparam");
        let script =
            format!("ulimit -v {kilobytes}; exec '{program}' unwrap in.obj -o out.obj --threads 1 --quiet");
        let output = std::process::Command::new("sh")
            .args(["-c", &script])
            .current_dir(folder.path(""))
            .output()
            .unwrap();
        if output.status.code() == Some(0) {
            assert_eq!(folder.names(), ["in.obj", "out.obj"]);
            assert_eq!(folder.read("out.obj").lines().filter(|line| line.starts_with("f ")).count(), 3600);
            std::fs::remove_file(folder.path("out.obj")).unwrap();
            done += 1;
        } else {
            // What ends a process that gets no memory may leave its temporary file, but no output.
            assert!(!folder.path("out.obj").exists(), "{kilobytes} kB: {output:?}");
            failed += 1;
        }
    }
    assert!(done > 0 && failed > 0, "{done} done, {failed} failed");
}

/// One thread, or many more than there are processors: the same bytes, of a mesh that is large enough to be mapped by way of coarser
/// ones and in many pieces, and of many islands that are packed and rounded.
#[test]
fn the_number_of_threads_changes_nothing() {
    let cases: [(&str, String, &[&str]); 2] = [
        ("22,500 quads", hill(150), &["--method", "direct"]),
        ("many islands", beside(3..24), &["--uv-precision", "f32"]),
    ];
    for (name, text, more) in cases {
        let folder = Folder::new();
        folder.write("in.obj", text);
        for threads in ["1", "2", "64"] {
            let output = format!("{threads}.obj");
            folder
                .qparam(&[&["unwrap", "in.obj", "-o", &output, "--threads", threads], more].concat())
                .code(0);
        }
        assert!(folder.read("1.obj") == folder.read("2.obj"), "{name}");
        assert!(folder.read("1.obj") == folder.read("64.obj"), "{name}");
    }
}

/// Hills of these sizes, each with its own vertices.
fn beside(sizes: std::ops::Range<usize>) -> String {
    let (mut text, mut before) = (String::new(), 0);
    for n in sizes {
        for line in hill(n).lines() {
            match line.strip_prefix("f ") {
                Some(corners) => {
                    let corner = |field: &str| format!(" {}", field.parse::<usize>().unwrap() + before);
                    text += &format!("f{}\n", corners.split(' ').map(corner).collect::<String>());
                }
                None => text += &format!("{line}\n"),
            }
        }
        before += (n + 1) * (n + 1);
    }
    text
}

/// Runs at once on one output: each writes its own temporary file, and the last to finish has its map there, whole.
#[test]
fn several_runs_on_one_output_do_not_mix() {
    let folder = Folder::new();
    folder.write("a.obj", hill(20));
    folder.write("b.obj", hill(24));
    let run = |input: &str| folder.command(&["unwrap", input, "-o", "out.obj", "--quiet"]).spawn().unwrap();
    for child in [run("a.obj"), run("b.obj"), run("a.obj"), run("b.obj")] {
        assert!(child.wait_with_output().unwrap().status.success());
    }
    for name in ["a", "b"] {
        folder.qparam(&["unwrap", &format!("{name}.obj"), "-o", &format!("{name}_uv.obj")]).code(0);
    }
    let found = folder.read("out.obj");
    assert!(found == folder.read("a_uv.obj") || found == folder.read("b_uv.obj"));
    assert_eq!(folder.names(), ["a.obj", "a_uv.obj", "b.obj", "b_uv.obj", "out.obj"]);
}

/// Whatever asks the process to end, and whenever: no temporary file stays.
#[cfg(unix)]
#[test]
fn signals_leave_nothing_behind() {
    for signal in ["-INT", "-TERM", "-HUP"] {
        let folder = Folder::new();
        folder.write("in.obj", hill(150));
        for milliseconds in [0, 200, 500, 900] {
            let mut child =
                folder.command(&["unwrap", "in.obj", "--method", "uniform", "--quiet"]).spawn().unwrap();
            std::thread::sleep(std::time::Duration::from_millis(milliseconds));
            let id = child.id().to_string();
            // It may have ended already.
            let _ = std::process::Command::new("kill")
                .args([signal, &id])
                .stderr(std::process::Stdio::null())
                .status();
            let done = child.wait().unwrap().code() == Some(0);
            let names = folder.names();
            // Between the last look and the end the file is there already: whole.
            if names == ["in.obj", "in_uv.obj"] {
                let output = folder.read("in_uv.obj");
                assert_eq!(
                    output.lines().filter(|line| line.starts_with("f ")).count(),
                    150 * 150,
                    "{signal}"
                );
            } else {
                assert!(names == ["in.obj"] && !done, "{signal} after {milliseconds} ms: {names:?}");
            }
            let _ = std::fs::remove_file(folder.path("in_uv.obj"));
        }
    }
}
