//! What machine this is.

use serde::{Deserialize, Serialize};

/// Enough to judge times by; no date, no name, no path.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct Machine {
    pub(crate) processor: String,
    pub(crate) threads: usize,
    pub(crate) memory_gib: Option<u64>,
    pub(crate) system: String,
}

pub(crate) fn describe() -> Machine {
    let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
    let processor =
        field(&read("/proc/cpuinfo"), "model name").unwrap_or_else(|| "unknown processor".to_owned());
    let memory = field(&read("/proc/meminfo"), "MemTotal")
        .and_then(|value| value.trim_end_matches("kB").trim().parse::<u64>().ok());
    Machine {
        processor,
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        memory_gib: memory.map(|kilobytes| (kilobytes + (1 << 19)) >> 20),
        system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
    }
}

/// The value of the first `name : value` line.
pub(crate) fn field(text: &str, name: &str) -> Option<String> {
    text.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == name).then(|| value.trim().to_owned())
    })
}
