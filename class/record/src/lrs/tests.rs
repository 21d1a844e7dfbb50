//! The sender's reaction to each answer, against a server with scripted answers. Against a real one: tests/ralph.
#![allow(clippy::unwrap_used)]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpListener;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::{Lrs, Patience, Sent, Token, send};
use crate::store::Store;
use crate::{Entry, Uuid, example};

/// A request: its first line, its headers in small letters, its body.
struct Request {
    first: String,
    headers: Vec<String>,
    body: String,
}

impl Request {
    fn statements(&self) -> Vec<Uuid> {
        let all: Vec<serde_json::Value> = serde_json::from_str(&self.body).unwrap();
        let id = |it: &serde_json::Value| it["id"].as_str().unwrap().parse().unwrap();
        all.iter().map(id).collect()
    }
}

/// Answers each request in turn with the result of `answer`, until that is `None` or [`end`] asks; then it closes its port.
fn server(
    mut answer: impl FnMut(&Request) -> Option<String> + Send + 'static,
) -> (Lrs, JoinHandle<Vec<Request>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let served = thread::spawn(move || {
        let mut requests = Vec::new();
        loop {
            let (mut stream, _) = listener.accept().unwrap();
            let mut reader = BufReader::new(&mut stream);
            let mut line = || {
                let mut line = String::new();
                reader.read_line(&mut line).unwrap();
                line.trim().to_owned()
            };
            let first = line();
            let headers: Vec<String> = std::iter::from_fn(|| Some(line().to_lowercase()))
                .take_while(|line| !line.is_empty())
                .collect();
            let length = headers
                .iter()
                .find_map(|it| it.strip_prefix("content-length: "));
            let mut body = vec![0; length.map_or(0, |length| length.parse().unwrap())];
            reader.read_exact(&mut body).unwrap();
            let body = String::from_utf8(body).unwrap();
            let request = Request {
                first,
                headers,
                body,
            };
            let answer = match is_end(&request) {
                true => None,
                false => answer(&request),
            };
            let Some(answer) = answer else {
                return requests;
            };
            requests.push(request);
            stream.write_all(answer.as_bytes()).unwrap();
        }
    });
    let lrs = Lrs {
        endpoint: format!("http://127.0.0.1:{port}/xAPI/").parse().unwrap(),
        token: Token::of("name:password").unwrap(),
        patience: Patience {
            tries: 3,
            pause: Duration::from_millis(1),
            longest: Duration::from_millis(1),
            answer: Duration::from_secs(60),
        },
    };
    (lrs, served)
}

fn says(status: &str, body: &str) -> Option<String> {
    let length = body.len();
    Some(format!(
        "HTTP/1.1 {status}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n{body}"
    ))
}

fn here(first: &str, headers: &str) -> Option<String> {
    Some(format!(
        "HTTP/1.1 {first}\r\nConnection: close\r\nContent-Length: 0\r\n{headers}\r\n"
    ))
}

fn entry() -> Entry {
    Entry {
        id: Uuid::from_u128(1),
        pseudonym: "p07".parse().unwrap(),
        begun: "2026-03-01T08:00:00Z".parse().unwrap(),
        lesson: None,
        source: None,
        score: None,
        attempt: example::attempt(),
    }
}

/// Ends the server by one more request, and returns those before it.
fn end(lrs: &Lrs, served: JoinHandle<Vec<Request>>) -> Vec<Request> {
    if !served.is_finished() {
        let _ = ureq::get(lrs.endpoint.statements())
            .header("X-End", "1")
            .call();
    }
    served.join().unwrap()
}

/// A store in which an attempt's nine statements wait, and the result of sending them.
fn sending(
    answer: impl FnMut(&Request) -> Option<String> + Send + 'static,
) -> (Sent, Vec<Request>, Vec<Uuid>) {
    let folder = tempfile::tempdir().unwrap();
    let (lrs, served) = server(answer);
    let mut store = Store::open(&folder.path().join("class")).unwrap();
    let entry = entry();
    store.add(&entry, Some(lrs.endpoint.as_str())).unwrap();
    let ids = crate::xapi::statements(store.class(), &entry);
    let ids = ids.iter().map(|statement| statement.id).collect();
    let sent = send(&mut store, &lrs).unwrap();
    (sent, end(&lrs, served), ids)
}

fn is_end(request: &Request) -> bool {
    request.headers.iter().any(|it| it.starts_with("x-end"))
}

#[test]
fn what_is_away_is_asked_again_with_the_same() {
    let mut asked = 0;
    let (sent, requests, ids) = sending(move |_| {
        asked += 1;
        match asked {
            1 => here("503 Service Unavailable", "Retry-After: 99999\r\n"),
            // An answer without a message.
            2 => Some(String::new()),
            _ => says("200 OK", "[]"),
        }
    });
    assert_eq!((sent.delivered, sent.waiting, sent.stopped), (9, 0, None));
    assert_eq!(requests.len(), 3);
    for request in &requests {
        assert_eq!(request.statements(), ids);
        assert_eq!(request.first, "POST /xAPI/statements HTTP/1.1");
        for header in [
            "x-experience-api-version: 1.0.3",
            "content-type: application/json",
        ] {
            assert!(request.headers.iter().any(|it| it == header), "{header}");
        }
        let basic = |it: &String| it.starts_with("authorization: basic ");
        assert!(request.headers.iter().any(basic));
    }
}

/// Statements are not sent on elsewhere, and the request is not repeated.
#[test]
fn who_takes_nothing_is_asked_once_and_all_stays() {
    let elsewhere = TcpListener::bind("127.0.0.1:0").unwrap();
    elsewhere.set_nonblocking(true).unwrap();
    let to = format!("Location: http://{}/\r\n", elsewhere.local_addr().unwrap());
    for (answer, why) in [
        (here("307 Temporary Redirect", &to), "not followed"),
        (here("302 Found", &to), "not followed"),
        (says("401 Unauthorized", "who?"), "who?"),
        (says("403 Forbidden", ""), "403"),
        (says("404 Not Found", ""), "404"),
        (
            says("200 OK", "<html>hello</html>"),
            "not as a Learning Record Store",
        ),
    ] {
        let status = answer.as_deref().unwrap()["HTTP/1.1 ".len()..][..3].to_owned();
        let (sent, requests, _) = sending(move |_| answer.clone());
        assert_eq!(
            (sent.delivered, sent.waiting, requests.len()),
            (0, 9, 1),
            "{why}"
        );
        let told = sent.stopped.as_deref().unwrap();
        assert!(told.contains(why), "{told}");
        // The address that was asked, and the status.
        let of = format!("/xAPI/statements answers {status} ");
        assert!(
            told.starts_with("http://127.0.0.1:") && told.contains(&of),
            "{told}"
        );
    }
    assert!(elsewhere.accept().is_err(), "the token went elsewhere");
}

#[test]
fn one_that_is_refused_keeps_off_no_other() {
    let (sent, requests, ids) = sending(|request| {
        if request.body.contains("incident/hot") {
            says("400 Bad Request", "no heat")
        } else {
            here("204 No Content", "")
        }
    });
    assert_eq!((sent.delivered, sent.waiting, sent.stopped), (8, 1, None));
    assert_eq!(sent.refused.len(), 1);
    assert_eq!(
        (sent.refused[0].id, sent.refused[0].why.contains("no heat")),
        (ids[4], true)
    );
    // Halves of nine: at most four levels, of two each.
    assert!(requests.len() <= 9, "{}", requests.len());
}

#[test]
fn who_refuses_each_is_not_asked_for_ever() {
    let (sent, requests, _) = sending(|_| says("413 Content Too Large", ""));
    assert_eq!(
        (sent.delivered, sent.waiting, sent.refused.len()),
        (0, 9, 9)
    );
    assert!(requests.len() < 2 * 9, "{}", requests.len());
}

/// A part of a batch is stored already, one statement of that part with another content.
#[test]
fn a_conflict_is_looked_into() {
    let mut first = Vec::new();
    let (sent, requests, ids) = sending(move |request| {
        if request.first.starts_with("POST") && first.is_empty() {
            first = serde_json::from_str::<Vec<serde_json::Value>>(&request.body).unwrap();
            return says("409 Conflict", "there");
        }
        if request.first.starts_with("POST") {
            return here("204 No Content", "");
        }
        let asked = |it: &&serde_json::Value| request.first.contains(it["id"].as_str().unwrap());
        let index = first.iter().position(|it| asked(&it)).unwrap();
        let mut there = first[index].clone();
        // As a store does.
        there["stored"] = "2026-03-01T09:00:00Z".into();
        match index {
            0..3 => says("200 OK", &there.to_string()),
            3 => {
                there["object"]["id"] = "urn:uuid:other".into();
                says("200 OK", &there.to_string())
            }
            _ => says("404 Not Found", "{}"),
        }
    });
    assert_eq!((sent.delivered, sent.waiting, sent.stopped), (8, 1, None));
    assert_eq!(sent.refused.len(), 1);
    assert_eq!(sent.refused[0].id, ids[3]);
    assert_eq!(requests.last().unwrap().statements(), ids[4..]);
    assert_eq!(requests.len(), 1 + 9 + 1);
}

/// A token may write and not read, and a store's index may be behind: which statement conflicts is then found by sending them apart.
#[test]
fn one_that_conflicts_keeps_off_no_other() {
    for looked_up in ["403 Forbidden", "404 Not Found"] {
        let (sent, requests, ids) = sending(move |request| {
            if request.first.starts_with("GET") {
                says(looked_up, "")
            } else if request.body.contains("incident/hot") {
                says("409 Conflict", "another is there")
            } else {
                here("204 No Content", "")
            }
        });
        assert_eq!((sent.delivered, sent.waiting, sent.stopped), (8, 1, None));
        assert_eq!(sent.refused.len(), 1);
        let refused = &sent.refused[0];
        assert_eq!(refused.id, ids[4]);
        assert!(refused.why.contains("another is there"), "{}", refused.why);
        let posts = requests.iter().filter(|it| it.first.starts_with("POST"));
        assert!(posts.count() <= 9);
    }
}

/// Some stores compare a repeated statement with theirs letter by letter, time included. The recording was copied meanwhile, so that its
/// file has another time.
#[test]
fn a_later_call_sends_the_very_same_text() {
    let folder = tempfile::tempdir().unwrap();
    let mut asked = 0;
    let (lrs, served) = server(move |_| {
        asked += 1;
        match asked {
            1..=3 => here("503 Service Unavailable", ""),
            _ => here("204 No Content", ""),
        }
    });
    for begun in ["2026-03-01T08:00:00Z", "2026-03-02T09:00:00Z"] {
        let mut store = Store::open(&folder.path().join("class")).unwrap();
        let entry = Entry {
            begun: begun.parse().unwrap(),
            ..entry()
        };
        store.add(&entry, Some(lrs.endpoint.as_str())).unwrap();
        send(&mut store, &lrs).unwrap();
    }
    let requests = end(&lrs, served);
    assert_eq!(requests.len(), 4);
    let first = &requests[0].body;
    assert!(requests.iter().all(|request| request.body == *first));
    let statements: Vec<serde_json::Value> = serde_json::from_str(first).unwrap();
    for statement in &statements {
        let time = statement["timestamp"].as_str().unwrap();
        assert!(time.starts_with("2026-03-01T08:00:"), "{time}");
    }
}

#[test]
fn who_does_not_answer_is_named() {
    let (sent, _, _) = sending(|_| None);
    assert_eq!((sent.delivered, sent.waiting), (0, 9));
    let told = sent.stopped.unwrap();
    assert!(told.starts_with("http://127.0.0.1:"), "{told}");
    assert!(told.contains("/xAPI/statements: "), "{told}");
}
