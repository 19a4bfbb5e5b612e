//! `smoothpatch join`: several files as one surface.

use std::path::{Path, PathBuf, absolute};

use anyhow::{Context, bail};
use clap::Args;
use smoothpatch::io::{read_piece_file, write_pvtu};

use crate::arguments::EXIT_CODES;
use crate::exit::Outcome;
use crate::output_files::{OutputFiles, extension, write_file};
use crate::stdout::print;
use crate::table::{Table, bytes};

/// Join several .vtu files into one surface for viewers
///
/// Writes a small .pvtu file that names the pieces, which stay where they are: beside it or in
/// folders below. All pieces must have the same cell data.
#[derive(Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub(crate) struct JoinArguments {
    /// The pieces
    #[arg(value_name = "PIECE.vtu", required = true)]
    pieces: Vec<PathBuf>,

    /// Where to write
    #[arg(short, long, value_name = "FILE.pvtu")]
    output: PathBuf,

    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  smoothpatch join left.vtu right.vtu -o whole.pvtu";

pub(crate) fn run(arguments: &JoinArguments) -> anyhow::Result<Outcome> {
    let output = &arguments.output;
    if extension(output) != "pvtu" {
        bail!("-o {}: the name of joined pieces must end with .pvtu", output.display());
    }
    let files = OutputFiles::single(output);
    files.check_places()?;
    files.check_distinct(arguments.pieces.iter().map(PathBuf::as_path).collect())?;
    let mut pieces = Vec::with_capacity(arguments.pieces.len());
    for path in &arguments.pieces {
        pieces.push((beside(path, output)?, read_piece_file(path)?));
    }
    let written = write_file(output, |out| Ok(write_pvtu(out, &pieces)?))?;
    if !arguments.quiet {
        let mut table = Table::default();
        table.row("pieces", pieces.len());
        table.row("cells", pieces.iter().map(|(_, piece)| piece.cells).sum::<usize>());
        table.row("wrote", format!("{} ({})", written.file.display(), bytes(written.bytes)));
        print(&table.to_string())?;
    }
    Ok(Outcome::Success)
}

/// The path of a piece as the joining file names it.
fn beside(piece: &Path, output: &Path) -> anyhow::Result<String> {
    let (piece_place, output_place) = (absolute(piece)?, absolute(output)?);
    let folder = output_place.parent().unwrap_or(Path::new("/"));
    let Ok(relative) = piece_place.strip_prefix(folder) else {
        bail!(
            "{}: pieces must lie beside {} or in folders below; move one of them",
            piece.display(),
            output.display()
        );
    };
    let text = relative.to_str().context("the name of a piece is not text")?;
    Ok(text.replace('\\', "/"))
}
