//! What the machine can do at most: multiply-adds in registers, and a sum of three arrays that do not
//! fit a cache. Other benches are stated as a share of these.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pulp::{Arch, Simd, WithSimd};

/// Vectors that are changed in turn: more than multiply-adds take cycles.
const CHAINS: usize = 12;
const ROUNDS: u64 = 4096;

struct MultiplyAdds;

impl WithSimd for MultiplyAdds {
    type Output = (f64, u64);

    /// Returns a value that depends on everything, and the number of operations.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, u64) {
        let factor = simd.splat_f64s(black_box(0.999_999));
        let term = simd.splat_f64s(black_box(1e-6));
        let mut values: [S::f64s; CHAINS] =
            std::array::from_fn(|chain| simd.splat_f64s(chain as f64));
        for _ in 0..ROUNDS {
            for value in &mut values {
                *value = simd.mul_add_e_f64s(*value, factor, term);
            }
        }
        let sum = values.into_iter().map(|value| simd.reduce_sum_f64s(value)).sum();
        (sum, ROUNDS * (2 * CHAINS * S::F64_LANES) as u64)
    }
}

fn multiply_add(c: &mut Criterion) {
    let arch = Arch::new();
    let (_, operations) = arch.dispatch(MultiplyAdds);
    let mut group = c.benchmark_group("calibration");
    group.throughput(Throughput::Elements(operations));
    group.bench_function("multiply-add", |b| b.iter(|| arch.dispatch(MultiplyAdds).0));
    group.finish();
}

fn triad(c: &mut Criterion) {
    const LENGTH: usize = 1 << 23;
    let (x, y) = (vec![1.0_f64; LENGTH], vec![2.0_f64; LENGTH]);
    let mut sum = vec![0.0_f64; LENGTH];
    let mut group = c.benchmark_group("calibration");
    group.sample_size(20).throughput(Throughput::Elements((3 * size_of::<f64>() * LENGTH) as u64));
    group.bench_function("triad", |b| {
        b.iter(|| {
            let factor = black_box(3.0);
            for ((sum, x), y) in sum.iter_mut().zip(&x).zip(&y) {
                *sum = x + factor * y;
            }
            black_box(&mut sum);
        });
    });
    group.finish();
}

criterion_group!(benches, multiply_add, triad);
criterion_main!(benches);
