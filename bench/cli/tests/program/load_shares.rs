/// Load of each ball of lin-2.1 over the mean, under 5000 N along the axis,
/// along the loaded track from the end where the load acts: the static model of
/// Lin 2019, chapter 2. 32 balls; the largest share is 1.300 of the smallest.
/// It serves loads of 667 to 9600 N
/// and, the other way, of -552 to -9600 N
/// within 1 % of the grooves' friction and 5 % of the largest ball load.
#[allow(clippy::unreadable_literal, reason = "written by a program")]
pub static LOAD_SHARES: [epas_friction::LoadShare; 32] = {
    const fn share(share: f32) -> epas_friction::LoadShare {
        match epas_friction::LoadShare::new(share) {
            Ok(share) => share,
            Err(_) => panic!("a share is 0.01 to 100"),
        }
    }
    [
        share(1.0476071),
        share(0.9743335),
        share(0.92538375),
        share(0.90381426),
        share(0.90825415),
        share(0.9337257),
        share(0.9726173),
        share(1.0159382),
        share(1.054917),
        share(1.0827159),
        share(1.0957956),
        share(1.0944773),
        share(1.0849922),
        share(1.0703701),
        share(1.0564418),
        share(1.0480905),
        share(1.0479312),
        share(1.0556977),
        share(1.0682827),
        share(1.0804238),
        share(1.085958),
        share(1.0794345),
        share(1.0577203),
        share(1.0211438),
        share(0.9760197),
        share(0.92687476),
        share(0.8824334),
        share(0.8518626),
        share(0.8430918),
        share(0.8615419),
        share(0.90907955),
        share(0.9830299),
    ]
};
