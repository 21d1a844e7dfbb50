//! A lesson at the page: attempts, work that would be lost, the end, a class, and what goes wrong on the way.

use serde_json::json;
use vitriol_console::{Coming, Command, Incident, List, Text};
use vitriol_tests::browser::Look;
use vitriol_tests::devtools::Tab;

use crate::proxy::Proxy;
use crate::student::{FakeStudent, hub};

fn at(id: &str) -> String {
    format!("document.getElementById('{id}')")
}

fn click(tab: &mut Tab, id: &str) {
    tab.eval(&format!("{}.click()", at(id)));
}

fn reads(id: &str, text: &str) -> String {
    format!("{}.textContent === {}", at(id), json!(text))
}

/// An incident of that attempt, whose text is its own.
fn incident(attempt: u32, text: &str, grave: bool) -> Incident {
    Incident {
        t_s: Some(20.0),
        text: Text::clipped(text),
        grave,
        attempt,
        scene: Text::clipped("Correct: acid into water"),
    }
}

#[test]
fn incidents_belong_to_attempts_and_work_is_not_lost_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let student = FakeStudent::in_hub(&hub, "Ada");
    let Some(mut tab) = Tab::new() else { return };
    tab.look([1280, 900], Look::Light);
    tab.go(&hub.invite().unwrap().address);
    tab.until("document.querySelectorAll('#incident-list li').length === 1");

    // Another scene has begun: what went wrong before stays under its own attempt.
    {
        let mut state = student.state.lock().unwrap();
        state.scene = Text::clipped("Incorrect: water into acid");
        (state.choice, state.attempt) = (Some(1), 2);
        state.incidents = List::clipped([
            incident(1, "Acid on the left hand.", true),
            incident(2, "Water was poured into acid.", true),
        ]);
        (state.incidents_of_attempt, state.incidents_so_far) = (1, 2);
    }
    tab.until("document.querySelectorAll('#incident-list li').length === 2");
    let list =
        "[...document.getElementById('incident-list').children].map((part) => part.textContent)";
    assert_eq!(
        tab.eval(list),
        json!([
            "Attempt 2: Incorrect: water into acid (now)",
            "20.0 s ⚠ Water was poured into acid.",
            "Attempt 1: Correct: acid into water",
            "20.0 s ⚠ Acid on the left hand.",
        ])
    );
    assert_eq!(tab.eval(&reads("incident-count", "1")), true);

    // The scene that was asked for is marked while it is prepared, and a line says so.
    let pressed = "[...document.querySelectorAll('#scenes button')].findIndex((it) => it.getAttribute('aria-pressed') === 'true')";
    assert_eq!(tab.eval(pressed), 1);
    student.state.lock().unwrap().coming = Some(Coming {
        scene: Text::clipped("Correct: acid into water"),
        choice: Some(0),
    });
    tab.until(&format!("!{}.hidden", at("coming")));
    assert_eq!(tab.eval(pressed), 0);
    let line = tab.eval(&format!("{}.textContent", at("coming-scene")));
    let line = line.as_str().unwrap();
    assert!(
        line.starts_with("Being prepared: Correct: acid into water."),
        "{line}"
    );
    student.state.lock().unwrap().coming = None;
    tab.until(&format!("{}.hidden", at("coming")));

    // Only what loses work asks.
    click(&mut tab, "reset");
    assert_eq!(student.ordered(), Command::Reset {});
    {
        let mut state = student.state.lock().unwrap();
        state.worked = true;
        // The page shows that it has this state.
        state.controls.message = Text::clipped("At work.");
    }
    tab.until(&reads("shown", "At work."));
    click(&mut tab, "other-order");
    assert_eq!(tab.eval(&format!("{}.open", at("lose"))), true);
    student.nothing_else();
    click(&mut tab, "lose-not");
    assert_eq!(tab.eval(&format!("{}.open", at("lose"))), false);
    student.nothing_else();
    click(&mut tab, "other-order");
    click(&mut tab, "lose-now");
    assert_eq!(student.ordered(), Command::Toggle {});
    student.nothing_else();
}

#[test]
fn the_end_leaves_a_summary() {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let student = FakeStudent::in_hub(&hub, "Ada");
    student.state.lock().unwrap().recording = Some(Text::clipped("/home/ada/pour.mcap"));
    let Some(mut tab) = Tab::new() else { return };
    tab.go(&hub.invite().unwrap().address);
    tab.until(&reads("shown", "nothing"));
    assert_eq!(tab.eval(&format!("{}.hidden", at("summary"))), true);
    click(&mut tab, "end");
    click(&mut tab, "end-now");
    assert_eq!(student.ordered(), Command::End {});
    tab.until(&format!("!{}.hidden", at("summary")));
    let text = |tab: &mut Tab, id: &str| {
        let text = tab.eval(&format!("{}.textContent", at(id)));
        text.as_str().unwrap().to_owned()
    };
    let length = text(&mut tab, "summary-length");
    let end = " s of simulated time, in 1 attempt; the last scene was: Correct: acid into water.";
    assert!(
        length.starts_with("It lasted ") && length.ends_with(end),
        "{length}"
    );
    assert_eq!(
        text(&mut tab, "summary-incidents"),
        "1 incident, 1 of them grave; they are listed below."
    );
    assert_eq!(
        text(&mut tab, "summary-recording"),
        "It is recorded on the student's computer in /home/ada/pour.mcap"
    );
    // Nothing can be asked for any more, k_v neither.
    let on = "[...document.querySelectorAll('#controls button, #controls input, #controls select')].filter((it) => !it.disabled).length";
    assert_eq!(tab.eval(on), 0);
    // The program ends with its session.
    drop(student);
    drop(hub);
    tab.until(&reads("link", "The session is over."));
    assert_eq!(tab.eval(&format!("{}.hidden", at("summary"))), false);
}

#[test]
fn a_page_that_is_open_takes_another_code() {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let _student = FakeStudent::in_hub(&hub, "Ada");
    let Some(mut tab) = Tab::new() else { return };
    let page = format!("http://{}/", hub.address());
    tab.go(&format!("{page}#AAAAA-AAAAA"));
    tab.until("document.getElementById('entry-said').textContent.startsWith('This code is wrong')");
    // As where an address is pasted that differs in its fragment alone: nothing is loaded.
    let paste = |code: &str| format!("location.hash = {}", json!(format!("#{code}")));
    tab.eval("window.stays = true");
    tab.eval(&paste(&hub.invite().unwrap().code));
    tab.until("!document.getElementById('student').hidden");
    assert_eq!(tab.eval("window.stays"), true);
    assert_eq!(tab.eval("location.hash"), "");
    // A page that is connected leaves a code to another browser.
    let spare = hub.invite().unwrap().code;
    tab.eval(&paste(&spare));
    tab.until("document.getElementById('link').textContent.startsWith('Connected already')");
    assert_eq!(crate::client::enter(hub.address(), &spare).status, 204);
}

#[test]
fn a_message_that_was_not_sent_stays_and_an_old_picture_tells_its_age() {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let proxy = Proxy::new(hub.address());
    let student = FakeStudent::in_hub(&hub, "Ada");
    let Some(mut tab) = Tab::new() else { return };
    tab.look([1280, 900], Look::Light);
    let code = hub.invite().unwrap().code;
    tab.go(&format!("http://{}/#{code}", proxy.address));
    tab.until(&reads("age", "live"));

    // The view can be as wide as the page.
    let width = format!("{}.getBoundingClientRect().width", at("screen"));
    let narrow = tab.eval(&width).as_f64().unwrap();
    click(&mut tab, "picture");
    let wide = tab.eval(&width).as_f64().unwrap();
    assert!(wide > 1.5 * narrow, "{narrow} and {wide} pixels");
    click(&mut tab, "zoom");
    let again = tab.eval(&width).as_f64().unwrap();
    // A scroll bar may have come or gone.
    assert!((again - narrow).abs() < 20.0, "{narrow} and {again} pixels");
    // What concerns the solver is folded.
    let titles = "[...document.querySelectorAll('#solver figcaption')].map((it) => it.textContent.split(',')[0])";
    assert_eq!(
        tab.eval(titles),
        json!(["Superheat", "Void fraction", "Frame time"])
    );
    assert_eq!(tab.eval(&format!("{}.open", at("solver"))), false);
    assert_eq!(
        tab.eval("document.querySelectorAll('#plots figure').length"),
        2
    );

    proxy.cut(true);
    tab.until("document.getElementById('link').textContent.startsWith('No connection')");
    tab.until("/^picture of [1-9]\\d* s ago$/.test(document.getElementById('age').textContent)");
    let send = "{ message.value = 'Slowly!'; message.form.requestSubmit(); message.value }"
        .replace("message.", &format!("{}.", at("message")));
    assert_eq!(tab.eval(&send), "Slowly!");
    assert_eq!(
        tab.eval(&reads("said", "Message: not sent, there is no connection.")),
        true
    );
    proxy.cut(false);
    tab.until(&reads("link", "Connected"));
    tab.until(&reads("age", "live"));
    assert_eq!(tab.eval(&format!("{}.value", at("message"))), "Slowly!");
    student.nothing_else();
    tab.eval(&format!("{}.form.requestSubmit()", at("message")));
    let text = Text::clipped("Slowly!");
    assert_eq!(student.ordered(), Command::Message { text });
    tab.until(&format!("{}.value === ''", at("message")));
}

#[test]
fn a_class_shows_first_who_needs_help_and_is_directed_as_one() {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let students = ["Ada", "Bo", "Cy"].map(|name| FakeStudent::in_hub(&hub, name));
    let lists = [
        Vec::new(),
        vec![
            incident(1, "It was poured too fast.", false),
            incident(1, "Liquid was spilt.", false),
        ],
        vec![
            incident(1, "Acid on the face.", true),
            incident(1, "Liquid was spilt.", false),
        ],
    ];
    for (student, list) in students.iter().zip(lists) {
        let mut state = student.state.lock().unwrap();
        state.incidents_of_attempt = list.len() as u32;
        state.incidents = List::clipped(list);
    }
    let Some(mut tab) = Tab::new() else { return };
    tab.go(&hub.invite().unwrap().address);
    let names =
        "[...document.querySelectorAll('#students strong')].map((it) => it.textContent).join()";
    tab.until(&format!("{names} === 'Cy,Bo,Ada'"));
    let card = tab.eval("document.querySelector('#students button').textContent");
    let card = card.as_str().unwrap();
    assert!(card.contains("⚠ 2 incidents: Acid on the face."), "{card}");

    let all = |command: Command| {
        for student in &students {
            assert_eq!(student.ordered(), command);
        }
    };
    click(&mut tab, "all-pause");
    all(Command::Pause { on: true });
    tab.until(&reads("all-said", "Pause: sent to 3 students."));
    click(&mut tab, "all-go");
    all(Command::Pause { on: false });
    let send = format!(
        "{{ {0}.value = 'Goggles on!'; {0}.form.requestSubmit(); 1 }}",
        at("all-message")
    );
    tab.eval(&send);
    let text = Text::clipped("Goggles on!");
    all(Command::Message { text });
    tab.until(&format!("{}.value === ''", at("all-message")));
    // A scene for all asks first.
    tab.eval(&format!(
        "{{ {0}.value = '1'; {0}.form.requestSubmit(); 1 }}",
        at("all-choice")
    ));
    tab.until(&format!("{}.open", at("lose")));
    for student in &students {
        student.nothing_else();
    }
    click(&mut tab, "lose-now");
    all(Command::Scene { choice: 1 });
}
