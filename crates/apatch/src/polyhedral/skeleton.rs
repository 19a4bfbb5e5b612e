//! The triangulation of guards and corner points, with the apices its triangles may get
//! \[BCX94 Algorithms 1 and 2\].

use glam::DVec3;

use super::error::HullError;
use super::guards::Guards;
use super::polyhedron::Polyhedron;
use super::settings::ShapeControl;
use crate::min_norm::deepest_direction;

/// Where a point of the triangulation comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PointOrigin {
    /// A guard of this face: the surface touches the face there.
    Guard(usize),
    /// The surface cuts this corner, of more than three edges, there.
    Corner(usize),
}

/// Which part of the solid a triangle rounds off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TriangleOrigin {
    /// A corner of three edges.
    Corner(usize),
    /// A corner of more edges, at the edge towards the second vertex.
    Fan([usize; 2]),
    /// The middle of an edge.
    Edge([usize; 2]),
    /// A planar piece of a face.
    Face(usize),
}

/// What is varied when the tetrahedra do not fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Trial {
    pub(crate) alpha: Option<f64>,
    pub(crate) tau: f64,
    pub(crate) clearance: f64,
}

/// A triangle of the triangulation, with places for its apices.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SkeletonTriangle {
    /// Its corners, counter-clockwise seen from outside.
    pub corners: [usize; 3],
    /// The apex offered on the positive and negative side, used where an edge needs it.
    pub apices: [Option<DVec3>; 2],
    /// What it rounds off.
    pub origin: TriangleOrigin,
}

/// The triangulation that a hull is built over: everything else follows from it.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Skeleton {
    /// Guards and corner points.
    pub points: Vec<DVec3>,
    /// Their unit normals.
    pub normals: Vec<DVec3>,
    /// Where they come from.
    pub origins: Vec<PointOrigin>,
    /// The triangles.
    pub triangles: Vec<SkeletonTriangle>,
}

struct Builder<'a> {
    solid: &'a Polyhedron,
    guards: &'a Guards,
    trial: Trial,
    shape: &'a ShapeControl,
    made: Skeleton,
    /// For each side, how far from its start the apex of the corner stands, in lengths of the edge.
    reach: Vec<f64>,
}

/// The triangulation over the guards.
///
/// # Errors
///
/// [`HullError::NoAboveNormal`].
pub(crate) fn skeleton(
    solid: &Polyhedron,
    guards: &Guards,
    trial: Trial,
    shape: &ShapeControl,
) -> Result<Skeleton, HullError> {
    let made = Skeleton {
        points: guards.points.clone(),
        normals: guards.faces.iter().map(|&f| solid.facets()[f].normal).collect(),
        origins: guards.faces.iter().map(|&f| PointOrigin::Guard(f)).collect(),
        triangles: Vec::new(),
    };
    let reach = vec![0.0; solid.sides.len()];
    let mut builder = Builder { solid, guards, trial, shape, made, reach };
    for vertex in 0..solid.vertices().len() {
        let fan = solid.fan(vertex);
        if fan.is_empty() {
            continue;
        }
        let trihedral = fan.len() == 3 && builder.trihedral(vertex, [fan[0], fan[1], fan[2]]);
        if !trihedral {
            builder.fan(vertex, &fan)?;
        }
    }
    (0..solid.sides.len()).for_each(|side| builder.net(side));
    for &corners in &guards.fills {
        let origin = TriangleOrigin::Face(guards.faces[corners[0]]);
        builder.made.triangles.push(SkeletonTriangle { corners, apices: [None; 2], origin });
    }
    Ok(builder.made)
}

impl Builder<'_> {
    /// The point a fraction of the way along a side.
    fn along(&self, side: usize, x: f64) -> DVec3 {
        let side = self.solid.sides[side];
        let (v, w) = (self.solid.position(side.origin), self.solid.position(side.target));
        v + (w - v) * x
    }

    /// One triangle at a corner of three edges; `false` where the plane of the guards misses the first
    /// half of an edge that differs from the other two: such corners get a fan.
    fn trihedral(&mut self, vertex: usize, fan: [usize; 3]) -> bool {
        let corners = fan.map(|side| self.guards.of_side[side]);
        let ridges = fan.map(|side| self.solid.is_ridge(side));
        let at = self.solid.position(vertex);
        let convex = ridges.into_iter().filter(|r| *r).count();
        let apices = if let 0 | 3 = convex {
            if convex == 3 { [Some(at), None] } else { [None, Some(at)] }
        } else {
            let odd = (0..3).find(|&i| ridges[i] == (convex == 1)).unwrap_or(0);
            let [a, b, c] = corners.map(|g| self.guards.points[g]);
            let (plane, along) = ((b - a).cross(c - a), self.along(fan[odd], 1.0) - at);
            let x = (a - at).dot(plane) / along.dot(plane);
            if !(x > 0.0 && x < 0.5) {
                return false;
            }
            self.reach[fan[odd]] = 0.5 * (x + 0.5);
            let beyond = self.along(fan[odd], 0.5 * (x + 0.5));
            if convex == 2 { [Some(at), Some(beyond)] } else { [Some(beyond), Some(at)] }
        };
        let origin = TriangleOrigin::Corner(vertex);
        self.made.triangles.push(SkeletonTriangle { corners, apices, origin });
        true
    }

    /// Triangles around a new point, one at each edge.
    fn fan(&mut self, vertex: usize, fan: &[usize]) -> Result<(), HullError> {
        let faces: Vec<usize> = fan.iter().map(|&side| self.solid.sides[side].face).collect();
        let normals: Vec<DVec3> = faces.iter().map(|&f| self.solid.facets()[f].normal).collect();
        let normal = deepest_direction(&normals).ok_or(HullError::NoAboveNormal { vertex })?;
        let guards: Vec<usize> = fan.iter().map(|&side| self.guards.of_side[side]).collect();
        let depth = self.depth(vertex, normal, &normals, &guards);
        let centre = self.made.points.len();
        self.made.points.push(self.solid.position(vertex) + normal * depth);
        self.made.normals.push(normal);
        self.made.origins.push(PointOrigin::Corner(vertex));
        for (i, &side) in fan.iter().enumerate() {
            let right = guards[(i + fan.len() - 1) % fan.len()];
            let corners = [centre, right, guards[i]];
            let foot = self.along(side, self.trial.tau);
            self.reach[side] = self.trial.tau;
            let apices = [1.0, -1.0].map(|sign| Some(self.fan_apex(corners, normal, foot, sign)));
            let origin = TriangleOrigin::Fan([vertex, self.solid.sides[side].target]);
            self.made.triangles.push(SkeletonTriangle { corners, apices, origin });
        }
        Ok(())
    }

    /// How far along its normal the surface stays from a corner: 0 if the guards are on both sides.
    fn depth(&self, vertex: usize, normal: DVec3, normals: &[DVec3], guards: &[usize]) -> f64 {
        let at = self.solid.position(vertex);
        let heights: Vec<f64> =
            guards.iter().map(|&g| (self.guards.points[g] - at).dot(normal)).collect();
        let least = heights
            .iter()
            .copied()
            .fold(f64::INFINITY, |least, t| if t.abs() < least.abs() { t } else { least });
        if heights.iter().any(|t| t * least <= 0.0) {
            return 0.0;
        }
        match self.shape.corners.get(&vertex).copied().or(self.trial.alpha) {
            Some(alpha) => (1.0 - alpha) * least,
            None => {
                let weights: f64 = normals.iter().map(|n| 1.0 + normal.dot(*n)).sum();
                let balanced = heights.iter().sum::<f64>() / weights;
                (balanced / least).clamp(0.15, 0.85) * least
            }
        }
    }

    /// The lowest point over the edge that is above the tangent plane at the centre of the fan and
    /// high enough over the triangle \[ours, instead of Step (5)\].
    fn fan_apex(&self, corners: [usize; 3], normal: DVec3, foot: DVec3, sign: f64) -> DVec3 {
        let [a, b, c] = corners.map(|p| self.made.points[p]);
        let twice = (b - a).cross(c - a);
        let (plane, area) = (twice.normalize_or_zero(), 0.5 * twice.length());
        let over_centre = -sign * (foot - a).dot(normal);
        let wanted = self.trial.clearance * area.sqrt() - sign * (foot - a).dot(plane);
        let rise = plane.dot(normal);
        let over_triangle = if rise > 0.0 { wanted / rise } else { 0.0 };
        foot + normal * (sign * over_centre.max(over_triangle).max(0.0))
    }

    /// Triangles over the middle of an edge whose ends have different guards in one of its faces.
    fn net(&mut self, side: usize) {
        let data = self.solid.sides[side];
        if data.origin > data.target {
            return;
        }
        let guard = |side: usize| self.guards.of_side[side];
        let [g1, g2] = [guard(side), guard(data.next)];
        let [g4, g3] = [guard(data.twin), guard(self.solid.sides[data.twin].next)];
        let (from, to) = (self.reach[side], 1.0 - self.reach[data.twin]);
        let at = |x: f64| from + (to - from) * x;
        let triangles = match (g1 != g2, g3 != g4) {
            (true, true) => vec![([g1, g3, g2], at(0.25)), ([g3, g4, g2], at(0.75))],
            (true, false) => vec![([g1, g3, g2], at(0.5))],
            (false, true) => vec![([g3, g4, g1], at(0.5))],
            (false, false) => return,
        };
        for (corners, x) in triangles {
            let apex = Some(self.along(side, x));
            let apices = if self.solid.is_ridge(side) { [apex, None] } else { [None, apex] };
            let origin = TriangleOrigin::Edge([data.origin, data.target]);
            self.made.triangles.push(SkeletonTriangle { corners, apices, origin });
        }
    }
}
