//! Per-element containers, indexed by typed ids; the only place that knows about threads.

use std::ops::{Index, IndexMut};

use crate::ids::{EdgeId, FaceId, HalfedgeId, VertexId};

#[cfg(feature = "rayon")]
fn collect<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync) -> Vec<T> {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    (0..count).into_par_iter().map(&f).collect()
}

#[cfg(not(feature = "rayon"))]
fn collect<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync) -> Vec<T> {
    (0..count).map(f).collect()
}

#[cfg(feature = "rayon")]
fn change<T: Send>(values: &mut [T], f: impl Fn(usize, &mut T) + Sync) {
    use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
    values.par_iter_mut().enumerate().for_each(|(i, value)| f(i, value));
}

#[cfg(not(feature = "rayon"))]
fn change<T: Send>(values: &mut [T], f: impl Fn(usize, &mut T) + Sync) {
    values.iter_mut().enumerate().for_each(|(i, value)| f(i, value));
}

macro_rules! element_map {
    ($(#[$doc:meta])* $name:ident, $id:ident) => {
        $(#[$doc])*
        ///
        /// Filled by a pure function of the element id, in parallel with the feature `rayon`; the
        /// values are the same bit for bit either way.
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name<T>(Vec<T>);

        impl<T> $name<T> {
            /// Wraps values that are already in id order.
            #[must_use]
            pub fn from_vec(values: Vec<T>) -> Self {
                Self(values)
            }

            /// One value for each of the ids `0..count`.
            pub fn from_fn(count: usize, f: impl Fn($id) -> T + Sync) -> Self
            where
                T: Send,
            {
                Self(collect(count, |i| f($id::new(i))))
            }

            /// Like [`from_fn`](Self::from_fn), with the error of the lowest failing id if any.
            ///
            /// # Errors
            ///
            /// The first error in id order, whatever the number of threads.
            pub fn try_from_fn<E: Send>(
                count: usize,
                f: impl Fn($id) -> Result<T, E> + Sync,
            ) -> Result<Self, E>
            where
                T: Send,
            {
                collect(count, |i| f($id::new(i))).into_iter().collect::<Result<_, _>>().map(Self)
            }

            /// A map of the same size, value by value.
            pub fn map<U: Send>(&self, f: impl Fn($id, &T) -> U + Sync) -> $name<U>
            where
                T: Sync,
            {
                $name(collect(self.0.len(), |i| f($id::new(i), &self.0[i])))
            }

            /// Changes every value in its place, without a second map.
            pub fn change(&mut self, f: impl Fn($id, &mut T) + Sync)
            where
                T: Send,
            {
                change(&mut self.0, |i, value| f($id::new(i), value));
            }

            /// Number of elements.
            #[must_use]
            pub fn len(&self) -> usize {
                self.0.len()
            }

            /// No elements at all.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.0.is_empty()
            }

            /// The values in id order.
            #[must_use]
            pub fn as_slice(&self) -> &[T] {
                &self.0
            }

            /// The values in id order, to change.
            pub fn as_mut_slice(&mut self) -> &mut [T] {
                &mut self.0
            }

            /// The values in id order, by value.
            #[must_use]
            pub fn into_vec(self) -> Vec<T> {
                self.0
            }

            /// Ids and values in id order.
            pub fn iter(&self) -> impl ExactSizeIterator<Item = ($id, &T)> {
                self.0.iter().enumerate().map(|(i, value)| ($id::new(i), value))
            }
        }

        impl<T> Index<$id> for $name<T> {
            type Output = T;
            #[inline]
            fn index(&self, id: $id) -> &T {
                &self.0[id.index()]
            }
        }

        impl<T> IndexMut<$id> for $name<T> {
            #[inline]
            fn index_mut(&mut self, id: $id) -> &mut T {
                &mut self.0[id.index()]
            }
        }
    };
}

element_map! {
    /// One value per vertex.
    VertexMap, VertexId
}
element_map! {
    /// One value per face.
    FaceMap, FaceId
}
element_map! {
    /// One value per edge.
    EdgeMap, EdgeId
}
element_map! {
    /// One value per half-edge.
    HalfedgeMap, HalfedgeId
}
