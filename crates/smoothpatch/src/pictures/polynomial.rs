//! Cells of files as polynomials of two parameters.

use basemesh::glam::{DVec2, DVec3};
use bezier_core::PatchJet;
use io::GridCell;
use render::Domain;

/// Coefficients of 1, u, v, u², uv, v², u²v, uv².
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polynomial([DVec3; 8]);

impl Polynomial {
    /// The polynomial that a cell stands for, with these values at its points.
    pub(super) fn of_cell(cell: &GridCell, values: &[DVec3]) -> Self {
        let mut c = [DVec3::ZERO; 8];
        c[0] = values[0];
        match (cell, values) {
            (GridCell::Triangle(_), &[a, b, d]) => {
                c[1] = b - a;
                c[2] = d - a;
            }
            (GridCell::Quad(_), &[a, b, d, e]) => {
                c[1] = b - a;
                c[2] = e - a;
                c[4] = (a - b) + (d - e);
            }
            (GridCell::QuadraticTriangle(_), &[a, b, d, ab, bd, da]) => {
                [c[1], c[3]] = parabola(a, ab, b);
                [c[2], c[5]] = parabola(a, da, d);
                c[4] = (a - ab + bd - da) * 4.0;
            }
            (GridCell::QuadraticQuad(_), &[a, b, d, e, ab, bd, de, ea]) => {
                [c[1], c[3]] = parabola(a, ab, b);
                [c[2], c[5]] = parabola(a, ea, e);
                let [along, bent] = parabola(e, de, d);
                c[6] = bent - c[3];
                c[7] = parabola(b, bd, d)[1] - c[5];
                c[4] = along - c[1] - c[7];
            }
            _ => unreachable!("invariant: a cell has as many values as points"),
        }
        Self(c)
    }

    pub(super) fn at(&self, DVec2 { x: u, y: v }: DVec2) -> DVec3 {
        let c = &self.0;
        c[0] + (c[1] + (c[3] + c[6] * v) * u) * u + (c[2] + c[5] * v + (c[4] + c[7] * v) * u) * v
    }

    pub(super) fn jet(&self, at: DVec2) -> PatchJet {
        let DVec2 { x: u, y: v } = at;
        let c = &self.0;
        PatchJet {
            point: self.at(at),
            du: c[1] + (c[3] + c[6] * v) * (2.0 * u) + (c[4] + c[7] * v) * v,
            dv: c[2] + (c[5] + c[7] * u) * (2.0 * v) + (c[4] + c[6] * u) * u,
            duu: (c[3] + c[6] * v) * 2.0,
            duv: c[4] + (c[6] * u + c[7] * v) * 2.0,
            dvv: (c[5] + c[7] * u) * 2.0,
        }
    }
}

/// Coefficients of `t` and `t²` of the parabola with these values at 0, 1/2 and 1.
fn parabola(start: DVec3, middle: DVec3, end: DVec3) -> [DVec3; 2] {
    [(middle - start) * 4.0 - (end - start), ((start - middle) + (end - middle)) * 2.0]
}

pub(super) fn domain(cell: &GridCell) -> Domain {
    match cell {
        GridCell::Triangle(_) | GridCell::QuadraticTriangle(_) => Domain::Triangle,
        GridCell::Quad(_) | GridCell::QuadraticQuad(_) => Domain::Square,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parameters of the points of each kind of cell.
    fn places(cell: &GridCell) -> Vec<DVec2> {
        let corners = domain(cell).corners();
        let mids = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| a.midpoint(*b));
        let all: Vec<DVec2> = corners.iter().copied().chain(mids).collect();
        all[..cell.points().len()].to_vec()
    }

    #[test]
    fn polynomials_pass_through_their_points() {
        let cells = [
            GridCell::Triangle([0, 1, 2]),
            GridCell::Quad([0, 1, 2, 3]),
            GridCell::QuadraticTriangle([0, 1, 2, 3, 4, 5]),
            GridCell::QuadraticQuad([0, 1, 2, 3, 4, 5, 6, 7]),
        ];
        for cell in cells {
            let value = |k: usize| DVec3::new((k * k) as f64, 3.0 - k as f64, ((k * 7) % 5) as f64);
            let values: Vec<DVec3> = (0..cell.points().len()).map(value).collect();
            let polynomial = Polynomial::of_cell(&cell, &values);
            for (at, &expected) in places(&cell).into_iter().zip(&values) {
                assert!(polynomial.at(at).distance(expected) < 1e-13, "{cell:?} at {at}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_polynomial() {
        let cell = GridCell::QuadraticQuad([0, 1, 2, 3, 4, 5, 6, 7]);
        let value = |k: usize| DVec3::new((k * k % 7) as f64, k as f64, ((k * 3) % 5) as f64);
        let values: Vec<DVec3> = (0..8).map(value).collect();
        let polynomial = Polynomial::of_cell(&cell, &values);
        let (at, h) = (DVec2::new(0.3, 0.6), 0.25);
        let jet = polynomial.jet(at);
        // of degree two in each parameter, so that central differences are exact
        let shifted = |x: f64, y: f64| polynomial.jet(at + DVec2::new(x, y));
        let (right, left, up, down) =
            (shifted(h, 0.0), shifted(-h, 0.0), shifted(0.0, h), shifted(0.0, -h));
        let slope = |a: DVec3, b: DVec3| (a - b) / (2.0 * h);
        for (found, expected) in [
            (jet.du, slope(right.point, left.point)),
            (jet.dv, slope(up.point, down.point)),
            (jet.duu, slope(right.du, left.du)),
            (jet.duv, slope(up.du, down.du)),
            (jet.dvv, slope(up.dv, down.dv)),
        ] {
            assert!(found.distance(expected) < 1e-12, "{found} and {expected}");
        }
    }
}
