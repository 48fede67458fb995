//! Nodes and weights of Gauss and Legendre for any number of nodes, found by the compiler.
//!
//! In double precision, which never reaches the target: [`Rule::NODES`] is a constant.

/// The rule of `N` nodes.
pub(super) struct Rule<const N: usize>;

impl<const N: usize> Rule<N> {
    /// Nodes on -1 to 1 from the left, each with its weight; weights add up to 2.
    pub(super) const NODES: [(f32, f32); N] = nodes();
}

/// Zeros of the Legendre polynomial of degree `N`, by Newton's method beside those found already (Maehly): each starts where
/// the one before lies, and comes down to the next zero from outside.
const fn nodes<const N: usize>() -> [(f32, f32); N] {
    let mut found = [0.0; N];
    let mut nodes = [(0.0, 0.0); N];
    let mut index = 0;
    while index < N {
        // Outside of every zero that is left.
        let mut x = 1.0_f64;
        let mut steps = 0;
        while steps < 60 {
            let (value, slope) = legendre(N, x);
            let mut removed = 0.0;
            let mut other = 0;
            while other < index {
                removed += 1.0 / (x - found[other]);
                other += 1;
            }
            x -= value / (slope - value * removed);
            steps += 1;
        }
        let (_, slope) = legendre(N, x);
        found[index] = x;
        nodes[N - 1 - index] = (x as f32, (2.0 / ((1.0 - x * x) * slope * slope)) as f32);
        index += 1;
    }
    nodes
}

/// The Legendre polynomial of this degree and its derivative.
const fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    let (mut slope_before, mut slope) = (0.0, 0.0);
    let mut index = 0;
    while index < degree {
        // (n+1) P_{n+1} = (2n+1) x P_n - n P_{n-1}, and its derivative.
        let n = index as f64;
        let next = ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0);
        let slope_next = ((2.0 * n + 1.0) * (value + x * slope) - n * slope_before) / (n + 1.0);
        (before, value) = (value, next);
        (slope_before, slope) = (slope, slope_next);
        index += 1;
    }
    (value, slope)
}
