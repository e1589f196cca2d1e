//! Where the comparison keeps its things: all below `target/compare`.

use std::path::{Path, PathBuf};

/// The folders of the comparison.
pub(super) struct Places {
    /// The workspace.
    pub(super) root: PathBuf,
    /// Cargo's target folder.
    pub(super) target: PathBuf,
    /// Scripts and sources of the comparison.
    pub(super) scripts: PathBuf,
    /// The virtual environment.
    pub(super) venv: PathBuf,
    /// Results as data.
    pub(super) data: PathBuf,
    /// Meshes from formulas.
    pub(super) meshes: PathBuf,
    /// One folder a mesh, in it one set of files a method.
    pub(super) runs: PathBuf,
    /// What tools write uncalled for: caches, settings, temporary files.
    pub(super) scratch: PathBuf,
}

impl Places {
    pub(super) fn new() -> Result<Self, String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new(".")).to_owned();
        let target =
            std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |path| root.join(path));
        let own = target.join("compare");
        let places = Self {
            scripts: root.join("xtask").join("compare"),
            venv: own.join("venv"),
            meshes: own.join("meshes"),
            data: own.clone(),
            runs: own.join("runs"),
            scratch: own.join("scratch"),
            root,
            target,
        };
        for folder in [&places.meshes, &places.runs, &places.home(), &places.temporary()] {
            std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        Ok(places)
    }

    fn home(&self) -> PathBuf {
        self.scratch.join("home")
    }

    fn temporary(&self) -> PathBuf {
        self.scratch.join("tmp")
    }

    /// The binary that the C++ rivals are compiled into.
    pub(super) fn cgal(&self) -> PathBuf {
        self.target.join("compare").join(format!("cgal{}", std::env::consts::EXE_SUFFIX))
    }

    /// Environment that keeps caches and temporary files of an installation in place.
    pub(super) fn install_environment(&self) -> Vec<(&'static str, PathBuf)> {
        vec![
            ("PIP_CACHE_DIR", self.scratch.join("pip")),
            ("TMPDIR", self.temporary()),
            ("PYTHONDONTWRITEBYTECODE", PathBuf::from("1")),
        ]
    }

    /// Environment of the runs: a home of their own as well.
    pub(super) fn run_environment(&self) -> Vec<(&'static str, PathBuf)> {
        let mut environment = self.install_environment();
        environment.extend([
            ("HOME", self.home()),
            ("XDG_CACHE_HOME", self.scratch.join("cache")),
            ("XDG_CONFIG_HOME", self.scratch.join("config")),
            ("BLENDER_USER_RESOURCES", self.scratch.join("blender")),
        ]);
        environment
    }
}
