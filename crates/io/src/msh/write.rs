//! From curved elements to text.

use std::io::{self, Write};

use glam::DVec3;

use super::error::MshError;
use super::{MAX_MSH_ORDER, MshOptions, MshVersion};
use crate::curved_mesh::CurvedMesh;
use crate::node_order::{node_order, quad_node_order};
use crate::text::Text;

/// Gmsh's numbers of triangles and quadrilaterals of order 1, 2, …
const TRIANGLE_TYPES: [u32; MAX_MSH_ORDER] = [2, 9, 21, 23, 25, 42, 43, 44, 45, 46];
const QUAD_TYPES: [u32; MAX_MSH_ORDER] = [3, 10, 36, 37, 38, 47, 48, 49, 50, 51];

/// All elements of one kind.
struct Block<'a> {
    what: &'static str,
    msh_type: u32,
    nodes: &'a [usize],
    /// The rank of each node in the order of Gmsh.
    order: Vec<usize>,
}

impl Block<'_> {
    fn elements(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.nodes.chunks_exact(self.order.len())
    }
}

/// Writes a mesh as text, with coordinates from which the same f64 are read back.
///
/// Nodes and elements keep their order, triangles before quadrilaterals, and count from 1. All
/// elements belong to surface 1 and to physical group 1.
///
/// # Errors
///
/// [`MshError`].
pub fn write_msh(
    out: &mut dyn Write,
    mesh: &CurvedMesh,
    options: &MshOptions,
) -> Result<(), MshError> {
    let order = mesh.order;
    if !(1..=MAX_MSH_ORDER).contains(&order) {
        return Err(MshError::Order { order, limit: MAX_MSH_ORDER });
    }
    let name = &options.group;
    if name.is_empty() || name.chars().any(|letter| letter.is_control() || letter == '"') {
        return Err(MshError::Group { name: name.clone() });
    }
    let blocks = [
        Block {
            what: "triangle",
            msh_type: TRIANGLE_TYPES[order - 1],
            nodes: &mesh.triangles,
            order: node_order(order),
        },
        Block {
            what: "quadrilateral",
            msh_type: QUAD_TYPES[order - 1],
            nodes: &mesh.quads,
            order: quad_node_order(order),
        },
    ];
    blocks.iter().try_for_each(|block| check(block, &mesh.points))?;
    let blocks: Vec<_> = blocks.into_iter().filter(|block| !block.nodes.is_empty()).collect();
    let mut text = Text::new(out);
    match options.version {
        MshVersion::V4 => version_4(&mut text, &mesh.points, &blocks, name)?,
        MshVersion::V2 => version_2(&mut text, &mesh.points, &blocks, name)?,
    }
    Ok(text.finish()?)
}

fn check(block: &Block<'_>, points: &[DVec3]) -> Result<(), MshError> {
    let (what, each, count) = (block.what, block.order.len(), points.len());
    if !block.nodes.len().is_multiple_of(each) {
        return Err(MshError::NodeCount { nodes: block.nodes.len(), what, each });
    }
    for (at, &node) in block.nodes.iter().enumerate() {
        let element = at / each;
        match points.get(node) {
            None => return Err(MshError::MissingNode { what, element, node, count }),
            Some(position) if !position.is_finite() => {
                return Err(MshError::NotFinite { what, element, node, position: *position });
            }
            Some(_) => {}
        }
    }
    Ok(())
}

fn version_4(
    text: &mut Text<'_>,
    points: &[DVec3],
    blocks: &[Block<'_>],
    name: &str,
) -> io::Result<()> {
    head(text, "4.1", name)?;
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    text.push("$Entities\n0 0 1 0\n1 ");
    coordinates(text.push(""), low);
    coordinates(text.push(" "), high);
    text.push(" 1 1 0").line()?;
    text.push("$EndEntities\n$Nodes\n1 ").integer(points.len()).push(" 1 ");
    text.integer(points.len()).push("\n2 1 0 ").integer(points.len()).line()?;
    for node in 1..=points.len() {
        text.integer(node).line()?;
    }
    for &point in points {
        coordinates(text, point);
        text.line()?;
    }
    let elements: usize = blocks.iter().map(|block| block.elements().len()).sum();
    text.push("$EndNodes\n$Elements\n").integer(blocks.len()).push(" ").integer(elements);
    text.push(" 1 ").integer(elements).line()?;
    let mut element = 0;
    for block in blocks {
        text.push("2 1 ").integer(block.msh_type).push(" ").integer(block.elements().len());
        text.line()?;
        for nodes in block.elements() {
            element += 1;
            text.integer(element);
            node_list(text, nodes, &block.order)?;
        }
    }
    text.push("$EndElements").line()
}

fn version_2(
    text: &mut Text<'_>,
    points: &[DVec3],
    blocks: &[Block<'_>],
    name: &str,
) -> io::Result<()> {
    head(text, "2.2", name)?;
    text.push("$Nodes\n").integer(points.len()).line()?;
    for (node, &point) in (1_usize..).zip(points) {
        coordinates(text.integer(node).push(" "), point);
        text.line()?;
    }
    let elements: usize = blocks.iter().map(|block| block.elements().len()).sum();
    text.push("$EndNodes\n$Elements\n").integer(elements).line()?;
    let mut element = 0;
    for block in blocks {
        for nodes in block.elements() {
            element += 1;
            text.integer(element).push(" ").integer(block.msh_type).push(" 2 1 1");
            node_list(text, nodes, &block.order)?;
        }
    }
    text.push("$EndElements").line()
}

fn head(text: &mut Text<'_>, version: &str, name: &str) -> io::Result<()> {
    text.push("$MeshFormat\n").push(version).push(" 0 8\n$EndMeshFormat\n");
    text.push("$PhysicalNames\n1\n2 1 \"").push(name).push("\"\n$EndPhysicalNames").line()
}

fn coordinates(text: &mut Text<'_>, point: DVec3) {
    text.real(point.x).push(" ").real(point.y).push(" ").real(point.z);
}

fn node_list(text: &mut Text<'_>, nodes: &[usize], order: &[usize]) -> io::Result<()> {
    for &rank in order {
        text.push(" ").integer(nodes[rank] + 1);
    }
    text.line()
}
