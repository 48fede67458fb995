//! Equations of motion of one ball between its grooves, in scaled variables.
//!
//! Frame along the ball path: tangent `t`, normal `n` (to the axis), binormal `b`; the axis is
//! `k = Sa t + Ca b`. A contact lies at `C = (0, Cn, Cb)` from the ball's centre (times `r_b`): the main
//! ones at `A = (0, -cos, -sin)` of the contact angle on the nut and `B = (0, cos, sin)` on the screw,
//! the minor ones at `A' = (0, -cos, sin)` and `B' = (0, cos, -sin)`. With `x = (0, -Cb, Cn)` across
//! the groove and `y = t` along it, the slips (7), (8) of Lin, Velinsky, Ravani 1994 are for each contact
//!
//! ```text
//! Vx = wt - u Sa        Vy = D (w - u) + wn Cb - (wb - u Ca) Cn
//! ```
//!
//! (`u` the speed of the groove's body, `w` that of the ball about the axis, `D = d / r_b`), and a
//! normal load `Q` with friction `(fx, fy)` gives the ball a force `(fy, -Q Cn - fx Cb, -Q Cb + fx Cn)`
//! and a moment `r_b (fx, fy Cb, -fy Cn)`.

use std::f64::consts::PI;

use nalgebra::SVector;
use num_dual::DualNum;

use epas_reference::curvature::Groove;
use epas_reference::error::ReferenceError;
use epas_reference::steady_state::BallScrewState;

/// How far the ball is from rolling: `wt`, `wn`, `wb` and `D w`, less those of rolling, over `|Omega|`.
///
/// Differences in place of speeds: where a contact sticks its slip is a millionth of the surface speed or
/// less, and the difference of two surface speeds would round it away.
pub type State<T> = SVector<T, 4>;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    pub groove: Groove,
    pub normal: f64,
    pub binormal: f64,
}

/// One ball with two contacts on the groove of `minor` and one on the other; speeds over the relative
/// speed of screw and nut, loads over `F0 = Fa / (Ca Sb)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    pub sin_a: f64,
    pub cos_a: f64,
    pub sin_b: f64,
    pub cos_b: f64,
    pub friction: f64,
    /// `a = r_b / r_m`.
    pub ball_ratio: f64,
    /// Speeds of screw and nut; their difference is 1 or -1.
    pub screw: f64,
    pub nut: f64,
    pub minor: Groove,
    /// `F0 f r_b / (I Omega²)`.
    pub grip: f64,
    /// `m r_m Omega² / F0`.
    pub inertia: f64,
    /// Slip speed over which friction is smoothed, over `r_b |Omega|`.
    pub smoothing: f64,
}

/// Speeds over `|Omega|`: about the screw's axis, and of the ball along tangent, normal and binormal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speeds<T> {
    pub orbital: T,
    pub ball: [T; 3],
}

/// What acts at a contact: the normal load over `F0`, the slip over `r_b |Omega|`, and the friction over
/// `f Q` (both across and along the groove).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action<T> {
    pub contact: Contact,
    pub normal_load: T,
    pub slip: [T; 2],
    pub pull: [T; 2],
}

impl Motion {
    /// The ball's motion where `turning` turns and the other part moves along the axis; `smoothing` over
    /// the slip speed of rolling. With a positive speed the load is moved, with a negative one it drives.
    pub fn new(
        ball: &BallScrewState,
        turning: Groove,
        minor: Groove,
        smoothing: f64,
    ) -> Result<Self, ReferenceError> {
        ball.check()?;
        let (sin_a, cos_a) = ball.lead_angle.sin_cos();
        let (sin_b, cos_b) = ball.contact_angle.sin_cos();
        let radius = ball.ball_radius;
        let mass = ball.ball_density * 4.0 / 3.0 * PI * radius.powi(3);
        let load = ball.axial_load / (cos_a * sin_b);
        let squared = ball.speed * ball.speed;
        // Only the relative turn counts: a turning nut is a screw that turns the other way.
        let (screw, nut) = match turning {
            Groove::Screw => (ball.speed.signum(), 0.0),
            Groove::Nut => (0.0, -ball.speed.signum()),
        };
        Ok(Self {
            sin_a,
            cos_a,
            sin_b,
            cos_b,
            friction: ball.friction,
            ball_ratio: radius / ball.pitch_radius,
            screw,
            nut,
            minor,
            grip: load * ball.friction / (0.4 * mass * radius * squared),
            inertia: mass * ball.pitch_radius * squared / load,
            smoothing: smoothing * sin_a,
        })
    }

    /// `D = d / r_b = 1 / (a Ca)`.
    pub fn arm(&self) -> f64 {
        1.0 / (self.ball_ratio * self.cos_a)
    }

    /// Speed of the screw over the nut: 1 or -1.
    pub fn relative(&self) -> f64 {
        self.screw - self.nut
    }

    fn contacts(&self) -> [Contact; 3] {
        let (s, c) = (self.sin_b, self.cos_b);
        let at = |groove, normal, binormal| Contact {
            groove,
            normal,
            binormal,
        };
        let minor = match self.minor {
            Groove::Nut => at(Groove::Nut, -c, s),
            Groove::Screw => at(Groove::Screw, c, -s),
        };
        [at(Groove::Nut, -c, -s), at(Groove::Screw, c, s), minor]
    }

    fn speed_of(&self, groove: Groove) -> f64 {
        match groove {
            Groove::Screw => self.screw,
            Groove::Nut => self.nut,
        }
    }

    /// The ball sticks to the groove with two contacts; against the other one it slips across only.
    pub fn rolling(&self) -> Speeds<f64> {
        let (c, arm) = (self.cos_b, self.arm());
        let sum = self.screw + self.nut;
        Speeds {
            orbital: 0.5 * (sum - self.relative() * self.cos_a * c / arm),
            ball: [
                self.speed_of(self.minor) * self.sin_a,
                0.0,
                0.5 * (sum * self.cos_a - self.relative() * arm / c),
            ],
        }
    }

    pub fn speeds<T: DualNum<f64> + Copy>(&self, state: &State<T>) -> Speeds<T> {
        let rolling = self.rolling();
        let [t, n, b, advance] = (*state).into();
        let [t0, n0, b0] = rolling.ball;
        Speeds {
            orbital: advance / self.arm() + rolling.orbital,
            ball: [t + t0, n + n0, b + b0],
        }
    }

    /// Slips, friction and normal loads of A, B and the minor contact; the loads from the radial and
    /// binormal equilibrium of the ball and the axial load on the nut, eq. (5b), (5c), (9).
    pub fn actions<T: DualNum<f64> + Copy>(&self, state: &State<T>) -> [Action<T>; 3] {
        let [t, n, b, advance] = (*state).into();
        let f = self.friction;
        let mut actions = self.contacts().map(|contact| {
            let base = (self.speed_of(self.minor) - self.speed_of(contact.groove)) * self.sin_a;
            let slip = [
                t + base,
                advance + n * contact.binormal - b * contact.normal,
            ];
            let [x, y] = slip;
            // Coulomb friction opposes the slip; V / sqrt(V² + V0²) smooths its reversal.
            let speed = (x * x + y * y + self.smoothing * self.smoothing).sqrt();
            Action {
                contact,
                normal_load: T::from(0.0),
                slip,
                pull: [-x / speed, -y / speed],
            }
        });
        let radial = actions.map(|at| at.pull[0] * (-f * at.contact.binormal) - at.contact.normal);
        let lateral = actions.map(|at| at.pull[0] * (f * at.contact.normal) - at.contact.binormal);
        let axial = actions.map(|at| match at.contact.groove {
            Groove::Nut => {
                (at.pull[0] * (f * at.contact.normal) - at.contact.binormal) * self.cos_a
                    + at.pull[1] * (f * self.sin_a)
            }
            Groove::Screw => T::from(0.0),
        });
        let orbital = self.speeds(state).orbital;
        let right = [
            orbital * orbital * self.inertia,
            T::from(0.0),
            T::from(self.cos_a * self.sin_b),
        ];
        let loads = cramer([radial, lateral, axial], right);
        for (action, load) in actions.iter_mut().zip(loads) {
            action.normal_load = load;
        }
        actions
    }

    /// Rate of the state over the angle of the turning part: eq. (5) with the accelerations `m d W' t` and `I omega'`.
    pub fn rate<T: DualNum<f64> + Copy>(&self, state: &State<T>) -> State<T> {
        let Speeds {
            orbital: w,
            ball: [t, n, b],
        } = self.speeds(state);
        // I (omega' + W k x omega), k = Sa t + Ca b.
        let mut rate = [
            w * n * self.cos_a,
            w * (b * self.sin_a - t * self.cos_a),
            -w * n * self.sin_a,
            T::from(0.0),
        ];
        for at in self.actions(state) {
            let [x, y] = at.pull.map(|pull| pull * at.normal_load * self.grip);
            // The last one: I / (m r_b²) = 0.4.
            let parts = [x, y * at.contact.binormal, -y * at.contact.normal, y * 0.4];
            for (rate, part) in rate.iter_mut().zip(parts) {
                *rate += part;
            }
        }
        State::from(rate)
    }

    /// Torque on the screw over `r_m F0`, `(R x F) · k` over its contacts, eq. (9).
    pub fn torque(&self, actions: &[Action<f64>; 3]) -> f64 {
        actions
            .iter()
            .filter(|at| at.contact.groove == Groove::Screw)
            .map(|at| {
                let [x, y] = at.pull.map(|pull| pull * self.friction);
                let (n, b) = (at.contact.normal, at.contact.binormal);
                let (radius, lever) = (self.ball_ratio * n - 1.0, self.ball_ratio * b);
                let (force_n, force_b) = (-n - x * b, -b + x * n);
                at.normal_load
                    * (self.sin_a * (radius * force_b - lever * force_n) - self.cos_a * radius * y)
            })
            .sum()
    }
}

fn cramer<T: DualNum<f64> + Copy>(rows: [[T; 3]; 3], right: [T; 3]) -> [T; 3] {
    let determinant = |m: [[T; 3]; 3]| {
        let [[a, b, c], [d, e, f], [g, h, i]] = m;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    };
    let whole = determinant(rows);
    [0, 1, 2].map(|column| {
        let mut changed = rows;
        for (row, value) in changed.iter_mut().zip(right) {
            row[column] = value;
        }
        determinant(changed) / whole
    })
}
