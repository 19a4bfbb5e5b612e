//! `smoothpatch query`: closest points and ray hits on a curved mesh.

mod table;

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::{ArgGroup, Args};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::nagata::{PatchPoint, Ray, SurfaceQueries};

use crate::arguments::EXIT_CODES;
use crate::exit::Outcome;
use crate::nagata::options::SurfaceOptions;
use crate::nagata::task::Task;
use crate::output_files::{OutputFiles, write_file};
use crate::stdout::print;
use table::{Rows, read};

/// Find closest points or ray hits on a curved mesh
///
/// The mesh is curved as by `smoothpatch nagata`. Both files are tables with three or six numbers a
/// line, separated by commas, semicolons or spaces; a first line with names and lines that start with
/// # are skipped.
///
/// The result is a table, too: `row` counts the lines of numbers from 0 and `face` the faces of the mesh
/// from 0. `u` and `v` are the weights of the first two corners in a triangle, and run from the first
/// corner to the second and to the last in a quadrilateral. For a ray without a hit they are empty.
#[derive(Args)]
#[command(
    group = ArgGroup::new("what").required(true),
    after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"),
)]
pub(crate) struct QueryArguments {
    #[command(flatten)]
    surface: SurfaceOptions,

    /// Points (x,y,z): the closest point of the surface for each, with its signed distance, negative
    /// behind the surface
    #[arg(long, value_name = "POINTS.csv", group = "what")]
    points: Option<PathBuf>,

    /// Rays (origin and direction: x,y,z,dx,dy,dz): the first hit of each
    #[arg(long, value_name = "RAYS.csv", group = "what")]
    rays: Option<PathBuf>,

    /// All hits of each ray, in order, instead of the first
    #[arg(long, requires = "rays")]
    all_hits: bool,

    /// Where to write the table [default: the standard output]
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  smoothpatch query mesh.obj --points points.csv
  smoothpatch query mesh.obj --continuity g1 --rays rays.csv -o hits.csv
  smoothpatch query lens.obj --normals file --rays rays.csv --all-hits";

/// Names of the columns that describe a point of the surface.
const POINT: &str = "x,y,z,normal_x,normal_y,normal_z,face,u,v";

pub(crate) fn run(arguments: &QueryArguments) -> anyhow::Result<Outcome> {
    let inputs = [&arguments.points, &arguments.rays].into_iter().flatten();
    let inputs: Vec<_> = inputs.map(PathBuf::as_path).collect();
    if let Some(path) = &arguments.output {
        let files = OutputFiles::table(path)?;
        files.check_places()?;
        files.check_distinct([inputs, arguments.surface.files_read()].concat())?;
    }
    let table = match (&arguments.points, &arguments.rays) {
        (Some(path), _) => closest(&arguments.surface, &read::<3>(path)?)?,
        (None, Some(path)) => hits(&arguments.surface, &read::<6>(path)?, arguments.all_hits)?,
        (None, None) => bail!("give --points or --rays"),
    };
    match &arguments.output {
        Some(path) => drop(write_file(path, |out| out.write_all(table.as_bytes()))?),
        None => print(&table)?,
    }
    Ok(Outcome::Success)
}

fn closest(options: &SurfaceOptions, points: &Rows<3>) -> anyhow::Result<String> {
    let task = Task::new(options, None)?;
    let queries = SurfaceQueries::new(&task.surface);
    let mut table = format!("row,signed_distance,{POINT}\n");
    for (row, &(line, point)) in points.rows.iter().enumerate() {
        let Some(found) = queries.closest(DVec3::from_array(point)) else {
            bail!("{}: line {line}: there is no closest point", points.path.display());
        };
        let distance = found.signed_distance;
        let place = described(&found.at, found.face.index());
        writeln!(table, "{row},{distance:?},{place}")?;
    }
    Ok(table)
}

fn hits(options: &SurfaceOptions, rays: &Rows<6>, all: bool) -> anyhow::Result<String> {
    let checked = rays.rows.iter().map(|&(line, [x, y, z, dx, dy, dz])| {
        let ray = Ray { origin: DVec3::new(x, y, z), direction: DVec3::new(dx, dy, dz) };
        if !ray.is_valid() {
            bail!("{}: line {line}: the direction must not be zero", rays.path.display());
        }
        Ok(ray)
    });
    let checked = checked.collect::<anyhow::Result<Vec<_>>>()?;
    let task = Task::new(options, None)?;
    let queries = SurfaceQueries::new(&task.surface);
    let mut table = format!("row,t,{POINT}\n");
    for (row, ray) in checked.iter().enumerate() {
        let hits =
            if all { queries.hits(ray) } else { queries.first_hit(ray).into_iter().collect() };
        if hits.is_empty() {
            writeln!(table, "{row}{}", ",".repeat(10))?;
        }
        for hit in hits {
            writeln!(table, "{row},{:?},{}", hit.t, described(&hit.at, hit.face.index()))?;
        }
    }
    Ok(table)
}

/// The columns [`POINT`]; without a normal, three of them are empty.
fn described(at: &PatchPoint, face: usize) -> String {
    let numbers = |v: DVec3| format!("{:?},{:?},{:?}", v.x, v.y, v.z);
    let normal = at.normal.map_or(",,".to_owned(), numbers);
    let [u, v] = at.parameters;
    format!("{},{normal},{face},{u:?},{v:?}", numbers(at.point))
}
