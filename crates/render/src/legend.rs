//! What the colours of numbers mean.

use glam::DVec2;

use crate::colour::Colour;
use crate::glyphs;
use crate::picture::Picture;
use crate::scale::Scale;

/// Space between parts, in heights of a digit.
const GAP: f64 = 0.8;
/// Width of the coloured bar, in heights of a digit.
const BAR: f64 = 1.4;

/// A bar with the colours of a scale and numbers beside it, for a picture of this height; as wide as it
/// must be.
#[must_use]
pub fn legend(scale: &Scale, height: usize, background: Colour) -> Picture {
    let digit = (height as f64 / 50.0).max(9.0);
    let marks: Vec<(f64, String)> =
        scale.marks().into_iter().map(|mark| (mark, text(mark, scale))).collect();
    let widest = marks.iter().map(|(_, text)| glyphs::width(text, digit)).fold(0.0, f64::max);
    let numbers = (GAP + BAR + GAP) * digit;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few digits wide")]
    let width = (numbers + widest + 2.0 * GAP * digit).ceil() as usize;
    let mut picture = Picture::new([width, height], background);
    let (top, bottom) = (0.2 * height as f64, 0.8 * height as f64);
    let bar = GAP * digit..(GAP + BAR) * digit;
    for row in 0..height {
        let t = (bottom - (row as f64 + 0.5)) / (bottom - top);
        if !(0.0..1.0).contains(&t) {
            continue;
        }
        let inside = (0..width).filter(|&column| bar.contains(&(column as f64 + 0.5)));
        inside.for_each(|column| picture.blend(column, row, scale.map.at(t), 1.0));
    }
    let ink = Colour::grey(0.2);
    for (mark, text) in marks {
        let y = bottom - scale.position(mark) * (bottom - top);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "in the picture"
        )]
        let row = (y as usize).min(height - 1);
        let tick = bar.end..bar.end + 0.3 * digit;
        let columns = (0..width).filter(|&column| tick.contains(&(column as f64 + 0.5)));
        columns.for_each(|column| picture.blend(column, row, ink, 1.0));
        glyphs::write(&mut picture, &text, DVec2::new(numbers, y + 0.5 * digit), digit, ink);
    }
    picture
}

/// As many digits as the steps between marks need.
fn text(mark: f64, scale: &Scale) -> String {
    let span = scale.high - scale.low;
    if scale.logarithmic || !(1e-3..1e5).contains(&span) {
        // the sum of steps is not quite round
        let rounded = format!("{mark:.2e}");
        let (digits, exponent) = rounded.split_once('e').unwrap_or((&rounded, "0"));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        return if mark == 0.0 { "0".to_owned() } else { format!("{digits}e{exponent}") };
    }
    let decimals = (0..6).find(|&d| span / 10.0_f64.powi(-d) >= 10.0).unwrap_or(6);
    #[allow(clippy::cast_sign_loss, reason = "not negative")]
    let text = format!("{mark:.*}", decimals as usize);
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        "0".to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::ColourMap;

    #[test]
    fn numbers_are_short() {
        let decades =
            Scale { low: 1e-9, high: 1e-5, logarithmic: true, map: ColourMap::Sequential };
        let texts: Vec<_> = decades.marks().into_iter().map(|m| text(m, &decades)).collect();
        assert_eq!(texts, ["1e-9", "1e-8", "1e-7", "1e-6", "1e-5"]);
        let linear = Scale { low: -0.7, high: 0.7, logarithmic: false, map: ColourMap::Diverging };
        let texts: Vec<_> = linear.marks().into_iter().map(|m| text(m, &linear)).collect();
        assert_eq!(texts, ["-0.5", "0", "0.5"]);
    }

    #[test]
    fn the_bar_has_the_colours() {
        let scale = Scale { low: 0.0, high: 1.0, logarithmic: false, map: ColourMap::Sequential };
        let picture = legend(&scale, 400, Colour::grey(1.0));
        let column = 12;
        let near = |row, t| picture.pixel(column, row).difference(scale.map.at(t)) < 0.02;
        assert!(near(318, 0.0) && near(200, 0.5) && near(81, 1.0), "from below to above");
    }
}
