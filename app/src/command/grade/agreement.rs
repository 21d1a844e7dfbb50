//! How the findings of a simulation agree with those in a recording.

use std::collections::{BTreeMap, BTreeSet};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use vitriol_lesson::Attempt;

use super::beyond::{Beyond, Place, Thing, Values, two_decimals};
use super::wrong::Words;

/// How far what is found on two devices may be apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Tolerance of a moment, s.
    pub time_s: f64,
    /// Tolerance of a volume, as a share of the larger one.
    pub share: f64,
    /// Tolerance of a volume beside that share, m³.
    pub volume_m3: f64,
}

impl Default for Tolerance {
    /// Bits of another device are as another seed of the particles' jitter at first. Four times and more of what seeds make of the
    /// same hands (`docs/measurements/lesson.md`), and the least spill that is one.
    fn default() -> Self {
        Self {
            time_s: 0.2,
            share: 0.05,
            volume_m3: 0.1e-6,
        }
    }
}

impl FromStr for Tolerance {
    type Err = String;

    /// Seconds, per cent and millilitres, such as `0.2,5,0.1`.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|it| it.parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[time_s, percent, millilitres])
                if [time_s, percent, millilitres]
                    .iter()
                    .all(|it| it.is_finite() && *it >= 0.0) =>
            {
                Ok(Self {
                    time_s,
                    share: percent / 100.0,
                    volume_m3: millilitres * 1e-6,
                })
            }
            _ => Err("give seconds, per cent and millilitres, such as 0.2,5,0.1".into()),
        }
    }
}

/// How two findings of the same track agree.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// The most that moments of the same thing are apart, s.
    pub time_s: f64,
    /// The most that volumes of the same thing are apart, m³.
    pub volume_m3: f64,
    /// What is beyond the tolerance; empty where all is within.
    pub beyond: Vec<Beyond>,
}

/// Pours from one flask to another, or incidents of one kind in one place. They are summed up: where one of two devices sees a
/// gap of a second, it counts two pours in place of one.
#[derive(Default)]
struct Sum {
    count: usize,
    /// m³; `None` of what has no volume.
    volume_m3: Option<f64>,
    /// When the largest of them began, and its volume.
    largest: (f64, f64),
}

impl Agreement {
    /// How the attempts in a recording agree with those that were found.
    pub fn of(recorded: &[Attempt], found: &[Attempt], tolerance: Tolerance) -> Self {
        let mut agreement = Self::default();
        let numbers = [recorded.len(), found.len()];
        if numbers[0] != numbers[1] {
            agreement.beyond.push(Beyond::Attempts(numbers));
        }
        for (number, (recorded, found)) in (1..).zip(recorded.iter().zip(found)) {
            agreement.compare(number, &[sums(recorded), sums(found)], tolerance);
        }
        agreement
    }

    fn compare(&mut self, attempt: u32, both: &[BTreeMap<Thing, Sum>; 2], tolerance: Tolerance) {
        let keys: BTreeSet<&Thing> = both.iter().flat_map(BTreeMap::keys).collect();
        for key in keys {
            let nothing = Sum::default();
            let [recorded, found] = both
                .each_ref()
                .map(|sums| sums.get(key).unwrap_or(&nothing));
            let mut beyond = |values: Values| {
                let thing = key.clone();
                self.beyond.push(Beyond::Thing {
                    attempt,
                    thing,
                    values,
                });
            };
            let volumes = [recorded, found].map(|it| it.volume_m3);
            if volumes.iter().any(Option::is_some) {
                let [a, b] = volumes.map(Option::unwrap_or_default);
                self.volume_m3 = self.volume_m3.max((a - b).abs());
                // An amount that is no number is none that agrees.
                let within = (a - b).abs() <= tolerance.share * a.max(b) + tolerance.volume_m3;
                if !within {
                    beyond(Values::Volumes([a, b]));
                    continue;
                }
                if a.min(b) <= tolerance.volume_m3 {
                    // So little has no moment that counts.
                    continue;
                }
            } else if recorded.count != found.count {
                beyond(Values::Counts([recorded.count, found.count]));
                continue;
            }
            let [a, b] = [recorded, found].map(|it| it.largest.0);
            self.time_s = self.time_s.max((a - b).abs());
            let within = (a - b).abs() <= tolerance.time_s;
            if !within {
                beyond(Values::Moments([a, b]));
            }
        }
    }

    /// In a few words.
    pub fn text(&self, words: &Words) -> String {
        if self.beyond.is_empty() {
            let apart = [self.time_s, 1e6 * self.volume_m3];
            let [seconds, millilitres] = apart.map(|it| two_decimals(it, words));
            let holes = [("seconds", &*seconds), ("millilitres", &*millilitres)];
            words.grades.verified.apart.fill(&holes)
        } else {
            let told = self.beyond.iter().map(|it| it.told(words));
            told.collect::<Vec<_>>().join("; ")
        }
    }
}

/// What an attempt holds, by what, where and of which flasks.
fn sums(attempt: &Attempt) -> BTreeMap<Thing, Sum> {
    let mut sums = BTreeMap::<Thing, Sum>::new();
    let pours = attempt.pours.iter().map(|pour| {
        let thing = Thing::Poured {
            from: pour.from.clone(),
            into: pour.into.clone(),
        };
        (thing, pour.t_s, Some(pour.volume_m3))
    });
    let incidents = attempt.incidents.iter().map(|incident| {
        let (place, volume_m3) = Place::of(&incident.what);
        let kind = incident.what.kind().to_owned();
        (Thing::Incident { kind, place }, incident.t_s, volume_m3)
    });
    for (thing, t_s, volume_m3) in pours.chain(incidents) {
        let sum = sums.entry(thing).or_default();
        if let Some(volume) = volume_m3 {
            *sum.volume_m3.get_or_insert(0.0) += volume;
        }
        let size = volume_m3.unwrap_or_default();
        if sum.count == 0 || size > sum.largest.1 {
            sum.largest = (t_s, size);
        }
        sum.count += 1;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use vitriol_lesson::{Cause, Incident, Pour, What};

    fn pour(t_s: f64, millilitres: f64) -> Pour {
        Pour {
            t_s,
            until_s: t_s + 0.5,
            from: "acid".into(),
            into: Some("water".into()),
            volume_m3: 1e-6 * millilitres,
            fastest_m3_s: 0.0,
            acid: 0.98,
            met: None,
            bare_face: false,
        }
    }

    fn incident(t_s: f64, what: What) -> Incident {
        Incident {
            t_s,
            until_s: t_s,
            what,
            cause: Cause::Unknown,
            place_m: [0.0; 3],
        }
    }

    fn hot(flask: &str, t_s: f64) -> Incident {
        let (flask, temperature_c) = (flask.into(), 70.0);
        incident(
            t_s,
            What::Hot {
                flask,
                temperature_c,
            },
        )
    }

    fn attempt(pours: Vec<Pour>, incidents: Vec<Incident>) -> Attempt {
        Attempt {
            scene: "acid-into-water".into(),
            pours,
            incidents,
            ..Attempt::default()
        }
    }

    const LIMITS: Tolerance = Tolerance {
        time_s: 0.5,
        share: 0.1,
        volume_m3: 1e-6,
    };

    fn agreement(recorded: Attempt, found: Attempt) -> Agreement {
        Agreement::of(&[recorded], &[found], LIMITS)
    }

    #[test]
    fn amounts_agree_within_a_share_and_a_little() {
        let of = |a, b| {
            let [a, b] = [a, b].map(|it| attempt(vec![pour(1.0, it)], Vec::new()));
            agreement(a, b)
        };
        let close = of(20.0, 22.9);
        assert!(close.beyond.is_empty(), "{close:?}");
        assert!((close.volume_m3 - 2.9e-6).abs() < 1e-12);
        assert_eq!(of(20.0, 23.5).beyond.len(), 1);
        // Less than the least that counts, and more.
        let none = attempt(Vec::new(), Vec::new());
        let some = |it| attempt(vec![pour(1.0, it)], Vec::new());
        assert!(agreement(none.clone(), some(0.9)).beyond.is_empty());
        assert_eq!(agreement(none, some(1.5)).beyond.len(), 1);
        assert_eq!(of(20.0, f64::NAN).beyond.len(), 1);
    }

    #[test]
    fn a_tolerance_is_three_numbers() {
        let default = Tolerance::default();
        assert_eq!("0.2,5,0.1".parse(), Ok(default));
        for wrong in [
            "",
            "0.5",
            "0.2,5",
            "0.2,5,0.1,1",
            "-1,5,0.1",
            "nan,20,1",
            "a,b,c",
        ] {
            assert!(wrong.parse::<Tolerance>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn one_pour_may_be_two_on_another_device() {
        let one = attempt(vec![pour(1.0, 20.0)], Vec::new());
        let two = attempt(vec![pour(1.1, 12.0), pour(3.0, 8.0)], Vec::new());
        let agreement = agreement(one, two);
        assert!(agreement.beyond.is_empty(), "{agreement:?}");
        assert!((agreement.time_s - 0.1).abs() < 1e-9);
    }

    #[test]
    fn moments_kinds_and_flasks_are_told_apart() {
        let of = |a, b| {
            let [a, b] = [a, b].map(|it| attempt(Vec::new(), it));
            agreement(a, b).beyond
        };
        assert!(of(vec![hot("a", 1.0)], vec![hot("a", 1.4)]).is_empty());
        assert_eq!(of(vec![hot("a", 1.0)], vec![hot("a", 1.6)]).len(), 1);
        assert_eq!(of(vec![hot("a", 1.0)], vec![hot("b", 1.0)]).len(), 2);
        assert_eq!(of(vec![hot("a", 1.0)], Vec::new()).len(), 1);
        let dropped = |broke| {
            let (flask, speed_m_s) = ("a".to_owned(), 3.0);
            vec![incident(
                1.0,
                What::Dropped {
                    flask,
                    speed_m_s,
                    broke,
                },
            )]
        };
        assert_eq!(of(dropped(true), dropped(false)).len(), 2);
        let none: [Attempt; 0] = [];
        let one = [attempt(Vec::new(), Vec::new())];
        assert_eq!(Agreement::of(&none, &one, LIMITS).beyond.len(), 1);
    }
}
