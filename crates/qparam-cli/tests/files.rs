//! Files are replaced as a whole or not at all.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use std::process::Stdio;

use common::{Folder, hill};

#[test]
fn the_output_may_be_the_input() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    folder.qparam(&["unwrap", "in.obj", "-o", "out.obj"]).code(0);
    folder.qparam(&["unwrap", "in.obj", "-o", "in.obj"]).code(0);
    assert_eq!(folder.read("in.obj"), folder.read("out.obj"));
    assert_eq!(folder.names(), ["in.obj", "out.obj"]);
}

#[test]
fn a_target_that_cannot_be_is_refused_before_the_work() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    std::fs::create_dir(folder.path("folder")).unwrap();
    for target in ["folder", "missing/out.obj", "in.obj/out.obj"] {
        let run = folder.qparam(&["unwrap", "in.obj", "-o", target]).code(6);
        assert!(run.stderr.contains("help:"), "{target}: {}", run.stderr);
        assert_eq!(folder.names(), ["folder", "in.obj"], "{target}");
    }
}

/// With a folder that may not be written, nothing appears in it. (The superuser may write everywhere.)
#[cfg(unix)]
#[test]
fn a_read_only_folder_stays_as_it_is() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let closed = folder.path("closed");
    std::fs::create_dir(&closed).unwrap();
    std::fs::set_permissions(&closed, std::fs::Permissions::from_mode(0o555)).unwrap();
    let superuser =
        std::fs::write(closed.join("probe"), "").and_then(|()| std::fs::remove_file(closed.join("probe")));
    let run = folder.qparam(&["unwrap", "in.obj", "-o", "closed/out.obj"]);
    if superuser.is_err() {
        assert_eq!(run.code, 6, "{}", run.stderr);
        assert!(common::names(&closed).is_empty());
    }
    std::fs::set_permissions(&closed, std::fs::Permissions::from_mode(0o755)).unwrap();
}

/// A full disk is noticed; `/dev/full` is one.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let run = folder.qparam(&["unwrap", "in.obj", "-o", "/dev/full"]).code(6);
    assert!(run.stderr.contains("No space left"), "{}", run.stderr);
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let output = folder.command(&["info", "in.obj"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(6));
}

/// `qparam … | head` ends without a panic, whatever was printed.
#[test]
fn a_reader_that_leaves_is_no_panic() {
    let folder = Folder::new();
    folder.write("in.obj", hill(40));
    for arguments in [&["info", "in.obj"][..], &["unwrap", "in.obj", "-o", "-"], &["completions", "bash"]] {
        let mut child =
            folder.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(!message.contains("panicked"), "{arguments:?}: {message}");
        let expected = if arguments[0] == "unwrap" { 6 } else { 0 };
        assert_eq!(output.status.code(), Some(expected), "{arguments:?}: {message}");
    }
}

/// Ctrl-C at any moment: exit code 130 and no file, or it came too late: exit code 0 and the file.
#[cfg(unix)]
#[test]
fn ctrl_c_leaves_nothing_behind() {
    use std::process::{Command, Stdio};
    let folder = Folder::new();
    folder.write("in.obj", hill(120));
    let interrupt = |child: &std::process::Child| {
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    };
    // Before the handler is in place, the signal itself ends the process.
    let is_interrupted = |code: Option<i32>| matches!(code, Some(130) | None);
    // This run cannot be over before the signal: its input does not end.
    let mut waiting = folder.command(&["unwrap", "-", "-o", "in_uv.obj"]);
    let mut waiting = waiting.stdin(Stdio::piped()).spawn().unwrap();
    interrupt(&waiting);
    let kept_open = waiting.stdin.take();
    assert!(is_interrupted(waiting.wait().unwrap().code()));
    drop(kept_open);
    assert_eq!(folder.names(), ["in.obj"]);
    // How long the whole takes depends on the machine: the moments go on until it is done.
    for milliseconds in (0..).map(|i| 15 * i * i) {
        let mut child = folder.command(&["unwrap", "in.obj", "--quiet"]).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(milliseconds));
        interrupt(&child);
        let status = child.wait().unwrap();
        let names = folder.names();
        if status.code() == Some(0) {
            assert_eq!(names, ["in.obj", "in_uv.obj"]);
            break;
        }
        assert!(is_interrupted(status.code()), "exit code {:?}", status.code());
        assert_eq!(names, ["in.obj"]);
    }
}

/// A pipe that nobody reads is waited for before any file is begun: ctrl-C ends the waiting and leaves nothing.
#[cfg(unix)]
#[test]
fn waiting_for_a_reader_can_be_ended() {
    use std::process::Command;
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    assert!(Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap().success());
    let arguments =
        ["unwrap", "in.obj", "--quiet", "--method=paper", "-o", "pipe", "--simplified", "simple.obj"];
    let mut child = folder.command(&arguments).spawn().unwrap();
    // The work itself takes milliseconds; if not, the signal ends that.
    std::thread::sleep(std::time::Duration::from_millis(400));
    assert!(child.try_wait().unwrap().is_none(), "nobody has read");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.names(), ["in.obj", "pipe"]);
}

/// The simplified mesh goes to a place of its own, by whatever name that place is called.
#[test]
fn the_simplified_mesh_replaces_neither_input_nor_output() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let before = folder.read("in.obj");
    let mut places = vec![("out.obj", "./out.obj"), ("out.obj", "./in.obj"), ("out.obj", "in.obj")];
    if cfg!(unix) {
        #[cfg(unix)]
        std::os::unix::fs::symlink("in.obj", folder.path("link.obj")).unwrap();
        places.push(("out.obj", "link.obj"));
    }
    for (output, simplified) in places {
        folder
            .qparam(&["unwrap", "in.obj", "--method=paper", "-o", output, "--simplified", simplified])
            .code(2);
        assert_eq!(folder.read("in.obj"), before, "{simplified}");
        assert!(!folder.path("out.obj").exists(), "{simplified}");
    }
    folder
        .qparam(&["unwrap", "in.obj", "--method=paper", "-o", "in.obj", "--simplified", "simple.obj"])
        .code(0);
}

/// A mesh cannot be brought back from its figures.
#[test]
fn the_csv_does_not_replace_the_input() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    for csv in ["in.obj", "./in.obj"] {
        folder.qparam(&["sweep", "in.obj", "--csv", csv]).code(2);
        assert_eq!(folder.read("in.obj"), hill(4), "{csv}");
    }
}
