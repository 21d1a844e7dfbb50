//! Census of the liquid by place, and of its moves between places since the last look, while the simulation goes on.
//!
//! It is made on the device, because to copy all particles to the host in each frame would take longer than the look. A step depends
//! on nothing of it, so a replay without looks has the same bits.

mod seen;

use super::buffers::Buffers;
use super::dormant;
use super::pipelines::{Constants, SolverPass};
use super::spray::spray_left;
use super::vessels::Vessels;
use super::{Solver, SolverError};
use glam::{DVec3, Vec3};
use std::sync::atomic::{AtomicBool, Ordering};
use vitriol_gpu::{Buffer, Gpu, GpuError, QueueKind, Readback, Recorder, bytes_of_elements};
use vitriol_shaders::layout::{BubbleBefore, CensusRun, Limb};
use vitriol_shaders::{Library, sim};

use crate::chemistry::Chemistry;
use crate::parameters::Parameters;

pub use seen::{
    BubbleCount, Bubbling, Came, Census, Held, Landed, Moved, Onto, Place, Skin, SkinPart, Touching,
};

/// Parts of skin that a look has at most: two hands of 28 bones, and a face.
pub const MOST_LIMBS: usize = 64;

/// Acid mass fraction from which on liquid harms: the least that the EU's CLP Regulation (Annex VI) names for sulfuric acid, as
/// irritating skin and eyes.
pub const HARMFUL: f64 = 0.05;

/// Temperature from which on liquid harms, °C: at 54.4 °C water burns through skin in half a minute (US Consumer Product Safety
/// Commission, tap water scalds, document 5098), as long as a wet sleeve stays on it.
pub const SCALDS: f64 = 55.0;

/// Height up to which liquid lies on table or floor, support radii.
pub const LYING: f64 = 2.0;

/// As in `common/liquid/tallies.wgsl`.
const PLACES: usize = 6;
const WORDS: usize = 23;
const MOVED_WORDS: usize = 3;
const LANDINGS: usize = 64;
const LANDINGS_ON_GLASS: usize = 32;
const LANDING_WORDS: usize = 9;
const ONTO_TABLE: usize = 3;
const ONTO_FLOOR: usize = 4;
const ONTO_FLASK: usize = 5;
const WARMTHS: [f64; 2] = [-50.0, 350.0];
const SUPERHEATS: [f64; 2] = [-350.0, 150.0];
const VOLUMES: f64 = 8.0;
const SPEEDS: f64 = 8.0;
const BUBBLE_RADII: f64 = 1.0 / 256.0;

/// Half of the edge of the cube in which positions are resolved, for a scene of real size: a room, m.
const REACH: f64 = 4.0;

/// A look under way.
pub struct CensusRecord {
    tallies: Readback,
    /// Where there is spray.
    sprayed: Option<Readback>,
    units: Units,
}

/// Memory of the looks before: the last place of each particle, and each bubble at the last look. It is no part of the state, and is
/// taken to another device beside it.
#[derive(Clone, Debug)]
pub struct LooksMemory {
    places: Vec<u32>,
    bubbles: Vec<BubbleBefore>,
    is_first: bool,
}

/// The census' passes with their buffers.
pub(super) struct Looks {
    particles: SolverPass,
    /// Over bubbles and drops, where there are some.
    bubbles: Option<SolverPass>,
    /// `limbs`, `places_before`, `bubbles_before`, `tallies`.
    own: [Buffer; 4],
    units: Units,
    /// Whether the next look has none before it.
    is_first: AtomicBool,
}

/// Units of the words of a tally.
#[derive(Clone, Copy, Debug)]
struct Units {
    flasks: usize,
    heated: bool,
    /// Quanta of a share of 1.
    whole: f64,
    /// V0, m³.
    volume: f64,
    centre: DVec3,
    reach: f64,
}

impl Looks {
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        parameters: &Parameters,
        [count, flasks]: [usize; 2],
        (scale, rinsing): (f64, bool),
        (constants, buffers, vessels): (&Constants, &Buffers, &Vessels),
    ) -> Result<Self, SolverError> {
        let whole = (u32::MAX as usize / count.max(1)).min(65_536);
        let slots = parameters.bubbles().map_or(0, |it| it.slots() as usize);
        let buffer = |label, bytes| Buffer::storage(gpu, label, bytes);
        let own = [
            buffer("limbs", bytes_of_elements::<Limb>(MOST_LIMBS))?,
            buffer("places_before", bytes_of_elements::<u32>(count))?,
            buffer("bubbles_before", bytes_of_elements::<BubbleBefore>(slots))?,
            buffer("tallies", bytes_of_elements::<u32>(words(flasks)))?,
        ];
        let all = bound(&own, buffers, vessels);
        let extra = [
            ("WHOLE", whole as f64),
            ("LYING", LYING * parameters.support_radius),
            ("HARMFUL", HARMFUL),
            ("SCALDS", SCALDS),
            ("TOUCHES", 0.5 * parameters.particle_volume().cbrt()),
        ];
        let constants = constants.and(&extra);
        let of_particles = [
            ("PAPERS_BOILING_POINT", papers_boiling_point(parameters)),
            ("RINSING", f64::from(u8::from(rinsing))),
        ];
        let make = |shader, own: &[_]| constants.pass(gpu, library, &all, shader, own);
        let bubbles = (slots > 0).then(|| make(sim::CENSUS_BUBBLES, &[]));
        Ok(Self {
            particles: make(sim::CENSUS, &of_particles)?,
            bubbles: bubbles.transpose()?,
            own,
            units: Units {
                flasks,
                heated: parameters.chemistry.is_some(),
                whole: whole as f64,
                volume: parameters.particle_volume(),
                centre: DVec3::ZERO,
                reach: REACH * scale,
            },
            is_first: AtomicBool::new(true),
        })
    }

    /// Marks the state as replaced: the next look counts no arrivals, since nothing moved to where it is.
    pub(super) fn begin_anew(&self) {
        self.is_first.store(true, Ordering::Relaxed);
    }
}

/// The buffers that the pass binds.
fn bound<'a>(
    [limbs, places, bubbles, tallies]: &'a [Buffer; 4],
    b: &'a Buffers,
    vessels: &'a Vessels,
) -> [&'a Buffer; 17] {
    [
        limbs,
        places,
        bubbles,
        tallies,
        &b.position,
        &b.velocity,
        &b.tags,
        &b.heat,
        &b.bulk,
        &b.bubbles,
        &b.claims,
        &b.drops,
        &b.solution,
        &b.poses,
        &vessels.flasks,
        &vessels.radii,
        &vessels.distances,
    ]
}

/// T_B of the paper's chemistry, °C. Where nothing boils it is water's.
fn papers_boiling_point(parameters: &Parameters) -> f64 {
    match &parameters.chemistry {
        Some(Chemistry::Paper(paper)) => paper.boiling.map_or(100.0, |it| it.boiling_point),
        _ => 100.0,
    }
}

/// Number of words of all tallies: those of each place, then those of each place and flask, then the drops that came to rest, of which those
/// on glass are last.
fn words(flasks: usize) -> usize {
    let landings = [LANDINGS, LANDINGS_ON_GLASS].map(words_of_landings);
    words_of_places(flasks) + landings.iter().sum::<usize>()
}

/// Number of words of a list of so many drops that came to rest.
fn words_of_landings(most: usize) -> usize {
    1 + most * LANDING_WORDS
}

/// Number of words of each place, and of each place and flask.
fn words_of_places(flasks: usize) -> usize {
    (flasks + PLACES) * (WORDS + flasks * MOVED_WORDS)
}

/// A [`LooksMemory`] on its way to the host.
pub(crate) struct LooksMemoryRecord {
    places: Readback,
    bubbles: Readback,
    is_first: bool,
}

impl LooksMemoryRecord {
    /// The memory.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the submission has finished.
    pub(crate) fn get(&self) -> Result<LooksMemory, GpuError> {
        Ok(LooksMemory {
            places: self.places.get()?,
            bubbles: self.bubbles.get()?,
            is_first: self.is_first,
        })
    }
}

impl Solver {
    /// Records the copies of the looks' memory after the looks that were recorded before.
    pub(crate) fn record_looks_memory(
        &self,
        rec: &mut Recorder,
    ) -> Result<LooksMemoryRecord, GpuError> {
        let [_, places, bubbles, _] = &self.looks.own;
        Ok(LooksMemoryRecord {
            places: rec.read_back(places)?,
            bubbles: rec.read_back(bubbles)?,
            is_first: self.looks.is_first.load(Ordering::Relaxed),
        })
    }

    /// The looks' memory; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn looks_memory(&self) -> Result<LooksMemory, SolverError> {
        let mut rec = self.gpu.recorder(QueueKind::Main)?;
        let record = self.record_looks_memory(&mut rec)?;
        self.gpu.submit(rec)?.wait()?;
        Ok(record.get()?)
    }

    /// Takes up the looks' memory of a solver of the same scene in the same state.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn remember_looks(&self, memory: &LooksMemory) -> Result<(), SolverError> {
        let [_, places, bubbles, _] = &self.looks.own;
        let mut rec = self.gpu.recorder(QueueKind::Main)?;
        rec.upload(places, &memory.places)?;
        rec.upload(bubbles, &memory.bubbles)?;
        self.gpu.submit(rec)?.wait()?;
        self.looks
            .is_first
            .store(memory.is_first, Ordering::Relaxed);
        Ok(())
    }

    /// Records a look, behind a frame; `skin` is that of the user, of which parts beyond [`MOST_LIMBS`] are left out, and `elapsed` the
    /// time since the last look, s. An arrival at a place is counted in one look alone, so each is to be read.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn record_census(
        &self,
        rec: &mut Recorder,
        skin: &[SkinPart],
        elapsed: f64,
    ) -> Result<CensusRecord, SolverError> {
        let looks = &self.looks;
        let [limbs, .., tallies] = &looks.own;
        let parts: Vec<Limb> = skin.iter().take(MOST_LIMBS).map(limb).collect();
        if !parts.is_empty() {
            rec.upload(limbs, &parts)?;
        }
        rec.fill(tallies, 0)?;
        if self.count > 0 {
            let units = &looks.units;
            let run = CensusRun {
                centre: units.centre.as_vec3().to_array(),
                reach: units.reach as f32,
                elapsed: elapsed as f32,
                limbs: parts.len() as u32,
                first: looks.is_first.swap(false, Ordering::Relaxed).into(),
                substeps: self.parameters.substeps,
            };
            let all = bound(&looks.own, &self.buffers, &self.vessels);
            if let (Some(pass), Some(bubbles)) = (&looks.bubbles, self.parameters.bubbles()) {
                let pass = pass.begin(rec, &all).constants(&run);
                pass.indirect(&self.buffers.claims, dormant::look_size(bubbles))?;
            }
            let pass = looks.particles.begin(rec, &all);
            pass.constants(&run).invocations(self.count)?;
        }
        Ok(CensusRecord {
            tallies: rec.read_back(tallies)?,
            sprayed: match self.parameters.bubbles() {
                Some(bubbles) if bubbles.places_of_drops() > 0 => {
                    Some(rec.read_back(&self.buffers.spray_left)?)
                }
                _ => None,
            },
            units: looks.units,
        })
    }
}

fn limb(part: &SkinPart) -> Limb {
    let [a, b] = part.ends.map(|end| end.to_array());
    let [radius_a, radius_b] = part.radii;
    Limb {
        a,
        radius_a,
        b,
        radius_b,
        whose: part.whose as u32,
        ..Limb::default()
    }
}

/// The records of a list of drops that came to rest, whose first word is their number.
fn listed(words: &[u32]) -> Vec<[u32; LANDING_WORDS]> {
    let Some((&count, words)) = words.split_first() else {
        return Vec::new();
    };
    let (records, _) = words.as_chunks::<LANDING_WORDS>();
    records.iter().take(count as usize).copied().collect()
}

impl CensusRecord {
    /// The census.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the submission has finished.
    pub fn get(&self) -> Result<Census, GpuError> {
        let tallies = self.tallies.get::<u32>()?;
        let units = &self.units;
        let places = WORDS * (units.flasks + PLACES);
        let before = words_of_places(units.flasks).min(tallies.len());
        let (tallies, of_landings) = tallies.split_at(before);
        let (of_places, of_moves) = tallies.split_at(places.min(tallies.len()));
        let (of_places, _) = of_places.as_chunks::<WORDS>();
        let (of_moves, _) = of_moves.as_chunks::<MOVED_WORDS>();
        let mut places = of_places.iter();
        let mut row = || places.next().copied().unwrap_or([0; WORDS]);
        let quanta = match &self.sprayed {
            Some(sprayed) => sprayed.get::<u32>()?,
            None => Vec::new(),
        };
        Ok(Census {
            flasks: (0..units.flasks).map(|_| units.held(&row())).collect(),
            air: units.held(&row()),
            table: units.held(&row()),
            floor: units.held(&row()),
            skin: [row(), row(), row()].map(|words| units.touching(&words)),
            moves: of_moves.iter().map(|words| units.moved(words)).collect(),
            landed: units.landed(of_landings),
            sprayed: (0..units.flasks)
                .map(|flask| units.volume * spray_left(quanta.get(flask)))
                .collect(),
        })
    }
}

impl Units {
    /// In the order of the words' constants in `common/liquid/tallies.wgsl`.
    fn moved(&self, &[particles, volume, acid]: &[u32; MOVED_WORDS]) -> Moved {
        Moved {
            particles,
            volume: VOLUMES * self.volume * f64::from(volume) / self.whole,
            acid: match volume {
                0 => 0.0,
                _ => f64::from(acid) / f64::from(volume),
            },
        }
    }

    /// The drops that came to rest, in an order that does not depend on the device's.
    fn landed(&self, words: &[u32]) -> Vec<Landed> {
        let (others, on_glass) = words.split_at(words_of_landings(LANDINGS).min(words.len()));
        let mut records = listed(others);
        records.extend(listed(on_glass));
        records.sort_unstable();
        let landed = records.into_iter().filter_map(|words| {
            let [onto, numbers @ ..] = words;
            let [x, y, z, a, b, c, volume, acid] = numbers.map(f32::from_bits);
            let onto = match onto as usize {
                ONTO_TABLE => Onto::Table,
                ONTO_FLOOR => Onto::Floor,
                flask if flask >= ONTO_FLASK => Onto::Flask(flask - ONTO_FLASK),
                skin => Onto::Skin(*Skin::ALL.get(skin)?),
            };
            Some(Landed {
                onto,
                position: Vec3::new(x, y, z),
                way: Vec3::new(a, b, c),
                volume: self.volume * f64::from(volume),
                acid,
            })
        });
        landed.collect()
    }

    fn touching(&self, words: &[u32; WORDS]) -> Touching {
        let Held {
            particles, came, ..
        } = self.held(words);
        let [.., rinsed] = *words;
        Touching {
            particles,
            came,
            rinsed: VOLUMES * self.volume * f64::from(rinsed) / self.whole,
        }
    }

    /// In the order of the words' constants in `common/liquid/tallies.wgsl`.
    fn held(&self, words: &[u32; WORDS]) -> Held {
        let [
            here,
            volume,
            warmth,
            acid,
            came,
            came_volume,
            came_speed,
            x,
            y,
            z,
            came_acid,
            bubbles,
            radii,
            born,
            collapsed,
            collapsed_radii,
            burst,
            burst_radii,
            came_warmth,
            hottest,
            superheat,
            bubbles_volume,
            _,
        ] = *words;
        let sum = |word: u32| f64::from(word) / self.whole;
        let mean = |word: u32, of: u32, [low, high]: [f64; 2]| match of {
            0 => 0.0,
            of => low + (high - low) * sum(word) / f64::from(of),
        };
        let share = [0.0, 1.0];
        let sides = [-self.reach, self.reach];
        let radius = [0.0, BUBBLE_RADII * self.reach];
        let number = |count: u32, radii: u32| BubbleCount {
            count,
            radius: mean(radii, count, radius),
        };
        let position = [x, y, z].map(|word| mean(word, came, sides));
        Held {
            particles: here,
            volume: VOLUMES * self.volume * sum(volume),
            temperature: (self.heated && here > 0).then(|| mean(warmth, here, WARMTHS) as f32),
            hottest: (self.heated && here > 0).then(|| mean(hottest, 1, WARMTHS) as f32),
            superheat: (self.heated && here > 0).then(|| mean(superheat, 1, SUPERHEATS) as f32),
            acid: mean(acid, here, share) as f32,
            came: Came {
                particles: came,
                volume: VOLUMES * self.volume * sum(came_volume),
                speed: mean(came_speed, came, [0.0, SPEEDS * self.reach]),
                position: self.centre + DVec3::from_array(position),
                acid: mean(came_acid, came, share),
                temperature: (self.heated && came > 0).then(|| mean(came_warmth, came, WARMTHS)),
            },
            bubbles: Bubbling {
                here: number(bubbles, radii),
                volume: VOLUMES * self.volume * sum(bubbles_volume),
                born,
                collapsed: number(collapsed, collapsed_radii),
                burst: number(burst, burst_radii),
            },
        }
    }
}
