//! The result of a look: the liquid in each place, and the arrivals there since the look before.

use glam::{DVec3, Vec3};

use super::PLACES;

/// Whose skin a part is.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Skin {
    /// The left hand.
    Left,
    /// The right hand.
    Right,
    /// The face.
    Face,
}

impl Skin {
    /// In the order of [`Census::skin`].
    pub const ALL: [Self; 3] = [Self::Left, Self::Right, Self::Face];
}

/// A part of a user that liquid can touch: the hull of two spheres in the scene's stage, m of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinPart {
    /// Whose it is.
    pub whose: Skin,
    /// The spheres' centres.
    pub ends: [Vec3; 2],
    /// Their radii.
    pub radii: [f32; 2],
}

/// Liquid in a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held {
    /// Particles in it.
    pub particles: u32,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// Mean temperature over them, °C; `None` of none, and where no heat is modelled.
    pub temperature: Option<f32>,
    /// Temperature of the hottest particle, °C; `None` of none, and where no heat is modelled.
    pub hottest: Option<f32>,
    /// Greatest superheat (temperature over the boiling point) of a particle, K, mostly negative; `None` of none, and where no heat is
    /// modelled.
    pub superheat: Option<f32>,
    /// Mean acid mass fraction over them.
    pub acid: f32,
    /// Liquid that came to it from elsewhere since the last look.
    pub came: Came,
    /// Its bubbles.
    pub bubbles: Bubbling,
}

/// Harmful liquid at a user's skin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touching {
    /// Particles that touch it, without thrown drops.
    pub particles: u32,
    /// Harmful liquid that came to it and had not touched it before.
    pub came: Came,
    /// Volume of harmless liquid that came to it and had not touched it before, m³ of the scene; 0 in a scene without tools.
    pub rinsed: f64,
}

/// Liquid that came to a place since the last look; means are over particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Came {
    /// Particles.
    pub particles: u32,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// Mean speed, m/s.
    pub speed: f64,
    /// Mean place in the stage, m of the scene.
    pub position: DVec3,
    /// Mean acid mass fraction.
    pub acid: f64,
    /// Mean temperature, °C; `None` of none, and where no heat is modelled.
    pub temperature: Option<f64>,
}

/// A place of a [`Census`].
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Place {
    /// In a flask.
    Flask(usize),
    /// In no flask, and not lying.
    Air,
    /// Lying on the table.
    Table,
    /// Lying on the floor.
    Floor,
    /// At a user's skin, and harmful.
    Skin(Skin),
}

impl Place {
    /// In the order of the tallies.
    fn row(self, flasks: usize) -> usize {
        match self {
            Self::Flask(flask) => flask,
            Self::Air => flasks,
            Self::Table => flasks + 1,
            Self::Floor => flasks + 2,
            Self::Skin(skin) => flasks + 3 + skin as usize,
        }
    }
}

/// Liquid that came to a place since the last look and had been in a given flask last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moved {
    /// Particles.
    pub particles: u32,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// Acid mass fraction, mean over that volume.
    pub acid: f64,
}

/// What a drop came to rest on.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Onto {
    /// A user's skin, or what is worn on it.
    Skin(Skin),
    /// The table.
    Table,
    /// The floor.
    Floor,
    /// The outside of a flask. What flies against its inside runs down into its liquid.
    Flask(usize),
}

/// Drops of a bubble that came to rest since the last look: harmful ones on skin, all on table, floor and the outside of glass. A particle is
/// none: it is liquid that runs on, or lies there itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landed {
    /// What it came to rest on.
    pub onto: Onto,
    /// Where it lies; where it touched skin, the place to which it came in the time of the look. In the stage, and on a flask in the
    /// flask's frame, m of the scene.
    pub position: Vec3,
    /// Its way to there in the time of the look, m of the scene; 0 on table, floor and glass.
    pub way: Vec3,
    /// Volume, m³ of the scene.
    pub volume: f64,
    /// Acid mass fraction.
    pub acid: f32,
}

/// Bubbles of a flask, and those that were born, collapsed or burst since the last look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bubbling {
    /// Present bubbles, and their mean radius, m.
    pub here: BubbleCount,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// Number of bubbles born since the last look.
    pub born: u32,
    /// Bubbles that collapsed in liquid too cold for them, and the mean of their largest radii, m.
    pub collapsed: BubbleCount,
    /// Bubbles that burst at the surface, and the mean of their largest radii, m.
    pub burst: BubbleCount,
}

/// A number of bubbles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BubbleCount {
    /// How many.
    pub count: u32,
    /// Their mean radius, m; 0 of none.
    pub radius: f64,
}

/// Where all liquid is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Census {
    /// By flask.
    pub flasks: Vec<Held>,
    /// In no flask, and not lying.
    pub air: Held,
    /// Lying on the table.
    pub table: Held,
    /// Lying on the floor.
    pub floor: Held,
    /// By [`Skin::ALL`]: harmful liquid of no flask ([`HARMFUL`](super::HARMFUL)) that touches it, and that newly came to it.
    pub skin: [Touching; 3],
    /// Liquid moved by place and flask, which [`Census::moved`] reads; empty where nothing moved.
    pub moves: Vec<Moved>,
    /// Drops that came to rest since the last look; of more than 64 any 64, and beside them of more than 32 on flasks any 32.
    pub landed: Vec<Landed>,
    /// By flask: volume of the drops of its bubbles that came to rest elsewhere since the start, m³ of the scene at rest density.
    pub sprayed: Vec<f64>,
}

impl Census {
    /// Liquid that came to a place and had been in `flask` last. On table and floor, and at skin, each particle counts once until it is
    /// in a flask again, so that liquid that bounces or runs off is not counted twice.
    pub fn moved(&self, to: Place, flask: usize) -> Moved {
        let flasks = self.flasks.len();
        let row = to.row(flasks);
        match flask < flasks {
            true => (self.moves.get(row * flasks + flask))
                .copied()
                .unwrap_or_default(),
            false => Moved::default(),
        }
    }

    /// This census with `moved` as the value that [`Census::moved`] gives for `to` and `flask`, for tests of code that reads it.
    #[must_use]
    pub fn with_moved(mut self, to: Place, flask: usize, moved: Moved) -> Self {
        let flasks = self.flasks.len();
        let row = to.row(flasks);
        self.moves
            .resize((flasks + PLACES) * flasks, Moved::default());
        if let Some(held) = self.moves.get_mut(row * flasks + flask) {
            *held = moved;
        }
        self
    }
}
