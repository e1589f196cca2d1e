//! A folder of its own for each test, and `qparam` run in it.

#![allow(dead_code, unreachable_pub, reason = "every test file uses its own part")]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use qparam_cli::{Environment, Exit, Interrupt, Streams};

/// An empty folder in which `qparam` runs; removed at the end of the test.
pub struct Folder(tempfile::TempDir);

/// What a run left behind.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    /// Every file and folder, sorted.
    pub fn names(&self) -> Vec<String> {
        names(self.0.path())
    }

    /// The command, with nothing of the caller's surroundings.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_qparam"));
        command.args(arguments).current_dir(self.0.path()).env_remove("NO_COLOR");
        command.env("XDG_CONFIG_HOME", self.path("no-settings")).env("COLUMNS", "100");
        command
    }

    pub fn qparam(&self, arguments: &[&str]) -> Run {
        self.qparam_with(arguments, b"")
    }

    pub fn qparam_with(&self, arguments: &[&str], stdin: &[u8]) -> Run {
        let mut command = self.command(arguments);
        let mut child =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // A command that needs no input may be gone already.
        let _ = child.stdin.take().unwrap().write_all(stdin);
        let output = child.wait_with_output().unwrap();
        Run {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

impl Run {
    #[track_caller]
    pub fn code(self, expected: i32) -> Self {
        assert_eq!(self.code, expected, "stdout:\n{}\nstderr:\n{}", self.stdout, self.stderr);
        self
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}:\n{}", self.stdout))
    }
}

/// What a run in this process left behind.
pub struct Ended {
    pub exit: Exit,
    pub stdout: String,
    pub stderr: String,
}

/// The command in this process, with `stdin` as its standard input.
pub fn in_process(arguments: &[&str], stdin: &[u8]) -> Ended {
    interrupted(arguments, stdin, &Interrupt::new())
}

/// The same with somebody who may interrupt it.
pub fn interrupted(arguments: &[&str], mut stdin: &[u8], interrupt: &Interrupt) -> Ended {
    let (mut output, mut messages) = (Vec::new(), Vec::new());
    let mut streams = Streams {
        stdin: &mut stdin,
        stdout: &mut output,
        stderr: &mut messages,
        stdout_color: false,
        stderr_color: false,
        stderr_is_terminal: false,
        interrupt,
    };
    let arguments = ["qparam"].iter().chain(arguments).map(|&argument| argument.into());
    let exit = qparam_cli::run(arguments, &Environment::default(), &mut streams);
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Ended { exit, stdout: text(output), stderr: text(messages) }
}

pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A hill of `n` × `n` quads with everything around it that has to survive.
pub fn hill(n: usize) -> String {
    let mut text = String::from("# a hill\nmtllib hill.mtl\no Hill\n");
    for row in 0..=n {
        for column in 0..=n {
            let (x, y) = (column as f64 / n as f64 - 0.5, row as f64 / n as f64 - 0.5);
            text += &format!("v {x:.4} {y:.4} {:.4}\n", 0.5 * (-8.0 * (x * x + y * y)).exp());
        }
    }
    text += "usemtl grass\ns 1\n";
    for row in 0..n {
        for column in 0..n {
            let first = row * (n + 1) + column + 1;
            text += &format!("f {} {} {} {}\n", first, first + 1, first + n + 2, first + n + 1);
        }
    }
    text + "# the end\n"
}

/// A flat grid with its own positions as UVs.
pub fn flat_with_uv(n: usize) -> String {
    let mut text = String::new();
    for row in 0..=n {
        for column in 0..=n {
            text += &format!("v {column} {row} 0\nvt {column} {row}\n");
        }
    }
    for row in 0..n {
        for column in 0..n {
            let first = row * (n + 1) + column + 1;
            let corners = [first, first + 1, first + n + 2, first + n + 1].map(|v| format!("{v}/{v}"));
            text += &format!("f {}\n", corners.join(" "));
        }
    }
    text
}

/// A cube: closed.
pub const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
";

/// Everything but `vt` lines, and `f` corners without what stands behind the first slash.
pub fn without_uv(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.starts_with("vt "));
    lines
        .map(|line| match line.strip_prefix("f ") {
            Some(corners) => {
                let first = |corner: &str| corner.split('/').next().unwrap_or_default().to_owned();
                format!("f {}\n", corners.split(' ').map(first).collect::<Vec<_>>().join(" "))
            }
            None => format!("{line}\n"),
        })
        .collect()
}
