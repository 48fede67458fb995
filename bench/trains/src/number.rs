//! From a number of balls that is known only when a program runs to a model whose number is a constant.

/// Most balls of a row.
pub const MOST_BALLS: u8 = 64;

/// No model is compiled for programs that know their number of balls.
#[cfg(not(feature = "any-number"))]
macro_rules! with_balls {
    ($model:ident, $scene:ident, $balls:expr, $configuration:expr) => {{
        let _ = (
            $balls,
            $configuration,
            core::marker::PhantomData::<$scene<1>>,
        );
        Ok(None)
    }};
}

/// A scene with so many balls; none where the number is out of range.
#[cfg(feature = "any-number")]
macro_rules! with_balls {
    (plain $scene:ident, $balls:expr, $configuration:expr; $($count:literal)*) => {
        match $balls {
            $($count => FrictionModel::<$scene<$count>>::new($configuration)
                .map(|model| Some(Box::new(model) as _)),)*
            _ => Ok(None),
        }
    };
    (remembering $scene:ident, $balls:expr, $configuration:expr; $($count:literal)*) => {
        match $balls {
            $($count => FrictionModel::<Remembering<$scene<$count>>>::new($configuration)
                .map(|model| Some(Box::new(model) as _)),)*
            _ => Ok(None),
        }
    };
    ($kind:ident, $scene:ident, $balls:expr, $configuration:expr) => {
        with_balls!($kind $scene, $balls, $configuration;
            1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
            33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61
            62 63 64)
    };
}
pub(crate) use with_balls;
