//! The state of a run's liquid and its incidents, as they are sent to the console.

use std::time::{Duration, Instant};

use vitriol_console::{Flask, Incident, List, Points, Readings, Text};
use vitriol_lesson::{Attempt, Event, Incident as Found, Rubric, Score, Texts, What};
use vitriol_sim::scene::{Feature, Scene};
use vitriol_sim::solver::Held;

/// Most incidents that are sent.
const MOST: usize = 32;
/// Time between two looks for incidents that are under way. Our choice: an amount is seen to grow, and few frames have a look.
const LOOK: Duration = Duration::from_millis(250);

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

/// Evaluates the events of a run that goes on.
#[derive(Clone, Debug, Default)]
pub struct Evaluation {
    /// The number of events that were evaluated.
    events: usize,
    /// Incidents that were under way at the last look.
    under_way: Vec<Found>,
    looked: Option<Instant>,
    attempts: Attempts,
}

impl Evaluation {
    /// The attempts as they were evaluated last.
    pub fn attempts(&self) -> &Attempts {
        &self.attempts
    }

    /// Evaluates the events anew where there are more of them, or where what is under way has changed. An event is emitted when it is over:
    /// `so_far` gives those that there would be if the attempt ended now.
    pub fn follow(
        &mut self,
        events: &[Event],
        so_far: impl FnOnce() -> Vec<Event>,
        (texts, rubric): (&Texts, &Rubric),
    ) {
        let now = Instant::now();
        let is_new = self.events != events.len();
        let waits = self
            .looked
            .is_some_and(|last| now.duration_since(last) < LOOK);
        // What is over must not be listed as under way too.
        if !is_new && waits {
            return;
        }
        self.looked = Some(now);
        let found = so_far().into_iter().filter_map(|event| match event {
            Event::Incident(incident) => Some(incident),
            _ => None,
        });
        let under_way: Vec<Found> = found.collect();
        if is_new || under_way != self.under_way {
            self.events = events.len();
            self.attempts = attempts(events, &under_way, texts, rubric);
            self.under_way = under_way;
        }
    }
}

/// The attempts in these events, the present one scored by `rubric`. Incidents that are under way are listed with what has come of them so
/// far; points are for what is over.
fn attempts(events: &[Event], under_way: &[Found], texts: &Texts, rubric: &Rubric) -> Attempts {
    let mut attempts = Attempt::all(events.iter().cloned());
    let score = attempts.last().map(|it| Score::of(it, rubric, texts));
    let score = score.filter(|score| score.of > 0);
    if let Some(present) = attempts.last_mut() {
        present.incidents.extend_from_slice(under_way);
        (present.incidents).sort_by(|one, other| one.t_s.total_cmp(&other.t_s));
    }
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
    use vitriol_lesson::{Cause, Contents, Glassware, Surface};

    fn begun(t_s: f64, scene: &str) -> Event {
        Event::Begun {
            t_s,
            scene: scene.to_owned(),
            contents: Contents::new(),
            glass: Glassware::default(),
        }
    }

    fn found(t_s: f64, what: What) -> Event {
        Event::Incident(Found {
            t_s,
            until_s: t_s,
            what,
            cause: Cause::Unknown,
            place_m: [0.0; 3],
        })
    }

    /// A spill is listed from its beginning on, its amount grows, and when it is over it is listed once. It takes no points before.
    #[test]
    fn a_spill_under_way_is_listed() {
        let (texts, rubric) = (Texts::english().unwrap(), Rubric::default());
        let spilt = |ml: f64| {
            let what = What::Spilt {
                surface: Surface::Bench,
                volume_m3: 1e-6 * ml,
                acid: 0.98,
            };
            found(3.0, what)
        };
        let mut events = vec![begun(0.0, "acid-into-water")];
        let mut evaluation = Evaluation::default();
        let mut listed = |events: &[Event], so_far: Vec<Event>| {
            // However soon it is asked again.
            evaluation.looked = None;
            evaluation.follow(events, || so_far, (&texts, &rubric));
            let told = evaluation.attempts();
            assert_eq!(told.of_present as usize, told.incidents.len());
            let all = told.incidents.iter();
            let all: Vec<_> = all.map(|it| it.text.replace('\u{a0}', " ")).collect();
            (all.concat(), told.points)
        };
        let (none, before) = listed(&events, Vec::new());
        assert_eq!(none, "");
        assert_eq!(
            listed(&events, vec![spilt(6.4)]),
            (
                "Spilt on the bench: 6.4 mL of 98 % acid.".to_owned(),
                before
            )
        );
        let (more, points) = listed(&events, vec![spilt(13.4)]);
        assert_eq!(
            (&*more, points),
            ("Spilt on the bench: 13 mL of 98 % acid.", before)
        );
        events.push(spilt(14.0));
        let (over, after) = listed(&events, Vec::new());
        assert_eq!(over, "Spilt on the bench: 14 mL of 98 % acid.");
        assert_ne!(after, before);
    }

    /// A new event is taken in at once: what was under way would else be listed beside it.
    #[test]
    fn what_is_over_is_listed_once() {
        let texts = (&Texts::english().unwrap(), &Rubric::default());
        let what = |broke| What::Dropped {
            flask: "source".to_owned(),
            speed_m_s: 2.0,
            broke,
        };
        let mut events = vec![begun(0.0, "acid-into-water")];
        let mut evaluation = Evaluation::default();
        evaluation.follow(&events, || vec![found(1.0, what(false))], texts);
        assert_eq!(evaluation.attempts().of_present, 1);
        let before = evaluation.attempts().incidents[0].text.clone();
        events.push(found(1.0, what(true)));
        evaluation.follow(&events, Vec::new, texts);
        assert_eq!(evaluation.attempts().of_present, 1);
        assert_ne!(evaluation.attempts().incidents[0].text, before);
    }

    /// What went wrong in an attempt is told as that attempt's, and the present one counts its own alone. All are counted, and a grave one
    /// of the present attempt stays in the list after more others than fit.
    #[test]
    fn incidents_are_of_their_attempts() {
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
        let told = attempts(&events, &[], &texts, &rubric);
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
        let told = attempts(&events, &[], &texts, &rubric);
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
        let told = attempts(&events, &[], &texts, &rubric);
        assert_eq!([told.so_far, told.grave_so_far], [123, 42]);
        let times: Vec<_> = told.incidents.iter().filter_map(|it| it.t_s).collect();
        assert_eq!(times, (108..140).map(f64::from).collect::<Vec<_>>());
        let none = attempts(&[], &[], &texts, &rubric);
        assert_eq!((none.present, none.points), (0, None));
    }
}
