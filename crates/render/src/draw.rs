//! From patches to a picture.

use glam::{DVec2, DVec3};
use thiserror::Error;

use crate::camera::Camera;
use crate::colour::Colour;
use crate::edges;
use crate::lattice::{COARSE, ScreenPatch};
use crate::patches::{Hit, Patches};
use crate::picture::Picture;
use crate::shade::Shade;
use crate::threads;
use crate::visible::{Band, OUTER, SAMPLES, Seen};

/// Rows of pixels that are worked on at once.
const BAND: usize = 16;
/// Outer samples of a pixel whose colours differ by less, in linear light, stand for all.
const ALIKE: f64 = 0.02;
/// Half the width of edges, in pixels; half of a line is on each of the two patches.
const HALF_LINE: f64 = 0.5;
/// How much of the surface is seen through an edge.
const THROUGH: f64 = 0.25;

/// How patches are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Style<'a> {
    /// What the colours show.
    pub shade: Shade<'a>,
    /// Draw the edges of patches.
    pub edges: bool,
    /// Behind the surface.
    pub background: Colour,
}

impl<'a> Style<'a> {
    /// On white, without edges.
    #[must_use]
    pub fn new(shade: Shade<'a>) -> Self {
        Self { shade, edges: false, background: Colour::grey(1.0) }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DrawError {
    /// A point of a patch is not finite.
    #[error("patch {patch} has a point that is not finite")]
    NotFinite {
        /// The first such patch.
        patch: usize,
    },
}

/// A camera from this direction that shows all patches, with a margin of 4 % of the smaller side.
///
/// `None` if there is no patch, a point is not finite, or all are in one place.
#[must_use]
pub fn frame(patches: &[&dyn Patches], axes: [DVec3; 3], size: [usize; 2]) -> Option<Camera> {
    let points = patches.iter().flat_map(|patches| {
        (0..patches.count()).flat_map(move |patch| {
            patches.domain(patch).lattice(COARSE).map(move |at| patches.point(patch, at))
        })
    });
    Camera::framing(points, axes, size, 0.04)
}

/// Draws patches as the camera sees them.
///
/// Each pixel has 16 samples. A sample shows the patch that is nearest to the viewer, with the normal
/// of the patch at these parameters; the point of the patch is nearer than 0.03 pixels to the
/// sample's line of sight. Pixels on one patch whose outer four samples look alike take their mean,
/// all others the mean of the 16. The picture does not depend on the number of threads.
///
/// # Errors
///
/// [`DrawError`] if a point is not finite.
pub fn draw(
    patches: &dyn Patches,
    camera: &Camera,
    size: [usize; 2],
    style: &Style<'_>,
) -> Result<Picture, DrawError> {
    let [width, height] = size;
    let extent = DVec2::new(width as f64, height as f64);
    let middle = extent * 0.5;
    let on_screen = threads::map(patches.count(), |patch| {
        ScreenPatch::new(patches, patch, camera, extent).ok_or(DrawError::NotFinite { patch })
    });
    let on_screen = on_screen.into_iter().collect::<Result<Vec<_>, _>>()?;
    let painter = Painter { patches, camera, style };
    let bands = threads::map(height.div_ceil(BAND), |band| {
        let first_row = band * BAND;
        let rows = BAND.min(height - first_row);
        let mut band = Band::new(width, first_row, rows);
        for (id, patch) in on_screen.iter().enumerate() {
            band.add(id, patch, middle);
        }
        let pixels = (0..rows).flat_map(|row| (0..width).map(move |column| (row, column)));
        pixels.map(|(row, column)| painter.pixel(&band.pixel(row, column))).collect::<Vec<_>>()
    });
    Ok(Picture::from_pixels(size, bands.into_iter().flatten().collect()))
}

struct Painter<'a> {
    patches: &'a dyn Patches,
    camera: &'a Camera,
    style: &'a Style<'a>,
}

impl Painter<'_> {
    fn pixel(&self, samples: &[Option<Seen>; SAMPLES]) -> Colour {
        if samples.iter().all(Option::is_none) {
            return self.style.background;
        }
        let outer = OUTER.map(|sample| self.sample(samples[sample]));
        let patch = |sample: &Option<Seen>| sample.map(|seen| seen.patch);
        let one_patch = samples.iter().all(|sample| patch(sample) == patch(&samples[0]));
        let alike = outer.iter().all(|colour| colour.difference(outer[0]) < ALIKE);
        if one_patch && alike {
            return mean(&outer);
        }
        mean(&samples.map(|sample| self.sample(sample)))
    }

    fn sample(&self, seen: Option<Seen>) -> Colour {
        let Some(Seen { patch, at }) = seen else { return self.style.background };
        let point = self.patches.surface_point(patch, at);
        let normal = point.normal.normalize_or_zero();
        let hit = Hit { patch, at, point: point.point, normal };
        let colour = self.style.shade.colour(&hit, self.camera.axes);
        if !self.style.edges {
            return colour;
        }
        let distance = edges::distance(self.patches, patch, at, &point);
        if distance * self.camera.pixels_per_length > HALF_LINE {
            return colour;
        }
        self.line_colour().mix(colour, THROUGH)
    }

    /// Edges must be seen on black and white stripes.
    fn line_colour(&self) -> Colour {
        match self.style.shade {
            Shade::Zebra(_) | Shade::Isophotes(_) => Colour::from_srgb([0.85, 0.30, 0.15]),
            Shade::Normals | Shade::Values(..) => Colour::grey(0.15),
        }
    }
}

fn mean(colours: &[Colour]) -> Colour {
    let sum = colours.iter().fold(Colour::default(), |sum, &colour| sum.plus(colour));
    sum.times(1.0 / colours.len() as f64)
}
