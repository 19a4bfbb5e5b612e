//! `cargo xtask verify --html`: everything on one page that needs nothing else.

mod picture;
mod plot;

use std::path::Path;

use anyhow::{Context, Result};
use smoothpatch::io::Method;

use super::cases::Case;
use super::{Row, present};
use crate::schemes;
use crate::study::{self, Convergence};
use crate::table::escaped;
use plot::Figure;

/// Levels for the plots, if the study was not run as a whole.
const FACES: usize = 2000;

/// What is plotted: distances over the diagonal and angles in degrees.
const FIGURES: [Figure; 2] = [
    Figure { title: "largest distance", of: |errors| Some(errors.max), rounding: 2e-14 },
    Figure { title: "largest normal angle", of: |errors| errors.normal_deg, rounding: 1e-10 },
];

/// What is shown.
pub(super) struct Page<'a> {
    pub(super) good: bool,
    pub(super) rows: &'a [Row],
    pub(super) schemes: &'a [schemes::Row],
    /// The scenes that are drawn.
    pub(super) cases: &'a [Case],
    /// From the study; small levels are measured if there are none.
    pub(super) convergence: Vec<Convergence>,
}

impl Page<'_> {
    /// Writes the page to `path`, or to `target/verify/verify.html`.
    pub(super) fn write(&self, path: Option<&Path>) -> Result<()> {
        let usual = crate::root().join("target/verify/verify.html");
        let path = path.unwrap_or(&usual);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        std::fs::write(path, self.text()?).with_context(|| path.display().to_string())?;
        println!("page written to {}", path.display());
        Ok(())
    }

    fn text(&self) -> Result<String> {
        let verdict = if self.good { "Everything holds." } else { "Not everything holds." };
        let class = if self.good { "good" } else { "bad" };
        let mut text = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>smoothpatch: verification</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
             <h1>Verification</h1>\n<p class=\"{class}\">{verdict}</p>\n<p>Written by <code>cargo xtask \
             verify --html</code>. Distances over the diagonal of the bounding box, angles in \
             degrees.</p>\n"
        );
        if !self.rows.is_empty() {
            text += "<h2>Splines fitted to the scenes</h2>\n";
            text += &present::table(self.rows).html();
            text += &reasons(&present::failures(self.rows));
        }
        if !self.schemes.is_empty() {
            text += "<h2>Patch schemes over given meshes</h2>\n";
            text += &schemes::table(self.schemes).html();
            text += &reasons(&schemes::failures(self.schemes));
        }
        text += &self.plots()?;
        text += &self.pictures()?;
        Ok(text + "</body>\n</html>\n")
    }

    fn plots(&self) -> Result<String> {
        let measured;
        let families = if self.convergence.is_empty() {
            measured = study::convergence(FACES)?;
            &measured
        } else {
            &self.convergence
        };
        let mut text = String::from(
            "<h2>Convergence</h2>\n<p>Errors over the length of edges, which halve from point to point. \
             The numbers are the slopes of lines fitted to the last three points above the rounding of \
             the measurement.</p>\n",
        );
        for family in families {
            let Convergence { family: name, formula, .. } = family;
            text += &format!("<h3>{}: <code>{}</code></h3>\n", escaped(name), escaped(formula));
            text += "<div class=\"row\">\n";
            for figure in &FIGURES {
                text += &format!("<figure>\n{}</figure>\n", plot::plot(figure, &family.levels)?);
            }
            text += "</div>\n";
        }
        Ok(text)
    }

    fn pictures(&self) -> Result<String> {
        let refined: Vec<&Case> =
            self.cases.iter().filter(|case| case.method == Method::Refined).collect();
        if refined.is_empty() {
            return Ok(String::new());
        }
        let mut text = String::from(
            "<h2>Reflection lines</h2>\n<p>Refined method. The stripes are unbroken where tangent planes \
             are continuous.</p>\n<div class=\"row\">\n",
        );
        for case in refined {
            let name = escaped(&case.scene.name);
            match picture::zebra(case) {
                Ok(uri) => {
                    text += &format!(
                        "<figure><img src=\"{uri}\" alt=\"reflection lines on {name}\">\
                         <figcaption>{name}</figcaption></figure>\n"
                    );
                }
                // the table has the reason why a fit failed
                Err(error) => {
                    text += &format!(
                        "<p class=\"bad\">{name}: {}</p>\n",
                        escaped(&format!("{error:#}"))
                    );
                }
            }
        }
        Ok(text + "</div>\n")
    }
}

fn reasons(lines: &str) -> String {
    if lines.is_empty() {
        return String::new();
    }
    format!("<pre class=\"bad\">{}</pre>\n", escaped(lines))
}

const STYLE: &str = "\
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 76rem; margin: 0 auto; padding: 1rem; }
h1, h2, h3 { line-height: 1.2; }
h2 { margin-top: 2.5rem; }
h3 { font-weight: 500; overflow-wrap: anywhere; }
code, pre { font: 0.9em ui-monospace, monospace; }
pre { white-space: pre-wrap; }
.good { color: #1a6b35; font-weight: 600; }
.bad { color: #a11; font-weight: 600; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.6rem; text-align: right; white-space: nowrap; border-bottom: 1px solid #e3e3e3; }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: #fff; }
tr.fail td { background: #fdecea; }
.row { display: flex; flex-wrap: wrap; gap: 1rem; }
figure { margin: 0; flex: 1 1 20rem; max-width: 36rem; }
figcaption { text-align: center; }
img, svg { width: 100%; height: auto; }
";
