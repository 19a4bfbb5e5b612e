//! What the colours stand for, and where the numbers come from.

use anyhow::{anyhow, bail};
use smoothpatch::FieldSource;
use smoothpatch::basemesh::SurfaceTarget;
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings};
use smoothpatch::pictures::{deviation_scale, symmetric_scale, values};
use smoothpatch::render::{Hit, Patches, Scale, Shade, Value};

use super::options::{PictureOptions, ShadeName};
use super::source::Source;

/// How the surfaces of all files are coloured.
pub(crate) struct Shading<'a> {
    kind: Kind<'a>,
    /// For people.
    pub(crate) meaning: String,
    pub(crate) scale: Option<Scale>,
}

/// A number at each point of a surface.
type Number<'a> = Box<dyn Fn(&Hit) -> Option<f64> + Sync + 'a>;

enum Kind<'a> {
    Plain(Shade<'static>),
    /// A function of the point for each file.
    Numbers(Vec<Number<'a>>),
}

impl Shading<'_> {
    /// Calls `f` with the shade of a file.
    pub(crate) fn with_shade<T>(&self, file: usize, f: impl FnOnce(Shade<'_>) -> T) -> T {
        match (&self.kind, self.scale) {
            (Kind::Numbers(of_files), Some(scale)) => f(Shade::Values(&*of_files[file], scale)),
            (Kind::Plain(shade), _) => f(*shade),
            (Kind::Numbers(_), None) => unreachable!("invariant: numbers have a scale"),
        }
    }
}

/// What the options ask for, if the files have it.
pub(crate) fn choose<'a>(
    sources: &'a [Source],
    options: &PictureOptions,
    field: Option<&'a dyn ImplicitSurface>,
) -> anyhow::Result<Shading<'a>> {
    if options.range.is_some()
        && !matches!(options.shade, ShadeName::Curvature | ShadeName::Deviation)
    {
        bail!("--range is used with --shade curvature and --shade deviation only");
    }
    let stripes = options.stripes;
    let plain = |shade, meaning: &str| Shading {
        kind: Kind::Plain(shade),
        meaning: meaning.into(),
        scale: None,
    };
    match options.shade {
        ShadeName::Zebra => Ok(plain(Shade::Zebra(stripes), "reflection lines")),
        ShadeName::Isophotes => Ok(plain(Shade::Isophotes(stripes), "isophotes")),
        ShadeName::Normals => {
            Ok(plain(Shade::Normals, "normals: red to the right, green up, blue to you"))
        }
        ShadeName::Curvature => curvature(sources, options),
        ShadeName::Deviation => deviation(sources, options, field),
    }
}

fn curvature<'a>(sources: &'a [Source], options: &PictureOptions) -> anyhow::Result<Shading<'a>> {
    if let Some(source) = sources.iter().find(|source| !source.has_curvature) {
        bail!(
            "{}: flat cells have no curvature, and the file has no point data `mean_curvature`",
            source.name
        );
    }
    let of_file =
        |source: &'a Source| -> Number<'a> { Box::new(|hit| source.patches.mean_curvature(hit)) };
    let functions: Vec<_> = sources.iter().map(of_file).collect();
    let found = numbers(sources, &functions);
    let mut scale = symmetric_scale(&found).ok_or_else(|| anyhow!("no point has a curvature"))?;
    if let Some([low, high]) = options.range {
        scale = Scale { low, high, ..scale };
    }
    let meaning = format!(
        "mean curvature, from {} (convex) to {} (concave) per unit of length",
        short(scale.low),
        short(scale.high)
    );
    Ok(Shading { kind: Kind::Numbers(functions), meaning, scale: Some(scale) })
}

fn deviation<'a>(
    sources: &'a [Source],
    options: &PictureOptions,
    field: Option<&'a dyn ImplicitSurface>,
) -> anyhow::Result<Shading<'a>> {
    let mut functions: Vec<Number<'a>> = Vec::new();
    for source in sources {
        functions.push(match (field, &source.deviation) {
            (Some(field), _) => {
                let target = FieldSource::new(field, source.diagonal, ProjectionSettings::default());
                Box::new(move |hit| {
                    Some(target.foot(hit.point)?.point.distance(hit.point) / source.diagonal)
                })
            }
            (None, Some(of_patches)) => Box::new(|hit| of_patches.get(hit.patch).copied()),
            (None, None) => bail!(
                "{}: the file has no deviations; name the surface with --scene, --shape or --formula",
                source.name
            ),
        });
    }
    let found = numbers(sources, &functions);
    let scale = match options.range {
        Some([low, _]) if low <= 0.0 => bail!("--range: a scale in powers of ten begins above 0"),
        Some([low, high]) => {
            deviation_scale(&[low, high]).map(|scale| Scale { low, high, ..scale })
        }
        None => deviation_scale(&found),
    };
    let scale = scale.ok_or_else(|| anyhow!("all deviations are 0: there is nothing to see"))?;
    let of = if field.is_some() { "at each point" } else { "largest of each patch, from the file" };
    let largest = found.last().copied().unwrap_or(0.0);
    let meaning = format!(
        "deviation {of}, from {:.0e} to {:.0e} of the diagonal; {} is the largest of some points",
        scale.low,
        scale.high,
        short(largest)
    );
    Ok(Shading { kind: Kind::Numbers(functions), meaning, scale: Some(scale) })
}

/// The numbers of all files, ascending.
fn numbers(sources: &[Source], functions: &[Number<'_>]) -> Vec<f64> {
    let of_file = |(source, function): (&Source, &Number<'_>)| {
        let (patches, value): (&dyn Patches, Value<'_>) = (&*source.patches, &**function);
        values(patches, value)
    };
    let mut all: Vec<f64> = sources.iter().zip(functions).flat_map(of_file).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Three digits.
fn short(value: f64) -> String {
    let text = format!("{value:.2e}");
    if (1e-2..1e4).contains(&value.abs()) { format!("{value:.3}") } else { text }
}
