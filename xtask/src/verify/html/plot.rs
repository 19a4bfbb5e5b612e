//! Errors over the length of edges, both in logarithms.

use anyhow::{Result, anyhow};
use plotters::prelude::*;

use crate::study::{Errors, Level, Variant, variant_name};

/// Width and height of the drawing, scaled by the page.
const SIZE: (u32, u32) = (560, 420);

/// An error that is plotted.
pub(super) struct Figure {
    pub(super) title: &'static str,
    pub(super) of: fn(&Errors) -> Option<f64>,
    /// Below this an error is that of the measurement.
    pub(super) rounding: f64,
}

/// Which surfaces are shown, and their colours.
const LINES: [(Variant, RGBColor); 5] = [
    (Variant::Published, RGBColor(200, 90, 30)),
    (Variant::Refined, RGBColor(25, 95, 165)),
    (Variant::PublishedG0, RGBColor(225, 170, 90)),
    (Variant::Interpolant4, RGBColor(160, 160, 160)),
    (Variant::Interpolant7, RGBColor(90, 90, 90)),
];

/// One surface at all levels: lengths of edges and errors.
struct Line {
    variant: Variant,
    colour: RGBColor,
    points: Vec<(f64, f64)>,
}

/// A drawing (SVG) of one figure.
pub(super) fn plot(figure: &Figure, levels: &[Level]) -> Result<String> {
    let lines: Vec<Line> = LINES
        .into_iter()
        .map(|(variant, colour)| Line {
            variant,
            colour,
            points: points(levels, variant, figure.of),
        })
        .filter(|line| !line.points.is_empty())
        .collect();
    let mut svg = String::new();
    draw(&mut svg, figure, &lines).map_err(|error| anyhow!("{}: {error}", figure.title))?;
    Ok(svg)
}

fn points(
    levels: &[Level],
    variant: Variant,
    figure: fn(&Errors) -> Option<f64>,
) -> Vec<(f64, f64)> {
    let point = |level: &Level| {
        let error = level.errors.get(&variant).and_then(figure)?;
        // in lengths of the edges of a surface with one face
        let edge = (level.faces as f64).powf(-0.5);
        (error > 0.0 && error.is_finite()).then_some((edge, error))
    };
    levels.iter().filter_map(point).collect()
}

/// Slope of the line with the least squares in logarithms, over the last three points above rounding.
fn slope(points: &[(f64, f64)], rounding: f64) -> Option<f64> {
    let above: Vec<(f64, f64)> =
        points.iter().filter(|(_, y)| *y > rounding).map(|(x, y)| (x.ln(), y.ln())).collect();
    let last = &above[above.len().saturating_sub(3)..];
    let count = last.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| last.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let square: f64 = last.iter().map(|p| (p.0 - x).powi(2)).sum();
    let product: f64 = last.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    (last.len() >= 2 && square > 0.0).then(|| product / square)
}

fn draw(
    svg: &mut String,
    figure: &Figure,
    lines: &[Line],
) -> Result<(), Box<dyn std::error::Error>> {
    let all = || lines.iter().flat_map(|line| &line.points);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let low = all().map(of).fold(f64::INFINITY, f64::min);
        let high = all().map(of).fold(0.0, f64::max);
        (low, high)
    };
    let ((left, right), (low, high)) = (range(|p| p.0), range(|p| p.1));
    let area = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let decade = |x: f64| 10.0_f64.powf(x);
    let vertical = decade(low.log10().floor())..decade(high.log10().ceil());
    let mut chart = ChartBuilder::on(&area)
        .caption(figure.title, ("sans-serif", 18))
        .margin(8)
        .x_label_area_size(38)
        .y_label_area_size(60)
        .build_cartesian_2d((left * 0.8..right * 1.25).log_scale(), vertical.log_scale())?;
    chart
        .configure_mesh()
        .x_desc("edge length: 1 / √faces")
        .bold_line_style(RGBColor(225, 225, 225))
        .light_line_style(TRANSPARENT)
        .label_style(("sans-serif", 13))
        .x_labels(4)
        .x_label_formatter(&|x| format!("{x:.3}"))
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .draw()?;
    for Line { variant, colour, points } in lines {
        let order =
            slope(points, figure.rounding).map_or(String::new(), |slope| format!("  {slope:.1}"));
        let style = colour.stroke_width(2);
        chart
            .draw_series(LineSeries::new(points.iter().copied(), style).point_size(3))?
            .label(format!("{}{order}", variant_name(*variant)))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .background_style(WHITE.mix(0.85))
        .label_font(("sans-serif", 13))
        .draw()?;
    area.present()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_orders() {
        let line =
            |factor: f64| (0..5).map(move |k| (0.5_f64.powi(k), factor * 0.5_f64.powi(6 * k)));
        let found = slope(&line(3.0).collect::<Vec<_>>(), 0.0).expect("a slope");
        assert!((found - 6.0).abs() < 1e-12, "{found}");
        // what is left is rounding: it does not count
        let mut points: Vec<_> = line(1e-9).collect();
        points.push((0.5_f64.powi(5), 1e-15));
        points.push((0.5_f64.powi(6), 1e-15));
        let found = slope(&points, 2e-14).expect("a slope");
        assert!((found - 6.0).abs() < 1e-9, "{found}");
        assert_eq!(slope(&points[..1], 0.0), None, "one point has no slope");
    }
}
