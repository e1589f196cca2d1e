//! `cargo xtask instructions`: how many instructions small runs take, as a guard against getting slower that noise cannot move.
//!
//! Callgrind counts the instructions of `qparam` on one thread. Its synthetic processor hides what machines differ in above
//! AVX2 from run-time dispatch, so that a count depends on the compiler, the C library, and the program: within a few
//! hundredths of a percent for the same three. Counts are compared only where compiler and processor are of the kind that they
//! were made with.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::Parser;

use crate::arguments;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The committed counts.
const COUNTS: &str = "benches/instructions.toml";
/// How much more than committed is a failure: beyond what another C library does, and below what anybody would notice.
const TOLERANCE: f64 = 0.05;

/// Count the instructions of small runs with callgrind, into benches/instructions.toml.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask instructions")]
struct Arguments {
    /// Compare with the committed counts instead; skipped where there is no valgrind, another compiler or processor
    #[arg(long)]
    check: bool,
}

/// What was counted, and with what.
#[derive(Debug, Deserialize, PartialEq)]
struct Counts {
    rustc: String,
    processor: String,
    instructions: BTreeMap<String, u64>,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    arguments::parsed("cargo xtask instructions", arguments, instructions)
}

fn instructions(arguments: &Arguments) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")?;
    let path = root.join(COUNTS);
    let here = Counts { rustc: rustc(), processor: processor(), instructions: BTreeMap::new() };
    if !has_valgrind() {
        return match arguments.check {
            true => skip("valgrind is not installed"),
            false => Err("valgrind is not installed".to_owned()),
        };
    }
    if !arguments.check {
        let counts = Counts { instructions: count(root)?, ..here };
        let text = counts.text();
        std::fs::write(&path, &text).map_err(|error| format!("{}: {error}", path.display()))?;
        print!("{text}");
        return Ok(());
    }
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let known: Counts = toml::from_str(&text).map_err(|error| format!("{COUNTS}: {error}"))?;
    if let Some(why) = known.differs(&here) {
        return skip(&why);
    }
    let (report, is_good) = compare(&known.instructions, &count(root)?);
    print!("{report}");
    if is_good { Ok(()) } else { Err(format!("more instructions than {COUNTS} allows")) }
}

fn skip(why: &str) -> Result<(), String> {
    println!("skipped: {why}");
    Ok(())
}

impl Counts {
    /// Why other counts cannot be compared with these.
    fn differs(&self, other: &Self) -> Option<String> {
        let what =
            [("compiler", &self.rustc, &other.rustc), ("processor", &self.processor, &other.processor)];
        let (what, ours, theirs) = what.into_iter().find(|(_, ours, theirs)| ours != theirs)?;
        Some(format!("counted with the {what} {ours}, here it is {theirs}"))
    }

    fn text(&self) -> String {
        let mut text =
            "# Instructions of small runs on one thread, written by `cargo xtask instructions`.\n".to_owned();
        let _ = write!(
            text,
            "rustc = \"{}\"\nprocessor = \"{}\"\n\n[instructions]\n",
            self.rustc, self.processor
        );
        for (case, count) in &self.instructions {
            let _ = writeln!(text, "{case} = {count}");
        }
        text
    }
}

/// A line a case, and whether none takes too many. Fewer are welcome: the committed counts can be written anew.
fn compare(known: &BTreeMap<String, u64>, counted: &BTreeMap<String, u64>) -> (String, bool) {
    let (mut report, mut is_good) = (String::new(), true);
    for (case, &count) in counted {
        let Some(&before) = known.get(case) else {
            is_good = false;
            let _ = writeln!(report, "{case}: {count} instructions, none committed");
            continue;
        };
        let change = count as f64 / before as f64 - 1.0;
        let verdict = match change {
            _ if change > TOLERANCE => {
                "TOO MANY: make it cheaper, or run `cargo xtask instructions` and say why in the commit"
            }
            _ if change < -TOLERANCE => "fewer: run `cargo xtask instructions` to hold that",
            _ => "as committed",
        };
        is_good &= change <= TOLERANCE;
        let _ = writeln!(report, "{case}: {count} instructions, {:+.1} %, {verdict}", 100.0 * change);
    }
    (report, is_good)
}

/// The cases, each by its name.
fn count(root: &Path) -> Result<BTreeMap<String, u64>, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = Command::new(cargo)
        .current_dir(root)
        .args(["build", "--release", "--locked", "-p", "qparam-cli"])
        .status();
    if !built.map_err(|error| format!("cargo could not be started: {error}"))?.success() {
        return Err("qparam could not be built".to_owned());
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let program = target.join("release").join(format!("qparam{}", std::env::consts::EXE_SUFFIX));
    let folder = target.join("instructions");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let file = |name: &str| folder.join(name).display().to_string();
    let fixture = |name: &str| root.join("fixtures").join(name).display().to_string();
    let unwrap = |input: &str, output: &str| -> Vec<String> {
        ["unwrap", input, "-o", output, "--threads", "1", "--no-config", "--quiet"].map(str::to_owned).into()
    };
    let mut counts = BTreeMap::new();
    let nose = unwrap(&fixture("nose.obj"), &file("nose.obj"));
    counts.insert("unwrap-nose".to_owned(), callgrind(&program, &nose)?);
    let made = Command::new(&program).args(unwrap(&fixture("head.obj"), &file("head.obj"))).status();
    if !made.map_err(|error| format!("{}: {error}", program.display()))?.success() {
        return Err("fixtures/head.obj could not be unwrapped".to_owned());
    }
    let measure = ["measure".to_owned(), "--check".to_owned(), file("head.obj")];
    counts.insert("measure-head".to_owned(), callgrind(&program, &measure)?);
    Ok(counts)
}

/// The instructions of one run.
fn callgrind(program: &Path, arguments: &[String]) -> Result<u64, String> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(arguments)
        .env("RAYON_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("valgrind could not be started: {error}"))?;
    let text = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!(
            "qparam {} ended with {} under valgrind:\n{text}",
            arguments.join(" "),
            output.status
        ));
    }
    collected(&text).ok_or_else(|| format!("valgrind says nothing of what it collected:\n{text}"))
}

/// The number that callgrind prints in the end.
fn collected(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.split_once("Collected : "))?;
    line.1.split_whitespace().next()?.parse().ok()
}

fn has_valgrind() -> bool {
    let version =
        Command::new("valgrind").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// Version of the compiler without hash and date; nothing where there is none.
pub(crate) fn rustc() -> String {
    let output = Command::new("rustc").arg("--version").output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned()).unwrap_or_default();
    text.split(" (").next().unwrap_or_default().trim().to_owned()
}

/// The kind of processor, as far as programs under valgrind can tell.
fn processor() -> String {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        return "x86_64 with AVX2".to_owned();
    }
    std::env::consts::ARCH.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(pairs: &[(&str, u64)]) -> BTreeMap<String, u64> {
        pairs.iter().map(|&(case, count)| (case.to_owned(), count)).collect()
    }

    #[test]
    fn what_is_written_is_read() {
        let written = Counts {
            rustc: "rustc 1.2.3".into(),
            processor: "pdp11".into(),
            instructions: counts(&[("a-b", 12), ("c", 3)]),
        };
        assert_eq!(toml::from_str::<Counts>(&written.text()).as_ref(), Ok(&written));
        let other = Counts { rustc: "rustc 1.2.4".into(), ..written };
        let text = other.text().replace("1.2.4", "1.2.3");
        let known: Counts = toml::from_str(&text).expect("counts");
        assert_eq!(
            known.differs(&other).as_deref(),
            Some("counted with the compiler rustc 1.2.3, here it is rustc 1.2.4")
        );
        assert_eq!(other.differs(&other), None);
    }

    /// A twentieth more is borne, anything beyond is not; fewer are.
    #[test]
    fn more_instructions_fail() {
        let known = counts(&[("a", 1000)]);
        for (count, expected) in [(1000, true), (1049, true), (1060, false), (500, true)] {
            let (report, is_good) = compare(&known, &counts(&[("a", count)]));
            assert_eq!(is_good, expected, "{report}");
        }
        assert!(!compare(&known, &counts(&[("b", 1)])).1);
    }

    #[test]
    fn the_count_is_found() {
        let text =
            "==1== \n==1== Events    : Ir\n==1== Collected : 275094752\n==1== I   refs:      275,094,752\n";
        assert_eq!(collected(text), Some(275_094_752));
        assert_eq!(collected("nothing"), None);
    }
}
