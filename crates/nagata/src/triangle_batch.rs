//! Many C0 triangles at a time.

use glam::DVec3;

use crate::curvature_parameter::Limits;
use crate::lanes::{Flags, Lanes, curvature_parameters};
use crate::sample::{Row, fill_rows, lattice_size};
use crate::settings::EdgeSettings;
use crate::triangle::NagataTriangle;
use crate::widest::{Loops, widest};

/// Triangles that are computed together.
const LANES: usize = 16;

impl NagataTriangle {
    /// Fills `patches` with the patches of which `given` returns corners and unit normals, by position in
    /// `patches`: the same bits as from [`from_normals`](Self::from_normals), faster.
    pub fn fill_from_normals(
        patches: &mut [Self],
        settings: &EdgeSettings,
        given: impl Fn(usize) -> [[DVec3; 3]; 2],
    ) {
        widest(Filling { patches, settings, given });
    }

    /// Points of several patches, one patch after the other: the same bits as from
    /// [`sample`](Self::sample), faster.
    ///
    /// # Panics
    ///
    /// If `divisions` is zero or `points` has not that length times the number of patches.
    pub fn sample_all(patches: &[Self], divisions: usize, points: &mut [DVec3]) {
        let size = lattice_size(divisions);
        assert_eq!(points.len(), patches.len() * size, "one point for each lattice point");
        #[cfg(feature = "simd")]
        let done = vector::sample(patches, divisions, points);
        #[cfg(not(feature = "simd"))]
        let done = 0;
        let (patches, points) = (&patches[done..], &mut points[done * size..]);
        let (fours, rest) = patches.as_chunks::<4>();
        let (points, points_of_rest) = points.split_at_mut(4 * fours.len() * size);
        for (four, points) in fours.iter().zip(points.chunks_exact_mut(4 * size)) {
            let (a, points) = points.split_at_mut(size);
            let (b, points) = points.split_at_mut(size);
            let (c, d) = points.split_at_mut(size);
            fill_rows(
                [a, b, c, d],
                divisions,
                |row| row + 1,
                |eta| four.each_ref().map(|patch| patch.row(eta)),
            );
        }
        for (patch, points) in rest.iter().zip(points_of_rest.chunks_exact_mut(size)) {
            patch.sample(divisions, points);
        }
    }

    #[inline(always)]
    pub(crate) fn row(&self, eta: f64) -> Row {
        let [c00, c10, c01, c11, c20, c02] = self.monomials();
        Row { constant: c00 + (c10 + c20 * eta) * eta, linear: c01 + c11 * eta, quadratic: c02 }
    }
}

struct Filling<'a, G> {
    patches: &'a mut [NagataTriangle],
    settings: &'a EdgeSettings,
    given: G,
}

impl<G: Fn(usize) -> [[DVec3; 3]; 2]> Loops for Filling<'_, G> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let limits = Limits::new(self.settings);
        let [mut chords, mut normals, mut values] = [[Lanes::<LANES>::ZERO; 3]; 3];
        for (part, patches) in self.patches.chunks_mut(LANES).enumerate() {
            for (lane, patch) in patches.iter_mut().enumerate() {
                let [corners, at_corners] = (self.given)(part * LANES + lane);
                patch.corners = corners;
                let [a, b, c] = corners;
                let of_edges = [c - b, a - c, b - a];
                for i in 0..3 {
                    chords[i].set(lane, of_edges[i]);
                    normals[i].set(lane, at_corners[i]);
                }
            }
            // loops, because closures would be compiled apart
            let mut flags = Flags::<LANES>::NONE;
            for i in 0..3 {
                let ends = [&normals[(i + 1) % 3], &normals[(i + 2) % 3]];
                curvature_parameters(&chords[i], ends, &limits, &mut values[i], &mut flags);
            }
            for (lane, patch) in patches.iter_mut().enumerate() {
                let [a, b, c] = &values;
                patch.curvature = [a.get(lane), b.get(lane), c.get(lane)];
            }
            if flags.any_refused() {
                let given = |lane| (self.given)(part * LANES + lane);
                one_by_one(patches, self.settings, given, &flags);
            }
        }
    }
}

/// The patches of lanes that were refused.
#[cold]
fn one_by_one(
    patches: &mut [NagataTriangle],
    settings: &EdgeSettings,
    given: impl Fn(usize) -> [[DVec3; 3]; 2],
    flags: &Flags<LANES>,
) {
    for (lane, patch) in patches.iter_mut().enumerate().filter(|(lane, _)| flags.refused(*lane)) {
        let [corners, normals] = given(lane);
        *patch = NagataTriangle::from_normals(corners, normals, settings);
    }
}

#[cfg(feature = "simd")]
mod vector {
    use glam::DVec3;
    use pulp::{Arch, Simd, WithSimd};

    use crate::sample::lattice_size;
    use crate::triangle::NagataTriangle;

    /// Lanes of the widest vectors.
    const WIDEST: usize = 8;

    /// Samples as many patches together as a vector has lanes; returns how many patches are done.
    pub(super) fn sample(
        patches: &[NagataTriangle],
        divisions: usize,
        points: &mut [DVec3],
    ) -> usize {
        Arch::new().dispatch(Sampling { patches, divisions, points })
    }

    struct Sampling<'a> {
        patches: &'a [NagataTriangle],
        divisions: usize,
        points: &'a mut [DVec3],
    }

    impl WithSimd for Sampling<'_> {
        type Output = usize;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> usize {
            let (lanes, size) = (S::F64_LANES, lattice_size(self.divisions));
            let patches = self.patches.chunks_exact(lanes);
            for (patches, points) in patches.zip(self.points.chunks_exact_mut(lanes * size)) {
                together(simd, patches, self.divisions, points);
            }
            self.patches.len() / lanes * lanes
        }
    }

    /// Like [`NagataTriangle::sample`], one patch in each lane.
    #[inline(always)]
    fn together<S: Simd>(
        simd: S,
        patches: &[NagataTriangle],
        divisions: usize,
        points: &mut [DVec3],
    ) {
        let each = |f: &dyn Fn(usize) -> S::f64s| [f(0), f(1), f(2)];
        let (size, step) = (lattice_size(divisions), 1.0 / divisions as f64);
        let mut monomials = [[[0.0; WIDEST]; 3]; 6];
        for (lane, patch) in patches.iter().enumerate() {
            for (all, v) in monomials.iter_mut().zip(patch.monomials()) {
                (all[0][lane], all[1][lane], all[2][lane]) = (v.x, v.y, v.z);
            }
        }
        let [c00, c10, c01, c11, c20, c02] =
            monomials.each_ref().map(|all| all.each_ref().map(|x| vector::<S>(x)));
        // a x + b
        let add = |a: S::f64s, x: S::f64s, b: S::f64s| simd.add_f64s(simd.mul_f64s(a, x), b);
        let mut first = 0;
        for row in 0..=divisions {
            let eta = simd.splat_f64s(row as f64 * step);
            let constant = each(&|x| add(add(c20[x], eta, c10[x]), eta, c00[x]));
            let linear = each(&|x| add(c11[x], eta, c01[x]));
            let mut k = 0.0;
            for at in first..=first + row {
                let t = simd.splat_f64s(k * step);
                let [x, y, z] =
                    each(&|x| add(add(c02[x], t, linear[x]), t, constant[x])).map(lanes::<S>);
                for lane in 0..S::F64_LANES {
                    points[lane * size + at] = DVec3::new(x[lane], y[lane], z[lane]);
                }
                k += 1.0;
            }
            first += row + 1;
        }
    }

    #[inline(always)]
    fn vector<S: Simd>(lanes: &[f64; WIDEST]) -> S::f64s {
        S::as_simd_f64s(&lanes[..S::F64_LANES]).0[0]
    }

    #[inline(always)]
    fn lanes<S: Simd>(vector: S::f64s) -> [f64; WIDEST] {
        let mut lanes = [0.0; WIDEST];
        S::as_mut_simd_f64s(&mut lanes[..S::F64_LANES]).0[0] = vector;
        lanes
    }
}
