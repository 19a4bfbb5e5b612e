//! What the program says about itself.

use crate::workplace::Workplace;

#[test]
fn every_help_has_examples_and_exit_codes() {
    let place = Workplace::new();
    for line in [
        "--help",
        "fit --help",
        "check --help",
        "nagata --help",
        "apatch --help",
        "query --help",
        "render --help",
        "shapes --help",
    ] {
        let help = place.succeed(line);
        for part in ["Examples:\n  smoothpatch ", "Exit codes:\n  0  success"] {
            assert!(help.contains(part), "`{line}` lacks {part:?}:\n{help}");
        }
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    let version = concat!("smoothpatch ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!(Workplace::new().succeed("--version"), version);
}
