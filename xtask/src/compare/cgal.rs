//! CGAL, through the small C++ program beside the scripts, compiled when the headers are there.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::contestant::Contestant;
use super::places::Places;
use super::shell;

const INSTALL: &str = "install CGAL 5 or newer and Eigen 3 with their headers (Debian: libcgal-dev and libeigen3-dev) \
                       and a C++17 compiler";

/// The compiled program.
pub(super) struct Cgal {
    pub(super) version: String,
    binary: PathBuf,
    methods: Vec<String>,
}

/// Compiles the program unless that is done; otherwise says why there is none, and the way out.
pub(super) fn build(places: &Places) -> Result<Cgal, String> {
    let source = places.scripts.join("cgal.cpp");
    let binary = places.cgal();
    if !is_newer(&binary, &source) {
        compile(&source, &binary, places)?;
    }
    let methods = shell::output(Command::new(&binary).arg("--list"))?.lines().map(str::to_owned).collect();
    let version = shell::output(Command::new(&binary).arg("--version"))?.trim().to_owned();
    Ok(Cgal { version, binary, methods })
}

fn compile(source: &Path, binary: &Path, places: &Places) -> Result<(), String> {
    let prefixes = ["/usr/include", "/usr/local/include", "/opt/homebrew/include"].map(Path::new);
    if !prefixes.iter().any(|prefix| prefix.join("CGAL/Surface_mesh_parameterization").exists()) {
        return Err(format!("no CGAL headers: {INSTALL}"));
    }
    let Some(eigen) = prefixes.iter().map(|prefix| prefix.join("eigen3")).find(|path| path.exists()) else {
        return Err(format!("no Eigen headers: {INSTALL}"));
    };
    eprintln!("compiling the CGAL rivals");
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "c++".to_owned());
    let mut command = Command::new(compiler);
    command.args(["-std=c++17", "-O3", "-DNDEBUG", "-DCGAL_EIGEN3_ENABLED"]);
    for prefix in prefixes.iter().skip(1).filter(|prefix| prefix.join("CGAL").exists()) {
        command.arg("-isystem").arg(prefix);
    }
    command.arg("-isystem").arg(eigen).arg(source).arg("-o").arg(binary).args(["-lgmp", "-lmpfr"]);
    command.envs(places.install_environment());
    shell::output(&mut command).map(drop).map_err(|error| format!("did not compile ({error}): {INSTALL}"))
}

fn is_newer(file: &Path, than: &Path) -> bool {
    let changed = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    matches!((changed(file), changed(than)), (Some(file), Some(than)) if file > than)
}

impl Cgal {
    pub(super) fn contestants(&self) -> Vec<Contestant> {
        let contestant = |method: &String| Contestant {
            name: method.clone(),
            ours: false,
            input: "triangles, CGAL's own cut",
            program: self.binary.clone(),
            leading: vec![method.into()],
        };
        self.methods.iter().map(contestant).collect()
    }
}
