//! The solver's state, taken from a device and put on one again: one table of its arrays, by which it is read, checked, written and
//! hashed.

use super::buffers::Buffers;
use super::transfer::read;
use super::{Counters, Solver, SolverError, SolverState, dormant};
use bytemuck::Pod;
use std::sync::atomic::Ordering;
use vitriol_gpu::{Buffer, GpuError, QueueKind, Readback, Recorder};
use xxhash_rust::xxh3::Xxh3;

/// An array of a state.
struct Array {
    /// Its name in messages.
    what: &'static str,
    /// Where it is on the device.
    buffer: fn(&Buffers) -> &Buffer,
    get: fn(&SolverState) -> &dyn Elements,
    get_mut: fn(&mut SolverState) -> &mut dyn Elements,
    hashed: Hashed,
    second: SecondHalf,
}

/// How an array enters the hash of a state.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Hashed {
    No,
    /// Particle by particle in the order of their identities, since a replay need not repeat their slots.
    ByIdentity,
    /// As it is, after all particles.
    Whole,
}

/// Contents of a buffer behind its array, at a frame's end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SecondHalf {
    /// Nothing.
    None,
    /// The array again: a place that is empty is not copied from one set of records to the other.
    Same,
    /// As many zeros: nothing joins bubbles of the second set of records.
    Zeros,
}

macro_rules! array {
    ($buffer:ident, $($field:ident).+, $what:literal, $hashed:ident) => {
        array!($buffer, $($field).+, $what, $hashed, None)
    };
    ($buffer:ident, $($field:ident).+, $what:literal, $hashed:ident, $second:ident) => {
        Array {
            what: $what,
            buffer: |buffers| &buffers.$buffer,
            get: |state| &state.$($field).+,
            get_mut: |state| &mut state.$($field).+,
            hashed: Hashed::$hashed,
            second: SecondHalf::$second,
        }
    };
}

/// All arrays of a state but the neighbour list's; the hash has them in this order.
const ARRAYS: [Array; 30] = [
    array!(position, positions, "positions", ByIdentity),
    array!(velocity, velocities, "velocities", ByIdentity),
    array!(tags, tags, "tags", ByIdentity),
    array!(heat, heat, "heat", ByIdentity),
    array!(matter, matter, "contents", ByIdentity),
    array!(ledger, ledger, "ledger", No),
    array!(bulk, bulk, "bulk", No),
    array!(eddies, eddies, "eddies", No),
    array!(held, held, "held lines", No),
    array!(list_origin, list_origin, "list origins", No),
    array!(list_counts, list_counts, "list counts", No),
    array!(glass, glass, "glass", Whole),
    array!(puffs, steam.puffs, "puffs", No),
    array!(vented, steam.vented, "vented steam", No),
    array!(made, steam.made, "counts of steam", No),
    array!(dew, steam.dew, "dew", No),
    array!(bubbles, bubbles.bubbles, "bubbles", Whole, Same),
    array!(bubbled, bubbles.bubbled, "bubbled particles", No),
    array!(gas, bubbles.gas, "gas", No),
    array!(merging, bubbles.merging, "joining bubbles", No, Zeros),
    array!(falls, bubbles.falls, "falls", No),
    array!(venting, bubbles.venting, "gas that flasks let go", No),
    array!(cell_starts, bubbles.cell_starts, "cells", No),
    array!(drops, spray.drops, "drops", Whole),
    array!(sprayed, spray.sprayed, "sprayed particles", No),
    array!(spray_left, spray.left, "flasks that spray left", No),
    array!(counters, counters, "counters", No),
    array!(sleep, sleep.sleep, "liquid that sleeps", No),
    array!(flask_sleeps, sleep.flasks, "flasks whose liquid sleeps", No),
    array!(wall_push, sleep.pushes, "pushes of walls", No),
];

/// Elements of whatever type.
trait Elements {
    fn count(&self) -> usize;
    fn bytes(&self) -> &[u8];
    /// Takes the first `count` elements; buffers are a few bytes longer where a scene is empty.
    fn take(&mut self, readback: &Readback, count: usize) -> Result<(), GpuError>;
}

impl<T: Pod> Elements for Vec<T> {
    fn count(&self) -> usize {
        self.len()
    }

    fn bytes(&self) -> &[u8] {
        bytemuck::cast_slice(self)
    }

    fn take(&mut self, readback: &Readback, count: usize) -> Result<(), GpuError> {
        *self = readback.get()?;
        self.truncate(count);
        Ok(())
    }
}

/// Elements of each array of that state, in the order of the table.
pub(super) fn lengths(state: &SolverState) -> Vec<usize> {
    ARRAYS.iter().map(|it| (it.get)(state).count()).collect()
}

impl SolverState {
    /// Hash of the state that a replay must repeat: every particle's bits of position, velocity, membership, heat and content, in the
    /// order of
    /// their identities, and of the glass's heat, bubbles and drops.
    pub fn hash(&self) -> u64 {
        let mut order: Vec<usize> = (0..self.tags.len()).collect();
        order.sort_by_key(|&slot| self.tags[slot][1]);
        let of = |hashed| {
            let arrays = ARRAYS.iter().filter(move |it| it.hashed == hashed);
            arrays.map(|it| (it.get)(self)).filter(|it| it.count() > 0)
        };
        let of_particles: Vec<_> = of(Hashed::ByIdentity)
            .map(|it| (it.bytes(), it.bytes().len() / it.count()))
            .collect();
        let mut hash = Xxh3::new();
        for slot in order {
            for (bytes, size) in &of_particles {
                hash.update(&bytes[slot * size..(slot + 1) * size]);
            }
        }
        of(Hashed::Whole).for_each(|it| hash.update(it.bytes()));
        hash.digest()
    }
}

/// A state on its way to the host.
pub(crate) struct SolverStateRecord {
    /// By array; `None` where the scene has none.
    arrays: Vec<Option<(Readback, usize)>>,
    list: Option<(Readback, usize)>,
    long_lists: Readback,
    grid: super::grid::Grid,
}

impl SolverStateRecord {
    /// The state.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the submission has finished.
    pub(crate) fn get(self) -> Result<SolverState, GpuError> {
        let mut state = SolverState::default();
        for (array, copy) in ARRAYS.iter().zip(&self.arrays) {
            if let Some((readback, count)) = copy {
                (array.get_mut)(&mut state).take(readback, *count)?;
            }
        }
        if let Some((readback, count)) = &self.list {
            state.list.take(readback, *count)?;
        }
        let long_lists = self.long_lists.get()?;
        self.grid
            .settle(&state.list_counts, &long_lists, &mut state.list);
        Ok(state)
    }
}

impl Solver {
    /// Reads the state to the host; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn snapshot(&self) -> Result<SolverState, SolverError> {
        let mut rec = self.gpu.recorder(QueueKind::Main)?;
        let record = self.record_state(&mut rec)?;
        self.gpu.submit(rec)?.wait()?;
        Ok(record.get()?)
    }

    /// Records the copies of the state's arrays to the host, behind a frame.
    pub(crate) fn record_state(&self, rec: &mut Recorder) -> Result<SolverStateRecord, GpuError> {
        let b = &self.buffers;
        let mut copy = |buffer: &Buffer, count: usize| {
            let readback = (count > 0).then(|| rec.read_back(buffer)).transpose()?;
            Ok(readback.map(|readback| (readback, count)))
        };
        let arrays = ARRAYS.iter().zip(&self.lengths);
        let arrays: Result<_, GpuError> = arrays
            .map(|(array, count)| copy((array.buffer)(b), *count))
            .collect();
        let words = self.grid.places(self.count) + self.grid.long(self.count);
        Ok(SolverStateRecord {
            arrays: arrays?,
            list: copy(&b.list, words as usize)?,
            long_lists: rec.read_back(&b.long_lists)?,
            grid: self.grid,
        })
    }

    /// Puts a state on this device, a new one perhaps; the frames that follow have
    /// the bits that they would have had without the interruption. Waits for the device once.
    ///
    /// # Errors
    /// [`SolverError::OtherState`], or [`SolverError::Gpu`].
    pub fn restore(&self, state: &SolverState) -> Result<(), SolverError> {
        let long_lists = self.grid.long_lists(&state.list_counts);
        let long = if self.grid.fit(long_lists[0], self.count) {
            4 * long_lists[0] as usize
        } else {
            0
        };
        let listed = self.grid.places(self.count) as usize + long;
        let arrays = ARRAYS.iter().zip(&self.lengths);
        let sizes = arrays.map(|(it, expected)| (it.what, (it.get)(state).count(), *expected));
        for (what, found, expected) in sizes.chain([("list", state.list.len(), listed)]) {
            if found != expected {
                return Err(SolverError::OtherState {
                    what,
                    found,
                    expected,
                });
            }
        }
        let any = state.list_counts.iter().any(|&count| count > 0);
        self.listed.store(any, Ordering::Relaxed);
        self.looks.begin_anew();
        self.still.disturb();
        let (b, gpu) = (&self.buffers, &self.gpu);
        // All in one submission: beside a session's frames each wait takes as long as the pictures under way.
        let mut rec = gpu.recorder(QueueKind::Main)?;
        for array in &ARRAYS {
            let (buffer, bytes) = ((array.buffer)(b), (array.get)(state).bytes());
            match array.second {
                SecondHalf::None => rec.upload(buffer, bytes)?,
                SecondHalf::Same => rec.upload(buffer, &[bytes, bytes].concat())?,
                SecondHalf::Zeros => {
                    rec.upload(buffer, &[bytes, &vec![0; bytes.len()]].concat())?
                }
            }
        }
        rec.upload(&b.list, &state.list)?;
        rec.upload(&b.long_lists, &long_lists)?;
        rec.fill(&b.cell_counts, 0)?;
        rec.fill(&b.block_counts, 0)?;
        rec.upload(&b.turnover_plan, &[self.awake_turnover()])?;
        rec.upload(&b.awake_args, &self.awake_args(&state.sleep))?;
        if let Some(bubbles) = self.parameters.bubbles() {
            // At a frame's end nothing is to be born.
            rec.upload(&b.claims, &dormant::unclaimed(bubbles))?;
            rec.fill(&b.cavities, 0)?;
            rec.fill(&b.splits, 0)?;
            let (live, args) = self.listed_places(state.bubbles());
            rec.upload(&b.live, &live)?;
            rec.upload(&b.live_args, &args)?;
        }
        if self.steam.is_some() {
            rec.fill(&b.taken, 0)?;
        }
        rec.fill(&b.glass_taken, 0)?;
        rec.fill(&b.wetted, 0)?;
        if self.parameters.surface.is_some() {
            // Volumes are added to it, and each impulse leaves it at 0.
            rec.fill(&b.colour, 0)?;
        }
        // Nothing is stale yet; y and z of the dispatch sizes are 1.
        rec.upload(&b.list_args, &[[0u32, 1, 1, 0]; 3])?;
        gpu.submit(rec)?.wait()?;
        Ok(())
    }

    /// Reads the counters; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn counters(&self) -> Result<Counters, SolverError> {
        let words = read::<Counters>(&self.gpu, &self.buffers.counters, 1)?;
        Ok(words.first().copied().unwrap_or_default())
    }
}
