//! Times of passes, frame by frame.

use std::collections::BTreeMap;

use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Ticket;

use super::report::{PassRow, Timing};

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
pub(super) struct Tally {
    /// Labels as they came first.
    order: Vec<String>,
    passes: BTreeMap<String, Pass>,
    /// Whole frames, ms.
    totals: Vec<f64>,
}

impl Tally {
    /// Adds a frame; waits for the device.
    pub(super) fn add(&mut self, ticket: &Ticket) -> Result<(), Failure> {
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
    pub(super) fn rows(&self) -> (Vec<PassRow>, Timing) {
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
