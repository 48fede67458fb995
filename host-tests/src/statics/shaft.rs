//! The screw as an elastic shaft: its nodes, and how a point of its surface follows them.

use nalgebra::{SMatrix, Vector3};

use super::beam::{Section, groove_reduction};
use super::geometry::Geometry;
use crate::error::{ReferenceError, within};
use crate::material::Elastic;

/// What the shaft can do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShaftModel {
    /// Axial, torsional, bending and shear deformation.
    #[default]
    Timoshenko,
    /// Axial deformation only: the earlier model of Mei et al. that Lin 2019, Fig. 2.9 compares with.
    Bar,
    /// A rigid body with six degrees of freedom: the inner ring of a bearing.
    Rigid,
}

/// The shaft, cut into elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaft {
    /// What it can do.
    pub model: ShaftModel,
    /// Stiffnesses of its section.
    pub section: Section,
    /// Positions of the nodes along the axis, m, rising; one for a rigid shaft.
    pub nodes: Vec<f64>,
}

/// Length of an element inside the nut, m (Lin 2019, section 2.4.1).
pub const ELEMENT_IN_NUT: f64 = 15e-3;

/// Largest number of nodes.
const LARGEST_MESH: usize = 20_000;

impl Shaft {
    /// A screw from 0 to `length`, m, of this outer diameter, m, reduced by its groove. In the train of
    /// balls (from `train[0]` to `train[1]`) elements are 15 mm long as in the dissertation, outside they
    /// are at most a pitch diameter long; `refinement` divides each element by so much.
    pub fn screw(
        geometry: &Geometry,
        elastic: Elastic,
        (length, outer_diameter): (f64, f64),
        train: [f64; 2],
        refinement: usize,
    ) -> Result<Self, ReferenceError> {
        geometry.check()?;
        elastic.check()?;
        let largest = 2.0 * (geometry.pitch_radius + geometry.ball_radius);
        within("screw_length", length, 1e-3, 100.0)?;
        within("screw_diameter", outer_diameter, 0.05 * largest, largest)?;
        if !(1..=64).contains(&refinement) {
            return Err(ReferenceError::input(
                "refinement",
                format!("{refinement} is not within 1 to 64"),
            ));
        }
        if !(train[0] >= 0.0 && train[1] <= length) {
            return Err(ReferenceError::input(
                "nut_position",
                format!(
                    "the balls from {} to {} m are not on a screw of {length} m",
                    train[0], train[1]
                ),
            ));
        }
        let reduction = groove_reduction(geometry, outer_diameter)?;
        Ok(Self {
            model: ShaftModel::Timoshenko,
            section: Section::circular(reduction * outer_diameter, elastic),
            nodes: mesh(length, 2.0 * geometry.pitch_radius, train, refinement)?,
        })
    }

    /// A rigid ring whose forces and displacements are taken at `position`, m.
    pub fn rigid(position: f64) -> Self {
        Self {
            model: ShaftModel::Rigid,
            section: Section {
                axial: 0.0,
                bending: 0.0,
                torsion: 0.0,
                shear: 0.0,
            },
            nodes: vec![position],
        }
    }

    /// Puts a node at `position`, m, and gives its index; the nearest one where there is one within 1 nm.
    pub fn node_at(&mut self, position: f64) -> usize {
        if self.model == ShaftModel::Rigid {
            return 0;
        }
        if let Some(found) = self.nodes.iter().position(|z| (z - position).abs() < 1e-9) {
            return found;
        }
        let place = self.nodes.partition_point(|z| *z < position);
        self.nodes.insert(place, position);
        place
    }

    /// First and last position, m.
    pub fn ends(&self) -> [f64; 2] {
        [
            self.nodes.first().copied().unwrap_or(0.0),
            self.nodes.last().copied().unwrap_or(0.0),
        ]
    }

    /// Displacement of a point at `position`, m, and `radial`, m, off the axis: the first node it depends
    /// on, and the matrix on the displacements of that node and the next, eq. (2.21). The printed (2.20) has its two sides
    /// exchanged: the nodes' displacements give the axis', as in (2.21).
    pub fn point(&self, position: f64, radial: Vector3<f64>) -> (usize, SMatrix<f64, 3, 12>) {
        if self.model == ShaftModel::Rigid {
            let arm = radial + Vector3::new(0.0, 0.0, position - self.ends()[0]);
            let mut rigid = SMatrix::<f64, 3, 12>::zeros();
            rigid.fixed_view_mut::<3, 6>(0, 0).copy_from(&lever(arm));
            return (0, rigid);
        }
        let last = self.nodes.len().saturating_sub(2);
        let element = self
            .nodes
            .partition_point(|z| *z <= position)
            .saturating_sub(1)
            .min(last);
        let (start, end) = (self.nodes[element], self.nodes[element + 1]);
        let length = end - start;
        let shape = self.section.shape((position - start) / length, length);
        (element, lever(radial) * shape)
    }
}

/// Displacement at `arm` from that of its root: `[1, -D(arm)]`, eq. (2.18), (2.19).
fn lever(arm: Vector3<f64>) -> SMatrix<f64, 3, 6> {
    let mut matrix = SMatrix::<f64, 3, 6>::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
    matrix
        .fixed_view_mut::<3, 3>(0, 3)
        .copy_from(&-arm.cross_matrix());
    matrix
}

fn mesh(
    length: f64,
    pitch_diameter: f64,
    [first, last]: [f64; 2],
    refinement: usize,
) -> Result<Vec<f64>, ReferenceError> {
    let train = last - first;
    let inside = (train / ELEMENT_IN_NUT).ceil().max(1.0);
    let centre = 0.5 * (first + last);
    let half = (0.5 * inside * ELEMENT_IN_NUT)
        .min(centre)
        .min(length - centre)
        .max(0.5 * train);
    let marks = [0.0, centre - half, centre + half, length];
    let counts = [
        ((centre - half) / pitch_diameter).ceil(),
        inside,
        ((length - centre - half) / pitch_diameter).ceil(),
    ];
    if counts.iter().sum::<f64>() * refinement as f64 > LARGEST_MESH as f64 {
        return Err(ReferenceError::input(
            "screw_length",
            "the screw is too slender for a mesh of 20000 elements",
        ));
    }
    let mut nodes = vec![0.0];
    for (span, count) in marks.windows(2).zip(counts) {
        let (start, end) = (span[0], span[1]);
        if end - start < 1e-9 {
            continue;
        }
        let pieces = count.max(1.0) as usize * refinement;
        nodes
            .extend((1..=pieces).map(|piece| start + (end - start) * piece as f64 / pieces as f64));
    }
    Ok(nodes)
}
