//! The state of a run's liquid and its incidents, as they are sent to the console.

use vitriol_console::{Flask, Incident, List, Points, Readings, Text};
use vitriol_lesson::{Attempt, Event, Rubric, Score, Texts, What};
use vitriol_sim::scene::{Feature, Scene};
use vitriol_sim::solver::Held;

/// Most incidents that are sent.
const MOST: usize = 32;

/// The attempts of a run, as the console shows them.
#[derive(Clone, Debug, Default)]
pub struct Attempts {
    /// Number of the present one, from 1; 0 before the first.
    pub present: u32,
    /// What went wrong lately, attempt by attempt, in the order of its beginning. Grave incidents of the present attempt are the last to be
    /// left out: a card of the class names one of them.
    pub incidents: List<Incident, MOST>,
    /// Number of incidents of the present attempt.
    pub of_present: u32,
    /// The program's own points of the present attempt; `None` where nothing is judged yet.
    pub points: Option<Points>,
    /// Number of incidents in all.
    pub so_far: u32,
    /// Number of grave ones in all.
    pub grave_so_far: u32,
}

/// The attempts in these events, the present one scored by `rubric`.
pub fn attempts(events: &[Event], texts: &Texts, rubric: &Rubric) -> Attempts {
    let attempts = Attempt::all(events.iter().cloned());
    let of = |(number, attempt): (u32, &Attempt)| -> Vec<_> {
        let incidents = attempt.incidents.iter();
        incidents
            .map(|incident| Incident {
                t_s: Some(incident.t_s),
                text: Text::clipped(&texts.wrong(attempt, incident)),
                grave: matches!(
                    incident.what,
                    What::WaterIntoAcid { .. } | What::BoiledOver { .. } | What::OnSkin { .. }
                ),
                attempt: number,
                scene: Text::clipped(texts.scene(&attempt.scene)),
            })
            .collect()
    };
    let mut incidents: Vec<_> = (1..).zip(&attempts).flat_map(of).collect();
    let present = attempts.len() as u32;
    let so_far = incidents.len() as u32;
    let grave_so_far = incidents.iter().filter(|it| it.grave).count() as u32;
    let score = attempts.last().map(|it| Score::of(it, rubric, texts));
    let score = score.filter(|score| score.of > 0);
    let mut over = incidents.len().saturating_sub(MOST);
    for matters in [false, true] {
        incidents.retain(|it| {
            let goes = over > 0 && (it.grave && it.attempt == present) == matters;
            over -= usize::from(goes);
            !goes
        });
    }
    Attempts {
        present,
        of_present: attempts.last().map_or(0, |it| it.incidents.len() as u32),
        points: score.map(|score| Points {
            earned: score.points,
            of: score.of,
        }),
        so_far,
        grave_so_far,
        incidents: List::clipped(incidents),
    }
}

/// What is measured, at real size, of the flasks of those names; `[bench, floor]` is what lies there, real m³.
pub fn readings(
    scene: &Scene,
    names: &[String],
    flasks: &[Held],
    [bench, floor]: [f64; 2],
) -> Readings {
    let real = scene.scale.length_scale.powi(3);
    let boils = [Feature::Boiling, Feature::Evaporation].map(|it| scene.models(it));
    let superheats = flasks.iter().filter_map(|held| held.superheat);
    let [liquid, bubbles] = flasks.iter().fold([0.0, 0.0], |[liquid, bubbles], held| {
        [liquid + held.volume, bubbles + held.bubbles.volume]
    });
    let named = names.iter().zip(flasks);
    Readings {
        flasks: List::clipped(named.map(|(name, held)| Flask {
            name: Text::clipped(name),
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::{Cause, Contents, Glassware, Incident as Found};

    /// What went wrong in an attempt is told as that attempt's, and the present one counts its own alone. All are counted, and a grave one
    /// of the present attempt stays in the list after more others than fit.
    #[test]
    fn incidents_are_of_their_attempts() {
        let begun = |t_s, scene: &str| Event::Begun {
            t_s,
            scene: scene.to_owned(),
            contents: Contents::new(),
            glass: Glassware::default(),
        };
        let found = |t_s, what| {
            Event::Incident(Found {
                t_s,
                until_s: t_s,
                what,
                cause: Cause::Unknown,
                place_m: [0.0; 3],
            })
        };
        let dropped = |t_s| {
            let what = What::Dropped {
                flask: "source".to_owned(),
                speed_m_s: 2.0,
                broke: false,
            };
            found(t_s, what)
        };
        let boiled_over = |t_s| {
            let what = What::BoiledOver {
                flask: "source".to_owned(),
                volume_m3: 1e-6,
                acid: 0.5,
            };
            found(t_s, what)
        };
        let (texts, rubric) = (Texts::english().unwrap(), Rubric::default());
        let mut events = vec![begun(0.0, "water-into-acid")];
        events.extend((1..=40).map(|t| dropped(f64::from(t))));
        events.extend([begun(50.0, "my-own"), dropped(51.0)]);
        let told = attempts(&events, &texts, &rubric);
        assert_eq!([told.present, told.of_present, told.so_far], [2, 1, 41]);
        // By the table of the score: glass is worth 5 points, a flask that was dropped and no pour leave none of them, and the rest is not
        // judged.
        assert_eq!(told.points, Some(Points { earned: 0, of: 5 }));
        // The last ones of all.
        let whose: Vec<_> = told.incidents.iter().map(|it| it.attempt).collect();
        assert_eq!(whose, [&[1_u32; 31][..], &[2]].concat());
        let scenes = [0, 31].map(|at| &*told.incidents[at].scene);
        assert_eq!(scenes, ["Water into acid", "my-own"]);
        assert_eq!(told.incidents[31].t_s, Some(51.0));

        // A grave one before the drops of each attempt: that of the present attempt stays.
        events.insert(1, boiled_over(0.5));
        events.push(boiled_over(52.0));
        events.extend((60..100).map(|t| dropped(f64::from(t))));
        let told = attempts(&events, &texts, &rubric);
        assert_eq!(
            [told.of_present, told.so_far, told.grave_so_far],
            [42, 83, 2]
        );
        // What boiled over is worth 15.
        assert_eq!(told.points, Some(Points { earned: 0, of: 20 }));
        let times: Vec<_> = told.incidents.iter().filter_map(|it| it.t_s).collect();
        let last = (69..100).map(f64::from);
        assert_eq!(times, [52.0].into_iter().chain(last).collect::<Vec<_>>());
        // More grave ones than fit: the last of them.
        events.extend((100..140).map(|t| boiled_over(f64::from(t))));
        let told = attempts(&events, &texts, &rubric);
        assert_eq!([told.so_far, told.grave_so_far], [123, 42]);
        let times: Vec<_> = told.incidents.iter().filter_map(|it| it.t_s).collect();
        assert_eq!(times, (108..140).map(f64::from).collect::<Vec<_>>());
        let none = attempts(&[], &texts, &rubric);
        assert_eq!((none.present, none.points), (0, None));
    }
}
