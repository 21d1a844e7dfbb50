//! Messages from a network: garbage, and messages that are nearly right.
#![allow(clippy::unwrap_used, clippy::panic)]

use proptest::prelude::*;

use crate::bounded::{List, MESSAGE, Text};
use crate::command::{Command, SLOWEST};
use crate::picture::{Codec, EncodedPicture};
use crate::student::*;
use crate::wire::{FromPage, FromStudent, MOST_FROM_PAGE, MOST_STATE, ToStudent, read};

fn page(text: &str) -> Option<FromPage> {
    read(text, MOST_FROM_PAGE)
}

fn order(command: &str) -> Option<FromPage> {
    page(&format!(
        r#"{{"say":"order","echo":1,"student":2,"command":{command}}}"#
    ))
}

fn student() -> Student {
    Student {
        name: Text::clipped("Ada"),
        version: Text::clipped("0.1.0"),
        choices: List::clipped([Choice {
            title: Text::clipped("Acid into water"),
            kind: Kind::Correct,
            counterpart: Some(0),
        }]),
        k_v: Some(Range {
            least: 0.0,
            most: 2.0,
        }),
        replays: false,
        close_up: true,
    }
}

/// A state in which every field is as long as it can be.
fn full() -> State {
    // A quote takes two bytes in JSON, and this character four.
    fn long<const MOST: usize>() -> Text<MOST> {
        Text::clipped(&"\u{10348}".repeat(MOST))
    }
    let said = Said {
        t_s: Some(f64::MIN_POSITIVE),
        text: long(),
    };
    let incident = Incident {
        t_s: Some(-1.234_567_890_123_456_7e-300),
        text: long(),
        grave: false,
        attempt: u32::MAX,
        scene: long(),
    };
    let flask = Flask {
        name: long(),
        volume_m3: Some(1e-4),
        mean_c: Some(f64::NAN),
        hottest_c: Some(100.0),
    };
    State {
        step: Some(Step {
            number: u16::MAX,
            of: u16::MAX,
            title: long(),
        }),
        points: Some(Points {
            earned: u32::MAX,
            of: u32::MAX,
        }),
        hints: List::clipped(vec![said; 99]),
        incidents: List::clipped(vec![incident; 99]),
        coming: Some(Coming {
            scene: long(),
            choice: Some(u8::MAX),
        }),
        recording: Some(long()),
        readings: Readings {
            flasks: List::clipped(vec![flask; 99]),
            ..Readings::default()
        },
        ..State::default()
    }
}

#[test]
fn what_is_said_is_understood() {
    let all = [
        (r#"{"do":"scene","choice":0}"#, Command::Scene { choice: 0 }),
        (r#"{"do":"k-v","value":0.5}"#, Command::KV { value: 0.5 }),
        (r#"{"do":"reset"}"#, Command::Reset {}),
        (r#"{"do":"toggle"}"#, Command::Toggle {}),
        (r#"{"do":"pause","on":true}"#, Command::Pause { on: true }),
        (
            r#"{"do":"slow-motion","rate":0.25}"#,
            Command::SlowMotion { rate: 0.25 },
        ),
        (r#"{"do":"spare","on":false}"#, Command::Spare { on: false }),
        (
            r#"{"do":"message","text":"Slowly!"}"#,
            Command::Message {
                text: Text::clipped("Slowly!"),
            },
        ),
        (r#"{"do":"end"}"#, Command::End {}),
    ];
    for (text, command) in all {
        assert_eq!(command.check(&student()), Ok(()), "{text}");
        let expected = FromPage::Order {
            echo: 1,
            student: 2,
            command,
        };
        assert_eq!(order(text), Some(expected), "{text}");
    }
    let to_all = FromPage::OrderAll {
        echo: 3,
        command: Command::Pause { on: true },
    };
    let text = r#"{"say":"order-all","echo":3,"command":{"do":"pause","on":true}}"#;
    assert_eq!(page(text), Some(to_all));
    assert_eq!(page(r#"{"say":"lost"}"#), Some(FromPage::Lost {}));
    let pictures = FromPage::Pictures {
        codec: Some(Codec::Jpeg),
    };
    assert_eq!(page(r#"{"say":"pictures","codec":"jpeg"}"#), Some(pictures));
    let close_up = FromPage::Pictures {
        codec: Some(Codec::CloseUp),
    };
    assert_eq!(
        page(r#"{"say":"pictures","codec":"close-up"}"#),
        Some(close_up)
    );
}

#[test]
fn what_is_nearly_right_is_refused() {
    for text in [
        // Other fields, in a variant without any too.
        r#"{"do":"reset","path":"/etc/passwd"}"#,
        r#"{"do":"end","really":true}"#,
        r#"{"do":"toggle","choice":1}"#,
        r#"{"do":"pause","on":true,"off":true}"#,
        r#"{"do":"pause","on":true,"on":false}"#,
        r#"{"do":"pause"}"#,
        r#"{"do":"pause","on":1}"#,
        // A scene has no name here, and no path.
        r#"{"do":"scene","choice":"acid-into-water"}"#,
        r#"{"do":"scene","choice":-1}"#,
        r#"{"do":"scene","choice":256}"#,
        r#"{"do":"scene","choice":0.5}"#,
        r#"{"do":"k-v","value":"1"}"#,
        r#"{"do":"k-v","value":1e999}"#,
        r#"{"do":"k-v","value":NaN}"#,
        r#"{"do":"run","command":"rm"}"#,
        r#"{"DO":"reset"}"#,
        r#""reset""#,
        "null",
        "[]",
    ] {
        assert_eq!(order(text), None, "{text}");
    }
    let message = |text: &str| order(&format!(r#"{{"do":"message","text":"{text}"}}"#));
    assert!(message(&"é".repeat(MESSAGE)).is_some());
    assert!(message(&"é".repeat(MESSAGE + 1)).is_none());
    assert!(message(r"a\u0000b").is_none());
    assert!(message(r"a\nb").is_none());
    // The longest form of a message of this length.
    assert!(message(&r"\ud83d\ude00".repeat(MESSAGE)).is_some());
    assert!(
        page(&format!(
            r#"{{"say":"lost"}}{}"#,
            " ".repeat(MOST_FROM_PAGE)
        ))
        .is_none()
    );
    assert!(page(&"[".repeat(4000)).is_none());
}

#[test]
fn what_a_student_cannot_do_is_refused() {
    for command in [
        Command::Scene { choice: 1 },
        Command::KV { value: -0.1 },
        Command::KV { value: 2.1 },
        Command::KV { value: f64::NAN },
        Command::SlowMotion { rate: 0.0 },
        Command::SlowMotion {
            rate: SLOWEST / 2.0,
        },
        Command::SlowMotion { rate: 1.5 },
        Command::SlowMotion { rate: f64::NAN },
    ] {
        assert!(command.check(&student()).is_err(), "{command:?}");
    }
    let plain = Student {
        k_v: None,
        ..student()
    };
    assert!(Command::KV { value: 0.5 }.check(&plain).is_err());
    let other = Student {
        choices: List::default(),
        ..student()
    };
    assert!(Command::Toggle {}.check(&other).is_err());
    // Nothing of a recording can be changed.
    let replay = Student {
        replays: true,
        ..student()
    };
    let text = Text::clipped("Slowly!");
    for (command, can) in [
        (Command::Reset {}, false),
        (Command::Toggle {}, false),
        (Command::Spare { on: true }, false),
        (Command::Message { text }, false),
        (Command::Pause { on: true }, true),
        (Command::SlowMotion { rate: 0.5 }, true),
        (Command::End {}, true),
    ] {
        assert_eq!(command.check(&replay).is_ok(), can, "{command:?}");
    }
}

#[test]
fn the_longest_state_fits_and_a_longer_one_does_not() {
    let state = FromStudent::State {
        state: Box::new(full()),
    };
    let text = serde_json::to_string(&state).unwrap();
    let Some(FromStudent::State { state }) = read(&text, MOST_STATE) else {
        panic!("{} bytes were refused", text.len());
    };
    assert_eq!(state.incidents.len(), 32);
    // NaN is null.
    assert_eq!(state.readings.flasks[0].mean_c, None);
    assert_eq!(state.readings.flasks[0].volume_m3, Some(1e-4));
    let mut value = serde_json::to_value(full()).unwrap();
    let hints = value["hints"].as_array_mut().unwrap();
    hints.push(hints[0].clone());
    assert!(serde_json::from_value::<State>(value).is_err());
}

/// A state as programs of version 3 send it has no points. What they and those of version 4 are sent has nothing that they would refuse.
#[test]
fn messages_of_versions_before_are_read() {
    let mut value = serde_json::to_value(full()).unwrap();
    value.as_object_mut().unwrap().remove("points").unwrap();
    let text = format!(r#"{{"say":"state","state":{value}}}"#);
    let Some(FromStudent::State { state }) = read(&text, MOST_STATE) else {
        panic!("a state without points was refused");
    };
    assert_eq!(state.points, None);
    assert_eq!(state.incidents.len(), 32);
    let wanted = |card, close_up| ToStudent::Wanted {
        h264: true,
        jpeg: false,
        key: false,
        card,
        close_up,
    };
    let before = r#"{"say":"wanted","h264":true,"jpeg":false,"key":false}"#;
    assert_eq!(
        serde_json::to_string(&wanted(false, false)).unwrap(),
        before
    );
    assert_eq!(
        read::<ToStudent>(before, MOST_STATE),
        Some(wanted(false, false))
    );
    for (card, close_up) in [(true, false), (false, true)] {
        let now = serde_json::to_string(&wanted(card, close_up)).unwrap();
        assert!(now.contains("card") == card && now.contains("close_up") == close_up);
        let again = read::<ToStudent>(&now, MOST_STATE);
        assert_eq!(again, Some(wanted(card, close_up)));
    }
    // A card is no live view that a page could ask for.
    assert_eq!(page(r#"{"say":"pictures","codec":"card"}"#), None);
}

proptest! {
    #[test]
    fn garbage_says_nothing(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let text = String::from_utf8_lossy(&bytes);
        prop_assert_eq!(page(&text), None);
        prop_assert_eq!(read::<FromStudent>(&text, MOST_STATE), None);
        prop_assert_eq!(read::<ToStudent>(&text, MOST_STATE), None);
        // Any bytes behind a head are a picture's own: a decoder has to check them.
        if let Some(picture) = EncodedPicture::from_message(&bytes) {
            prop_assert_eq!(picture.to_message(), bytes);
        }
    }

    /// A message with one byte changed is refused, or is a message that can be written again.
    #[test]
    fn a_changed_byte_is_harmless(at in 0usize..90, byte in 32u8..127) {
        let mut text = br#"{"say":"order","echo":1,"student":2,"command":{"do":"message","text":"Slowly!"}}"#.to_vec();
        let at = at % text.len();
        text[at] = byte;
        let text = String::from_utf8(text).unwrap();
        if let Some(said) = page(&text) {
            let again = serde_json::to_string(&said).unwrap();
            prop_assert_eq!(page(&again), Some(said));
        }
    }

    #[test]
    fn a_picture_arrives_as_it_went(is_key: bool, width: u16, height: u16, time_us: u64,
        bytes in proptest::collection::vec(any::<u8>(), 1..50)) {
        for codec in [Codec::H264, Codec::Jpeg, Codec::CloseUp] {
            let picture = EncodedPicture { codec, is_key, size: [width, height], time_us, bytes: bytes.clone() };
            prop_assert_eq!(EncodedPicture::from_message(&picture.to_message()), Some(picture));
        }
    }
}
