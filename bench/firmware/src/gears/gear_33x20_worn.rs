// Folded by epas-design; not to be edited.
// digest of the inputs: b4cf3b2caf49ac5b
// pitch radius 0.0165 m, lead 0.02 m, ball radius 0.002778 m, contact angle 0.7853982 rad, clearance 0.000002 m, 36 balls
// holds for friction coefficients 0.075 to 0.075 and axial loads of 5 to 300 N a ball, both signs
// certificate: caged_torque, relative error on 2048 states that were not fitted (seed 1): largest 4.63e-5, rms 1.41e-5, mean -1.0e-6; flagged 0.00 %

/// A caged ball screw: `FrictionModel::<CagedBallScrew<1>, _>::of(&GEAR_33X20_WORN)`.
pub static GEAR_33X20_WORN: epas_friction::scene::CagedConstants<1> =
    match epas_friction::scene::CagedConstants::from_block(&GEAR_33X20_WORN_BLOCK) {
        Ok(constants) => constants,
        Err(_) => panic!("the block is damaged, or of another version of epas-friction"),
    };

#[rustfmt::skip]
#[allow(clippy::large_const_arrays, clippy::unreadable_literal, reason = "read while compiling alone")]
const GEAR_33X20_WORN_BLOCK: [u32; 101] = [
    0x53415045, 0x00000001, 0x00000065, 0x00000001, 0xaf49ac5b, 0xb4cf3b2c,
    0x3d99999a, 0x3ca3d70a, 0x42100000, 0x3f000000, 0x42c80000, 0x469c4000,
    0x41a00000, 0x00000000, 0x42f55b1e, 0x43073a93, 0x3f800000, 0x3d99999a,
    0x42f55b1e, 0x42fe28b4, 0x43034d02, 0x43040271, 0x4304701d, 0x4305804a,
    0x4306e3a2, 0x4306eefc, 0x3a5a8c48, 0x370fa631, 0x350c2c31, 0x34a77fb0,
    0x3a6e0db1, 0x380826f0, 0x36a3b8d4, 0x358137b0, 0x3a9de034, 0x3902ce74,
    0x37834373, 0x35a11596, 0x3aaa8cdb, 0x391d744e, 0x383842bf, 0xb81396ca,
    0x3ab3ad19, 0x392f7ce5, 0xb767e702, 0xb752edf4, 0x3ac6f84a, 0x38cb88ab,
    0xb865cd3d, 0xb705037e, 0x3ac80302, 0xb901ed43, 0x3b320279, 0xbd8c5a02,
    0x3ac7355d, 0xb9859984, 0xb868d3dd, 0x3862e9fc, 0x42f55b1e, 0x42fd541e,
    0x43025382, 0x4303c5ee, 0x43044e14, 0x4304ce91, 0x43062a5e, 0x430736ca,
    0x3a5c13f3, 0x371cba31, 0x354b8b9a, 0x34888a6b, 0x3a6d38cd, 0x37ee8d9f,
    0x367b1df8, 0x356a6893, 0x3a907527, 0x38bf06b6, 0x376873b8, 0x34907122,
    0x3aa5a463, 0x390a5a67, 0x3767c15a, 0x377fe390, 0x3aafa70b, 0x39261633,
    0x37487667, 0xb806c09e, 0x3ab9ef44, 0x391aafd2, 0xb7f3adbe, 0xb7338cf9,
    0x3ac9a8aa, 0x37302c87, 0xb89a73d6, 0xb6878b68, 0x3abfe0fa, 0xb92407c6,
    0x00000000, 0x00000000, 0x00000000, 0x00000000, 0x38ce458b,
];
