//! Captions of events.

use vitriol_sound::{
    Body, Bubbles, Caption, Drops, Ear, Event, Glass, Listener, Onto, Sound, Strike,
};

use crate::sounds::measure::{ahead, pour};

fn said(event: Event, time: f64) -> Vec<Caption> {
    let mut ear = Ear::default();
    ear.hear(&event, &Listener::default());
    ear.audible(time).collect()
}

fn boil(collapses: f32, bursts: f32) -> Sound {
    Sound::Bubbles(Bubbles {
        departures: 100.0,
        collapses,
        bursts,
        radius: 2e-3,
        subcooling: 10.0,
        depth: 0.05,
        density: 998.0,
        lasts: 0.05,
    })
}

const GLASS: Glass = Glass {
    radius: 0.035,
    wall: 1.4e-3,
    height: 0.095,
    filled: 0.5,
    density: 998.0,
    held: true,
};

fn blow(impulse: f32, bodies: [Body; 2]) -> Sound {
    Sound::Strike(Strike { impulse, bodies })
}

#[test]
fn each_sound_has_its_caption() {
    let drops = Drops {
        count: 3,
        diameter: 3e-3,
        speed: 2.0,
        onto: Onto::Bench,
    };
    for (sound, caption) in [
        (pour(0.05), Caption::Pouring),
        (boil(100.0, 10.0), Caption::Simmering),
        (boil(0.0, 300.0), Caption::Boiling),
        (Sound::Drops(drops), Caption::Drops),
        (
            blow(0.03, [Body::Glass(GLASS), Body::Bench]),
            Caption::GlassOnBench,
        ),
        (
            blow(0.03, [Body::Bench, Body::Glass(GLASS)]),
            Caption::GlassOnBench,
        ),
        (blow(0.005, [Body::Glass(GLASS); 2]), Caption::GlassOnGlass),
        (Sound::Break(GLASS), Caption::GlassBreaks),
        (Sound::Sizzle(1.0), Caption::AcidOnGlove),
    ] {
        assert_eq!(said(ahead(3.0, sound), 3.5), [caption], "{sound:?}");
        assert_eq!(said(ahead(3.0, sound), 4.5), [], "{sound:?}");
    }
}

#[test]
fn what_is_faint_or_far_has_none() {
    assert_eq!(
        said(
            ahead(0.0, blow(1e-5, [Body::Glass(GLASS), Body::Bench])),
            0.0
        ),
        []
    );
    let mut far = ahead(0.0, pour(1.0));
    far.position.z = -100.0;
    assert_eq!(said(far, 0.0), []);
    let mut lost = ahead(0.0, pour(1.0));
    lost.time = f64::NAN;
    assert_eq!(said(lost, 0.0), []);
}

/// A stream that goes on keeps its caption; two sounds have two, in one order.
#[test]
fn what_goes_on_stays() {
    let mut ear = Ear::default();
    for k in 0..90 {
        ear.hear(
            &ahead(f64::from(k) / 30.0, pour(0.07)),
            &Listener::default(),
        );
    }
    ear.hear(&ahead(3.0, Sound::Sizzle(1.0)), &Listener::default());
    let both: Vec<_> = ear.audible(3.1).collect();
    assert_eq!(both, [Caption::Pouring, Caption::AcidOnGlove]);
}
