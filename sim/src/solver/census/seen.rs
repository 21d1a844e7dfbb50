//! What a look says: what is in each place, and what came there since the look before.

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

/// A part of a user that liquid can come to: the hull of two spheres in the scene's stage, m of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinPart {
    /// Whose it is.
    pub whose: Skin,
    /// The spheres' middles.
    pub ends: [Vec3; 2],
    /// Their radii.
    pub radii: [f32; 2],
}

/// What is in a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held {
    /// Particles in it.
    pub particles: u32,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// Mean temperature over them, °C; `None` of none, and where no heat is modelled.
    pub temperature: Option<f32>,
    /// That of the hottest, °C, likewise.
    pub hottest: Option<f32>,
    /// By how much the one that is furthest above its boiling point is above it, K, likewise; most are below.
    pub superheat: Option<f32>,
    /// Mean acid mass fraction over them.
    pub acid: f32,
    /// What came to it from elsewhere since the last look.
    pub came: Came,
    /// Its bubbles.
    pub bubbles: Bubbling,
}

/// Harmful liquid at somebody's skin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touching {
    /// Particles that touch it; thrown drops are none.
    pub particles: u32,
    /// What came to it that had not touched it before.
    pub came: Came,
    /// Volume of what is not harmful that came to it, likewise, m³ of the scene; 0 in a scene without tools.
    pub rinsed: f64,
}

/// What came to a place since the last look; means are over particles.
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
    /// At somebody's skin, and harmful.
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

/// What came to a place since the last look and had been in one flask last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moved {
    /// Particles.
    pub particles: u32,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// Acid mass fraction, mean over that volume.
    pub acid: f64,
}

/// Bubbles of a flask, and what became of them since the last look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bubbling {
    /// That are there, and their mean radius, m.
    pub here: BubbleCount,
    /// Their volume, m³ of the scene.
    pub volume: f64,
    /// That came to be.
    pub born: u32,
    /// That went out in liquid that is too cold for them, and the mean of their largest radii.
    pub collapsed: BubbleCount,
    /// That burst at the surface, likewise.
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
    /// By [`Skin::ALL`]: of the liquid of no flask that is harmful ([`HARMFUL`](super::HARMFUL)) how much touches it and what came to it anew.
    pub skin: [Touching; 3],
    /// By place and flask, as [`Census::moved`] says; empty where nothing did.
    pub moves: Vec<Moved>,
    /// By flask: what drops of its bubbles came to rest elsewhere since the start, m³ of the scene at rest density.
    pub sprayed: Vec<f64>,
}

impl Census {
    /// What came to a place and had been in `flask` last. On table and floor each particle counts once until it is in a flask again, so
    /// that what bounces or runs off is no more than it is; at skin likewise.
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

    /// The same with what was arranged, for tests of what reads it.
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
