//! Impossible numbers.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use vitriol_sound::{
    Body, Bubble, Bubbles, Drops, Ear, Event, Glass, Listener, Mixer, Onto, Pour, Sound, Strike,
};

use crate::sounds::measure::{ahead, pour, render};

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        prop::num::f32::ANY,
        -10.0f32..10.0,
        prop::sample::select(vec![
            0.0,
            1e-3,
            1e3,
            f32::MAX,
            f32::MIN,
            f32::INFINITY,
            f32::NAN,
            1e-40
        ]),
    ]
}

fn body() -> impl Strategy<Value = Body> {
    let glass = (prop::array::uniform5(number()), any::<bool>());
    prop_oneof![
        Just(Body::Bench),
        Just(Body::Dull),
        glass.prop_map(|(n, held)| Body::Glass(glass_of(n, held))),
    ]
}

fn glass_of([radius, wall, height, filled, density]: [f32; 5], held: bool) -> Glass {
    Glass {
        radius,
        wall,
        height,
        filled,
        density,
        held,
    }
}

fn sound() -> impl Strategy<Value = Sound> {
    prop_oneof![
        prop::array::uniform4(number()).prop_map(|[flow, speed, density, lasts]| {
            Sound::Pour(Pour {
                flow,
                speed,
                density,
                lasts,
            })
        }),
        prop::array::uniform8(number()).prop_map(|n| {
            Sound::Bubbles(Bubbles {
                departures: n[0],
                collapses: n[1],
                bursts: n[2],
                radius: n[3],
                subcooling: n[4],
                depth: n[5],
                density: n[6],
                lasts: n[7],
            })
        }),
        prop::array::uniform3(number()).prop_map(|[radius, depth, density]| Sound::Bubble(
            Bubble {
                radius,
                depth,
                density
            }
        )),
        (number(), body(), body()).prop_map(|(impulse, a, b)| {
            Sound::Strike(Strike {
                impulse,
                bodies: [a, b],
            })
        }),
        prop::array::uniform5(number()).prop_map(|n| Sound::Break(glass_of(n, false))),
        (any::<u32>(), number(), number(), 0..2usize).prop_map(|(count, diameter, speed, onto)| {
            let onto = [Onto::Bench, Onto::Wet][onto];
            Sound::Drops(Drops {
                count,
                diameter,
                speed,
                onto,
            })
        }),
        number().prop_map(Sound::Sizzle),
    ]
}

fn event() -> impl Strategy<Value = Event> {
    let time = prop_oneof![-1.0f64..0.2, prop::num::f64::ANY, Just(f64::NAN)];
    let all = (time, any::<u32>(), prop::array::uniform3(number()), sound());
    all.prop_map(|(time, emitter, position, sound)| Event {
        time,
        emitter,
        position: Vec3::from_array(position),
        sound,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_number_makes_more_than_full_scale(
        events in prop::collection::vec(event(), 1..12),
        head in prop::array::uniform7(number()),
    ) {
        let mut mixer = Mixer::new(1);
        let mut ear = Ear::default();
        let listener = Listener {
            position: Vec3::new(head[0], head[1], head[2]),
            orientation: Quat::from_array([head[3], head[4], head[5], head[6]]),
        };
        let mut heard = vec![[0.0; 2]; 4800];
        for event in events {
            ear.hear(&event, &listener);
            mixer.push(event);
            mixer.render(&mut heard);
            mixer.listen(listener);
            prop_assert!(heard.iter().flatten().all(|it| it.abs() <= 0.9));
        }
        prop_assert!(ear.audible(0.0).count() <= 10);
    }
}

/// Events with a number that is not finite change nothing, and one that is infinitely far is not heard; neither silences others.
#[test]
fn what_cannot_be_leaves_the_rest_as_it_is() {
    let first = ahead(0.0, pour(1.0));
    let alone = render(&[first], 1.0);
    let lost = |change: &dyn Fn(&mut Event)| {
        let mut event = ahead(0.2, Sound::Sizzle(1.0));
        change(&mut event);
        event
    };
    for event in [
        lost(&|it| it.time = f64::NAN),
        lost(&|it| it.time = f64::INFINITY),
        lost(&|it| it.position.y = f32::NEG_INFINITY),
        lost(&|it| it.sound = Sound::Sizzle(f32::NAN)),
        lost(&|it| (it.emitter, it.position.x) = (2, f32::MAX)),
    ] {
        assert!(render(&[first, event], 1.0) == alone, "{event:?}");
    }
}
