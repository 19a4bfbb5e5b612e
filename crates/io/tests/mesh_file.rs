//! Meshes of other programs: what is read, what is put in order, what is refused.

use io::glam::DVec3;
use io::{MeshFile, MeshFileError, MeshFormat, Repairs, read_mesh, read_mesh_file};

/// A cube of six quadrilaterals, outward, as OBJ.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn read(text: &str, format: MeshFormat) -> Result<MeshFile, MeshFileError> {
    read_mesh(text.as_bytes(), Some(format))
}

fn obj(text: &str) -> MeshFile {
    read(text, MeshFormat::Obj).expect("a mesh")
}

fn refused(text: &str) -> String {
    read(text, MeshFormat::Obj).expect_err("no mesh").to_string()
}

/// Enclosed volume.
fn volume(file: &MeshFile) -> f64 {
    let mesh = &file.mesh;
    let of_face = |face| {
        let [a, b, c]: [DVec3; 3] = mesh.triangle(face);
        a.dot(b.cross(c)) / 6.0
    };
    mesh.topology().faces().map(of_face).sum()
}

#[test]
fn polygons_normals_and_groups() {
    let with_normals =
        CUBE.replace("f 4 3 2 1\n", "vn 0 0 -2\ng floor\nf 4//1 3//1 2//1 1//1\ng walls\n");
    let file = obj(&with_normals);
    assert_eq!((file.mesh.topology().face_count(), file.repairs.polygons), (12, 6));
    assert!((volume(&file) - 1.0).abs() < 1e-15, "nothing is turned: {}", volume(&file));
    assert_eq!(file.groups, ["floor", "walls"]);
    assert_eq!(file.group_of.as_slice(), [0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]);
    let normals = file.corner_normals.expect("some corners have one");
    assert_eq!(normals.as_slice()[1], [Some(DVec3::new(0.0, 0.0, -2.0)); 3]);
    assert_eq!(normals.as_slice()[2], [None; 3]);
}

#[test]
fn what_is_safe_is_done_and_counted() {
    // every face with corners of its own, one face turned, one twice, a vertex and a sliver of no use
    let mut text = String::new();
    let cube = obj(CUBE);
    for (t, [a, b, c]) in cube.mesh.face_indices().into_iter().enumerate() {
        let corners = if t == 5 { [b, a, c] } else { [a, b, c] };
        for corner in corners {
            let DVec3 { x, y, z } = cube.mesh.positions().as_slice()[corner];
            text += &format!("v {x} {y} -{z}\n");
        }
        text += "f -3 -2 -1\n";
    }
    text += "v 9 9 9\nf 1 2 3\nf 1 2 1\n";
    let file = obj(&text);
    let expected = Repairs {
        polygons: 0,
        merged_vertices: 28,
        unused_vertices: 1,
        collapsed_faces: 1,
        double_faces: 1,
        // mirrored by -z: all but the one that was turned before
        turned_faces: 11,
    };
    assert_eq!(file.repairs, expected);
    assert!((volume(&file) - 1.0).abs() < 1e-15, "outward: {}", volume(&file));
    assert_eq!(file.mesh.topology().vertex_count(), 8);
    assert!(!obj(CUBE).repairs.any(), "cutting polygons is no repair");
}

#[test]
fn what_is_not_safe_is_refused_with_numbers() {
    let wing = format!("{CUBE}v 2 2 2\nf 1 2 9\n");
    for (text, message) in [
        (wing.as_str(), "the edge between vertices 0 and 1, [0.5, 0, 0], has 3 faces (0, 2, 6)"),
        (&CUBE.replace("v 1 1 1", "v 1 nan 1"), "line 7: vertex 7 has the position"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "1 faces have no area (0)"),
        ("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", "face 0 cannot be cut into triangles"),
        // three triangles in a ring with half a turn
        (
            "v 0 0 0\nv 0 0 1\nv 2 0 0\nv 2 1 1\nv 1 2 1\nv 1 2 0\nf 1 3 4 2\nf 3 6 5 4\nf 6 2 1\nf 6 1 5\n",
            "the surface has only one side",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n",
            "the faces around vertex 0, [0, 0, 0], meet only in this point",
        ),
    ] {
        let error = refused(text);
        assert!(error.starts_with(message), "{message}\n{error}");
    }
}

#[test]
fn the_same_cube_in_all_formats() {
    let cube = obj(CUBE);
    let (positions, faces) = (cube.mesh.positions().as_slice(), cube.mesh.face_indices());
    let rows = |points: &[DVec3]| {
        points.iter().map(|p| format!("{} {} {}\n", p.x, p.y, p.z)).collect::<String>()
    };
    let triangles = faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect::<String>();
    let off = format!("OFF\n8 12 0\n{}{triangles}", rows(positions));
    let ply = format!(
        "ply\nformat ascii 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n\
         property float z\nelement face 12\nproperty list uchar uint vertex_index\nend_header\n{}{triangles}",
        rows(positions)
    );
    let facet = |corners: &[usize; 3]| {
        let vertices = rows(&corners.map(|v| positions[v]));
        let vertices: String = vertices.lines().map(|row| format!("vertex {row}\n")).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let stl = format!("solid a cube\n{}endsolid\n", faces.iter().map(facet).collect::<String>());
    for (text, format) in [(off, MeshFormat::Off), (ply, MeshFormat::Ply), (stl, MeshFormat::Stl)] {
        // the contents tell, whatever the name says
        let file = read(&text, MeshFormat::Obj).expect("a mesh");
        assert_eq!((file.format, file.repairs), (format, Repairs::default()));
        assert_eq!(file.mesh.topology().vertex_count(), 8, "{format:?}");
        assert!((volume(&file) - 1.0).abs() < 1e-15, "{format:?}");
    }
}

#[test]
fn binary_files() {
    let path = |name: &str| format!("{}/../../fixtures/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    let sphere = read_mesh_file(path("sphere_1280.stl")).expect("binary STL");
    assert_eq!((sphere.mesh.topology().vertex_count(), sphere.repairs), (642, Repairs::default()));
    let torus = read_mesh_file(path("torus_48x24.ply")).expect("PLY, big-endian");
    assert_eq!((torus.mesh.topology().face_count(), torus.repairs.polygons), (2304, 1152));
    let error = read_mesh_file(path("../scenes/torus.ron")).expect_err("no mesh").to_string();
    assert!(error.contains("torus.ron: neither the name nor the contents"), "{error}");
}

#[test]
fn damaged_files() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
               property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
               0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_eq!(read(ply, MeshFormat::Ply).expect("a triangle").mesh.topology().face_count(), 1);
    for (from, to, message) in [
        ("3 0 1 2\n", "3 0 1 7\n", "face 0 uses vertex 7, but there are only 3 vertices"),
        ("3 0 1 2\n", "3 0 1 -1\n", "face 0 uses vertex -1, but there are only 3 vertices"),
        ("3 0 1 2\n", "2 0 1\n", "face 0 has 2 corners"),
        ("property float z\n", "", "the PLY file has no coordinates x, y and z"),
        (
            "element face 1\nproperty list uchar int vertex_indices\n",
            "",
            "the PLY file has no element 'face'",
        ),
        ("int vertex_indices", "int corners", "the PLY file has no list 'vertex_indices'"),
        ("int vertex_indices", "float vertex_indices", "Line"),
        ("0 1 0\n", "0 nan 0\n", "Line 12"),
        ("3 0 1 2\n", "", "Line"),
    ] {
        let error = read(&ply.replacen(from, to, 1), MeshFormat::Ply).expect_err(to).to_string();
        assert!(error.starts_with(message), "{message}\n{error}");
    }
    let stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
               endloop\nendfacet\nendsolid s\n";
    assert_eq!(read(stl, MeshFormat::Stl).expect("a triangle").mesh.topology().face_count(), 1);
    for (from, to, message) in [
        ("vertex 1 0 0", "vertex 1 x 0", "line 5: expected a coordinate, found 'x'"),
        ("endloop\n", "", "line 7: expected endloop, found 'endfacet'"),
        ("endfacet\nendsolid s\n", "", "the file ends where endfacet should follow"),
    ] {
        let error = read(&stl.replacen(from, to, 1), MeshFormat::Stl).expect_err(to).to_string();
        assert!(error.contains(message), "{message}\n{error}");
    }
    let mut binary = vec![0; 84 + 50];
    binary[80] = 2;
    let error = read_mesh(&binary, Some(MeshFormat::Stl)).expect_err("short").to_string();
    assert_eq!(error, "the STL file announces 2 triangles but ends in triangle 1");
}
