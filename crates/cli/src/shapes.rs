//! `smoothpatch shapes`: what has a name.

use clap::Args;
use serde::Serialize;
use smoothpatch::implicit::{NamedShape, catalogue};

use crate::arguments::EXIT_CODES;
use crate::exit::Outcome;
use crate::stdout::{print, print_json};
use crate::table::Table;
use crate::values::region_text;

/// List the named shapes with formula, region and genus
#[derive(Args)]
#[command(after_help = format!("\
Examples:
  smoothpatch shapes
  smoothpatch shapes --json

{EXIT_CODES}"))]
pub(crate) struct ShapesArguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &ShapesArguments) -> anyhow::Result<Outcome> {
    if arguments.json {
        print_json(&catalogue().iter().map(Entry::new).collect::<Vec<_>>())?;
    } else {
        print(&catalogue().iter().map(describe).collect::<Vec<_>>().join("\n"))?;
    }
    Ok(Outcome::Success)
}

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    formula: &'static str,
    region: [[f64; 3]; 2],
    genus: Option<u32>,
}

impl Entry {
    fn new(shape: &NamedShape) -> Self {
        let region = [shape.region.min.to_array(), shape.region.max.to_array()];
        Self { name: shape.name, formula: shape.formula, region, genus: shape.genus }
    }
}

fn describe(shape: &NamedShape) -> String {
    let mut table = Table::default();
    table.row("formula", shape.formula);
    table.row("region", region_text(&shape.region));
    match shape.genus {
        Some(genus) => table.row("genus", genus),
        None => table.row("genus", "depends on its parameters"),
    }
    format!("{}\n{table}", shape.name)
}
