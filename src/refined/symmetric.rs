//! A symmetric, positive system of three equations, in the order roll, yaw, speed.

/// Added to the diagonal, over the trace: in two-point contact the matrix has rank two, and without this a pivot would
/// vanish. From 1e-7 to 1e-4 errors are the same; a rounding is 6e-8.
const DAMPING: f32 = 1e-6;

/// Damping of a ball that has no loaded contact, N: it follows its neighbours without resistance.
const FLOOR: f32 = 1e-9;

/// Upper triangle of the matrix and the right side.
#[derive(Clone, Copy)]
pub(super) struct System {
    roll_roll: f32,
    roll_yaw: f32,
    roll_speed: f32,
    yaw_yaw: f32,
    yaw_speed: f32,
    speed_speed: f32,
    pub(super) right: Vector,
}

/// Roll, yaw, speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Vector {
    pub(super) roll: f32,
    pub(super) yaw: f32,
    pub(super) speed: f32,
}

impl Vector {
    pub(super) const ZERO: Self = Self {
        roll: 0.0,
        yaw: 0.0,
        speed: 0.0,
    };

    #[inline]
    pub(super) fn dot(self, other: Self) -> f32 {
        self.roll * other.roll + self.yaw * other.yaw + self.speed * other.speed
    }
}

/// The system in triangular form.
#[derive(Clone, Copy)]
pub(super) struct Factors {
    inverse: [f32; 3],
    yaw_roll: f32,
    speed_roll: f32,
    speed_yaw: f32,
}

impl System {
    pub(super) const EMPTY: Self = Self {
        roll_roll: 0.0,
        roll_yaw: 0.0,
        roll_speed: 0.0,
        yaw_yaw: 0.0,
        yaw_speed: 0.0,
        speed_speed: 0.0,
        right: Vector::ZERO,
    };

    /// Adds `weight` times the square of the row `(roll, yaw, 1)`.
    #[inline]
    pub(super) fn add_slip(&mut self, weight: f32, roll: f32, yaw: f32) {
        let (weighted_roll, weighted_yaw) = (weight * roll, weight * yaw);
        self.roll_roll += weighted_roll * roll;
        self.roll_yaw += weighted_roll * yaw;
        self.yaw_yaw += weighted_yaw * yaw;
        self.roll_speed += weighted_roll;
        self.yaw_speed += weighted_yaw;
        self.speed_speed += weight;
    }

    /// Adds `weight` times the square of the row `(roll, yaw, 0)`.
    #[inline]
    pub(super) fn add_spin(&mut self, weight: f32, roll: f32, yaw: f32) {
        let (weighted_roll, weighted_yaw) = (weight * roll, weight * yaw);
        self.roll_roll += weighted_roll * roll;
        self.roll_yaw += weighted_roll * yaw;
        self.yaw_yaw += weighted_yaw * yaw;
    }

    /// Subtracts `weight` times the square of the row `(roll, yaw, speed)`: eliminates an unknown.
    #[inline]
    pub(super) fn subtract(&mut self, by: Vector, weight: f32) {
        let (roll, yaw, speed) = (weight * by.roll, weight * by.yaw, weight * by.speed);
        self.roll_roll -= roll * by.roll;
        self.roll_yaw -= roll * by.yaw;
        self.roll_speed -= roll * by.speed;
        self.yaw_yaw -= yaw * by.yaw;
        self.yaw_speed -= yaw * by.speed;
        self.speed_speed -= speed * by.speed;
    }

    /// The damped system as a product of triangle, diagonal and transposed triangle: speed comes last, so that its own compliance is the
    /// last reciprocal, and the matrix of rank two of two-point contact loses no digits before it.
    ///
    /// The pivots are at least the damping, 1e-6 of the trace, but for roundings of 3e-7 of the trace:
    /// they stay positive.
    #[inline]
    pub(super) fn factors(&self) -> Factors {
        let damping = DAMPING * (self.roll_roll + self.yaw_yaw + self.speed_speed) + FLOOR;
        let first = 1.0 / (self.roll_roll + damping);
        let yaw_roll = self.roll_yaw * first;
        let speed_roll = self.roll_speed * first;
        let second = 1.0 / (self.yaw_yaw + damping - yaw_roll * self.roll_yaw);
        let left = self.yaw_speed - speed_roll * self.roll_yaw;
        let speed_yaw = left * second;
        let last = self.speed_speed + damping - speed_roll * self.roll_speed - speed_yaw * left;
        Factors {
            inverse: [first, second, 1.0 / last],
            yaw_roll,
            speed_roll,
            speed_yaw,
        }
    }
}

impl Factors {
    /// The solution for a right side.
    #[inline]
    pub(super) fn solve(&self, right: Vector) -> Vector {
        let [first, second, last] = self.inverse;
        let yaw = right.yaw - self.yaw_roll * right.roll;
        let speed = (right.speed - self.speed_roll * right.roll - self.speed_yaw * yaw) * last;
        let yaw = yaw * second - self.speed_yaw * speed;
        let roll = right.roll * first - self.yaw_roll * yaw - self.speed_roll * speed;
        Vector { roll, yaw, speed }
    }

    /// The solution for a unit force along the track.
    #[inline]
    pub(super) fn speed_column(&self) -> Vector {
        let speed = self.inverse[2];
        let yaw = -self.speed_yaw * speed;
        let roll = -self.yaw_roll * yaw - self.speed_roll * speed;
        Vector { roll, yaw, speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_was_added() {
        let mut system = System::EMPTY;
        system.add_slip(2.0, 0.7, 0.6);
        system.add_slip(3.0, -0.7, 0.8);
        system.add_spin(1.0, 0.5, 0.9);
        let wanted = Vector {
            roll: 0.3,
            yaw: -0.2,
            speed: 0.1,
        };
        let right = Vector {
            roll: system.roll_roll * 0.3 - system.roll_yaw * 0.2 + system.roll_speed * 0.1,
            yaw: system.roll_yaw * 0.3 - system.yaw_yaw * 0.2 + system.yaw_speed * 0.1,
            speed: system.roll_speed * 0.3 - system.yaw_speed * 0.2 + system.speed_speed * 0.1,
        };
        let factors = system.factors();
        let found = factors.solve(right);
        // The damping changes the solution by 1e-6 times the condition number, about 10.
        assert!((found.roll - wanted.roll).abs() < 3e-5);
        assert!((found.yaw - wanted.yaw).abs() < 3e-5);
        assert!((found.speed - wanted.speed).abs() < 3e-5);

        let column = factors.speed_column();
        let same = factors.solve(Vector {
            roll: 0.0,
            yaw: 0.0,
            speed: 1.0,
        });
        assert!((column.roll - same.roll).abs() < 1e-6);
        assert!((column.yaw - same.yaw).abs() < 1e-6);
        assert!((column.speed - same.speed).abs() < 1e-6);
    }
}
