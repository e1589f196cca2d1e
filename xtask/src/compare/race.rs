//! The runs: every method in a process of its own, in alternating order, timed and bounded.

use std::collections::hash_map::DefaultHasher;
use std::hash::Hasher;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::contestant::Contestant;
use super::numbers::median;
use super::ours;
use super::places::Places;
use super::python::Interpreter;
use super::shell;

/// `qparam unwrap` wrote UVs, but flips or overlaps remain: a result to be measured, not a failure.
const WRITTEN_BUT_INVALID: i32 = 7;

/// How to run.
pub(super) struct Race<'a> {
    pub(super) places: &'a Places,
    pub(super) interpreter: &'a Interpreter,
    pub(super) runs: u32,
    pub(super) timeout: f64,
}

/// What a method came in with: medians over its runs.
pub(super) struct Finish {
    /// The result of the last run.
    pub(super) output: PathBuf,
    pub(super) solve_seconds: f64,
    pub(super) process_seconds: f64,
    pub(super) cpu_seconds: f64,
    pub(super) peak_memory_bytes: u64,
    /// Whether all runs wrote the same bytes.
    pub(super) repeatable: bool,
}

/// One run.
struct Lap {
    account: Account,
    cost: Cost,
    hash: u64,
}

/// The report of `launch.py`.
#[derive(Deserialize)]
struct Cost {
    status: i32,
    timed_out: bool,
    wall_seconds: f64,
    cpu_seconds: f64,
    peak_memory_bytes: u64,
}

/// What a process says of itself: the report of a rival.
#[derive(Debug, Deserialize, PartialEq)]
pub(super) struct Account {
    pub(super) solve_seconds: f64,
    /// None where the system does not tell.
    pub(super) peak_memory_bytes: Option<u64>,
}

impl Race<'_> {
    /// Runs all methods on a mesh; one entry a method, a message for those that fail.
    pub(super) fn run(
        &self,
        contestants: &[Contestant],
        mesh: &Path,
        folder: &Path,
    ) -> Result<Vec<Result<Finish, String>>, String> {
        // Results of earlier runs must not pass for results of this one.
        let _ = std::fs::remove_dir_all(folder);
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let mut laps: Vec<Result<Vec<Lap>, String>> = contestants.iter().map(|_| Ok(Vec::new())).collect();
        for round in 0..self.runs {
            for i in order(contestants.len(), round) {
                let Ok(done) = &mut laps[i] else { continue };
                match self.lap(&contestants[i], mesh, folder) {
                    Ok(lap) => done.push(lap),
                    Err(message) => {
                        eprintln!("  {}: {message}", contestants[i].name);
                        laps[i] = Err(message);
                    }
                }
            }
        }
        let finish = |(contestant, laps): (&Contestant, Result<Vec<Lap>, String>)| {
            laps.map(|laps| Finish::of(&laps, folder.join(format!("{}.obj", contestant.name))))
        };
        Ok(contestants.iter().zip(laps).map(finish).collect())
    }

    fn lap(&self, contestant: &Contestant, mesh: &Path, folder: &Path) -> Result<Lap, String> {
        let file = |ending: &str| folder.join(format!("{}.{ending}", contestant.name));
        let (output, report, cost) = (file("obj"), file("json"), file("cost.json"));
        let (stdout, stderr) = (file("out"), file("err"));
        let _ = std::fs::remove_file(&output);
        let mut command = Command::new(&self.interpreter.program);
        command.arg(self.places.scripts.join("launch.py")).arg(&cost).arg(self.timeout.to_string());
        command.args([&stdout, &stderr]).arg("--").args(contestant.command(mesh, &output, &report));
        command.current_dir(folder).envs(self.places.run_environment());
        shell::output(&mut command)?;

        let read = |path: &Path| std::fs::read_to_string(path).map_err(|error| error.to_string());
        let cost: Cost = serde_json::from_str(&read(&cost)?).map_err(|error| error.to_string())?;
        if cost.timed_out {
            return Err(format!("no result within {} s", self.timeout));
        }
        if cost.status != 0 && !(contestant.ours && cost.status == WRITTEN_BUT_INVALID) {
            let said = std::fs::read(&stderr)
                .ok()
                .and_then(|bytes| shell::complaint(&String::from_utf8_lossy(&bytes)));
            return Err(said.map_or_else(|| ended(cost.status), |said| self.without_paths(&said, mesh)));
        }
        let account = if contestant.ours {
            ours::own_account(&read(&stdout)?).ok_or("its report names no time")?
        } else {
            serde_json::from_str(&read(&report)?).map_err(|error| error.to_string())?
        };
        let mut hasher = DefaultHasher::new();
        hasher.write(&std::fs::read(&output).map_err(|error| format!("no output: {error}"))?);
        Ok(Lap { account, cost, hash: hasher.finish() })
    }

    /// A message without the folders of this machine.
    fn without_paths(&self, message: &str, mesh: &Path) -> String {
        let folder = |path: &Path| format!("{}{}", path.display(), std::path::MAIN_SEPARATOR);
        let message = message.replace(&folder(&self.places.root), "");
        mesh.parent().map_or(message.clone(), |parent| message.replace(&folder(parent), ""))
    }
}

/// Forward and backward in turn, so that what warms up or wears out the machine hits all alike.
pub(super) fn order(count: usize, round: u32) -> Vec<usize> {
    if round.is_multiple_of(2) { (0..count).collect() } else { (0..count).rev().collect() }
}

fn ended(status: i32) -> String {
    if status < 0 {
        format!("ended by signal {}", -status)
    } else {
        format!("exit code {status}, no message")
    }
}

impl Lap {
    fn peak_memory_bytes(&self) -> u64 {
        self.account.peak_memory_bytes.unwrap_or(self.cost.peak_memory_bytes)
    }
}

impl Finish {
    fn of(laps: &[Lap], output: PathBuf) -> Self {
        let middle = |value: &dyn Fn(&Lap) -> f64| median(laps.iter().map(value).collect());
        Self {
            output,
            solve_seconds: middle(&|lap| lap.account.solve_seconds),
            process_seconds: middle(&|lap| lap.cost.wall_seconds),
            cpu_seconds: middle(&|lap| lap.cost.cpu_seconds),
            peak_memory_bytes: middle(&|lap| lap.peak_memory_bytes() as f64) as u64,
            repeatable: laps.iter().all(|lap| lap.hash == laps[0].hash),
        }
    }
}
