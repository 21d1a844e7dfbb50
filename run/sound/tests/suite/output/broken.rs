//! Servers that do not work.

use std::io::Write;
use std::os::unix::net::UnixListener;
use std::time::{Duration, Instant};

use glam::Vec3;
use vitriol_sound::{Device, Event, Listener, Mixer, Output, OutputError, Sound, State, devices};

use crate::output::server::{Server, inside, kill, until};

fn open() -> Result<Output, OutputError> {
    Output::open(Device::Default, Mixer::new(1))
}

fn sizzle() -> Vec<Event> {
    let (emitter, position) = (1, Vec3::ZERO);
    vec![Event {
        time: 0.0,
        emitter,
        position,
        sound: Sound::Sizzle(1.0),
    }]
}

/// Frames are still accepted, without a wait, and the state is that nothing is played.
fn dies() {
    let output = open().unwrap();
    output.frame(Listener::default(), sizzle());
    assert_eq!(output.state(), State::Playing);
    kill();
    let cause = until("the end", || match output.state() {
        State::Ended { cause } => Some(cause),
        State::Playing | State::Silent => None,
    });
    eprintln!("{cause}");
    for _ in 0..1000 {
        output.frame(Listener::default(), sizzle());
    }
    assert!(matches!(open(), Err(OutputError::NoServer)));
}

#[test]
fn a_server_that_dies_ends_it_quietly() {
    inside(dies, Server::start);
}

#[test]
fn no_server_is_said() {
    let none = || {
        assert!(matches!(open(), Err(OutputError::NoServer)));
        assert!(matches!(devices(), Err(OutputError::NoServer)));
        let silent = Output::open(Device::Silent, Mixer::new(1)).unwrap();
        silent.frame(Listener::default(), sizzle());
        assert_eq!((silent.state(), silent.latency()), (State::Silent, None));
    };
    inside(none, |_| Some(()));
}

/// The server listens, and never sends a message.
#[test]
fn a_mute_server_is_not_waited_for() {
    let mute = || {
        let begun = Instant::now();
        assert!(matches!(open(), Err(OutputError::TimedOut)));
        assert!(matches!(devices(), Err(OutputError::TimedOut)));
        // Twice two seconds, and what a busy machine needs.
        until("no thread waits on", || {
            let threads = std::fs::read_dir("/proc/self/task").unwrap();
            let names = threads.map(|it| std::fs::read_to_string(it.unwrap().path().join("comm")));
            let sound =
                |name: std::io::Result<String>| name.is_ok_and(|it| it.starts_with("sound"));
            (names.filter_map(|it| sound(it).then_some(())).count() == 0).then_some(())
        });
        assert!(
            begun.elapsed() < Duration::from_secs(10),
            "{:?}",
            begun.elapsed()
        );
    };
    let listen = |folder: &std::path::Path| UnixListener::bind(folder.join("socket")).ok();
    inside(mute, listen);
}

/// A server that is no PulseAudio is refused, whatever it sends.
#[test]
fn nonsense_is_refused() {
    let nonsense = || {
        for _ in 0..50 {
            let error = open().unwrap_err();
            assert!(!matches!(error, OutputError::NoDevice { .. }), "{error}");
        }
    };
    let listen = |folder: &std::path::Path| {
        let listener = UnixListener::bind(folder.join("socket")).ok()?;
        std::thread::spawn(move || {
            let mut state = 1u64;
            for client in listener.incoming() {
                let bytes: Vec<u8> = (0..400)
                    .map(|index| {
                        state = state.wrapping_mul(6364136223846793005).wrapping_add(1);
                        // Every second message has a possible length.
                        if state & 1 << 40 == 0 && index < 20 {
                            20 * u8::from(index == 3)
                        } else {
                            (state >> 56) as u8
                        }
                    })
                    .collect();
                let _ = client.and_then(|mut client| client.write_all(&bytes));
            }
        });
        Some(())
    };
    inside(nonsense, listen);
}
