//! One surface, or two side by side, with a legend.

use anyhow::anyhow;
use smoothpatch::render::{
    Camera, Colour, Patches, Picture, Style, draw as draw_patches, frame, legend,
};

use super::options::PictureOptions;
use super::shading::Shading;
use super::source::Source;

pub(crate) fn draw(
    sources: &[Source],
    shading: &Shading<'_>,
    options: &PictureOptions,
) -> anyhow::Result<Picture> {
    let [width, height] = options.size;
    let background = Colour::grey(1.0);
    let legend = shading.scale.map(|scale| legend(&scale, height, background));
    let legend_width = legend.as_ref().map_or(0, |legend| legend.size()[0]);
    // two surfaces do not touch each other when they fill their panels
    let between = if sources.len() > 1 { width / 50 } else { 0 };
    let room = width.saturating_sub(legend_width + between * (sources.len() - 1));
    let panel = [room / sources.len(), height];
    if panel[0] < height / 8 {
        return Err(anyhow!(
            "--size {width}x{height}: the picture is too narrow for what it must show"
        ));
    }
    let patches: Vec<&dyn Patches> =
        sources.iter().map(|source| -> &dyn Patches { &*source.patches }).collect();
    let axes = options.view.axes(options.up.into());
    let framed =
        frame(&patches, axes, panel).ok_or_else(|| anyhow!("the surface has no extent"))?;
    let camera = Camera {
        centre: options.centre.unwrap_or(framed.centre),
        pixels_per_length: framed.pixels_per_length * options.zoom,
        ..framed
    };
    let mut whole = Picture::new([width, height], background);
    for (file, (patches, source)) in patches.iter().zip(sources).enumerate() {
        let drawn = shading.with_shade(file, |shade| {
            let style = Style { edges: options.edges, background, ..Style::new(shade) };
            draw_patches(*patches, &camera, panel, &style)
        });
        let drawn = drawn.map_err(|error| anyhow!("{}: {error}", source.name))?;
        whole.paste(&drawn, [file * (panel[0] + between), 0]);
    }
    if let Some(legend) = legend {
        whole.paste(&legend, [width - legend_width, 0]);
    }
    Ok(whole)
}
