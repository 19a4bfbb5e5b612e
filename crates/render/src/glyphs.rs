//! Digits and signs, drawn as lines.

use glam::DVec2;

use crate::colour::Colour;
use crate::picture::Picture;

/// Width and height of a glyph on its grid, and the step to the next.
const WIDTH: f64 = 4.0;
const HEIGHT: f64 = 6.0;
const STEP: f64 = 5.6;

/// The line of a character on a grid of 4 by 6, upwards; empty for unknown ones.
fn glyph(character: char) -> &'static [[f64; 2]] {
    match character {
        '0' => &[
            [0., 1.3],
            [0., 4.7],
            [0.4, 5.6],
            [1.3, 6.],
            [2.7, 6.],
            [3.6, 5.6],
            [4., 4.7],
            [4., 1.3],
            [3.6, 0.4],
            [2.7, 0.],
            [1.3, 0.],
            [0.4, 0.4],
            [0., 1.3],
        ],
        '1' => &[[0.6, 4.8], [2.2, 6.], [2.2, 0.]],
        '2' => &[
            [0.1, 4.8],
            [0.6, 5.6],
            [1.5, 6.],
            [2.6, 6.],
            [3.5, 5.6],
            [3.9, 4.7],
            [3.6, 3.6],
            [0., 0.],
            [4., 0.],
        ],
        '3' => &[
            [0.2, 6.],
            [3.8, 6.],
            [1.9, 3.6],
            [2.8, 3.5],
            [3.7, 2.9],
            [4., 1.9],
            [3.6, 0.7],
            [2.6, 0.],
            [1.3, 0.],
            [0.4, 0.4],
            [0., 1.1],
        ],
        '4' => &[[3., 0.], [3., 6.], [0., 1.7], [4., 1.7]],
        '5' => &[
            [3.7, 6.],
            [0.6, 6.],
            [0.3, 3.2],
            [1.2, 3.8],
            [2.5, 3.8],
            [3.6, 3.2],
            [4., 2.],
            [3.6, 0.7],
            [2.6, 0.],
            [1.3, 0.],
            [0.4, 0.4],
            [0., 1.1],
        ],
        '6' => &[
            [3.6, 5.3],
            [2.8, 6.],
            [1.6, 6.],
            [0.6, 5.2],
            [0., 3.6],
            [0., 1.8],
            [0.5, 0.6],
            [1.4, 0.],
            [2.6, 0.],
            [3.5, 0.5],
            [4., 1.6],
            [4., 2.1],
            [3.5, 3.2],
            [2.6, 3.7],
            [1.5, 3.7],
            [0.5, 3.1],
            [0., 2.],
        ],
        '7' => &[[0., 6.], [4., 6.], [1.5, 0.]],
        '8' => &[
            [1.4, 3.2],
            [0.5, 3.8],
            [0.3, 4.7],
            [0.6, 5.5],
            [1.5, 6.],
            [2.5, 6.],
            [3.4, 5.5],
            [3.7, 4.7],
            [3.5, 3.8],
            [2.6, 3.2],
            [1.4, 3.2],
            [0.4, 2.6],
            [0., 1.6],
            [0.4, 0.5],
            [1.4, 0.],
            [2.6, 0.],
            [3.6, 0.5],
            [4., 1.6],
            [3.6, 2.6],
            [2.6, 3.2],
        ],
        '9' => &[
            [0.4, 0.7],
            [1.2, 0.],
            [2.4, 0.],
            [3.4, 0.8],
            [4., 2.4],
            [4., 4.2],
            [3.5, 5.4],
            [2.6, 6.],
            [1.4, 6.],
            [0.5, 5.5],
            [0., 4.4],
            [0., 3.9],
            [0.5, 2.8],
            [1.4, 2.3],
            [2.5, 2.3],
            [3.5, 2.9],
            [4., 4.],
        ],
        'e' => &[
            [0.3, 2.1],
            [3.7, 2.1],
            [3.5, 3.2],
            [2.7, 3.9],
            [1.4, 3.9],
            [0.5, 3.2],
            [0.2, 2.1],
            [0.5, 0.8],
            [1.4, 0.],
            [2.7, 0.],
            [3.6, 0.6],
        ],
        '-' => &[[0.5, 2.8], [3.5, 2.8]],
        '.' => &[[2., 0.4], [2., 0.]],
        _ => &[],
    }
}

/// Width of a text whose digits are `height` pixels high.
pub(crate) fn width(text: &str, height: f64) -> f64 {
    let count = text.chars().count() as f64;
    (count * STEP - (STEP - WIDTH)).max(0.0) * height / HEIGHT
}

/// Writes a text; `start` is where its base line begins, in pixels to the right and down.
pub(crate) fn write(picture: &mut Picture, text: &str, start: DVec2, height: f64, colour: Colour) {
    let unit = height / HEIGHT;
    let mut origin = start;
    for character in text.chars() {
        let place = |[x, y]: [f64; 2]| origin + DVec2::new(x, -y) * unit;
        for line in glyph(character).windows(2) {
            draw_line(picture, [place(line[0]), place(line[1])], 0.13 * height, colour);
        }
        origin.x += STEP * unit;
    }
}

/// A line with round ends; pixels at its border are mixed after their distance.
fn draw_line(picture: &mut Picture, [a, b]: [DVec2; 2], thickness: f64, colour: Colour) {
    let reach = 0.5 * thickness + 1.0;
    let [width, height] = picture.size();
    let (low, high) = (a.min(b) - reach, a.max(b) + reach);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the picture"
    )]
    let range = |low: f64, high: f64, count: usize| {
        let whole = |x: f64| x.clamp(0.0, count as f64) as usize;
        whole(low.floor())..whole(high.ceil())
    };
    for row in range(low.y, high.y, height) {
        for column in range(low.x, high.x, width) {
            let centre = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let along = (b - a).length_squared();
            let t =
                if along > 0.0 { ((centre - a).dot(b - a) / along).clamp(0.0, 1.0) } else { 0.0 };
            let distance = centre.distance(a.lerp(b, t));
            let part = (0.5 * thickness + 0.5 - distance).clamp(0.0, 1.0);
            picture.blend(column, row, colour, part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_characters_of_numbers_are_known() {
        for character in "0123456789e-.".chars() {
            let mut picture = Picture::new([20, 20], Colour::grey(1.0));
            write(
                &mut picture,
                &character.to_string(),
                DVec2::new(5.0, 15.0),
                10.0,
                Colour::grey(0.0),
            );
            let dark = picture.bytes().iter().filter(|&&byte| byte < 160).count();
            assert!(dark > 0, "{character} is seen");
        }
    }
}
