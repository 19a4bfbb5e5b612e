//! Orders of accuracy, measured on a torus.

mod common;

use meshfield::JetSettings;

#[test]
fn orders() {
    for degree in 2..=4 {
        for power in [0, 1, 2, 3] {
            for n in [12, 24, 48, 96] {
                let e = common::errors(
                    n,
                    &JetSettings { degree, distance_power: power, ..JetSettings::default() },
                );
                println!(
                    "degree {degree} power {power} n {n}: {}",
                    e.map(|x| format!("{x:9.2e}")).join(" ")
                );
            }
        }
    }
}
