//! The work is proportional to the number of triangles.

use std::sync::atomic::Ordering;

use implicit::NamedShape;

use crate::fields::{Counted, mesh_of};

#[test]
fn field_evaluations_per_triangle() {
    // shapes with tight enclosures come near the 4.4 of blocks that are hit at random
    for (name, most_values, most_enclosures) in
        [("sphere", 5.0, 0.1), ("torus", 5.0, 0.1), ("deccube", 7.0, 0.15)]
    {
        let shape = NamedShape::find(name).unwrap();
        for cells in [50, 100, 200] {
            let field = Counted::new(shape.field());
            let mesh = mesh_of(&field, &shape.region, cells).unwrap();
            let faces = mesh.topology().face_count() as f64;
            let values = field.values.load(Ordering::Relaxed) as f64 / faces;
            let enclosures = field.enclosures.load(Ordering::Relaxed) as f64 / faces;
            assert!(
                values < most_values && enclosures < most_enclosures,
                "{name} with {cells} cells: {values} values and {enclosures} enclosures a triangle"
            );
        }
    }
}
