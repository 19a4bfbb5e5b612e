//! `smoothpatch query`: closest points and rays on a cylinder.

use crate::nagata::cylinder;
use crate::workplace::Workplace;

/// How far the curved cylinder is from the round one: its edges turn by 15°.
const CLOSE: f64 = 1e-4;

fn place() -> Workplace {
    let place = Workplace::new();
    place.write("can.obj", cylinder(24));
    place
}

/// The numbers of a table under its line of names; empty fields are not a number.
fn numbers(table: &str, names: &str) -> Vec<Vec<f64>> {
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some(names), "{table}");
    lines.map(|line| line.split(',').map(|x| x.parse().unwrap_or(f64::NAN)).collect()).collect()
}

#[test]
fn closest_points_have_signed_distances() {
    let place = place();
    place.write("points.csv", "x,y,z\n3,0,0.25\n0.0 -0.9 0.1\n# above\n0.2;0.1;2.5\n");
    place.succeed("query can.obj --points points.csv -o closest.csv");
    let table = String::from_utf8(place.read("closest.csv")).unwrap();
    let names = "row,signed_distance,x,y,z,normal_x,normal_y,normal_z,face,u,v";
    let rows = numbers(&table, names);
    let expected = [
        [2.0, 1.0, 0.0, 0.25, 1.0, 0.0, 0.0],
        [-0.1, 0.0, -1.0, 0.1, 0.0, -1.0, 0.0],
        [1.5, 0.2, 0.1, 1.0, 0.0, 0.0, 1.0],
    ];
    assert_eq!(rows.len(), expected.len(), "{table}");
    for (k, (row, expected)) in rows.iter().zip(expected).enumerate() {
        assert_eq!(row[0], k as f64, "{table}");
        for (value, expected) in row[1..8].iter().zip(expected) {
            assert!((value - expected).abs() < 10.0 * CLOSE, "{row:?}, not {expected:?}");
        }
    }
}

#[test]
fn rays_hit_once_or_through_and_through() {
    let place = place();
    // through the axis, past the can, along the axis
    place.write("rays.csv", "3,0.1,0.2,-1,0,0\n3,0,5,-1,0,0\n0.1,0.2,4,0,0,-2\n");
    let names = "row,t,x,y,z,normal_x,normal_y,normal_z,face,u,v";
    let first = numbers(&place.succeed("query can.obj --rays rays.csv"), names);
    let rows: Vec<(f64, f64)> = first.iter().map(|row| (row[0], row[1])).collect();
    let side = (1.0 - 0.01_f64).sqrt();
    for ((row, t), expected) in [rows[0], rows[2]].iter().zip([(0.0, 3.0 - side), (2.0, 1.5)]) {
        assert_eq!(*row, expected.0, "{rows:?}");
        assert!((t - expected.1).abs() < CLOSE, "{t}, not {}", expected.1);
    }
    assert!(rows.len() == 3 && rows[1].0 == 1.0 && rows[1].1.is_nan(), "no hit: {rows:?}");
    let all = place.succeed("query can.obj --rays rays.csv --all-hits");
    let all = numbers(&all, names);
    assert_eq!(all.iter().map(|row| row[0]).collect::<Vec<_>>(), [0.0, 0.0, 1.0, 2.0, 2.0]);
    assert!(all[1][5] < -0.9 && all[4][7] < -0.9, "normals point outwards: {all:?}");
}

#[test]
fn bad_tables_name_the_line_and_leave_nothing() {
    let place = place();
    place.write("five.csv", "0,0,1,0,0,1\n1,2,3,4,5\n");
    place.write("word.csv", "x,y,z\n1,2,three\n");
    place.write("still.csv", "0,0,0,0,0,0\n");
    for (arguments, fragments) in [
        ("--rays five.csv", ["five.csv: line 2", "6 numbers"]),
        ("--points word.csv", ["word.csv: line 2", "three"]),
        ("--rays still.csv", ["still.csv: line 1", "direction"]),
        ("--points none.csv", ["none.csv", ""]),
    ] {
        let before = place.everything();
        let run = place.run(&format!("query can.obj {arguments} -o out.csv"));
        assert_eq!(run.code, 2, "{run:?}");
        for fragment in fragments {
            assert!(run.stderr.contains(fragment), "{fragment} in {}", run.stderr);
        }
        assert_eq!(place.everything(), before, "{arguments}");
    }
}
