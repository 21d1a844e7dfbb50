//! Many pages at a student's program, whose frame waits for none of them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use serde_json::json;
use vitriol_console::{
    Codec, Command, EncodedPicture, Incident, List, ORDERS, PICTURES, State, Student, Text,
};
use vitriol_tests::wait::until;

use crate::client::{Client, cookie};
use crate::student::{FakeStudent, card, first_state, hub};

/// Most messages that wait for a page: 64 answers, a class, a state, and pictures.
const WAITING: usize = 64 + 2 + PICTURES;

#[test]
fn ten_pages_see_and_direct() {
    let (_folder, hub) = hub();
    let student = FakeStudent::in_hub(&hub, "Ada");
    // Each with a code of its own.
    let mut clients: Vec<_> = (0..10).map(|_| Client::new(&hub, &cookie(&hub))).collect();
    let mut numbers = Vec::new();
    for (n, client) in clients.iter_mut().enumerate() {
        let codec = if n % 2 == 0 { "h264" } else { "jpeg" };
        let number = client.open(codec);
        let opened = client.hear("opened");
        assert_eq!(opened["is"]["name"], "Ada");
        let state = client.hear("state")["state"].clone();
        assert_eq!(state["readings"]["flasks"][0]["hottest_c"], 84.26);
        let picture = client.see();
        assert_eq!(picture[0], if n % 2 == 0 { 1 } else { 2 });
        assert_eq!(picture[1], 1, "a decoder can begin with it");
        let k_v = n as f64 / 4.0;
        let answer = client.order(number, &json!({"do": "k-v", "value": k_v}));
        numbers.push(answer["number"].as_u64().unwrap());
        assert_eq!(student.ordered(), Command::KV { value: k_v });
    }
    assert_eq!(numbers, (1..=10).collect::<Vec<_>>());
    assert_eq!(hub.counts().pages, 10);
    // A command that cannot be done is refused, and does not reach the student.
    let number = 1;
    let client = &mut clients[0];
    for command in [
        json!({"do": "k-v", "value": 4.5}),
        json!({"do": "scene", "choice": 3}),
        json!({"do": "slow-motion", "rate": 2}),
    ] {
        assert_eq!(
            client.order(number, &command)["say"],
            "refused",
            "{command}"
        );
    }
    let nobody = client.order(99, &json!({"do": "end"}));
    assert_eq!(nobody["why"], "this student is not connected");
    student.nothing_else();
    drop(student);
    until("the student is away", || {
        (hub.counts().students == 0).then_some(())
    });
    let away = clients[1].order(number, &json!({"do": "end"}));
    assert_eq!(away["why"], "this student is not connected");
    clients.clear();
    until("the pages are gone", || {
        (hub.counts().pages == 0).then_some(())
    });
}

#[test]
fn an_order_to_all_goes_to_each_that_can_do_it() {
    let (_folder, hub) = hub();
    let students = ["Ada", "Bo"].map(|name| FakeStudent::in_hub(&hub, name));
    let mut client = Client::new(&hub, &cookie(&hub));
    let class = |client: &mut Client, count: usize| loop {
        let class = client.hear("class");
        if class["students"].as_array().unwrap().len() == count {
            break class;
        }
    };
    assert_eq!(class(&mut client, 2)["choices"][2]["kind"], "other");
    let scene = json!({"do": "scene", "choice": 1});
    client.say(&json!({"say": "order-all", "echo": 7, "command": scene}));
    let answer = client.hear("ordered-all");
    assert_eq!(
        answer,
        json!({"say": "ordered-all", "echo": 7, "given": 2, "refused": 0})
    );
    for student in &students {
        assert_eq!(student.ordered(), Command::Scene { choice: 1 });
    }
    // A replay offers no scene, and takes no message.
    let replay = Student {
        replays: true,
        choices: List::default(),
        ..card("Replay")
    };
    let replay = FakeStudent::new(hub.student(replay).unwrap().unwrap());
    assert_eq!(class(&mut client, 3)["choices"], json!([]));
    let message = json!({"do": "message", "text": "Slowly!"});
    client.say(&json!({"say": "order-all", "echo": 8, "command": message}));
    let answer = client.hear("ordered-all");
    let counts = json!([answer["given"], answer["refused"]]);
    assert_eq!(counts, json!([2, 1]));
    for student in &students {
        let text = Text::clipped("Slowly!");
        assert_eq!(student.ordered(), Command::Message { text });
    }
    replay.nothing_else();
}

#[test]
fn a_card_names_the_gravest_incident_of_the_attempt() {
    let (_folder, hub) = hub();
    let port = hub.student(card("Ada")).unwrap().unwrap();
    let incident = |attempt, text: &str, grave| Incident {
        text: Text::clipped(text),
        attempt,
        grave,
        ..Incident::default()
    };
    port.publish(State {
        attempt: 2,
        incidents: List::clipped([
            incident(1, "Acid on the face, before.", true),
            incident(2, "Acid on the left hand.", true),
            incident(2, "Liquid was spilt.", false),
        ]),
        incidents_of_attempt: 2,
        incidents_so_far: 3,
        grave_so_far: 2,
        ..first_state()
    });
    let mut client = Client::new(&hub, &cookie(&hub));
    let student = loop {
        let student = client.hear("class")["students"][0].take();
        if student["incidents"] != 0 {
            break student;
        }
    };
    assert_eq!(student["gravest"], "Acid on the left hand.");
    assert_eq!(student["grave"], true);
    assert_eq!(student["incidents"], 2);
}

#[test]
fn a_program_that_takes_no_orders_gets_no_more_than_it_can_hold() {
    let (_folder, hub) = hub();
    let port = hub.student(card("Ada")).unwrap().unwrap();
    // It had orders of another hub before.
    port.publish(State {
        done: 41,
        ..first_state()
    });
    let mut client = Client::new(&hub, &cookie(&hub));
    let number = client.open("jpeg");
    client.hear("state");
    let reset = json!({"do": "reset"});
    let answers: Vec<_> = (0..ORDERS + 3)
        .map(|_| client.order(number, &reset))
        .collect();
    let (taken, refused) = answers.split_at(ORDERS);
    let numbers: Vec<_> = taken.iter().filter_map(|a| a["number"].as_u64()).collect();
    assert_eq!(numbers, (42..42 + ORDERS as u64).collect::<Vec<_>>());
    assert!(refused.iter().all(|answer| answer["say"] == "refused"));
    assert_eq!(port.commands().len(), ORDERS);
}

/// A browser that stops reading: pictures are left out for it, its queues are bounded, another page goes on, and the frame's thread does
/// not wait once.
#[test]
fn one_stops_reading_and_no_frame_waits() {
    let (_folder, hub) = hub();
    let port = hub.student(card("Ada")).unwrap().unwrap();
    port.publish(first_state());
    let mut dead = Client::new(&hub, &cookie(&hub));
    let number = dead.open("h264");
    let mut good = Client::new(&hub, &cookie(&hub));
    good.open("h264");
    good.hear("opened");
    until("pictures are wanted", || port.wanted().h264.then_some(()));

    let over = AtomicBool::new(false);
    let waits = std::thread::scope(|scope| {
        let frames = scope.spawn(|| {
            // Pictures are made before: to allocate and free in the loop could wait.
            let bytes = vec![0; 256 << 10];
            let picture = |n: u64| EncodedPicture {
                codec: Codec::H264,
                is_key: n.is_multiple_of(16),
                size: [640, 360],
                time_us: n,
                bytes: bytes.clone(),
            };
            let pictures: Vec<_> = (0..16).map(|n| Arc::new(picture(n))).collect();
            let mut waits = 0;
            let mut orders = 0;
            for n in 0.. {
                let state = State {
                    frame: n,
                    ..first_state()
                };
                let before = waited();
                port.publish(state);
                port.picture(pictures[n as usize % 16].clone());
                let taken = port.commands();
                port.wanted();
                port.take_key_request();
                waits += waited() - before;
                orders += taken.len();
                if over.load(Ordering::Relaxed) {
                    break;
                }
                std::thread::sleep(Duration::from_millis(1));
            }
            (waits, orders)
        });
        // Until the system's buffers are full of unread bytes.
        until("the one that does not read is left out", || {
            let counts = hub.counts();
            assert!(counts.waiting <= WAITING, "{counts:?}");
            (counts.left_out > 100).then_some(())
        });
        // The other page is up to date.
        let answer = good.order(number, &json!({"do": "reset"}));
        assert_eq!(answer["say"], "ordered");
        let now = good.hear("state")["state"]["frame"].as_u64().unwrap();
        let later = good.hear("state")["state"]["frame"].as_u64().unwrap();
        assert!(later > now);
        good.see();
        over.store(true, Ordering::Relaxed);
        let (waits, orders) = frames.join().unwrap();
        assert_eq!(orders, 1);
        waits
    });
    assert_eq!(waits, 0, "the frame's thread waited");
}

/// How often this thread has given up the processor to wait for something; 0 where the system does not count it.
fn waited() -> u64 {
    // Linux, Documentation/filesystems/proc.rst, table 1-2.
    let status = std::fs::read_to_string("/proc/thread-self/status").unwrap_or_default();
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("voluntary_ctxt_switches:"));
    line.map_or(0, |count| count.trim().parse().unwrap())
}
