//! The rivals that come as Python packages: an interpreter, a virtual environment, pinned versions.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::contestant::{Absent, Contestant};
use super::league::About;
use super::places::Places;
use super::shell;

/// The interpreter that every pinned package has a wheel for; `bpy` 5.0.1 has none for any other.
const PYTHON: &str = "3.11";

/// What the scripts themselves need; `bpy` wants a numpy below 2, which in turn has no wheels for newer interpreters.
const SUPPORT: &[&str] = &["numpy==1.26.4", "scipy==1.17.1"];
const SUPPORT_WITHOUT_BPY: &[&str] = &["numpy==2.4.6", "scipy==1.17.1"];

/// Package, pinned version, prefix of its methods in `rival.py`, how quads reach it.
const RIVALS: &[(&str, &str, &str, &str)] = &[
    ("libigl", "2.6.3", "libigl", "triangles, fans as by libigl"),
    ("bpy", "5.0.1", "blender", "quads, cut inside"),
    ("xatlas", "0.0.11", "xatlas", "triangles, fans"),
    ("uvunwrap", "0.3.0", "uvunwrap", "triangles with their polygons, fans"),
];

/// The virtual environment and what is in it.
pub(super) struct Interpreter {
    pub(super) program: PathBuf,
    pub(super) version: String,
    pub(super) packages: Vec<Package>,
}

/// A rival's package.
pub(super) struct Package {
    name: &'static str,
    prefix: &'static str,
    input: &'static str,
    /// Name and version, or why it is not there.
    pub(super) installed: Result<String, String>,
}

/// Makes the virtual environment and installs what is missing in it.
pub(super) fn prepare(places: &Places, chosen: Option<&Path>, install: bool) -> Result<Interpreter, String> {
    let program = places.venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if install {
        make(places, &program, chosen)?;
    }
    let version =
        version(&program).ok_or("there is no virtual environment yet: run once without --no-install")?;
    for package in support(&version) {
        add(places, &program, package, install).map_err(|error| {
            format!("{error} (Python {version}; Python {PYTHON} is known to do, see --python)")
        })?;
    }
    let packages = RIVALS.iter().map(|&(name, pin, prefix, input)| {
        let installed = add(places, &program, &format!("{name}=={pin}"), install).map_err(|error| {
            format!("{error} ({name} {pin} is known to install with Python {PYTHON}; this is {version})")
        });
        Package { name, prefix, input, installed: installed.map(|()| format!("{name} {pin}")) }
    });
    let packages = packages.collect();
    Ok(Interpreter { program, version: format!("Python {version}"), packages })
}

/// A virtual environment of the best interpreter at hand; one of another interpreter is replaced.
fn make(places: &Places, program: &Path, chosen: Option<&Path>) -> Result<(), String> {
    let present = version(program);
    if chosen.is_none() && present.as_deref().is_some_and(is_exact) {
        return Ok(());
    }
    let base = find(chosen)?;
    if present.is_some() && present == version(&base) {
        return Ok(());
    }
    eprintln!("making a virtual environment with {}", base.display());
    let mut command = Command::new(&base);
    command.args(["-m", "venv", "--clear"]).arg(&places.venv).envs(places.install_environment());
    shell::output(&mut command)
        .map(drop)
        .map_err(|error| format!("no virtual environment ({error}); Debian has the module in python3-venv"))
}

fn is_exact(version: &str) -> bool {
    version.strip_prefix(PYTHON).is_some_and(|rest| rest.starts_with('.'))
}

fn support(version: &str) -> &'static [&'static str] {
    if is_exact(version) { SUPPORT } else { SUPPORT_WITHOUT_BPY }
}

/// An interpreter for the virtual environment: the wanted version, else any that can at least run the scripts.
fn find(chosen: Option<&Path>) -> Result<PathBuf, String> {
    if let Some(path) = chosen {
        return version(path).map(|_| path.to_owned()).ok_or(format!("{} is no Python", path.display()));
    }
    let exact = PathBuf::from(format!("python{PYTHON}"));
    let candidates = [exact, PathBuf::from("python3"), PathBuf::from("python")];
    let versions = candidates.iter().filter_map(|path| Some((path, version(path)?)));
    let mut found: Vec<(&PathBuf, String)> = versions.collect();
    found.sort_by_key(|(_, version)| !is_exact(version));
    let Some((path, version)) = found.first() else {
        return Err(format!(
            "no Python found: install Python {PYTHON} (bpy needs just that), or name it with --python"
        ));
    };
    if !is_exact(version) {
        eprintln!(
            "Python {PYTHON} was not found (bpy needs it); going on with {version}: some rivals will be absent"
        );
    }
    Ok((*path).clone())
}

/// The full version, `None` when the program does not run.
fn version(program: &Path) -> Option<String> {
    let script = "import platform; print(platform.python_version())";
    shell::output(Command::new(program).args(["-c", script])).ok().map(|text| text.trim().to_owned())
}

fn add(places: &Places, python: &Path, package: &str, install: bool) -> Result<(), String> {
    let (name, pin) = package.split_once("==").unwrap_or((package, ""));
    let script = format!("import importlib.metadata as m; print(m.version('{name}'))");
    let there = shell::output(Command::new(python).args(["-c", &script]));
    if there.is_ok_and(|version| version.trim() == pin) {
        return Ok(());
    }
    if !install {
        return Err(format!("{name} {pin} is not installed: run without --no-install"));
    }
    eprintln!("installing {name} {pin}");
    let mut command = Command::new(python);
    command.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--only-binary",
        ":all:",
    ]);
    // Without the supporting pins in sight, a rival's dependencies would replace them.
    let version = version(python).unwrap_or_default();
    command.arg(package).args(support(&version)).envs(places.install_environment());
    shell::output(&mut command).map(drop)
}

/// The methods of the packages that are there, and the packages that are not.
pub(super) fn contestants(places: &Places, interpreter: &Interpreter) -> (Vec<Contestant>, Vec<Absent>) {
    let script = places.scripts.join("rival.py");
    let listed = shell::output(
        Command::new(&interpreter.program).arg(&script).arg("--list").envs(places.run_environment()),
    )
    .unwrap_or_default();
    let (mut present, mut absent) = (Vec::new(), Vec::new());
    for package in &interpreter.packages {
        if let Err(why) = &package.installed {
            absent.push(Absent { tool: package.name.to_owned(), why: why.clone() });
            continue;
        }
        for method in listed.lines().filter(|method| method.starts_with(package.prefix)) {
            present.push(Contestant {
                name: method.to_owned(),
                ours: false,
                input: package.input,
                program: interpreter.program.clone(),
                leading: vec![script.clone().into(), method.into()],
            });
        }
    }
    (present, absent)
}

/// What a mesh is, by the script's own reader.
pub(super) fn inspect(places: &Places, interpreter: &Interpreter, mesh: &Path) -> Result<About, String> {
    let mut command = Command::new(&interpreter.program);
    command.arg(places.scripts.join("mesh.py")).arg(mesh).envs(places.run_environment());
    let text = shell::output(&mut command).map_err(|error| format!("{}: {error}", mesh.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", mesh.display()))
}
