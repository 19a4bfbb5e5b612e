//! The Python environment with the readers.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use anyhow::{Context, Result, bail};

/// What pip says if it does not reach a registry.
const NO_NETWORK: [&str; 4] = [
    "NewConnectionError",
    "Temporary failure in name resolution",
    "Network is unreachable",
    "ConnectTimeoutError",
];

/// An environment in which everything is installed.
pub(crate) struct Environment {
    python: PathBuf,
}

impl Environment {
    /// Makes the environment, or takes the one that is there if it was made from the same list.
    ///
    /// The inner error says what this machine lacks.
    pub(crate) fn make(
        python: &Path,
        folder: &Path,
        requirements: &Path,
    ) -> Result<Result<Self, String>> {
        let wanted = fs::read_to_string(requirements)?;
        let (inside, stamp) = (folder.join("bin/python"), folder.join("requirements.txt"));
        if fs::read_to_string(&stamp).is_ok_and(|made| made == wanted) {
            return Ok(Ok(Self { python: inside }));
        }
        match Command::new(python).arg("--version").output() {
            Ok(output) if output.status.success() => {}
            _ => return Ok(Err(format!("there is no {}", python.display()))),
        }
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
        let made = Command::new(python).args(["-m", "venv"]).arg(folder).output()?;
        if !made.status.success() {
            bail!("python3 -m venv failed (Debian: python3-venv): {}", text(&made.stdout));
        }
        let arguments =
            ["-m", "pip", "install", "--disable-pip-version-check", "--no-cache-dir", "-r"];
        let installed = Command::new(&inside).args(arguments).arg(requirements).output()?;
        if !installed.status.success() {
            let problem = text(&installed.stderr);
            if NO_NETWORK.iter().any(|sign| problem.contains(sign)) {
                return Ok(Err("the registry of Python packages is not reached".into()));
            }
            bail!("pip install -r {} failed:\n{problem}", requirements.display());
        }
        fs::write(&stamp, wanted)?;
        Ok(Ok(Self { python: inside }))
    }

    /// Its Python.
    pub(crate) fn program(&self) -> &Path {
        &self.python
    }

    /// Runs all checks at the same time and prints what they say, one after the other.
    pub(super) fn check(&self, scripts: &[PathBuf], samples: &Path) -> Result<bool> {
        let start = Instant::now();
        let mut running = Vec::new();
        for script in scripts {
            let mut command = Command::new(&self.python);
            command
                .arg("-B")
                .arg(script)
                .arg(samples)
                .stdout(Stdio::piped())
                .stderr(Stdio::piped());
            running.push((script, command.spawn().with_context(|| script.display().to_string())?));
        }
        let mut good = true;
        for (script, child) in running {
            let output = child.wait_with_output()?;
            print!("{}", text(&output.stdout));
            if !output.status.success() {
                good = false;
                println!("{} failed\n{}", script.display(), text(&output.stderr));
            }
        }
        println!("checks done after {:.1} s", start.elapsed().as_secs_f64());
        Ok(good)
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
