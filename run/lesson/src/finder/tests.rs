//! Tests with observations that are arranged by hand: real size, 100 a second.
#![allow(clippy::unwrap_used, clippy::panic)]

use glam::{DVec3, Quat, Vec3};
use vitriol_sim::bodies::{Break, Strike, Worn};
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{BubbleCount, Came, Census, Held, Moved, Place, Skin as Part, Touching};

mod incidents;

use super::*;
use crate::event::{Cause, Incident, Pour, Skin, Surface, What};

const STEP: f64 = 0.01;
/// Volume that arrives in one observation of a pour of 4 mL/s, m³.
const BIT: f64 = 0.04e-6;

/// The two flasks of the scene: the source is held, the target stands. 20 mL in one, 160 mL in the other.
struct Arranged {
    finder: Finder,
    t: f64,
    held: [Held; 2],
    poses: [Pose; 2],
    hands: [bool; 2],
    sprayed: [f64; 2],
    worn: Worn,
    said: Vec<Event>,
}

fn held(volume: f64, acid: f32, temperature: f32) -> Held {
    Held {
        particles: 1000,
        volume,
        temperature: Some(temperature),
        hottest: Some(temperature + 5.0),
        acid,
        ..Held::default()
    }
}

impl Arranged {
    fn new(acids: [f32; 2]) -> Self {
        let scene = Scene::builtin("water-into-acid").unwrap();
        let poses = [0, 1].map(|flask| scene.flasks[flask].stage_from_flask);
        let mut arranged = Self {
            finder: Finder::new("water-into-acid", &scene, Limits::default()),
            t: 0.0,
            held: [held(20e-6, acids[0], 20.0), held(160e-6, acids[1], 20.0)],
            poses,
            hands: [true, false],
            sprayed: [0.0; 2],
            worn: Worn::default(),
            said: Vec::new(),
        };
        arranged.looks(1, &|census| census);
        arranged
    }

    fn tilt(&mut self, flask: usize, degrees: f32) {
        self.poses[flask].orientation = Quat::from_rotation_z(-degrees.to_radians());
    }

    /// Has bubbles in that flask from now on.
    fn bubbles(&mut self, flask: usize) {
        self.held[flask].bubbles.here = BubbleCount {
            count: 3,
            radius: 1e-3,
        };
    }

    /// Takes `count` observations of the census that `change` makes, with the step's impacts and breaks in the first.
    fn looks_with(
        &mut self,
        count: usize,
        (strikes, breaks): (&[Strike], &[Break]),
        change: &dyn Fn(Census) -> Census,
    ) {
        for n in 0..count {
            let before = self.t;
            self.t += STEP;
            let census = change(Census {
                flasks: self.held.to_vec(),
                sprayed: self.sprayed.to_vec(),
                ..Census::default()
            });
            self.said.extend(self.finder.looked(&Seen {
                worn: self.worn,
                sash_open: None,
                dipped: &[],
                t: self.t,
                before,
                elapsed: STEP,
                census: &census,
                poses: &self.poses,
                held: &self.hands,
                strikes: if n == 0 { strikes } else { &[] },
                breaks: if n == 0 { breaks } else { &[] },
            }));
        }
    }

    fn looks(&mut self, count: usize, change: &dyn Fn(Census) -> Census) {
        self.looks_with(count, (&[], &[]), change);
    }

    /// Takes `count` observations, in each of which `volume` (m³) leaves the source and arrives at `to`.
    fn pours(&mut self, count: usize, volume: f64, acid: f64, to: Place) {
        self.looks(count, &|census| {
            let moved = moved(volume, acid);
            census
                .with_moved(Place::Air, 0, moved)
                .with_moved(to, 0, moved)
        });
    }

    /// A pause, then the end of the attempt.
    fn end(&mut self) -> (Vec<Pour>, Vec<Incident>) {
        self.looks(150, &|census| census);
        let ended = self.finder.end();
        self.said.extend(ended);
        let pours = self.said.iter().filter_map(|it| match it {
            Event::Poured(pour) => Some(pour.clone()),
            _ => None,
        });
        let incidents = self.said.iter().filter_map(|it| match it {
            Event::Incident(incident) => Some(incident.clone()),
            _ => None,
        });
        (pours.collect(), incidents.collect())
    }
}

fn moved(volume: f64, acid: f64) -> Moved {
    Moved {
        particles: (volume / 15.6e-9).ceil() as u32,
        volume,
        acid,
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-9)
}

/// A pour begins with the step that the first observation of it is behind: at 0.06 s, where 0.06 + 0.01 - 0.01 is 0.05999999999999999.
#[test]
fn a_pour_begins_at_a_whole_time() {
    let mut arranged = Arranged::new([0.0, 0.98]);
    arranged.tilt(0, 80.0);
    arranged.looks(5, &|census| census);
    arranged.t = 0.06;
    arranged.pours(100, 4e-6 * STEP, 0.0, Place::Flask(1));
    let (pours, incidents) = arranged.end();
    assert_eq!([pours[0].t_s, incidents[0].t_s], [0.06; 2]);
}

/// 4 mL of water in a second, a pause too short to end a pour, and 4 mL more: one pour, which is the incorrect order and not too fast.
/// Acid into water at six times the limit is in order, and too fast.
#[test]
fn a_pour_has_its_amount_its_rate_and_its_order() {
    for (acids, rate) in [([0.0, 0.98], 4.0), ([0.98, 0.0], 30.0)] {
        let mut arranged = Arranged::new(acids);
        arranged.tilt(0, 80.0);
        let acid = f64::from(acids[0]);
        arranged.pours(100, 1e-6 * rate * STEP, acid, Place::Flask(1));
        let under_way = |arranged: &Arranged, rates: f64| {
            let now = arranged.finder.pouring().unwrap();
            assert!(near(now.volume_m3, 1e-6 * rate), "{now:?}");
            assert!(near(now.rate_m3_s, 1e-6 * rates), "{now:?}");
        };
        under_way(&arranged, rate);
        // Half a second without liquid: the pour goes on, at no rate.
        arranged.looks(50, &|census| census);
        under_way(&arranged, 0.0);
        arranged.pours(100, 1e-6 * rate * STEP, acid, Place::Flask(1));
        let (pours, incidents) = arranged.end();
        assert_eq!(arranged.finder.pouring(), None);
        let [pour] = &pours[..] else {
            panic!("{pours:?}");
        };
        assert_eq!(
            (pour.from.as_str(), pour.into.as_deref()),
            ("source", Some("target"))
        );
        assert!(near(pour.volume_m3, 2e-6 * rate), "{pour:?}");
        assert!(near(pour.fastest_m3_s, 1e-6 * rate), "{pour:?}");
        assert!(near(pour.t_s, STEP) && near(pour.until_s, 2.51), "{pour:?}");
        assert!(
            near(pour.met.unwrap().acid, f64::from(acids[1])),
            "{pour:?}"
        );
        let [incident] = &incidents[..] else {
            panic!("{incidents:?}");
        };
        assert_eq!(
            incident.cause,
            Cause::Pouring {
                from: "source".into()
            }
        );
        match &incident.what {
            What::WaterIntoAcid {
                flask,
                met_acid,
                volume_m3,
            } => {
                assert_eq!((flask.as_str(), acids[0]), ("target", 0.0));
                assert!(near(*met_acid, f64::from(0.98_f32)) && near(*volume_m3, 8e-6));
                assert!(near(incident.t_s, pour.t_s) && near(incident.until_s, pour.until_s));
            }
            What::PouredTooFast {
                flask,
                rate_m3_s,
                limit_m3_s,
            } => {
                assert_eq!((flask.as_str(), acids[1]), ("target", 0.0));
                assert!(near(*rate_m3_s, 30e-6) && *limit_m3_s == 5e-6);
            }
            other => panic!("{other:?}"),
        }
    }
}

/// Goggles that are put on while it pours come too late; a scene without goggles has nobody bare.
#[test]
fn a_pour_says_whether_the_face_was_bare() {
    for (first, then, bare) in [
        (None, None, false),
        (Some(true), Some(true), false),
        (Some(false), Some(false), true),
        (Some(false), Some(true), true),
        (Some(true), Some(false), true),
    ] {
        let mut arranged = Arranged::new([0.98, 0.0]);
        arranged.tilt(0, 80.0);
        for goggles in [first, then] {
            arranged.worn.goggles = goggles;
            arranged.pours(50, BIT, 0.98, Place::Flask(1));
        }
        let (pours, _) = arranged.end();
        assert_eq!(pours.len(), 1);
        assert_eq!(pours[0].bare_face, bare, "{first:?}, {then:?}");
    }
    // Goggles that are off before and after do not matter.
    let mut arranged = Arranged::new([0.98, 0.0]);
    arranged.worn.goggles = Some(false);
    arranged.looks(50, &|census| census);
    arranged.tilt(0, 80.0);
    arranged.worn.goggles = Some(true);
    arranged.pours(50, BIT, 0.98, Place::Flask(1));
    arranged.worn.goggles = Some(false);
    assert!(!arranged.end().0[0].bare_face);
}

/// Acid that has been diluted below the limit is not concentrated any more: what arrives then is not in the incorrect order. Water onto
/// water is no incident, however fast, nor is acid onto acid.
#[test]
fn the_order_is_judged_by_what_is_met() {
    let mut arranged = Arranged::new([0.0, 0.60]);
    arranged.tilt(0, 80.0);
    arranged.pours(50, BIT, 0.0, Place::Flask(1));
    arranged.held[1].acid = 0.50;
    arranged.looks(1, &|census| census);
    arranged.pours(50, BIT, 0.0, Place::Flask(1));
    let (_, incidents) = arranged.end();
    let [incident] = &incidents[..] else {
        panic!("{incidents:?}");
    };
    let What::WaterIntoAcid { volume_m3, .. } = incident.what else {
        panic!("{incident:?}");
    };
    assert!(near(volume_m3, 50.0 * BIT), "{incident:?}");

    for acids in [[0.0, 0.0], [0.93, 0.98]] {
        let mut arranged = Arranged::new(acids);
        arranged.tilt(0, 80.0);
        arranged.pours(50, 10.0 * BIT, f64::from(acids[0]), Place::Flask(1));
        let (pours, incidents) = arranged.end();
        assert_eq!((pours.len(), incidents.len()), (1, 0), "{incidents:?}");
    }
}

/// Two pours with a pause between are two; drops that cling are none, and what comes from an upright flask was not poured.
#[test]
fn what_is_no_pour() {
    let mut arranged = Arranged::new([0.0, 0.0]);
    arranged.tilt(0, 80.0);
    arranged.pours(20, BIT, 0.0, Place::Flask(1));
    arranged.looks(120, &|census| census);
    arranged.pours(20, BIT, 0.0, Place::Flask(1));
    arranged.looks(120, &|census| census);
    arranged.pours(4, BIT, 0.0, Place::Flask(1));
    arranged.looks(120, &|census| census);
    arranged.tilt(0, 5.0);
    arranged.pours(20, BIT, 0.0, Place::Flask(1));
    assert_eq!(arranged.end().0.len(), 2);
}
