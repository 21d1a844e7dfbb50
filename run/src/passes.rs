//! Passes of a scene at rest: how many, what they bind, and their times frame by frame.

use std::collections::BTreeMap;

use serde::Serialize;
use vitriol_gpu::{Gpu, QueueKind, Ticket};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;

use crate::failure::{Blame, Failure};
use crate::rank::Ranks;

/// One pass in a frame.
#[derive(Debug, Clone, Serialize)]
pub struct PassRow {
    /// Label of the pass.
    pub name: String,
    /// Dispatches in a frame.
    pub dispatches: u32,
    /// Bytes of the buffers that its dispatches in a frame bind, each once a
    /// dispatch.
    pub bytes: u64,
    /// Its time in a frame.
    #[serde(flatten)]
    pub time: Timing,
}

/// Median and 95th percentile, ms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Timing {
    /// Median over frames, ms.
    pub median_ms: f64,
    /// 95th percentile over frames, ms.
    pub p95_ms: f64,
}

impl Timing {
    /// The timing of times in ms, one a frame; NaN where there is none. The percentile
    /// is the nearest rank, so it is always a time that was measured.
    pub fn of(times: &[f64]) -> Self {
        let ranks = Ranks::of(times);
        let rank = |share| ranks.at(share).unwrap_or(f64::NAN);
        Self {
            median_ms: rank(0.5),
            p95_ms: rank(0.95),
        }
    }
}

/// A frame's passes of one label.
#[derive(Default)]
struct Pass {
    dispatches: u32,
    bytes: u64,
    /// Of each frame, ms.
    times: Vec<f64>,
}

/// Times of several frames' passes, by label.
#[derive(Default)]
pub struct Tally {
    /// Labels as they came first.
    order: Vec<String>,
    passes: BTreeMap<String, Pass>,
    /// Whole frames, ms.
    totals: Vec<f64>,
}

impl Tally {
    /// Adds a frame; waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn add(&mut self, ticket: &Ticket) -> Result<(), Failure> {
        ticket.wait().other()?;
        let mut frame: BTreeMap<String, (u32, u64, f64)> = BTreeMap::new();
        for pass in ticket.timings().other()? {
            if pass.label == "total" {
                self.totals.push(pass.nanoseconds * 1e-6);
                continue;
            }
            if !self.order.contains(&pass.label) {
                self.order.push(pass.label.clone());
            }
            let sum = frame.entry(pass.label).or_default();
            sum.0 += 1;
            sum.1 += pass.bytes;
            sum.2 += pass.nanoseconds * 1e-6;
        }
        for (label, (dispatches, bytes, time)) in frame {
            let pass = self.passes.entry(label).or_default();
            (pass.dispatches, pass.bytes) = (dispatches, bytes);
            pass.times.push(time);
        }
        Ok(())
    }

    /// The passes in their order, and whole frames.
    pub fn rows(&self) -> (Vec<PassRow>, Timing) {
        let rows = self.order.iter().filter_map(|name| {
            let pass = self.passes.get(name)?;
            Some(PassRow {
                name: name.clone(),
                dispatches: pass.dispatches,
                bytes: pass.bytes,
                time: Timing::of(&pass.times),
            })
        });
        (rows.collect(), Timing::of(&self.totals))
    }
}

/// Begins a frame of a scene at rest.
///
/// # Errors
/// An error of the device.
pub fn solve(gpu: &Gpu, world: &World) -> Result<Ticket, Failure> {
    let mut rec = gpu.recorder(QueueKind::Main).other()?;
    let poses = world.poses();
    world.solver().record(&mut rec, poses, poses).other()?;
    gpu.submit(rec).other()
}

/// Passes of a first frame of `scene`, which rebuilds its lists in every substep that
/// asks for it, and bytes of device memory a particle.
///
/// # Errors
/// An error of the device.
pub fn anatomy(gpu: &Gpu, scene: &Scene) -> Result<(Vec<PassRow>, u64), Failure> {
    let world = World::new(gpu, &Library::watching(), scene, 0).other()?;
    let mut tally = Tally::default();
    tally.add(&solve(gpu, &world)?)?;
    Ok((tally.rows().0, world.solver().bytes_per_particle()))
}
