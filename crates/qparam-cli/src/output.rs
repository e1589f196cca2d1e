//! Files that are replaced as a whole or not at all.
//!
//! A new file is written beside its target, flushed to the disk, and renamed over it; several, once all are complete.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt::{Interrupt, Phase};

const BUFFER: usize = 1 << 18;

/// Where output goes; shown as messages call it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    Stdout,
    File(PathBuf),
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stdout => f.write_str("<stdout>"),
            Self::File(path) => path.display().fmt(f),
        }
    }
}

impl Target {
    pub(crate) fn new(path: &Path) -> Self {
        if path.as_os_str() == "-" { Self::Stdout } else { Self::File(path.to_owned()) }
    }

    /// Whether both would write the same file, by whatever names and links.
    pub(crate) fn is_same_place(&self, other: &Self) -> bool {
        let real = |path: &Path| {
            let target = real_target(path).ok()?;
            let folder = fs::canonicalize(folder_of(&target)).ok()?;
            Some(folder.join(target.file_name()?))
        };
        match (self, other) {
            (Self::Stdout, Self::Stdout) => true,
            (Self::File(a), Self::File(b)) => a == b || real(a).is_some_and(|a| Some(a) == real(b)),
            _ => false,
        }
    }

    /// Whether it is written to directly, and whoever reads it may be slow: standard output, a pipe, a device.
    pub(crate) fn is_stream(&self) -> bool {
        match self {
            Self::Stdout => true,
            Self::File(path) => is_special(path),
        }
    }

    /// Fails early when the target could not be written anyway: after hours of work would be late.
    pub(crate) fn probe(&self) -> Result<(), Failure> {
        let Self::File(path) = self else { return Ok(()) };
        let refuse = |why: &str, help: &str| {
            Err(Failure::new(Exit::Output, format!("{}: {why}", path.display())).help(help.to_owned()))
        };
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => {
                return refuse("is a folder, not a file", "name a file in it");
            }
            Ok(found) if found.is_file() && found.permissions().readonly() => {
                return refuse("may not be written", "name another file, or change its permissions");
            }
            Ok(found) if !found.is_file() => return Ok(()),
            _ => {}
        }
        let folder = folder_of(&real_target(path).map_err(|error| cannot(path, &error))?);
        // An unnamed file: nothing is left behind, whatever happens.
        tempfile::tempfile_in(&folder).map(drop).map_err(|error| {
            cannot(path, &error).help(format!(
                "the folder {} must exist and be writable; or name another place",
                folder.display()
            ))
        })
    }

    /// Hands `content` a writer; the target changes only when everything went well.
    pub(crate) fn write<T>(
        &self,
        stdout: &mut dyn Write,
        interrupt: &Interrupt,
        content: impl FnOnce(&mut dyn Write) -> io::Result<T>,
    ) -> Result<T, Failure> {
        together(stdout, interrupt, |outputs| outputs.write(self, content))
    }
}

/// Runs `work`, which writes the outputs of a command. Its files are put in their places together, once all are complete; after a
/// failure or an interruption none is. (Where the file system refuses a renaming, the files before are in place already.)
pub(crate) fn together<T>(
    stdout: &mut dyn Write,
    interrupt: &Interrupt,
    work: impl FnOnce(&mut Outputs<'_>) -> Result<T, Failure>,
) -> Result<T, Failure> {
    interrupt.during(Phase::Writing, || {
        let mut outputs = Outputs { stdout, interrupt, complete: Vec::new() };
        let value = work(&mut outputs)?;
        outputs.place()?;
        Ok(value)
    })
}

/// What a command writes. Streams go first: a reader that is slow can be left while there is no file to clean up.
pub(crate) struct Outputs<'a> {
    stdout: &'a mut dyn Write,
    interrupt: &'a Interrupt,
    /// Files beside their targets.
    complete: Vec<Complete>,
}

struct Complete {
    file: NamedTempFile,
    target: PathBuf,
    /// As messages call it.
    name: PathBuf,
}

impl Outputs<'_> {
    /// Hands `content` a writer for `target`.
    pub(crate) fn write<T>(
        &mut self,
        target: &Target,
        content: impl FnOnce(&mut dyn Write) -> io::Result<T>,
    ) -> Result<T, Failure> {
        if self.interrupt.is_requested() {
            return Err(Failure::interrupted());
        }
        let path = match target {
            Target::File(path) if is_special(path) => {
                // A device or a pipe cannot be renamed over.
                let open = || File::options().write(true).open(path);
                return self
                    .stream(|_| open().and_then(|file| passed_on(file, content)))
                    .map_err(|e| cannot(path, &e));
            }
            Target::File(path) => path,
            Target::Stdout => {
                return self.stream(|stdout| passed_on(stdout, content)).map_err(|error| {
                    Failure::new(Exit::Output, "standard output could not be written").cause(&error)
                });
            }
        };
        let (file, value) = beside(path, content).map_err(|error| cannot(path, &error))?;
        self.complete.push(file);
        Ok(value)
    }

    /// Whoever reads may be slow, or wait for ever: the process may end meanwhile, if it leaves nothing behind.
    fn stream<T>(&mut self, work: impl FnOnce(&mut dyn Write) -> T) -> T {
        if !self.complete.is_empty() {
            return work(self.stdout);
        }
        self.interrupt.during(Phase::Free, || work(self.stdout))
    }

    /// In phase [`Phase::Writing`], so that no signal comes between two files.
    fn place(self) -> Result<(), Failure> {
        if self.complete.is_empty() {
            return Ok(());
        }
        if self.interrupt.is_requested() {
            return Err(Failure::interrupted());
        }
        for Complete { file, target, name } in self.complete {
            file.persist(&target).map_err(|error| cannot(&name, &error.error))?;
        }
        self.interrupt.placed();
        Ok(())
    }
}

fn cannot(path: &Path, error: &io::Error) -> Failure {
    Failure::new(Exit::Output, format!("{} could not be written", path.display())).cause(error)
}

fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| !found.is_file())
}

fn passed_on<T>(writer: impl Write, content: impl FnOnce(&mut dyn Write) -> io::Result<T>) -> io::Result<T> {
    let mut writer = BufWriter::with_capacity(BUFFER, writer);
    let result = content(&mut writer).and_then(|value| writer.flush().map(|()| value));
    // Whatever is left in the buffer has nowhere to go, and must not be tried again.
    let _ = writer.into_parts();
    result
}

/// A file beside `path`, complete and on the disk.
fn beside<T>(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<T>,
) -> io::Result<(Complete, T)> {
    let existing = fs::metadata(path).ok();
    let target = real_target(path)?;
    let mut temporary = tempfile::Builder::new();
    temporary.prefix(".qparam-").suffix(".part");
    #[cfg(unix)]
    if existing.is_none() {
        // What any new file gets; the umask takes its part from it.
        temporary.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    }
    let mut file = temporary.tempfile_in(folder_of(&target))?;
    let value = passed_on(file.as_file_mut(), content)?;
    if let Some(existing) = existing {
        // Another owner's permissions may be refused; the content matters more.
        let _ = file.as_file().set_permissions(existing.permissions());
    }
    file.as_file().sync_all()?;
    Ok((Complete { file, target, name: path.to_owned() }, value))
}

/// Behind a symbolic link, the file itself is replaced, and the link stays; also where it dangles.
fn real_target(path: &Path) -> io::Result<PathBuf> {
    const LINKS: usize = 40;
    let mut target = path.to_owned();
    for _ in 0..LINKS {
        match fs::symlink_metadata(&target) {
            Ok(found) if found.is_symlink() => target = folder_of(&target).join(fs::read_link(&target)?),
            _ => return Ok(target),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io;
    use std::path::Path;

    use super::{Interrupt, Target, together};
    use crate::exit::Exit;

    fn write(path: &Path, text: &str) -> Result<(), super::Failure> {
        Target::new(path).write(&mut io::sink(), &Interrupt::new(), |w| w.write_all(text.as_bytes()))
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The old content stays until the new one is complete, and no other file is left.
    #[test]
    fn a_failure_leaves_everything_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        fs::write(&path, "old").unwrap();
        let failure = Target::new(&path)
            .write(&mut io::sink(), &Interrupt::new(), |w| {
                w.write_all(&[b'x'; 1 << 20])?;
                Err::<(), _>(io::Error::other("disk full"))
            })
            .unwrap_err();
        assert_eq!(failure.class, Exit::Output);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.obj"]);
    }

    #[test]
    fn an_interrupted_write_leaves_everything_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        let interrupt = Interrupt::new();
        let result = Target::new(&path).write(&mut io::sink(), &interrupt, |w| {
            interrupt.request();
            w.write_all(b"new")
        });
        assert_eq!(result.unwrap_err().class, Exit::Interrupted);
        assert!(names(folder.path()).is_empty());
    }

    /// Two files: neither where the second fails or a signal comes in between, else both.
    #[test]
    fn several_files_are_placed_together() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| Target::new(&folder.path().join(name)));
        let both = |interrupt: &Interrupt, between: &dyn Fn() -> io::Result<()>| {
            together(&mut io::sink(), interrupt, |outputs| {
                outputs.write(&a, |w| w.write_all(b"a"))?;
                outputs.write(&b, |w| w.write_all(b"b").and_then(|()| between()))
            })
        };
        let failure = both(&Interrupt::new(), &|| Err(io::Error::other("disk full"))).unwrap_err();
        assert_eq!(failure.class, Exit::Output);
        assert!(names(folder.path()).is_empty());
        let interrupt = Interrupt::new();
        let failure = both(&interrupt, &|| {
            interrupt.request();
            Ok(())
        });
        assert_eq!(failure.unwrap_err().class, Exit::Interrupted);
        assert!(names(folder.path()).is_empty());
        both(&Interrupt::new(), &|| Ok(())).unwrap();
        assert_eq!(names(folder.path()), ["a", "b"]);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_survive() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.obj"), folder.path().join("link.obj"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("a.obj", &link).unwrap();
        write(&link, "new").unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    }

    #[test]
    fn impossible_targets_are_found_before_the_work() {
        let folder = tempfile::tempdir().unwrap();
        for path in [folder.path().to_owned(), folder.path().join("missing").join("a.obj")] {
            assert_eq!(Target::new(&path).probe().unwrap_err().class, Exit::Output);
            assert!(write(&path, "x").is_err());
        }
        assert!(Target::new(&folder.path().join("a.obj")).probe().is_ok());
        assert!(names(folder.path()).is_empty(), "probing leaves nothing");
    }
}
