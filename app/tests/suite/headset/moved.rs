//! A headset that is switched on late, whose user recentres with a full flask in the hand, and whose session is lost and found
//! elsewhere.

use glam::{Quat, Vec3};
use vitriol_run::track::key;
use vitriol_tests::mock::{self, Change, HandState, Lost, Mock, SpaceKind};
use vitriol_xr::track::load;
use vitriol_xr::{Hand, PoseFrame, Side};

use crate::headset::drive;
use crate::headset::pour::{replay, whole};
use crate::headset::program::{self, Program};

/// A display of 30 Hz: three steps a frame.
const PERIOD: f64 = 1.0 / 30.0;
/// The frames in which the hand begins to move as the track says, recentres, presses A, and loses the session; and of the end.
/// The track has the flask lifted and upright from 1.4 to 2 s.
const BEGINS: u64 = 10;
const RECENTRES: u64 = BEGINS + 48;
const PRESSES: u64 = BEGINS + 54;
const LOSES: u64 = BEGINS + 60;
const ENDS: u64 = BEGINS + 66;

fn pose(pose: &vitriol_xr::Pose) -> mock::Pose {
    mock::Pose::new(pose.position, pose.orientation)
}

/// What the runtime is told of a frame of the track.
fn wear(mock: &Mock, at: u64, frame: &PoseFrame) {
    // She looks aside as she presses A, which turns the bench.
    let mut head = frame.stage_from_view;
    if at >= PRESSES {
        head.orientation = Quat::from_rotation_y(0.25) * head.orientation;
    }
    mock.say_at(at, Change::head(pose(&head)));
    let hand: &Hand = frame.hand(Side::Right);
    let state = HandState {
        grip: pose(&hand.stage_from_grip),
        aim: pose(&hand.stage_from_aim),
        squeeze: hand.squeeze,
        a: at == PRESSES,
        ..HandState::touch(1)
    };
    mock.say_at(at, Change::hand(1, state));
}

mod long {
    use super::*;

    #[test]
    fn a_full_flask_stays_full() {
        let off = [
            Change::Headset(false),
            Change::Period((1e9 * PERIOD) as i64),
        ];
        let Some(mock) = mock::enter("headset::moved::long::a_full_flask_stays_full", &off) else {
            return;
        };
        let track = drive::track();
        for at in 0..=ENDS {
            let time = PERIOD * at.saturating_sub(BEGINS) as f64;
            wear(&mock, at, &track.sample(0, time));
        }
        let there = mock::Pose::new(Vec3::new(1.0, 0.0, 0.4), Quat::from_rotation_y(1.2));
        let floor = SpaceKind::LocalFloor;
        mock.say_at(RECENTRES, Change::recentre(floor, there));
        // Found again, the session has its floor where it was at first, and nobody says so.
        mock.say_at(
            LOSES,
            Change::Move {
                space: floor,
                origin: mock::Pose::IDENTITY,
                announced: false,
                pose_valid: false,
                later: 0,
            },
        );
        mock.say_at(LOSES, Change::Lose(Lost::Session));

        let scene = program::scene(mock.folder());
        let recording = mock.folder().join("session.mcap");
        let mut program = Program::start(&scene, &recording);
        program.says("switch it on");
        mock.say(Change::Headset(true));
        program.says("session lost");
        program.says("Focused");
        program.frames(20);
        let (report, _) = program.end();
        assert_eq!(report["renewals"], 1);
        assert_eq!(report["lost_particles"], 0);

        let recorded = load(recording.to_str().unwrap()).unwrap();
        whole(&recorded, report["steps"].as_u64().unwrap());
        let leaps: Vec<usize> = (0..recorded.frames.len())
            .filter(|&at| {
                let scenario = &recorded.frames[at].scenario;
                scenario.iter().any(|it| it.key == key::PLACEMENT)
            })
            .collect();
        // The bench is laid at the start, twice as she asks, and once after the loss.
        assert_eq!(leaps.len(), 4, "{leaps:?}");
        // It is in the hand whenever that is there: a session that was found has its controllers some frames later.
        let in_hand = |at: usize| {
            let hand = recorded.frames[at].hand(Side::Right);
            let flask = recorded.stage_from_flasks[at][0];
            let place = hand
                .stage_from_grip
                .inverse()
                .transform_point(flask.position);
            (hand.active && hand.valid).then_some(place)
        };
        let held = in_hand(leaps[1] - 1).unwrap();
        let known = (leaps[1]..recorded.frames.len() - 1).filter_map(in_hand);
        let off: Vec<f32> = known.map(|place| place.distance(held)).collect();
        assert!(
            off.len() > 60 && off.iter().all(|off| *off < 1e-4),
            "{off:?}"
        );
        let replayed = replay(&recorded);
        assert_eq!(report["state_hash"], replayed.hash.as_str());
        // All of its 150 mL; particles are of 85 mg.
        assert!(
            replayed.kept > 0.1499 && replayed.poured == 0.0,
            "{} kg",
            replayed.kept
        );
    }
}
