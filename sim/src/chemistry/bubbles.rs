//! Bubbles of steam for the solver's passes: their number, where they are born, and in which substeps they act.

/// Bubbles where a scene has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bubbles {
    /// Edge of the cube of liquid that has one nucleus, m.
    pub nuclei_spacing: f64,
    /// How long a bubble lasts at the surface, s.
    pub foam_time: f64,
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

/// Frequency times diameter of bubbles that leave a nucleus in water at 100 °C, m/s.
const FREQUENCY_DIAMETER: f64 = 0.092;

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

    /// Share of particles of `spacing` (m) that are nuclei.
    pub fn nuclei(&self, spacing: f64) -> f64 {
        (spacing / self.nuclei_spacing).powi(3).min(1.0)
    }

    /// Time between two bubbles of a nucleus, s: frequency times diameter is 0.59 (σ g/ρ)^¼ (Zuber 1963), with the
    /// spacing for the diameter.
    pub fn nucleus_wait(&self) -> f64 {
        self.nuclei_spacing / FREQUENCY_DIAMETER
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
