/// How the body is held, which chooses the pole `O`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Support {
    /// Free in space: `O` is the centre of mass of the frozen body `S*` and the translation is eliminated.
    #[default]
    Free,
    /// One point of the carrier is fixed in space and is the pole `O`.
    FixedPoint {
        /// The point (m), in the file's frame.
        point: [f64; 3],
    },
}
