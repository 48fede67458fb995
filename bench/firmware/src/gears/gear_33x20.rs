// Folded by epas-design; not to be edited.
// digest of the inputs: ace237b54106831d
// pitch radius 0.0165 m, lead 0.02 m, ball radius 0.002778 m, contact angle 0.7853982 rad, clearance -0.0000004068737 m, 36 balls
// holds for friction coefficients 0.075 to 0.075 and axial loads of 5 to 300 N a ball, both signs
// certificate: caged_torque, relative error on 2048 states that were not fitted (seed 1): largest 8.15e-5, rms 4.04e-5, mean -3.8e-6; flagged 0.00 %

/// A caged ball screw: `FrictionModel::<CagedBallScrew<1>, _>::of(&GEAR_33X20)`.
pub static GEAR_33X20: epas_friction::scene::CagedConstants<1> =
    match epas_friction::scene::CagedConstants::from_block(&GEAR_33X20_BLOCK) {
        Ok(constants) => constants,
        Err(_) => panic!("the block is damaged, or of another version of epas-friction"),
    };

#[rustfmt::skip]
#[allow(clippy::large_const_arrays, clippy::unreadable_literal, reason = "read while compiling alone")]
const GEAR_33X20_BLOCK: [u32; 101] = [
    0x53415045, 0x00000001, 0x00000065, 0x00000001, 0x4106831d, 0xace237b5,
    0x3d99999a, 0x3ca3d70a, 0x42100000, 0x3f000000, 0x42c80000, 0x469c4000,
    0x41a00000, 0x40fb6aa0, 0x4301fbae, 0x43074422, 0x4302f957, 0x3d99999a,
    0x4301fbae, 0x4302a713, 0x4302cb2a, 0x4302d1cd, 0x43038074, 0x4304c0dd,
    0x43053805, 0x4306216d, 0x3a236919, 0xb9e0928c, 0x398c673e, 0x37b3c35b,
    0x39f2c630, 0xb7c00b80, 0x391656d6, 0x3b0859eb, 0x39f5a1d9, 0x3945d961,
    0xbb642558, 0x3e6615a2, 0x39f905d0, 0x3a0098e5, 0xb8a773ce, 0x374bd428,
    0x3a4b8389, 0x39d1921c, 0xb85a6cd2, 0x372b58f3, 0x3a9f4380, 0x39a32c72,
    0x36ff5618, 0x362692a4, 0x3ab28002, 0x39a5208e, 0xb8519605, 0xb7b143c5,
    0x3ad0983e, 0x393737f0, 0xb8d8b64f, 0xb6d5bd04, 0x4301fbae, 0x43029f3f,
    0x4302c7e8, 0x4302d021, 0x430357c5, 0x43049103, 0x430534a3, 0x4305fa58,
    0x3a237038, 0xb9dd6c2d, 0x398e02d6, 0x376d900f, 0x39f5501c, 0xb837b3bd,
    0x392b8257, 0x3ab9d6ce, 0x39f6ceb7, 0x39137b18, 0xba40dcd9, 0x3d9f3eef,
    0x39fa2104, 0x3a017d3a, 0xb8a595eb, 0x36c74602, 0x3a3c183b, 0x39da911c,
    0xb87d4316, 0x372fb261, 0x3a979279, 0x39a58bac, 0xb8224d16, 0x380f3967,
    0x3ab11f12, 0x39a010db, 0xb825d167, 0xb7f0bb1e, 0x3acb33dc, 0x394eee85,
    0xb8cf59f0, 0xb6ded08f, 0x00000000, 0x00000000, 0x079baf2a,
];
