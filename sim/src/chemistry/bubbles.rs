//! Bubbles of steam for the solver's passes: their number, where they are born, and in which substeps they act.

use crate::fill::split_mix;

/// Bubbles where a scene has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bubbles {
    /// Edge of the cube of liquid that has one nucleus which grows at a superheat of 1 K, m.
    pub nuclei_spacing: f64,
    /// How long a bubble lasts at the surface, s; without it until its film has drained.
    pub foam_time: Option<f64>,
    /// Most of them at a time; rounded up to whole groups.
    pub most: u32,
    /// Whether the drops that they throw up when they burst are followed.
    pub spray: bool,
    /// Whether streams take air down.
    pub air: bool,
}

/// Threads of a workgroup, of which each bubble has one or more.
const GROUP: u32 = 64;

/// Steps of the bubbles in a frame: one goes a millimetre or less in it. An even number, as they have two sets of records.
const STEPS: u32 = 4;

/// Excess pressure over an atmosphere of water's vapour 1 K above the boiling point, by Clausius and Clapeyron with 4890 K for the latent
/// heat over the gas constant. A nucleus of 33 µm grows at it.
const WOKEN: f64 = 0.0357;

/// Nuclei of dirty and of clean liquid ([`Bubbles::nuclei_spacing`], m): their number varies by six decades from one water to another
/// (Brennen 1995, Cavitation and Bubble Dynamics, section 1.12).
pub const NUCLEI: [f64; 2] = [0.01, 1.0];

/// Nuclei of the liquid that `seed` draws ([`Bubbles::nuclei_spacing`], m): any number between those of dirty and of clean liquid, each
/// decade as likely.
pub fn drawn_nuclei(seed: u64) -> f64 {
    let [dirty, clean] = NUCLEI;
    let lot = split_mix(split_mix(seed) ^ NUCLEI_LOT) as f64 / 2f64.powi(64);
    dirty * (clean / dirty).powf(lot)
}

/// Tells this draw from the filling's.
const NUCLEI_LOT: u64 = 0x6e75_636c_6569;

/// Most places: a bubble's key has 16 bits for its own.
const MOST_SLOTS: u32 = 65_536;

/// A step of the bubbles, after a substep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BubbleStep {
    /// Substeps since the step before.
    pub substeps: u32,
    /// Whether it reads the second set of records and writes the first.
    pub second: bool,
}

impl Bubbles {
    /// Places for bubbles, in whole groups.
    pub fn slots(&self) -> u32 {
        self.most.clamp(1, MOST_SLOTS).next_multiple_of(GROUP)
    }

    /// Places for drops: of each bubble those of its jet and of its film.
    pub fn places_of_drops(&self) -> u32 {
        if self.spray { 2 * self.slots() } else { 0 }
    }

    /// Excess pressure of vapour, over an atmosphere, at which as many nuclei grow as there are particles of `spacing` (m): their number
    /// rises with its cube, as N(>R) ∝ R⁻³ (Brennen 1995).
    pub fn nucleus_pressure(&self, spacing: f64) -> f64 {
        WOKEN * self.nuclei_spacing / spacing
    }

    /// The step after substep `n` of `substeps` in a frame, which are 2 or more.
    pub fn step_after(n: u32, substeps: u32) -> Option<BubbleStep> {
        let steps = if substeps < STEPS { 2 } else { STEPS };
        let [before, after] = [n, n + 1].map(|n| n * steps / substeps);
        let start = |step: u32| (step * substeps).div_ceil(steps);
        (after > before).then(|| BubbleStep {
            substeps: start(before + 1) - start(before),
            second: before % 2 == 1,
        })
    }

    /// The next step after or behind substep `n`.
    pub fn step_from(n: u32, substeps: u32) -> Option<BubbleStep> {
        (n..substeps).find_map(|n| Self::step_after(n, substeps))
    }

    /// Share of the time from the step before substep `n` to the next one that has passed at its end.
    pub fn covered(n: u32, substeps: u32) -> f64 {
        let next = (n..substeps).find_map(|at| Some((at, Self::step_after(at, substeps)?)));
        next.map_or(1.0, |(at, step)| {
            1.0 - f64::from(at - n) / f64::from(step.substeps)
        })
    }

    /// Share of the way to its next volume that a particle's gas goes in substep `n`, so that it is there when bubbles act.
    pub fn approach(n: u32, substeps: u32) -> f64 {
        let left = (n..substeps).find(|&n| Self::step_after(n, substeps).is_some());
        1.0 / f64::from(left.unwrap_or(n) - n + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::Bubbles;

    #[test]
    fn a_frames_steps_take_a_frame() {
        for substeps in 2..40 {
            let all: Vec<_> = (0..substeps)
                .filter_map(|n| Bubbles::step_after(n, substeps))
                .collect();
            assert_eq!(all.len() % 2, 0, "{substeps}");
            assert_eq!(all.iter().map(|step| step.substeps).sum::<u32>(), substeps);
            assert!(
                all.iter()
                    .enumerate()
                    .all(|(k, step)| step.second == (k % 2 == 1))
            );
            assert!(Bubbles::step_after(substeps - 1, substeps).is_some());
            let mut way = 1.0;
            let mut covered = 0.0;
            for n in 0..substeps {
                let step = Bubbles::step_from(n, substeps).map_or(0, |step| step.substeps);
                covered += 1.0 / f64::from(step);
                assert!(
                    f64::abs(covered - Bubbles::covered(n, substeps)) < 1e-12,
                    "{substeps}, {n}"
                );
                if Bubbles::step_after(n, substeps).is_some() {
                    covered = 0.0;
                }
                way *= 1.0 - Bubbles::approach(n, substeps);
                if Bubbles::step_after(n, substeps).is_some() {
                    assert!(f64::abs(way) < 1e-12, "{substeps}: {way}");
                    way = 1.0;
                }
            }
        }
    }
}
