//! How many threads work.

use crate::exit::Exit;
use crate::failure::Failure;

/// Runs `work` on a pool of `threads`; 0 takes the one that is there.
pub(crate) fn with<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    if threads == 0 {
        return Ok(work());
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| {
        Failure::new(Exit::Computation, format!("{threads} threads could not be started"))
            .cause(&error)
            .help("ask for fewer with --threads")
    })?;
    Ok(pool.install(work))
}
