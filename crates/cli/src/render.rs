//! `smoothpatch render`: a picture of patches in a file.

mod options;
mod picture;
mod shading;
mod source;

use std::path::PathBuf;

use anyhow::bail;
use clap::{ArgGroup, Args};

use crate::arguments::EXIT_CODES;
use crate::exit::Outcome;
use crate::output_files::{OutputFiles, extension, write_file};
use crate::stdout::print;
use crate::surface::{SURFACE, SurfaceArguments};
use crate::table::{Table, bytes};
use crate::threads::ThreadArguments;
use options::{PictureOptions, ShadeName};
use smoothpatch::io::write_png;
use source::Source;

/// Draw patches with their true normals
///
/// Reflection lines show what a table of angles cannot: where tangent planes break, the stripes break;
/// where only curvatures jump, they have a kink. The file may hold patches of `fit`, quadratic cells of
/// `nagata`, or flat triangles with normals of `nagata --cells flat` and `apatch`.
#[derive(Args)]
#[command(
    group = ArgGroup::new(SURFACE),
    after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"),
)]
pub(crate) struct RenderArguments {
    /// Patches or cells, as written by `fit`, `nagata` and `apatch`
    #[arg(value_name = "RESULT.vtu")]
    file: PathBuf,

    /// Where to write the picture
    #[arg(short, long, value_name = "FILE.png")]
    output: PathBuf,

    /// A second file, drawn to the right of the first, with the same camera and colours
    #[arg(long, value_name = "OTHER.vtu")]
    compare: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureOptions,

    /// The surface to measure the deviation from (RON)
    #[arg(long, value_name = "SCENE.ron", group = SURFACE)]
    scene: Option<PathBuf>,

    #[command(flatten)]
    surface: SurfaceArguments,

    #[command(flatten)]
    threads: ThreadArguments,

    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  smoothpatch render torus.vtu -o torus.png
  smoothpatch render torus.vtu -o torus.png --shade curvature --view 30,40 --size 800x600
  smoothpatch render torus.vtu -o torus.png --shade deviation --shape torus --edges
  smoothpatch fit --shape torus --faces 100 --method published -o g1.vtu --before-join g0.vtu
  smoothpatch render g0.vtu --compare g1.vtu -o mended.png --zoom 2
  smoothpatch nagata spot.obj --triangulate --continuity g1 --cells flat -o spot.vtu
  smoothpatch render spot.vtu -o spot.png --up y --view front";

pub(crate) fn run(arguments: &RenderArguments) -> anyhow::Result<Outcome> {
    let RenderArguments { file, output, compare, .. } = arguments;
    if extension(output) != "png" {
        bail!("-o {}: the name of a picture must end with .png", output.display());
    }
    let chosen = arguments.surface.scene(arguments.scene.as_deref())?;
    if chosen.is_some() && arguments.picture.shade != ShadeName::Deviation {
        bail!("a surface to compare with is used with --shade deviation only");
    }
    let files = OutputFiles::single(output);
    files.check_places()?;
    let scene = chosen.as_ref().and_then(|chosen| chosen.file.as_deref());
    let inputs = [Some(file.as_path()), compare.as_deref(), scene];
    files.check_distinct(inputs.into_iter().flatten().collect())?;
    arguments.threads.apply()?;
    let field = match &chosen {
        Some(chosen) => Some(smoothpatch::scene::field_of(&chosen.scene.surface)?),
        None => None,
    };
    let names = [Some(file), compare.as_ref()];
    let sources = names
        .into_iter()
        .flatten()
        .map(|name| Source::read(name))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let shading = shading::choose(&sources, &arguments.picture, field.as_deref())?;
    let picture = picture::draw(&sources, &shading, &arguments.picture)?;
    let written = write_file(output, |out| Ok(write_png(out, picture.size(), &picture.bytes())?))?;
    if !arguments.quiet {
        let mut table = Table::default();
        for source in &sources {
            table.row(source.name.clone(), &source.contents);
        }
        table.row("colours", &shading.meaning);
        let [width, height] = picture.size();
        table.row(
            "wrote",
            format!("{} ({width}x{height}, {})", output.display(), bytes(written.bytes)),
        );
        print(&table.to_string())?;
    }
    Ok(Outcome::Success)
}
