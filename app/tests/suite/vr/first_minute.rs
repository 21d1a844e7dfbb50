//! The signs of a first minute, in the picture: with each step another one where it belongs, then none. What differs between a
//! session with signs and one without is the sign, since the rest is the same bits.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_session::session::SessionOutcome;
use vitriol_session::stand_in::StandIn;
use vitriol_sim::scene::Preset;
use vitriol_tests::gpu;
use vitriol_xr::track::Track;
use vitriol_xr::{Hand, HeadsetFrame, Joints, Pose, Turn, View};

use crate::vr::common::{self, Settled, Trouble, Worn, hash, pour};
use crate::vr::loss::replayed;
use crate::vr::seen::{keep_rgb, read};

const EXTENT: [u32; 2] = [400, 425];
/// Frames a second, of two steps each; the track's 9.6 s and half a second in which it is seen that the flask stands.
const RATE: f64 = 45.0;
const FRAMES: u64 = 456;

/// The left eye's pictures, by frame, row by row.
type Pictures = Rc<RefCell<BTreeMap<u64, Vec<[u8; 4]>>>>;

/// Keeps the pictures of some frames, and has no others drawn; the left hand may be a bare one that is there, and the right one gone.
struct Looks {
    at: BTreeSet<u64>,
    bare: Option<Vec3>,
    pictures: Pictures,
    settled: Settled,
}

impl Trouble for Looks {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        if !self.at.contains(&after) {
            return None;
        }
        let gpu = vitriol_xr::Headset::gpu(headset).clone();
        let mut picture = read(&gpu, &headset.targets.colour);
        picture.truncate((EXTENT[0] * EXTENT[1]) as usize);
        self.pictures.borrow_mut().insert(after, picture);
        None
    }

    fn draws(&self, after: u64) -> bool {
        self.at.contains(&(after + 1))
    }

    fn ends(&mut self, after: u64) {
        self.settled.ends(after);
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        self.settled.frame(frame, after);
        if let Some(at) = self.bare {
            let hand = Hand {
                active: true,
                valid: true,
                stage_from_grip: Pose::new(at, glam::Quat::IDENTITY),
                ..Hand::default()
            };
            frame.poses.hands = [hand, Hand::default()];
            frame.joints = [Some(Joints([(at, 0.008); 26])), None];
        }
    }
}

/// Where the base of the flask with the water stands, and of the other beaker, which is 0.110 m high.
const FLASK: Vec3 = Vec3::new(-0.12, 0.75, -0.40);
const BEAKER: Vec3 = Vec3::new(0.12, 0.75, -0.40);

struct Session {
    outcome: SessionOutcome,
    track: Track,
    pictures: BTreeMap<u64, Vec<[u8; 4]>>,
    /// By frame, how the left eye saw in those that were kept.
    views: BTreeMap<u64, View>,
}

/// In scene `two-flasks`, with controllers.
fn run(gpu: &Gpu, hints: bool, frames: u64, at: &[u64]) -> Session {
    run_in(gpu, hints, (frames, at), (None, None))
}

/// In the built-in scene of that name at preset `fast`, else in `two-flasks`; with a bare hand at that place, else with controllers.
fn run_in(
    gpu: &Gpu,
    hints: bool,
    (frames, at): (u64, &[u64]),
    (scene, bare): (Option<&str>, Option<Vec3>),
) -> Session {
    let pictures = Pictures::default();
    let at: BTreeSet<u64> = at.iter().copied().collect();
    let trouble = Looks {
        at: at.clone(),
        bare,
        pictures: Rc::clone(&pictures),
        settled: Settled(gpu.clone()),
    };
    let track = pour().sample_track();
    let mut headset = Worn::of_extent(gpu, track, EXTENT, (RATE, frames), trouble);
    let (outcome, track) = common::run(&mut headset, |options| {
        options.hints = hints;
        if let Some(scene) = scene {
            options.plan.scene = options.plan.scenes.open(scene).unwrap();
            options.plan.preset = Preset::Fast;
        }
    });
    let views = headset.shown.iter().map(|shown| shown.views[0]);
    Session {
        outcome,
        track,
        pictures: pictures.take(),
        views: at.into_iter().zip(views).collect(),
    }
}

/// What a sign takes of a picture.
struct Seen {
    pixels: u32,
    /// Its middle, pixels.
    middle: [f32; 2],
    amber: u32,
    blue: u32,
    bright: u32,
    /// Where a layer under the picture is seen, too.
    open: u32,
}

fn sign(with: &[[u8; 4]], without: &[[u8; 4]]) -> Seen {
    let mut seen = Seen {
        pixels: 0,
        middle: [0.0; 2],
        amber: 0,
        blue: 0,
        bright: 0,
        open: 0,
    };
    for (n, ([r, g, b, alpha], other)) in (0_u32..).zip(with.iter().zip(without)) {
        // Edges beside it may be smoothed otherwise.
        if (0..3).all(|c| [r, g, b][c].abs_diff(other[c]) < 12) {
            continue;
        }
        seen.open += u32::from(*alpha < 255);
        seen.pixels += 1;
        seen.middle[0] += (n % EXTENT[0]) as f32 + 0.5;
        seen.middle[1] += (n / EXTENT[0]) as f32 + 0.5;
        seen.amber += u32::from(*r > 190 && (120..210).contains(g) && *b < 130);
        seen.blue += u32::from(*r < 140 && *b > 190);
        seen.bright += u32::from(r.min(g).min(b) > &190);
    }
    seen.middle = seen.middle.map(|sum| sum / seen.pixels.max(1) as f32);
    seen
}

/// Where a place of the scene is seen, pixels, and how many of them a sign's 0.12 m take there.
fn projected(view: &View, place: Vec3) -> ([f32; 2], f32) {
    let at = view.stage_from_eye.inverse().transform_point(place);
    let fov = view.fov;
    let share = |slope: f32, from: f32, to: f32| (slope - from.tan()) / (to.tan() - from.tan());
    let x = share(at.x / -at.z, fov.left, fov.right) * EXTENT[0] as f32;
    let y = share(at.y / -at.z, fov.up, fov.down) * EXTENT[1] as f32;
    let focal = EXTENT[0] as f32 / (fov.right.tan() - fov.left.tan());
    ([x, y], 0.12 * focal / -at.z)
}

/// The hand that is there, and whether it has a controller: without one there is no trigger, which is amber.
#[test]
fn a_bare_hand_is_shown_no_trigger() {
    let gpu = gpu::device();
    let at = [4];
    let hand = Some(FLASK + Vec3::new(-0.10, 0.05, 0.05));
    let [with, without] = [true, false].map(|hints| run_in(&gpu, hints, (4, &at), (None, hand)));
    let bare = sign(&with.pictures[&4], &without.pictures[&4]);
    keep_rgb("first-minute-bare", EXTENT, &with.pictures[&4]);
    is_over_the_flask(&bare, &with.views[&4]);
    assert!(
        bare.amber == 0 && bare.blue > 0,
        "{} {}",
        bare.amber,
        bare.blue
    );
}

/// The sign's middle is over the flask, to 18 mm: its rim is at 0.095 m, then 0.02 m of air and half of the sign.
fn is_over_the_flask(sign: &Seen, view: &View) {
    let (expected, width) = projected(view, FLASK + (0.095 + 0.02 + 0.06) * Vec3::Y);
    let off = [0, 1].map(|axis| (sign.middle[axis] - expected[axis]).abs() / width);
    assert!(off.iter().all(|off| *off < 0.15), "{off:?}");
}

mod long {
    use super::*;

    /// The correct order pours the acid, of which there is an eighth of the water; the hand that is at the water changes nothing.
    #[test]
    fn the_acid_is_shown_and_not_the_water() {
        let gpu = gpu::device();
        let at = [4];
        let hand = Some(BEAKER + Vec3::new(0.10, 0.05, 0.05));
        let scene = Some("acid-into-water");
        let [with, without] =
            [true, false].map(|hints| run_in(&gpu, hints, (4, &at), (scene, hand)));
        let acid = sign(&with.pictures[&4], &without.pictures[&4]);
        keep_rgb("first-minute-acid", EXTENT, &with.pictures[&4]);
        assert!(acid.blue > 0);
        is_over_the_flask(&acid, &with.views[&4]);
    }

    #[test]
    fn each_step_has_its_sign_until_it_is_done() {
        let gpu = gpu::device();
        // What is to be seen, when (s), and where: 0.02 m over the rim. A sign is 0.12 m wide.
        let rim = |base: Vec3, height: f32| base + (height + 0.02 + 0.06) * Vec3::Y;
        let steps = [
            ("take", 0.66, rim(FLASK, 0.095)),
            ("lift", 0.8, rim(FLASK, 0.095)),
            // With room for the flask that pours, and 0.06 m behind that.
            (
                "pour",
                2.5,
                rim(BEAKER, 0.110) + Vec3::new(0.014, 0.14, -0.058),
            ),
            ("put-down", 9.25, rim(FLASK, 0.095)),
        ];
        let frame = |seconds: f64| (RATE * seconds) as u64;
        let mut at: Vec<u64> = steps.iter().map(|(_, time, _)| frame(*time)).collect();
        // Other pictures of the motion, to be looked at.
        at.extend([2.0, 4.2, 6.0].map(frame));
        at.push(FRAMES);
        let with = run(&gpu, true, FRAMES, &at);
        let without = run(&gpu, false, FRAMES, &at);
        for (n, picture) in &with.pictures {
            keep_rgb(&format!("first-minute-{n:03}"), EXTENT, picture);
        }
        let mut found = Vec::new();
        for (name, time, place) in steps {
            let n = frame(time);
            let seen = sign(&with.pictures[&n], &without.pictures[&n]);
            let view = &with.views[&n];
            let (expected, width) = projected(view, place);
            let off = [0, 1].map(|axis| (seen.middle[axis] - expected[axis]).abs() / width);
            // It is a disc, may be covered by a hand or a flask in part, and has the panel's ground, before which it is seen to pour. 18 mm off.
            let disc = 0.25 * std::f32::consts::PI * width * width;
            let share = seen.pixels as f32 / disc;
            assert!(off.iter().all(|off| *off < 0.15), "{name}: {off:?}");
            assert!((0.35..1.15).contains(&share), "{name}: {share}");
            // Only where its edge is smoothed together with the panel.
            assert!(10 * seen.open < seen.pixels, "{name}: {}", seen.open);
            // Its rim.
            assert!(seen.bright > 20, "{name}: {}", seen.bright);
            found.push((seen.amber > 8, seen.blue > 0));
        }
        // A trigger; an arrow; none, but liquid; both again.
        assert_eq!(
            found.iter().map(|it| it.0).collect::<Vec<_>>(),
            [true, true, false, true]
        );
        assert!(found.iter().all(|it| it.1), "{found:?}");
        // While the flask pours none lies over it and its stream.
        let pours = frame(4.2);
        assert!(with.pictures[&pours] == without.pictures[&pours]);
        // After the last it is gone.
        assert_eq!(with.pictures[&FRAMES], without.pictures[&FRAMES]);

        let report = with.outcome.first_minute.unwrap();
        let done = |time: Option<f64>, range: std::ops::Range<f64>| {
            assert!(time.is_some_and(|time| range.contains(&time)), "{report:?}");
        };
        // The track's own times.
        done(report.taken_s, 0.6..0.85);
        done(report.lifted_s, 0.85..1.2);
        done(report.poured_s, 2.8..5.2);
        done(report.put_down_s, 9.7..10.1);
        assert_eq!(without.outcome.first_minute, None);
        // Neither liquid nor recording knows of them.
        let expected = hash(&without.outcome);
        assert_eq!(hash(&with.outcome), expected);
        assert_eq!(replayed(&gpu, with.track), expected);
        assert_eq!(without.outcome.world.holder(0), None);
    }
}
