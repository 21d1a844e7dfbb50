//! A server that works.

use std::time::{Duration, Instant};

use glam::Vec3;
use vitriol_sound::{
    Body, Device, Event, Glass, Listener, Mixer, Output, OutputError, Pour, Sound, State, Strike,
    devices,
};

use crate::output::server::{Recorder, Server, inside, until};

/// A beaker that is struck at the left.
fn clink() -> Event {
    let glass = Glass {
        radius: 0.035,
        wall: 1.4e-3,
        height: 0.095,
        filled: 0.0,
        density: 998.0,
        held: false,
    };
    let bodies = [Body::Glass(glass), Body::Dull];
    Event {
        time: 1234.5,
        emitter: 7,
        position: Vec3::new(-1.0, 0.0, -0.2),
        sound: Sound::Strike(Strike {
            impulse: 0.05,
            bodies,
        }),
    }
}

fn peaks(samples: &[[f32; 2]]) -> [f32; 2] {
    [0, 1].map(|side| {
        samples
            .iter()
            .fold(0.0, |peak: f32, it| peak.max(it[side].abs()))
    })
}

/// The samples that a mixer renders of it, from the first on.
fn expected() -> Vec<[f32; 2]> {
    let mut mixer = Mixer::new(1);
    mixer.push(Event {
        time: 0.0,
        ..clink()
    });
    let mut expected = vec![[0.0; 2]; 20_000];
    mixer.render(&mut expected);
    from_the_first(&mut expected);
    expected
}

fn from_the_first(samples: &mut Vec<[f32; 2]>) {
    let first = samples.iter().position(|it| it[0] != 0.0);
    samples.drain(..first.unwrap());
}

/// Records until `count` samples are not silent, which have no gaps between them.
fn heard(recorder: &mut Recorder, count: usize) -> Vec<[f32; 2]> {
    let mut heard = Vec::new();
    until("what is to be heard", || {
        let more = recorder.seconds(0.1);
        heard.extend(more.into_iter().filter(|it| *it != [0.0; 2]));
        (heard.len() >= count).then_some(())
    });
    heard
}

/// The recorded samples are those that a mixer renders of the same event. A server that runs dry on a busy machine plays silence until
/// there are more samples, and leaves nothing out: so gaps do not count.
fn arrives() {
    let output = Output::open(Device::Default, Mixer::new(1)).unwrap();
    let mut recorder = Recorder::start();
    assert_eq!(peaks(&recorder.seconds(0.1)), [0.0; 2]);
    let mut expected = expected();
    expected.retain(|it| *it != [0.0; 2]);
    output.frame(Listener::default(), vec![clink()]);
    let heard = heard(&mut recorder, expected.len());
    eprintln!("{} underflows", output.underflows());
    assert_eq!(output.state(), State::Playing);
    let [left, right] = peaks(&heard);
    assert!(left > 0.05 && left > 1.5 * right, "{left} {right}");
    // The blow may begin at any sample of a block, so that the ear's filter rounds otherwise.
    let same = |a: &[f32; 2], b: &[f32; 2]| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-6);
    let differs = heard.iter().zip(&expected).position(|(a, b)| !same(a, b));
    assert_eq!(differs, None, "of {}", expected.len());
}

#[test]
fn what_is_played_arrives() {
    inside(arrives, Server::start);
}

/// A stream with an event at 90 Hz goes on, and buffers hold 30 ms at most. On a busy machine they run dry and this test is late; both are
/// counted, and where either happened there may be gaps.
fn goes_on() {
    let output = Output::open(Device::Named("vitriol".into()), Mixer::new(1)).unwrap();
    let mut recorder = Recorder::start();
    let pour = |time: f64| Event {
        time,
        emitter: 1,
        position: Vec3::new(0.0, 0.0, -0.5),
        sound: Sound::Pour(Pour {
            flow: 2e-5,
            speed: 1.5,
            density: 998.0,
            lasts: 0.3,
        }),
    };
    let (mut heard, mut late, mut frame) = (Vec::new(), 0, 0_u32);
    let mut told = Instant::now();
    // 1.5 s of the stream: five times what one frame's event sounds.
    until("the stream", || {
        for _ in 0..9 {
            output.frame(Listener::default(), vec![pour(f64::from(frame) / 90.0)]);
            late += u32::from(told.elapsed() > Duration::from_millis(200));
            told = Instant::now();
            frame += 1;
            std::thread::sleep(Duration::from_millis(11));
        }
        heard.extend(recorder.seconds(0.1));
        let loud = heard.iter().filter(|it| **it != [0.0; 2]).count();
        (loud >= 72_000).then_some(())
    });
    from_the_first(&mut heard);
    let silent = heard.iter().filter(|it| **it == [0.0; 2]).count();
    let latency = until("the latency", || output.latency());
    let target = output.target().unwrap();
    let dry = output.underflows();
    eprintln!(
        "{silent} of {} silent; {latency:?} of {target:?}; dry {dry}, late {late} times",
        heard.len()
    );
    if (dry, late) == (0, 0) {
        assert_eq!(silent, 0);
    }
    if dry == 0 {
        assert_eq!(target, Duration::from_millis(25));
        assert!(latency <= Duration::from_millis(30), "{latency:?}");
    }
    assert_eq!(output.state(), State::Playing);
}

#[test]
fn a_stream_goes_on_within_thirty_milliseconds() {
    inside(goes_on, Server::start);
}

fn outputs() {
    let all = devices().unwrap();
    assert!(all.iter().any(|it| it.name == "vitriol"), "{all:?}");
    let by_name = Output::open(Device::Named("vitriol".into()), Mixer::new(1)).unwrap();
    assert_eq!(by_name.state(), State::Playing);
    let description = all[0].description.clone();
    Output::open(Device::Named(description), Mixer::new(1)).unwrap();
    let error = Output::open(Device::Named("nothing".into()), Mixer::new(1)).unwrap_err();
    assert!(
        matches!(&error, OutputError::NoDevice { others, .. } if others == "vitriol"),
        "{error}"
    );
}

#[test]
fn outputs_are_found_by_name() {
    inside(outputs, Server::start);
}
