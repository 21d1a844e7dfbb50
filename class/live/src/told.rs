//! The state of a run's liquid and its incidents, as they are sent to the console.

use vitriol_console::{Flask, Incident, List, Readings, Text};
use vitriol_lesson::{Attempt, Event, Glass, Texts, What};
use vitriol_sim::scene::{Feature, Scene};
use vitriol_sim::solver::Held;

/// What went wrong, in the order of its beginning.
pub fn incidents(events: &[Event], texts: &Texts) -> Vec<Incident> {
    let attempts = Attempt::all(events.iter().cloned());
    let of = |attempt: &Attempt| -> Vec<_> {
        let incidents = attempt.incidents.iter();
        incidents
            .map(|incident| Incident {
                t_s: Some(incident.t_s),
                text: Text::clipped(&texts.wrong(attempt, incident)),
                grave: matches!(
                    incident.what,
                    What::WaterIntoAcid { .. } | What::BoiledOver { .. } | What::OnSkin { .. }
                ),
            })
            .collect()
    };
    attempts.iter().flat_map(of).collect()
}

/// What is measured, at real size, of flasks as `texts` name them; `[bench, floor]` is what lies there, real m³.
pub fn readings(
    scene: &Scene,
    texts: &Texts,
    flasks: &[Held],
    [bench, floor]: [f64; 2],
) -> Readings {
    let glassware = Glass::all(scene);
    let real = scene.scale.length_scale.powi(3);
    let boils = [Feature::Boiling, Feature::Evaporation].map(|it| scene.models(it));
    let superheats = flasks.iter().filter_map(|held| held.superheat);
    let [liquid, bubbles] = flasks.iter().fold([0.0, 0.0], |[liquid, bubbles], held| {
        [liquid + held.volume, bubbles + held.bubbles.volume]
    });
    let named = scene.flasks.iter().zip(flasks);
    Readings {
        flasks: List::clipped(named.map(|(flask, held)| Flask {
            name: Text::clipped(&texts.flask(&glassware, &flask.name)),
            volume_m3: Some(real * held.volume),
            mean_c: held.temperature.map(f64::from),
            hottest_c: held.hottest.map(f64::from),
        })),
        superheat_k: superheats
            .reduce(f32::max)
            .map(f64::from)
            .filter(|_| boils.contains(&true)),
        void_fraction: (scene.models(Feature::Bubbles) && liquid > 0.0)
            .then(|| bubbles / (liquid + bubbles)),
        bench_m3: Some(bench),
        floor_m3: Some(floor),
    }
}
