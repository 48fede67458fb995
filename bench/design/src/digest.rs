//! What a block was folded from, as one number.
//!
//! The digest is FNV-1a with 64 bits over words of 32 bits, each with its least significant byte first; a number is the bits of its `f32`. Their
//! order, in which nothing has a name:
//!
//! | words | of |
//! |---|---|
//! | 1 | kind of the fold: 1 in a cage, 2 without |
//! | 1 | version of its algorithm |
//! | 3 | pitch radius, lead, ball radius |
//! | 2, 2 | groove of the screw, of the nut: 0 and its conformity, or 1 and its radius |
//! | 1 | contact angle |
//! | 3, 3 | material of the balls, of the grooves: Young's modulus, Poisson's ratio, density |
//! | 1 | friction coefficient |
//! | 2 | hysteresis loss, lubricant drag |
//! | 3 | clearance, number of loaded balls, reversal speed |
//! | 3 | largest nut speed, axial load, friction torque |
//! | 2 | without a cage: largest deviations on the screw, in the nut |
//! | 3 | range of friction coefficients: 1, least, largest; or three times 0 |
//! | 2 | least and largest axial load of a ball |
//! | 2 | seed of the certificate, low word first |

use epas_friction::{BallScrewParameters, GrooveSize, Limits, Material, RollingResistance};

use crate::caged::{self, CagedDesign, CagedFold};
use crate::uncaged::{self, UncagedFold};

struct Digest(u64);

impl Digest {
    fn of(kind: u32, algorithm: u32) -> Self {
        let mut digest = Self(0xcbf2_9ce4_8422_2325);
        digest.words(&[kind, algorithm]);
        digest
    }

    fn words(&mut self, words: &[u32]) {
        for byte in words.iter().flat_map(|word| word.to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }

    fn numbers(&mut self, numbers: &[f32]) {
        for number in numbers {
            self.words(&[number.to_bits()]);
        }
    }

    fn screw(&mut self, parameters: &BallScrewParameters) {
        let BallScrewParameters {
            pitch_radius,
            lead,
            ball_radius,
            screw_groove,
            nut_groove,
            contact_angle,
            ball_material,
            groove_material,
        } = *parameters;
        self.numbers(&[pitch_radius, lead, ball_radius]);
        for groove in [screw_groove, nut_groove] {
            let (kind, number) = match groove {
                GrooveSize::Conformity(conformity) => (0, conformity),
                GrooveSize::Radius(radius) => (1, radius),
            };
            self.words(&[kind, number.to_bits()]);
        }
        self.numbers(&[contact_angle]);
        for material in [ball_material, groove_material] {
            let Material {
                youngs_modulus,
                poisson_ratio,
                density,
            } = material;
            self.numbers(&[youngs_modulus, poisson_ratio, density]);
        }
    }

    fn gear(&mut self, gear: &CagedDesign) {
        let CagedDesign {
            design,
            friction,
            rolling_resistance:
                RollingResistance {
                    hysteresis_loss,
                    lubricant_drag,
                },
            clearance,
            loaded_balls,
            reversal_speed,
            limits:
                Limits {
                    nut_speed,
                    axial_load,
                    friction_torque,
                },
        } = gear;
        self.screw(design.parameters());
        self.numbers(&[*friction, *hysteresis_loss, *lubricant_drag]);
        self.numbers(&[clearance.gap(), f32::from(*loaded_balls), *reversal_speed]);
        self.numbers(&[*nut_speed, *axial_load, *friction_torque]);
    }

    fn domain(&mut self, friction: Option<[f32; 2]>, axial_load: [f32; 2], seed: u64) {
        self.words(&[u32::from(friction.is_some())]);
        self.numbers(&friction.unwrap_or_default());
        self.numbers(&axial_load);
        self.words(&[seed as u32, (seed >> 32) as u32]);
    }
}

pub(crate) fn of_caged(fold: &CagedFold) -> u64 {
    let CagedFold {
        gear,
        friction,
        axial_load,
        seed,
    } = fold;
    let mut digest = Digest::of(1, caged::ALGORITHM);
    digest.gear(gear);
    digest.domain(*friction, *axial_load, *seed);
    digest.0
}

pub(crate) fn of_uncaged(fold: &UncagedFold) -> u64 {
    let UncagedFold {
        gear,
        friction,
        ball_friction,
        axial_load,
        seed,
    } = fold;
    let mut digest = Digest::of(2, uncaged::ALGORITHM);
    digest.gear(&gear.gear);
    digest.numbers(&gear.deviations);
    digest.numbers(&[*ball_friction]);
    digest.domain(*friction, *axial_load, *seed);
    digest.0
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use epas_friction::{BallScrew, Clearance, DISSERTATION_DESIGNS};

    use super::*;
    use crate::{CagedDesign, UncagedDesign, gears};

    fn fold() -> CagedFold {
        CagedFold::of(gears::gear_33x20().unwrap())
    }

    fn with_gear(change: impl Fn(&mut CagedDesign)) -> CagedFold {
        let mut fold = fold();
        change(&mut fold.gear);
        fold
    }

    fn with_screw(change: impl Fn(&mut BallScrewParameters)) -> CagedFold {
        let mut parameters = DISSERTATION_DESIGNS[1].parameters;
        change(&mut parameters);
        with_gear(|gear| gear.design = BallScrew::new(parameters).unwrap())
    }

    fn up(number: &mut f32) {
        *number = number.next_up();
    }

    /// FNV-1a as published, byte by byte.
    fn fnv_1a(bytes: impl IntoIterator<Item = u8>) -> u64 {
        bytes
            .into_iter()
            .fold(14_695_981_039_346_656_037, |digest, byte| {
                (digest ^ u64::from(byte)).wrapping_mul(1_099_511_628_211)
            })
    }

    /// Every number of a screw, of its gear, of the domain, changed alone by one unit of its last place, gives another digest, and so do the
    /// kind of a groove and the kind of the fold.
    #[test]
    fn every_number_counts() {
        let changed = [
            fold(),
            with_screw(|screw| up(&mut screw.pitch_radius)),
            with_screw(|screw| up(&mut screw.lead)),
            with_screw(|screw| up(&mut screw.ball_radius)),
            with_screw(|screw| screw.screw_groove = GrooveSize::Conformity(0.53)),
            with_screw(|screw| screw.nut_groove = GrooveSize::Conformity(0.53)),
            with_screw(|screw| screw.nut_groove = GrooveSize::Radius(3.4e-3)),
            with_screw(|screw| screw.screw_groove = GrooveSize::Radius(3.4e-3)),
            with_screw(|screw| up(&mut screw.contact_angle)),
            with_screw(|screw| up(&mut screw.ball_material.youngs_modulus)),
            with_screw(|screw| up(&mut screw.ball_material.poisson_ratio)),
            with_screw(|screw| up(&mut screw.groove_material.youngs_modulus)),
            with_screw(|screw| up(&mut screw.groove_material.poisson_ratio)),
            with_screw(|screw| up(&mut screw.ball_material.density)),
            with_screw(|screw| up(&mut screw.groove_material.density)),
            with_gear(|gear| up(&mut gear.friction)),
            with_gear(|gear| up(&mut gear.rolling_resistance.hysteresis_loss)),
            with_gear(|gear| up(&mut gear.rolling_resistance.lubricant_drag)),
            with_gear(|gear| gear.clearance = Clearance::new(1e-6).unwrap()),
            with_gear(|gear| gear.loaded_balls += 1),
            with_gear(|gear| up(&mut gear.reversal_speed)),
            with_gear(|gear| up(&mut gear.limits.nut_speed)),
            with_gear(|gear| up(&mut gear.limits.axial_load)),
            with_gear(|gear| up(&mut gear.limits.friction_torque)),
        ];
        let mut domains = [fold(); 7];
        domains[0].friction = Some([0.05, 0.15]);
        domains[1].friction = Some([0.05, 0.15_f32.next_up()]);
        domains[2].friction = Some([0.05_f32.next_up(), 0.15]);
        up(&mut domains[3].axial_load[0]);
        up(&mut domains[4].axial_load[1]);
        domains[5].seed ^= 1 << 63;
        domains[6].seed += 1;
        let caged = changed.iter().chain(&domains);
        let mut seen: BTreeSet<u64> = caged.map(of_caged).collect();
        assert_eq!(seen.len(), changed.len() + domains.len());

        let design = |deviations| {
            UncagedFold::of(UncagedDesign {
                gear: fold().gear,
                deviations,
            })
        };
        for deviations in [[0.02, 0.01], [0.02, 0.01_f32.next_up()], [0.01, 0.02]] {
            assert!(
                seen.insert(of_uncaged(&design(deviations))),
                "{deviations:?}"
            );
        }
    }

    /// The digest is the published hash of the bare numbers in the stated order, written here without the name of a field: a name that changes
    /// changes no digest.
    #[test]
    fn names_do_not_count() {
        assert_eq!(fnv_1a(*b"foobar"), 0x8594_4171_f739_67e8);
        let fold = fold();
        let bits = f32::to_bits;
        let steel = [210e9, 0.28, 7800.0].map(bits);
        let mut words = vec![1, caged::ALGORITHM];
        words.extend([16.5e-3, 20e-3, 2.778e-3].map(bits));
        words.extend([0, bits(0.56), 0, bits(0.56)]);
        words.push(bits(core::f32::consts::FRAC_PI_4));
        words.extend(steel);
        words.extend(steel);
        words.extend([0.075, 0.01, 0.0].map(bits));
        words.extend([-4.068_737e-7, 36.0, 0.5].map(bits));
        words.extend([100.0, 20_000.0, 20.0].map(bits));
        words.extend([0, 0, 0, bits(5.0), bits(300.0), 1, 0]);
        let bytes = words.iter().flat_map(|word| word.to_le_bytes());
        assert_eq!(of_caged(&fold), fnv_1a(bytes));
    }
}
