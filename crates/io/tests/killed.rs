//! A program that dies while it writes leaves the old file as it was.

#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

use io::write_atomically;

/// Names the folder in the process that is killed.
const FOLDER: &str = "SMOOTHPATCH_TEST_KILLED_FOLDER";

/// Not a test of its own: what the killed process does. Without the variable it does nothing.
#[test]
fn endless_writer() {
    let Some(folder) = env::var_os(FOLDER) else { return };
    let block = [b'x'; 1 << 16];
    write_atomically(Path::new(&folder).join("part.step"), |out| {
        loop {
            out.write_all(&block)?;
            thread::sleep(Duration::from_millis(2));
        }
    })
    .unwrap();
}

/// Bytes of the unfinished file, once there is one.
fn unfinished(folder: &Path) -> Option<u64> {
    let mut files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let file = files.find(|file| file.file_name().to_string_lossy().starts_with(".unfinished"))?;
    Some(file.metadata().unwrap().len())
}

#[test]
fn the_old_file_survives() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.step");
    for old in [None, Some("old and whole")] {
        if let Some(text) = old {
            fs::write(&file, text).unwrap();
        }
        let mut writer = Command::new(env::current_exe().unwrap())
            .args(["--exact", "endless_writer", "--nocapture"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        let start = Instant::now();
        while unfinished(folder.path()).is_none_or(|bytes| bytes == 0) {
            assert!(start.elapsed() < Duration::from_secs(60), "nothing is written");
            thread::sleep(Duration::from_millis(5));
        }
        writer.kill().unwrap();
        writer.wait().unwrap();
        assert_eq!(fs::read_to_string(&file).ok().as_deref(), old, "the file under its name");
        for left in fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()) {
            if left != file {
                fs::remove_file(left).unwrap();
            }
        }
    }
}
