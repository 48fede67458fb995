//! Bristles on a contact ellipse: slip across the path and spin, at rest and rolling.
//!
//! Every point of the contact carries a bristle that bends with the motion of the two bodies against each other and slides where
//! its traction passes friction coefficient times Hertz's pressure. That leaves out how bristles pull on their neighbours through the bodies, so it
//! is no exact contact: it checks what the exact forms leave out, the path along which slip and spin grow and the rolling that carries bristles out of
//! the contact.
//!
//! Lengths are over the major semi-axis (across the path), forces over the friction limit.

/// A rectangular grid of bristles on an ellipse with the minor semi-axis `axis_ratio` along the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Brush {
    columns: Vec<Column>,
    /// Traction of a bristle over its bend.
    stiffness: f64,
    /// Size of a cell along the path.
    step: f64,
    area: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Column {
    across: f64,
    bristles: Vec<Bristle>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Bristle {
    along: f64,
    limit: f64,
    bend: [f64; 2],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    pub across: f64,
    pub spin: f64,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    pub force: f64,
    pub moment: f64,
}

impl Brush {
    /// `across` by `along` cells over the ellipse's rectangle, those whose centres lie inside. `compliance` is slip over force while every bristle
    /// sticks.
    #[must_use]
    pub fn new(axis_ratio: f64, across: usize, along: usize, compliance: f64) -> Self {
        let step = 2.0 * axis_ratio / along as f64;
        let width = 2.0 / across as f64;
        let place = |index: usize, count: usize| (2.0 * index as f64 + 1.0) / count as f64 - 1.0;
        let mut columns: Vec<Column> = (0..across)
            .map(|index| {
                let x = place(index, across);
                let bristles = (0..along)
                    .filter_map(|index| {
                        let y = place(index, along);
                        let left = 1.0 - x * x - y * y;
                        (left > 0.0).then(|| Bristle {
                            along: axis_ratio * y,
                            limit: left.sqrt(),
                            bend: [0.0; 2],
                        })
                    })
                    .collect();
                Column {
                    across: x,
                    bristles,
                }
            })
            .collect();
        let area = width * step;
        let bristles = || columns.iter().flat_map(|column| &column.bristles);
        let whole: f64 = bristles().map(|bristle| bristle.limit * area).sum();
        let stiffness = 1.0 / (compliance * area * bristles().count() as f64);
        for bristle in columns.iter_mut().flat_map(|column| &mut column.bristles) {
            bristle.limit /= whole;
        }
        Self {
            columns,
            stiffness,
            step,
            area,
        }
    }

    #[must_use]
    pub fn spin_stiffness(&self) -> f64 {
        self.sum(|x, bristle| self.stiffness * (x * x + bristle.along.powi(2)))
    }

    #[must_use]
    pub fn spin_limit(&self) -> f64 {
        self.sum(|x, bristle| bristle.limit * x.hypot(bristle.along))
    }

    pub fn follow(&mut self, motion: Motion) -> Load {
        let stiffness = self.stiffness;
        for column in &mut self.columns {
            for bristle in &mut column.bristles {
                bristle.bend[0] += motion.across - motion.spin * bristle.along;
                bristle.bend[1] += motion.spin * column.across;
                let traction = stiffness * bristle.bend[0].hypot(bristle.bend[1]);
                if traction > bristle.limit {
                    let share = bristle.limit / traction;
                    bristle.bend = bristle.bend.map(|bend| bend * share);
                }
            }
        }
        Load {
            force: self.sum(|_, bristle| stiffness * bristle.bend[0]),
            moment: self.sum(|x, bristle| {
                stiffness * (x * bristle.bend[1] - bristle.along * bristle.bend[0])
            }),
        }
    }

    fn sum(&self, value: impl Fn(f64, &Bristle) -> f64) -> f64 {
        let value = &value;
        let cells = self.columns.iter().flat_map(|column| {
            column
                .bristles
                .iter()
                .map(move |bristle| value(column.across, bristle))
        });
        self.area * cells.sum::<f64>()
    }
}
