//! VTU files that we did not write, or that something happened to.

#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use std::fmt::Write;

use common::{nets_from, strip};
use io::basemesh::{FaceMap, VertexId};
use io::bezier_core::BezierTriangle;
use io::glam::DVec3;
use io::{
    CellData, CellValues, VtuOptions, VtuReadError, VtuSurface, read_vtu, read_vtu_file, write_vtu,
};

/// Two quadratic patches in a file as other programs write it: points in no particular order, one
/// unused, other number types, extra arrays and elements, the common edge used from both sides.
const FOREIGN: &str = r#"<?xml version="1.0"?>
<!-- written by another program -->
<VTKFile type='UnstructuredGrid' version="2.2" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <UnstructuredGrid>
    <FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1">0.5</DataArray></FieldData>
    <Piece NumberOfPoints="10" NumberOfCells="2">
      <PointData Scalars="height">
        <DataArray type="Float64" Name="height" format="ascii">0 1 2 3 4 5 6 7 8 9</DataArray>
      </PointData>
      <CellData>
        <DataArray type="Float32" Name="small" format="ascii">0.1 -2</DataArray>
        <DataArray type="UInt8" Name="flag">1 0</DataArray>
        <DataArray type="Float64" Name="vector" NumberOfComponents="3">1 2 3 4 5 6</DataArray>
        <Array type="String" Name="label">97 0 98 0</Array>
      </CellData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii" RangeMin="0">
          9 9 9   0.1 0 0   1 0 0   1 1 0   0 1 0
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">0.1</Value>
          </InformationKey>
          0.5 0 0   1 .5 0   .5 .5 <![CDATA[1]]>   .5 1 0   0 .5 0
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int32" Name="connectivity" format="ascii">1 2 3 5 6 7   3 4 1 8 9 7</DataArray>
        <DataArray type="UInt64" Name="offsets" format="ascii">6 12</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">76 76</DataArray>
        <DataArray type="Int64" Name="faces" format="ascii"/>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
"#;

fn read(text: &str) -> Result<VtuSurface<6>, VtuReadError> {
    read_vtu(&mut text.as_bytes())
}

#[test]
fn a_foreign_file() {
    let surface = read(FOREIGN).unwrap();
    let corners: Vec<_> = surface
        .topology
        .faces()
        .map(|f| surface.topology.corners(f).map(VertexId::index))
        .collect();
    // points 1, 2, 3, 4 are the corners
    assert_eq!(corners, [[0, 1, 2], [2, 3, 0]]);
    let net = surface.nets.as_slice()[1].net();
    let x = f64::from(0.1_f32);
    #[rustfmt::skip]
    let expected = [
        [1.0, 1.0, 0.0],
        [0.5, 1.0, 0.0], [0.5, 0.5, 1.0],
        [0.0, 1.0, 0.0], [0.0, 0.5, 0.0], [x, 0.0, 0.0],
    ];
    assert_eq!(net.map(|p| p.to_array()), expected);
    let small = CellValues::Float64(vec![x, -2.0]);
    assert_eq!(
        surface.cell_data,
        [
            CellData { name: "small".into(), values: small },
            CellData { name: "flag".into(), values: CellValues::Int64(vec![1, 0]) },
        ]
    );
    assert_eq!(surface.skipped, ["height", "vector", "label"]);
}

/// The foreign file with binary connectivity of this text.
fn with_binary(header_type: &str, byte_order: &str, base64: &str) -> String {
    let array = format!(r#"Name="connectivity" format="binary">  {base64}  <"#);
    FOREIGN
        .replace(r#"Name="connectivity" format="ascii">1 2 3 5 6 7   3 4 1 8 9 7<"#, &array)
        .replace(r#" compressor="vtkZLibDataCompressor""#, "")
        .replace("UInt32", header_type)
        .replace("LittleEndian", byte_order)
}

#[test]
fn binary_headers_and_byte_orders() {
    use base64::Engine;
    let encode = |bytes: &[u8]| base64::engine::general_purpose::STANDARD.encode(bytes);
    let expected = read(FOREIGN).unwrap();
    let ids = [1, 2, 3, 5, 6, 7, 3, 4, 1, 8, 9, 7_i32];
    let little: Vec<u8> = ids.iter().flat_map(|id| id.to_le_bytes()).collect();
    let big: Vec<u8> = ids.iter().flat_map(|id| id.to_be_bytes()).collect();
    let joined = |header: &[u8], bytes: &[u8]| encode(&[header, bytes].concat());
    let (le4, le8, be4) = (48_u32.to_le_bytes(), 48_u64.to_le_bytes(), 48_u32.to_be_bytes());
    let variants = [
        with_binary("UInt32", "LittleEndian", &joined(&le4, &little)),
        with_binary("UInt64", "LittleEndian", &joined(&le8, &little)),
        with_binary("UInt32", "BigEndian", &joined(&be4, &big)),
        // byte count encoded by itself
        with_binary("UInt32", "LittleEndian", &(encode(&le4) + &encode(&little))),
        with_binary("UInt64", "LittleEndian", &(encode(&le8) + "\n" + &encode(&little))),
    ];
    for variant in variants {
        assert_eq!(read(&variant).unwrap(), expected, "{variant}");
    }
    let refused = |text: String| read(&text).unwrap_err().to_string();
    let short = with_binary("UInt32", "LittleEndian", &joined(&le4, &little[..44]));
    assert_eq!(
        refused(short),
        "the array 'connectivity' announces 48 bytes but has 44; the file is damaged or truncated"
    );
    let other_header = with_binary("UInt64", "LittleEndian", &joined(&le4, &little));
    assert!(refused(other_header).contains("announces"));
    let not_base64 = with_binary("UInt32", "LittleEndian", "MAAAAA*=");
    assert!(refused(not_base64).starts_with("the array 'connectivity' is not base64 ("));
    let odd = with_binary("UInt32", "LittleEndian", &joined(&3_u32.to_le_bytes(), &little[..3]));
    assert_eq!(refused(odd), "the array 'connectivity' has 3 bytes, not a multiple of 4");
    assert!(refused(with_binary("UInt32", "LittleEndian", "MA==")).contains("too short"));
    let compressed = with_binary("UInt32", "LittleEndian", &joined(&le4, &little))
        .replace("<VTKFile", r#"<VTKFile compressor="vtkLZ4DataCompressor""#);
    assert!(refused(compressed).starts_with(
        "the array 'connectivity' is compressed, which is not supported: re-save with compressor"
    ));
}

#[test]
fn refusals_say_what_to_do() {
    let check = |old: &str, new: &str, expected: &str| {
        assert!(FOREIGN.contains(old), "{old}");
        let message = read(&FOREIGN.replacen(old, new, 1)).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}");
    };
    check("'UnstructuredGrid'", "'PolyData'", "the attribute type=\"PolyData\" is not valid;");
    check(
        r#"format="ascii">6"#,
        r#"format="appended" offset="one">6"#,
        "the attribute offset=\"one\" is not valid; expected a whole number",
    );
    check(r#"format="ascii">6"#, r#"format="hex">6"#, "the attribute format=\"hex\"");
    check("    </Piece>", "</Piece><Piece>", "several pieces are not supported: re-save as one");
    check("NumberOfPoints=\"10\"", "NumberOfPoints=\"-1\"", "the attribute NumberOfPoints=\"-1\"");
    check(
        "NumberOfPoints=\"10\"",
        "NumberOfPoints=\"99999999999999\"",
        "the array 'Points' has 10",
    );
    check("NumberOfCells=\"2\"", "NumberOfCells=\"3\"", "the array 'types' has 2 values where 3");
    check("76 76", "76 5", "cell 1 has type 5; expected 76 like cell 0 (76 is");
    check("76 76", "76 69", "cell 1 has type 69; expected 76 like cell 0");
    check("76 76", "5 76", "cell 0 has type 5; expected 76 or 69 (76 is a Bézier triangle");
    check("6 12", "6 16", "cell 1 has 10 points; expected 6 (degree 2); read the file with");
    check("6 12", "12 6", "cell 0 has 12 points; expected 6");
    check("1 2 3 5 6 7", "1 2 3 5 6 77", "cell 0 uses point 77, but there are only 10 points");
    check("1 2 3 5 6 7", "1 2 3 5 6 -7", "cell 0 uses point -7, but there are only 10 points");
    check("1 2 3 5 6 7", "1 2 3 5 6", "the array 'connectivity' has 11 point ids for 2 cells");
    check("1 2 3 5 6 7", "1 2 3 5 x 7", "the array 'connectivity' is damaged at value 4: 'x'");
    check("1 2 3 5 6 7", "2 1 3 5 6 7", "faces 0 and 1 disagree about the orientation of edge 0-2");
    check(".5 1 0", ".5 nan 0", "cell 1 uses point 8 at [0.5, NaN, 0], which is not finite;");
    check(
        "\"Float32\" Name=\"Points\"",
        "\"Int32\" Name=\"Points\"",
        "the array 'Points' has type",
    );
    check("Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\"", "the array 'Points' does");
    check("Name=\"offsets\"", "Name=\"ends\"", "there is no array 'offsets' in <Cells>;");
    check("</Points>", "", "line ");
    check("<Value index", "<Value index=\"0\" & x", "line 20: ");
    check("<Value index=\"0\"", "<Value index=0", "line 20: ");
    check(".5 .5 <!", ".5 &amp; .5 <!", "line 22: unexpected '&amp;' among numbers");
    check("0.1 -2", "0.1", "the array 'small' has 1 values where 2 are announced");
    check(
        "Scalars=\"height\"",
        "RationalWeights=\"height\"",
        "rational patches are not supported: re-save as polynomial patches",
    );
    let rational = FOREIGN
        .replace("Scalars=\"height\"", "RationalWeights=\"height\"")
        .replace("0 1 2 3 4 5 6 7 8 9", "1 1 1 1 1 1 1 1 1 1");
    assert!(read(&rational).is_ok(), "weights of one change nothing");
}

/// The foreign file with connectivity and offsets behind the XML, as these bytes.
fn with_appended(attributes: &str, offsets: [usize; 2], blocks: &[u8]) -> Vec<u8> {
    let [connectivity, ends] = offsets.map(|at| format!(r#"format="appended" offset="{at}"><"#));
    let text = FOREIGN
        .replace(r#" compressor="vtkZLibDataCompressor""#, "")
        .replace(r#"format="ascii">1 2 3 5 6 7   3 4 1 8 9 7<"#, &connectivity)
        .replace(r#"format="ascii">6 12<"#, &ends)
        .replace("</VTKFile>", &format!("<AppendedData {attributes}>\n   _"));
    [text.as_bytes().trim_ascii(), blocks, b"\n  </AppendedData>\n</VTKFile>\n"].concat()
}

#[test]
fn appended_data() {
    use base64::Engine;
    let encode = |bytes: &[u8]| base64::engine::general_purpose::STANDARD.encode(bytes);
    let expected = read(FOREIGN).unwrap();
    let ids: Vec<u8> =
        [1, 2, 3, 5, 6, 7, 3, 4, 1, 8, 9, 7_i32].iter().flat_map(|id| id.to_le_bytes()).collect();
    let ends: Vec<u8> = [6, 12_u64].iter().flat_map(|end| end.to_le_bytes()).collect();
    let headers = [48_u32.to_le_bytes(), 16_u32.to_le_bytes()];
    let joined = [[&headers[0], ids.as_slice()].concat(), [&headers[1], ends.as_slice()].concat()];

    // bytes between the blocks that look like the end
    let odd = b"</AppendedData></VTKFile>\xff\x00<AppendedData>";
    let raw = [joined[0].as_slice(), odd, &joined[1]].concat();
    let raw_offsets = [0, joined[0].len() + odd.len()];
    let text = joined.each_ref().map(|block| encode(block));
    let apart = [encode(&headers[0]) + &encode(&ids), encode(&headers[1]) + &encode(&ends)];
    for (attributes, offsets, blocks) in [
        (r#"encoding="raw""#, raw_offsets, raw.clone()),
        (r#"encoding="base64""#, [0, text[0].len()], text.concat().into_bytes()),
        ("", [0, text[0].len()], text.concat().into_bytes()),
        (r#"encoding="base64""#, [0, apart[0].len()], apart.concat().into_bytes()),
    ] {
        let file = with_appended(attributes, offsets, &blocks);
        assert_eq!(read_vtu::<6>(&mut file.as_slice()).unwrap(), expected, "{attributes}");
    }

    let refused = |attributes: &str, offsets: [usize; 2], blocks: &[u8]| {
        let file = with_appended(attributes, offsets, blocks);
        read_vtu::<6>(&mut file.as_slice()).unwrap_err().to_string()
    };
    for (attributes, offsets, blocks, message) in [
        ("encoding='hex'", [0, 0], raw.as_slice(), "the attribute encoding=\"hex\" is not valid"),
        ("encoding='raw'", [0, 9999], &raw, "the array 'offsets' begins at byte 9999 of 1"),
        ("encoding='raw'", [0, 0], &raw, "the array 'offsets' has 6 values where 2 are announced"),
        ("encoding='raw'", [0, 0], &raw[..20], "the array 'offsets' announces 48 bytes but has "),
        ("", [0, 0], &text[0].as_bytes()[..30], "the array 'offsets' announces 48 bytes but has "),
        ("", [0, 0], b"*", "the array 'offsets' is too short"),
        ("", [0, 0], b"*AAA*AAA*AAA", "the array 'offsets' is not base64 ("),
    ] {
        let found = refused(attributes, offsets, blocks);
        assert!(found.starts_with(message), "{found}");
    }
    let none = FOREIGN
        .replace(r#" compressor="vtkZLibDataCompressor""#, "")
        .replace(r#"format="ascii">6 12<"#, r#"format="appended" offset="0"><"#);
    assert!(read(&none).unwrap_err().to_string().contains("there is no <AppendedData>"));
    let bare = FOREIGN.replace("</VTKFile>", "<AppendedData> AAAA </AppendedData></VTKFile>");
    assert!(read(&bare).unwrap_err().to_string().starts_with("there is no '_' before"));
    let error = read_vtu::<6>(&mut [b'<', 0xff].as_slice()).unwrap_err();
    assert!(error.to_string().starts_with("line 1: the bytes are not UTF-8"), "{error}");
}

#[test]
fn neighbours_with_points_of_their_own() {
    // the second cell has its own copy of point 7, the middle of the common edge
    let own = FOREIGN.replace("3 4 1 8 9 7", "3 4 1 8 9 0").replace("9 9 9 ", ".5 .5 1 ");
    assert_eq!(read(&own).unwrap().nets, read(FOREIGN).unwrap().nets);
    let torn = FOREIGN.replace("3 4 1 8 9 7", "3 4 1 8 9 0");
    let message = read(&torn).unwrap_err().to_string();
    assert!(message.starts_with("faces 1 and 0 disagree about point 1 of 2 of their edge "));
}

#[test]
fn every_truncation_is_refused() {
    let end = FOREIGN.rfind("</VTKFile>").unwrap();
    for at in 0..end + "</VTKFile".len() {
        if let Some(part) = FOREIGN.get(..at) {
            assert!(read(part).is_err(), "{at}");
        }
    }
    let cut = &FOREIGN[..FOREIGN.find("<Cells>").unwrap()];
    assert_eq!(
        read(cut).unwrap_err().to_string(),
        "the file ends inside <Piece>; it is truncated, so write it again"
    );
    assert!(read("").is_err());
    assert!(read("not XML at all").is_err());
}

#[test]
fn empty_and_absurd_files() {
    let mut text = String::from("<VTKFile type=\"UnstructuredGrid\">");
    (0..50_000).for_each(|_| text.push_str("<a>"));
    assert!(matches!(read(&text), Err(VtuReadError::Truncated { .. })));
    let mut cells = String::new();
    for (name, kind) in [("connectivity", "Int64"), ("offsets", "Int64"), ("types", "UInt8")] {
        write!(cells, "<DataArray type=\"{kind}\" Name=\"{name}\"/>").unwrap();
    }
    let none = format!(
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\
         <Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><Points><DataArray type=\"Float64\" \
         NumberOfComponents=\"3\"/></Points><Cells>{cells}</Cells></Piece></UnstructuredGrid></VTKFile>"
    );
    let message = read(&none).unwrap_err().to_string();
    assert!(message.starts_with("the mesh has no faces"), "{message}");
}

#[test]
fn files_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.vtu");
    let message = read_vtu_file::<6>(&path).unwrap_err().to_string();
    assert!(message.starts_with(&format!("{}: cannot read: ", path.display())), "{message}");
    let nets: FaceMap<BezierTriangle<DVec3, 6>> = nets_from(&strip(), || DVec3::X);
    let write = |nets: &FaceMap<_>| {
        io::write_atomically(&path, |out| {
            Ok(write_vtu(out, &strip(), nets, &VtuOptions::default())?)
        })
    };
    write(&nets).unwrap();
    assert_eq!(read_vtu_file::<6>(&path).unwrap().nets, nets);
    let before = std::fs::read(&path).unwrap();
    let mut broken = nets.clone();
    broken.as_mut_slice()[0].net_mut()[0].x = 2.0;
    let message = write(&broken).unwrap_err().to_string();
    assert!(message.contains("a.vtu: faces 0 and 1 disagree about their vertex 4"), "{message}");
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
}
