//! The frame of a STEP file: header, product, units, and instances with their numbers.

use std::fmt::Write as _;
use std::io::{self, Write};

use glam::DVec3;

use super::{LengthUnit, StepOptions, StepSchema};
use crate::patch_surface::PatchSurface;
use crate::text::Text;

/// A file that is being written, instance after instance.
pub(super) struct Document<'a> {
    text: Text<'a>,
    /// The number of the last instance.
    last: u64,
    name: String,
    /// Instances that the end refers to.
    shape: u64,
    context: u64,
    axes: u64,
}

impl<'a> Document<'a> {
    /// Writes everything that stands before the geometry.
    pub(super) fn begin(
        out: &'a mut dyn Write,
        options: &StepOptions,
        surface: &PatchSurface,
    ) -> io::Result<Self> {
        let name = string(&options.name);
        let text = Text::new(out);
        let mut document = Self { text, last: 0, name, shape: 0, context: 0, axes: 0 };
        document.header(options.schema)?;
        document.shape = document.product(options.schema)?;
        document.context = document.units(options, surface)?;
        let origin = document.point(DVec3::ZERO)?;
        let z = document.add("DIRECTION('',(0.,0.,1.))")?;
        let x = document.add("DIRECTION('',(1.,0.,0.))")?;
        document.axes = document.add(&format!("AXIS2_PLACEMENT_3D('',#{origin},#{z},#{x})"))?;
        Ok(document)
    }

    fn header(&mut self, schema: StepSchema) -> io::Result<()> {
        let schema = match schema {
            StepSchema::Ap242 => {
                "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 3 1 4 }"
            }
            StepSchema::Ap214 => "AUTOMOTIVE_DESIGN { 1 0 10303 214 3 1 1 }",
        };
        let program = concat!("smoothpatch ", env!("CARGO_PKG_VERSION"));
        // a constant time, so that the same surface gives the same bytes
        let lines = [
            "ISO-10303-21;".to_owned(),
            "HEADER;".to_owned(),
            "FILE_DESCRIPTION((''),'2;1');".to_owned(),
            format!(
                "FILE_NAME('{}','1970-01-01T00:00:00',(''),(''),'{program}','','');",
                self.name
            ),
            format!("FILE_SCHEMA(('{schema}'));"),
            "ENDSEC;".to_owned(),
            "DATA;".to_owned(),
        ];
        lines.iter().try_for_each(|line| self.text.push(line).line())
    }

    /// Returns the shape of the product.
    fn product(&mut self, schema: StepSchema) -> io::Result<u64> {
        let (protocol, year, description) = match schema {
            StepSchema::Ap242 => (
                "ap242_managed_model_based_3d_engineering",
                2020,
                "managed model based 3d engineering",
            ),
            StepSchema::Ap214 => {
                ("automotive_design", 2010, "core data for automotive mechanical design processes")
            }
        };
        let name = self.name.clone();
        let application = self.add(&format!("APPLICATION_CONTEXT('{description}')"))?;
        self.add(&format!(
            "APPLICATION_PROTOCOL_DEFINITION('international standard','{protocol}',{year},#{application})"
        ))?;
        let context = self.add(&format!("PRODUCT_CONTEXT('',#{application},'mechanical')"))?;
        let product = self.add(&format!("PRODUCT('{name}','{name}','',(#{context}))"))?;
        let formation = self.add(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"))?;
        let context = self.add(&format!(
            "PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')"
        ))?;
        let definition =
            self.add(&format!("PRODUCT_DEFINITION('design','',#{formation},#{context})"))?;
        self.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"))
    }

    /// Returns the context of the geometry.
    fn units(&mut self, options: &StepOptions, surface: &PatchSurface) -> io::Result<u64> {
        let prefix = match options.unit {
            LengthUnit::Millimetre => ".MILLI.",
            LengthUnit::Centimetre => ".CENTI.",
            LengthUnit::Metre => "$",
        };
        let length = self.add(&format!("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))"))?;
        let angle = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")?;
        let solid_angle = self.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")?;
        let uncertainty = self.begin_instance();
        self.text.push("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(");
        self.text.step_real(options.uncertainty * surface.diagonal()).push("),#").integer(length);
        self.text.push(",'distance_accuracy_value','')");
        self.end_instance()?;
        self.add(&format!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)\
             GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{uncertainty}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid_angle}))\
             REPRESENTATION_CONTEXT('',''))"
        ))
    }

    /// Starts an instance; its text follows.
    pub(super) fn begin_instance(&mut self) -> u64 {
        self.last += 1;
        self.text.push("#").integer(self.last).push("=");
        self.last
    }

    pub(super) fn end_instance(&mut self) -> io::Result<()> {
        self.text.push(";").line()
    }

    pub(super) fn add(&mut self, text: &str) -> io::Result<u64> {
        let id = self.begin_instance();
        self.text.push(text);
        self.end_instance()?;
        Ok(id)
    }

    pub(super) fn point(&mut self, at: DVec3) -> io::Result<u64> {
        let id = self.begin_instance();
        let text = self.text.push("CARTESIAN_POINT('',(").step_real(at.x).push(",");
        text.step_real(at.y).push(",").step_real(at.z).push("))");
        self.end_instance()?;
        Ok(id)
    }

    /// Points with numbers that follow each other; returns the first number.
    pub(super) fn points(&mut self, at: impl IntoIterator<Item = DVec3>) -> io::Result<u64> {
        let first = self.last + 1;
        at.into_iter().try_for_each(|at| self.point(at).map(drop))?;
        Ok(first)
    }

    pub(super) fn vertex(&mut self, point: u64) -> io::Result<u64> {
        self.add(&format!("VERTEX_POINT('',#{point})"))
    }

    /// A Bézier curve through `points` between the `ends`, as an edge.
    pub(super) fn edge(&mut self, ends: [u64; 2], points: &[u64]) -> io::Result<u64> {
        let degree = points.len() - 1;
        let curve = self.begin_instance();
        self.text.push("B_SPLINE_CURVE_WITH_KNOTS('',").integer(degree).push(",");
        self.references(points.iter().copied());
        let multiplicity = degree + 1;
        self.text.push(",.UNSPECIFIED.,.F.,.F.,(").integer(multiplicity).push(",");
        self.text.integer(multiplicity).push("),(0.,1.),.UNSPECIFIED.)");
        self.end_instance()?;
        let edge = self.begin_instance();
        let [start, end] = ends;
        self.text.push("EDGE_CURVE('',#").integer(start).push(",#").integer(end);
        self.text.push(",#").integer(curve).push(",.T.)");
        self.end_instance()?;
        Ok(edge)
    }

    /// A Bézier surface with `net(i, j)` as its control points, `i` along the first parameter,
    /// bounded by edges, as a face whose normal is that of the surface.
    pub(super) fn face(
        &mut self,
        degree: usize,
        net: impl Fn(usize, usize) -> u64,
        sides: &[(u64, bool)],
    ) -> io::Result<u64> {
        let surface = self.begin_instance();
        self.text.push("B_SPLINE_SURFACE_WITH_KNOTS('',").integer(degree).push(",");
        self.text.integer(degree);
        for i in 0..=degree {
            self.text.push(if i == 0 { ",(" } else { "," });
            self.references((0..=degree).map(|j| net(i, j)));
        }
        self.text.push("),.UNSPECIFIED.,.F.,.F.,.F.");
        for _ in 0..2 {
            self.text.push(",(").integer(degree + 1).push(",").integer(degree + 1).push(")");
        }
        self.text.push(",(0.,1.),(0.,1.),.UNSPECIFIED.)");
        self.end_instance()?;
        let first = self.last + 1;
        for &(edge, is_forward) in sides {
            self.begin_instance();
            self.text.push("ORIENTED_EDGE('',*,*,#").integer(edge);
            self.text.push(if is_forward { ",.T.)" } else { ",.F.)" });
            self.end_instance()?;
        }
        let sides: Vec<u64> = (first..=self.last).collect();
        let edge_loop = self.list("EDGE_LOOP", &sides)?;
        let bound = self.add(&format!("FACE_OUTER_BOUND('',#{edge_loop},.T.)"))?;
        self.add(&format!("ADVANCED_FACE('',(#{bound}),#{surface},.T.)"))
    }

    /// An instance with an empty name and a list.
    pub(super) fn list(&mut self, kind: &str, members: &[u64]) -> io::Result<u64> {
        let id = self.begin_instance();
        self.text.push(kind).push("('',");
        self.references(members.iter().copied());
        self.text.push(")");
        self.end_instance()?;
        Ok(id)
    }

    fn references(&mut self, ids: impl Iterator<Item = u64>) {
        for (at, id) in ids.enumerate() {
            self.text.push(if at == 0 { "(#" } else { ",#" }).integer(id);
        }
        self.text.push(")");
    }

    /// A solid inside a closed shell and outside of others, which face into the holes.
    pub(super) fn solid(&mut self, shell: u64, holes: &[u64]) -> io::Result<u64> {
        let name = self.name.clone();
        if holes.is_empty() {
            return self.add(&format!("MANIFOLD_SOLID_BREP('{name}',#{shell})"));
        }
        let mut oriented = Vec::with_capacity(holes.len());
        for hole in holes {
            oriented.push(self.add(&format!("ORIENTED_CLOSED_SHELL('',*,#{hole},.T.)"))?);
        }
        let id = self.begin_instance();
        self.text.push("BREP_WITH_VOIDS('").push(&name).push("',#").integer(shell).push(",");
        self.references(oriented.into_iter());
        self.text.push(")");
        self.end_instance()?;
        Ok(id)
    }

    /// Writes what stands behind the geometry.
    pub(super) fn end(mut self, solids: &[u64], open_shells: &[u64]) -> io::Result<()> {
        if !solids.is_empty() {
            self.representation("ADVANCED_BREP_SHAPE_REPRESENTATION", solids)?;
        }
        if !open_shells.is_empty() {
            let model = self.list("SHELL_BASED_SURFACE_MODEL", open_shells)?;
            self.representation("MANIFOLD_SURFACE_SHAPE_REPRESENTATION", &[model])?;
        }
        self.text.push("ENDSEC;").line()?;
        self.text.push("END-ISO-10303-21;").line()?;
        self.text.finish()
    }

    fn representation(&mut self, kind: &str, items: &[u64]) -> io::Result<()> {
        let id = self.begin_instance();
        self.text.push(kind).push("('',");
        let axes = self.axes;
        self.references([axes].into_iter().chain(items.iter().copied()));
        self.text.push(",#").integer(self.context).push(")");
        self.end_instance()?;
        let shape = self.shape;
        self.add(&format!("SHAPE_DEFINITION_REPRESENTATION(#{shape},#{id})")).map(drop)
    }
}

/// Text as it stands between apostrophes (ISO 10303-21, 6.4.3).
fn string(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut units = [0; 2];
    for letter in text.chars() {
        match letter {
            '\'' => escaped.push_str("''"),
            '\\' => escaped.push_str("\\\\"),
            ' '..='~' => escaped.push(letter),
            _ => {
                escaped.push_str("\\X2\\");
                for unit in letter.encode_utf16(&mut units) {
                    // writing to a string does not fail
                    let _ = write!(escaped, "{unit:04X}");
                }
                escaped.push_str("\\X0\\");
            }
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::string;

    #[test]
    fn strings_are_escaped() {
        assert_eq!(string("it's a \\ part"), "it''s a \\\\ part");
        assert_eq!(string("größe"), "gr\\X2\\00F6\\X0\\\\X2\\00DF\\X0\\e");
        assert_eq!(string("\n😀"), "\\X2\\000A\\X0\\\\X2\\D83DDE00\\X0\\");
    }
}
