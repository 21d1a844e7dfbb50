//! A frame's time of a scene at rest, and in turn with it that of peers.

use vitriol_gpu::{Gpu, vk};
use vitriol_run::units::percent;
use vitriol_run::{Blame, Failure};
use vitriol_sim::scene::Scene;

use super::frame::{QUEUED, queued, settled};
use super::peer::{Answer, Asked, Peer};
use super::report::PeerRow;
use vitriol_run::passes::Timing;

/// Rounds in which ours and the peers take turns, so that other work of the machine affects all alike.
const ROUNDS: usize = 2;

/// A frame at rest.
pub struct AtRest {
    /// Fluid particles.
    pub particles: u64,
    /// A frame's share of several that are queued.
    pub total: Timing,
    /// Recording and submitting a frame.
    pub cpu: Timing,
    /// Mean over particles of max(0, ρ/ρ₀ − 1) at the end.
    pub density_error_mean: f64,
    /// 99th percentile over particles of max(0, ρ/ρ₀ − 1) at the end.
    pub density_error_p99: f64,
    /// The peers that ran in turn with it.
    pub peers: Vec<PeerRow>,
}

/// Measures `frames` frames of a scene at rest, in turn with the peers.
///
/// # Errors
/// The error of the device or of a peer.
pub fn at_rest(gpu: &Gpu, scene: &Scene, frames: u32, peers: &[Peer]) -> Result<AtRest, Failure> {
    let world = settled(gpu, scene)?;
    let asked = Asked {
        particles: world.solver().count().into(),
        substeps: scene.solver.substeps,
        iterations: scene.solver.iterations,
        spacing: scene.scale.spacing,
        depth: depth(scene),
        frame_time: scene.scale.frame_time,
        gravity: scene.scale.gravity,
        viscosity: world.solver().parameters().substep_viscosity(),
        frames,
        on_processor: gpu.info().kind == vk::PhysicalDeviceType::CPU,
    };
    let (mut rounds, mut cpu) = (Vec::new(), Vec::new());
    let mut answers: Vec<Vec<Answer>> = vec![Vec::new(); peers.len()];
    for _ in 0..if peers.is_empty() { 1 } else { ROUNDS } {
        if !rounds.is_empty() {
            // While the peer compiled, the card was idle and may have slowed down.
            queued(gpu, &world, &mut Vec::new())?;
        }
        let times = (0..frames.div_ceil(QUEUED)).map(|_| queued(gpu, &world, &mut cpu));
        rounds.push(times.collect::<Result<Vec<f64>, Failure>>()?);
        for (peer, answers) in peers.iter().zip(&mut answers) {
            answers.push(peer.ask(&asked)?);
        }
    }
    let measured = world.measure().other()?;
    Ok(AtRest {
        particles: asked.particles,
        total: Timing::of(&rounds.concat()),
        cpu: Timing::of(&cpu),
        density_error_mean: measured.density_error_mean,
        density_error_p99: measured.density_error_p99,
        peers: answers
            .iter()
            .filter_map(|answers| PeerRow::of(&rounds, answers))
            .collect(),
    })
}

/// Depth of the deepest liquid when it rests, m.
fn depth(scene: &Scene) -> f64 {
    let of_flask = |(index, flask): (usize, &vitriol_sim::scene::Flask)| {
        let own = scene.liquids.iter().filter(|it| it.flask == index);
        let volume = own.map(|liquid| liquid.volume).sum();
        let full = flask.profile.rim_height();
        let level = flask.profile.level_for_volume(volume).unwrap_or(full);
        level - flask.profile.floor_height()
    };
    let depths = scene.flasks.iter().enumerate().map(of_flask);
    depths.fold(scene.scale.spacing, f64::max)
}

impl PeerRow {
    /// A row from a peer's answers, one for each of our rounds; `None` without answers.
    pub fn of(ours: &[Vec<f64>], answers: &[Answer]) -> Option<Self> {
        let last = answers.last()?;
        let median = |times: &[f64]| Timing::of(times).median_ms;
        let all: Vec<f64> = answers.iter().flat_map(|it| it.times_ms.clone()).collect();
        let total = Timing::of(&all);
        let rounds = answers.iter().zip(ours);
        Some(Self {
            name: last.name.clone(),
            version: last.version.clone(),
            device: last.device.clone(),
            total,
            range_ms: [
                all.iter().copied().fold(f64::INFINITY, f64::min),
                all.iter().copied().fold(0.0, f64::max),
            ],
            density_error_mean: last.density_error_mean,
            density_error_p99: last.density_error_p99,
            ratio: total.median_ms / median(&ours.concat()),
            ratios: rounds
                .map(|(answer, ours)| median(&answer.times_ms) / median(ours))
                .collect(),
        })
    }

    /// The row as text for people.
    pub fn describe(&self) -> String {
        let Timing { median_ms, p95_ms } = self.total;
        let ratios: Vec<String> = self.ratios.iter().map(|it| format!("{it:.2}")).collect();
        format!(
            "against {} {} on {}\n\
             {:<28} {median_ms:>10.3} {p95_ms:>10.3}   ({:.3} to {:.3})\n\
             density error: mean {}, 99th percentile {}\n\
             its time is {:.2} of ours ({} in turn)\n",
            self.name,
            self.version,
            self.device,
            "frame, queued",
            self.range_ms[0],
            self.range_ms[1],
            percent(self.density_error_mean),
            percent(self.density_error_p99),
            self.ratio,
            ratios.join(", ")
        )
    }
}
