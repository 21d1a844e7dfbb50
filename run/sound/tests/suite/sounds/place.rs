//! The places that sounds are heard from.

use glam::{Quat, Vec3};
use vitriol_sound::{Body, Event, Listener, Mixer, Sound, Strike};

use crate::sounds::measure::{ahead, mono, pour, render, rms};

fn at(position: Vec3) -> Vec<[f32; 2]> {
    let event = Event {
        position,
        ..ahead(0.0, pour(1.0))
    };
    render(&[event], 1.0)
}

fn loud(samples: &[[f32; 2]], side: usize) -> f64 {
    let one: Vec<f64> = samples.iter().map(|it| f64::from(it[side])).collect();
    rms(&one)
}

#[test]
fn what_is_mirrored_is_heard_mirrored_to_the_bit() {
    for (x, y, z) in [(1.0, 0.0, -1.0), (0.4, 0.3, 0.2), (2.0, 0.0, 0.0)] {
        let (right, left) = (at(Vec3::new(x, y, z)), at(Vec3::new(-x, y, z)));
        let swapped = |(a, b): (&[f32; 2], &[f32; 2])| a[0] == b[1] && a[1] == b[0];
        assert!(right.iter().zip(&left).all(swapped));
        assert!(loud(&right, 1) > 2.0 * loud(&right, 0));
    }
}

#[test]
fn half_the_distance_is_twice_as_loud() {
    let near = mono(&at(Vec3::new(0.0, 0.0, -0.5)));
    let far = mono(&at(Vec3::new(0.0, 0.0, -1.0)));
    assert!(
        near.iter()
            .zip(&far)
            .all(|(a, b)| (a - 2.0 * b).abs() <= 1e-6 * a.abs())
    );
}

/// The stream stays ahead; the head turns to the left, so that it is heard at the right.
#[test]
fn a_head_turns() {
    let mut mixer = Mixer::new(1);
    mixer.push(ahead(0.0, pour(3.0)));
    let mut heard = vec![[0.0; 2]; 48_000];
    mixer.render(&mut heard);
    assert!((loud(&heard, 0) / loud(&heard, 1) - 1.0).abs() < 1e-6);
    mixer.listen(Listener {
        position: Vec3::ZERO,
        orientation: Quat::from_rotation_y(std::f32::consts::FRAC_PI_2),
    });
    mixer.render(&mut heard);
    assert!(loud(&heard, 1) > 2.0 * loud(&heard, 0));
}

/// Sounds of seventeen places and more are heard all the same, and a thousand blows at once stay below full scale.
#[test]
fn more_than_there_is_room_for_is_heard() {
    let mut mixer = Mixer::new(1);
    for emitter in 0..1000 {
        mixer.push(Event {
            emitter,
            position: Vec3::new(emitter as f32 * 0.01 - 5.0, 0.0, -0.5),
            ..ahead(
                0.1,
                Sound::Strike(Strike {
                    impulse: 0.5,
                    bodies: [Body::Bench; 2],
                }),
            )
        });
    }
    let mut heard = vec![[0.0; 2]; 48_000];
    mixer.render(&mut heard);
    assert!(heard.iter().flatten().all(|it| it.abs() <= 0.9));
    assert!(loud(&heard, 0) > 0.01);
    assert_eq!(mixer.voices(), 0, "all have faded");
}
