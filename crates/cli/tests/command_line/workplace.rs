//! A temporary directory in which the program runs.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// A directory of its own, deleted at the end.
pub(crate) struct Workplace(TempDir);

/// What one run left behind.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Workplace {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// A place with `ball.vtu`, a fitted sphere.
    pub(crate) fn with_ball() -> Self {
        let place = Self::new();
        place.succeed("fit --shape sphere --faces 40 --quiet -o ball.vtu");
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(name), contents).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub(crate) fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// All names and contents, directories without contents.
    pub(crate) fn everything(&self) -> Vec<(String, Option<Vec<u8>>)> {
        let mut all: Vec<_> = fs::read_dir(self.0.path())
            .unwrap()
            .map(|entry| {
                let path = entry.unwrap().path();
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                (name, path.is_file().then(|| fs::read(&path).unwrap()))
            })
            .collect();
        all.sort();
        all
    }

    pub(crate) fn run_with(&self, arguments: &[&str]) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_smoothpatch"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .unwrap();
        let run = Run {
            code: output.status.code().expect("the program was not killed"),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        };
        for text in [&run.stdout, &run.stderr] {
            let odd = text.chars().find(|c| c.is_control() && *c != '\n');
            assert_eq!(odd, None, "a control character in piped output: {text:?}");
        }
        run
    }

    /// Runs a command line whose arguments contain no spaces.
    pub(crate) fn run(&self, line: &str) -> Run {
        self.run_with(&line.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs a command line that must succeed without complaints; returns what it prints.
    pub(crate) fn succeed(&self, line: &str) -> String {
        let run = self.run(line);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{line}\n{}", run.stdout);
        run.stdout
    }

    /// Runs a command line that cannot be carried out, with this in the one message.
    pub(crate) fn fails_with(&self, line: &str, message: &str) {
        let run = self.run(line);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{line}: {}", run.stderr);
        assert!(run.stderr.contains(message), "{line}: {} lacks {message:?}", run.stderr);
    }
}
