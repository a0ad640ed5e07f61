//! The numbers that shape ways; those of numerical accuracy are in `accuracy`.

/// Price of a door that is narrower than the body that is to pass it (u), unless parameters say otherwise:
/// more than any detour, so that such doors are a last resort, yet finite, so that an agent without a better
/// way still tries.
pub const IMPASSABLE_COST: f32 = 100.0;

/// The numbers that shape a [`Field`](crate::Field): prices beside the length of a path, and how closely its
/// bends are followed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NavigationParameters {
    /// Price of each door on a path that is narrower than the mover (u); at least 0.
    pub impassable: f32,
    /// Price of each unit of length within an obstacle grown by the mover's half width (dimensionless); at
    /// least 0.
    pub obstruction: f32,
    /// Price of each unit of length within the margin of a wall's end (dimensionless); at least 0. More than
    /// the way around costs keeps paths off corners.
    pub corner: f32,
    /// Distance to a bend below which [`Field::direction`](crate::Field::direction) cuts it (u); above 0.
    pub bend_distance: f32,
}

impl NavigationParameters {
    /// The parameters of PHASE's minds.
    pub const DEFAULT: Self =
        Self { impassable: IMPASSABLE_COST, obstruction: 2.0, corner: 3.0, bend_distance: 0.2 };
}

impl Default for NavigationParameters {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The numbers that shape an [`AssemblyField`](crate::AssemblyField): prices beside the length of the load's
/// path, and how exactly walls and the best path are followed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AssemblyParameters {
    /// Price of turning about the load (u/rad); at least 0.
    pub turning: f32,
    /// Price of each unit of cost while the assembly crosses a wall or is outside the arena (dimensionless);
    /// at least 0.
    pub collision: f32,
    /// Overlap with walls that does not count as a collision (u); at least 0. Grips yield a little, and
    /// positions and orientations are rounded to a grid.
    pub overlap: f32,
    /// Rise of the values from the nearest free configuration into a collision, relative to the cost of that
    /// move outside (dimensionless); at least 0. It has to lead out, and to matter little to a body that
    /// touches a wall.
    pub edge_rise: f32,
    /// Path length over which [`AssemblyField::descent`](crate::AssemblyField::descent) is averaged (u); at
    /// least 0.
    pub descent_length: f32,
}

impl AssemblyParameters {
    /// The parameters of PHASE's minds.
    pub const DEFAULT: Self =
        Self { turning: 1.0, collision: 10.0, overlap: 0.15, edge_rise: 2.0, descent_length: 0.75 };

    /// The bits that determine a field.
    pub(crate) fn bits(&self) -> [u32; 5] {
        let Self { turning, collision, overlap, edge_rise, descent_length } = *self;
        [turning, collision, overlap, edge_rise, descent_length].map(f32::to_bits)
    }
}

impl Default for AssemblyParameters {
    fn default() -> Self {
        Self::DEFAULT
    }
}
