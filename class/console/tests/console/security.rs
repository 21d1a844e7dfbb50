//! Requests that a hub refuses.

use serde_json::json;
use tokio_tungstenite::tungstenite::Message;

use crate::client::{Client, ask, cookie, enter};
use crate::student::{FakeStudent, hub};
use vitriol_tests::random::Random;

#[test]
fn a_code_is_good_once_and_wrong_ones_have_to_wait() {
    let (_folder, hub) = hub();
    let to = hub.address();
    let code = hub.invite().unwrap().code;
    assert_eq!(enter(to, "00000-00000").status, 403);
    let first = enter(to, &code);
    assert_eq!(first.status, 204);
    let set = first.field("set-cookie").unwrap();
    assert!(set.contains("; HttpOnly; SameSite=Strict"), "{set}");
    // The code is sent a second time.
    assert_eq!(enter(to, &code).status, 403);
    assert_eq!(hub.codes(), 0);
    for _ in 0..4 {
        assert_eq!(enter(to, "").status, 403);
    }
    let other = hub.invite().unwrap().code;
    let late = enter(to, &other);
    assert_eq!(late.status, 429, "the right code does not help any more");
    assert!(late.field("retry-after").unwrap().parse::<u64>().unwrap() <= 31);
    // A session that is open stays open.
    let cookie = set.split(';').next().unwrap();
    assert_eq!(
        ask(to, "GET /session", &[("Cookie", cookie)], "").status,
        204
    );
    // A session that has ended is ended, for a socket that is open too.
    let mut client = Client::new(&hub, cookie);
    let origin = format!("http://{to}");
    let fields = [("Cookie", cookie), ("Origin", &*origin)];
    assert_eq!(ask(to, "POST /leave", &fields, "").status, 204);
    assert_eq!(
        ask(to, "GET /session", &[("Cookie", cookie)], "").status,
        401
    );
    while client.next().is_some() {}
    assert_eq!(Client::try_new(to, cookie).err(), Some(401));
}

#[test]
fn nothing_is_had_without_a_session_from_elsewhere_or_at_another_host() {
    let (_folder, hub) = hub();
    let to = hub.address();
    let cookie = cookie(&hub);
    let port = to.port();
    let here = format!("http://{to}");
    let socket = |fields: &[(&str, &str)]| {
        let mut all = vec![
            ("Connection", "Upgrade"),
            ("Upgrade", "websocket"),
            ("Sec-WebSocket-Version", "13"),
            ("Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="),
        ];
        all.extend(fields);
        ask(to, "GET /socket", &all, "").status
    };
    assert_eq!(socket(&[("Origin", &here), ("Cookie", &cookie)]), 101);
    assert_eq!(socket(&[("Origin", &here)]), 401);
    assert_eq!(socket(&[("Origin", &here), ("Cookie", "vitriol-0=x")]), 401);
    assert_eq!(socket(&[("Cookie", &cookie)]), 403, "no origin");
    for origin in [
        "http://evil.example",
        "null",
        &format!("https://{to}"),
        &format!("{here}0"),
    ] {
        assert_eq!(
            socket(&[("Origin", origin), ("Cookie", &cookie)]),
            403,
            "{origin}"
        );
        let code = hub.invite().unwrap().code;
        let answer = ask(to, "POST /enter", &[("Origin", origin)], &code);
        assert_eq!(answer.status, 403, "{origin}");
    }
    for host in [
        "evil.example",
        &format!("evil.example:{port}"),
        "localhost",
        "",
    ] {
        assert_eq!(
            ask(to, "GET /", &[("Host", host)], "").status,
            403,
            "{host}"
        );
    }
    let named = format!("localhost:{port}");
    assert_eq!(ask(to, "GET /", &[("Host", &named)], "").status, 200);
    // A student's program has no way in over plain HTTP.
    assert_eq!(ask(to, "GET /student", &[], "").status, 400, "no upgrade");
    for path in ["/..", "/etc/passwd", "/socket/..", "//", "/session?x"] {
        let answer = ask(to, &format!("GET {path}"), &[], "");
        assert!(
            [400, 401, 404].contains(&answer.status),
            "{path}: {}",
            answer.status
        );
    }
    let long = "0".repeat(65);
    let answer = ask(to, "POST /enter", &[("Origin", &here)], &long);
    assert_eq!(answer.status, 413);
}

#[test]
fn browsers_are_told_to_be_careful() {
    let (_folder, hub) = hub();
    for path in ["/", "/session", "/nothing"] {
        let answer = ask(hub.address(), &format!("GET {path}"), &[], "");
        let policy = answer.field("content-security-policy").unwrap();
        for part in [
            "default-src 'none'",
            "frame-ancestors 'none'",
            "form-action 'none'",
        ] {
            assert!(policy.contains(part), "{policy}");
        }
        assert!(!policy.contains("unsafe"), "{policy}");
        assert_eq!(answer.field("x-content-type-options"), Some("nosniff"));
        assert_eq!(answer.field("referrer-policy"), Some("no-referrer"));
        assert_eq!(answer.field("cache-control"), Some("no-store"));
    }
    let page = ask(hub.address(), "GET /", &[], "").body;
    // Nothing else is loaded, and no handler stands in the markup.
    let (markup, script) = page.split_once("<script>").unwrap();
    for outside in [
        "://", "src=", "@import", "url(", "onclick=", "onload=", "style=",
    ] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(
        markup.contains("<h1>Vitriol</h1>") && script.ends_with("</script>\n</body>\n</html>\n")
    );
    // Text is never read as HTML.
    for hole in ["innerHTML", "insertAdjacentHTML", "document.write", "eval("] {
        assert!(!script.contains(hole), "{hole}");
    }
}

#[test]
fn ten_thousand_frames_of_garbage() {
    let (_folder, hub) = hub();
    let student = FakeStudent::in_hub(&hub, "Ada");
    let cookie = cookie(&hub);
    let mut good = Client::new(&hub, &cookie);
    let number = good.open("jpeg");
    let mut random = Random(7);
    let mut below = |most: usize| (random.number() * most as f64) as usize;
    // A socket with invalid messages only is closed after 16: each of these frames is read.
    for _ in 0..10_000 / 16 {
        let mut client = Client::new(&hub, &cookie);
        for _ in 0..16 {
            let bytes: Vec<u8> = (0..below(300)).map(|_| below(256) as u8).collect();
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let nearly = |command: &str| {
                format!(r#"{{"say":"order","echo":1,"student":{number},"command":{command}}}"#)
            };
            let message = match below(5) {
                0 => Message::binary(bytes),
                1 => Message::text(text),
                2 => Message::text(nearly("{}")),
                3 => Message::text(nearly(r#"{"do":"reset","path":"/etc/passwd"}"#)),
                _ => Message::text(r#"{"say":"open","student":1,"path":"/etc/passwd"}"#),
            };
            client.send(message).unwrap();
        }
        while client.next().is_some() {}
    }
    assert!(hub.counts().waiting <= 75, "{:?}", hub.counts());
    // A message of too many bytes.
    let mut long = Client::new(&hub, &cookie);
    let _ = long.send(Message::text(" ".repeat(5000)));
    while long.next().is_some() {}
    // A page with valid messages is served as before.
    let answer = good.order(number, &json!({"do": "pause", "on": true}));
    assert_eq!(answer["say"], "ordered");
    assert_eq!(
        student.ordered(),
        vitriol_console::Command::Pause { on: true }
    );
    student.nothing_else();
}
