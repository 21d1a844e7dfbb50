//! A lesson at the page: attempts, work that would be lost, the end, and what goes wrong on the way.

use serde_json::json;
use vitriol_console::{Coming, Command, Incident, List, Port, State, Text};
use vitriol_tests::browser::Look;
use vitriol_tests::devtools::Tab;
use vitriol_tests::wait;

use crate::look::{at, begins, class_of, click, no_complaints, open, reads, text};
use crate::proxy::Proxy;
use crate::student::{card, first_state};

/// An incident of that attempt, whose text is its own.
pub fn incident(attempt: u32, text: &str, grave: bool) -> Incident {
    Incident {
        t_s: Some(20.0),
        text: Text::clipped(text),
        grave,
        attempt,
        scene: Text::clipped("Acid into water"),
    }
}

#[test]
fn incidents_belong_to_attempts_and_work_is_not_lost_unasked() {
    let Some((_folder, hub, [student], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    open(&mut tab, &hub);
    tab.until("document.querySelectorAll('#incident-list li').length === 1");

    // Another scene has begun: what went wrong before stays under its own attempt.
    {
        let mut state = student.state.lock().unwrap();
        state.scene = Text::clipped("Water into acid");
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
            "Attempt 2: Water into acid (now)",
            "20.0 s ⚠ Water was poured into acid.",
            "Attempt 1: Acid into water",
            "20.0 s ⚠ Acid on the left hand.",
        ])
    );
    assert_eq!(tab.eval(&reads("incident-count", "1")), true);

    // The scene that was asked for is marked while it is prepared, and a line says so.
    let pressed = "[...document.querySelectorAll('#scenes button')].findIndex((it) => it.getAttribute('aria-pressed') === 'true')";
    assert_eq!(tab.eval(pressed), 1);
    student.state.lock().unwrap().coming = Some(Coming {
        scene: Text::clipped("Acid into water"),
        choice: Some(0),
    });
    tab.until(&format!("!{}.hidden", at("coming")));
    assert_eq!(tab.eval(pressed), 0);
    let line = text(&mut tab, "coming-scene");
    assert!(
        line.starts_with("Being prepared: Acid into water."),
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
    // What Enter presses does no harm, and Escape closes too.
    for key in ["Enter", "Escape"] {
        assert_eq!(tab.eval("document.activeElement.id"), "lose-not");
        tab.press(&[key]);
        tab.until(&format!("!{}.open", at("lose")));
        student.nothing_else();
        click(&mut tab, "other-order");
    }
    click(&mut tab, "lose-not");
    assert_eq!(tab.eval(&format!("{}.open", at("lose"))), false);
    student.nothing_else();
    click(&mut tab, "other-order");
    click(&mut tab, "lose-now");
    assert_eq!(student.ordered(), Command::Toggle {});
    student.nothing_else();
    no_complaints(&mut tab);
}

/// Another scene ends a lesson, whose recording is not graded then: the page says so, even where nothing was taken in a hand. The lesson's
/// own scene begins it anew.
#[test]
fn a_lesson_does_not_end_unasked() {
    let Some((_folder, hub, [student], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    open(&mut tab, &hub);
    tab.until(&begins("step", "Step 2 of 7"));
    let scene = |choice: u8| format!("document.querySelectorAll('#scenes button')[{choice}]");
    tab.eval(&format!("{}.click()", scene(1)));
    assert_eq!(tab.eval(&format!("{}.open", at("lose"))), true);
    assert_eq!(text(&mut tab, "lose-what"), "");
    let ends = "The lesson ends here, and none of the student's work in it will be graded.";
    assert_eq!(text(&mut tab, "lose-lesson"), ends);
    student.nothing_else();
    click(&mut tab, "lose-not");
    tab.eval(&format!("{}.click()", scene(0)));
    assert_eq!(student.ordered(), Command::Scene { choice: 0 });
    tab.until(&reads("said", "Acid into water: done."));
    click(&mut tab, "other-order");
    assert_eq!(text(&mut tab, "lose-lesson"), ends);
    click(&mut tab, "lose-now");
    assert_eq!(student.ordered(), Command::Toggle {});
    // There is no lesson in that scene.
    tab.until(&reads("step", "This scene has no procedure."));
    tab.eval(&format!("{}.click()", scene(2)));
    assert_eq!(student.ordered(), Command::Scene { choice: 2 });
    no_complaints(&mut tab);
}

/// An incident under way has a text that changes. The list is written and not made anew, so that it stays where it was scrolled to.
#[test]
fn an_incident_grows_in_its_place() {
    let Some((_folder, hub, [student], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    open(&mut tab, &hub);
    let item = "document.querySelector('#incident-list li')";
    for ml in ["6.4 mL", "13 mL"] {
        let text = format!("Spilt on the bench: {ml}.");
        student.state.lock().unwrap().incidents = List::clipped([incident(1, &text, false)]);
        tab.until(&format!("{item}.textContent === '20.0 s {text}'"));
        tab.eval(&format!("window.first ??= {item}; 1"));
    }
    assert_eq!(tab.eval(&format!("window.first === {item}")), true);
    no_complaints(&mut tab);
}

/// What an instructor needs at once is seen without scrolling on a small notebook's screen.
#[test]
fn the_first_screen_has_what_is_needed_at_once() {
    for language in ["en", "de", "es", "zh"] {
        let Some((_folder, hub, [_ada], mut tab)) = class_of(language, ["Ada"]) else {
            return;
        };
        tab.look([1366, 768], Look::Light);
        open(&mut tab, &hub);
        tab.until(&format!("{}.textContent !== ''", at("stream")));
        let below = "['screen', 'pause', 'message', 'unsay', 'end'].filter((id) => \
            document.getElementById(id).getBoundingClientRect().bottom > innerHeight)";
        assert_eq!(tab.eval(below), json!([]), "{language}");
    }
}

#[test]
fn the_end_leaves_a_summary() {
    let Some((_folder, hub, [student], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    student.state.lock().unwrap().recording = Some(Text::clipped("/home/ada/pour.mcap"));
    open(&mut tab, &hub);
    tab.until(&reads("shown", "nothing"));
    assert_eq!(tab.eval(&format!("{}.hidden", at("summary"))), true);
    click(&mut tab, "end");
    assert_eq!(tab.eval("document.activeElement.id"), "end-not");
    tab.press(&["Enter"]);
    tab.until(&format!("!{}.open", at("sure")));
    student.nothing_else();
    click(&mut tab, "end");
    click(&mut tab, "end-now");
    assert_eq!(student.ordered(), Command::End {});
    tab.until(&format!("!{}.hidden", at("summary")));
    let length = text(&mut tab, "summary-length");
    let end = " s of simulated time, in 1 attempt; the last scene was: Acid into water.";
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
    no_complaints(&mut tab);
}

/// Publishes this state until the page shows it, by its message: a port may leave a state out.
fn publish(port: &Port, state: &State, tab: &mut Tab, shown: &str) {
    let shows = reads("shown", shown);
    wait::until(shown, || {
        port.publish(state.clone());
        (tab.eval(&shows) == true).then_some(())
    });
}

/// A program that ends before its last state is sent has done what was ordered. Of more incidents than are sent the summary counts all.
#[test]
fn an_end_without_a_last_state_is_done() {
    let Some((_folder, hub, [], mut tab)) = class_of("en", []) else {
        return;
    };
    let port = hub.student(card("Ada")).unwrap().unwrap();
    let mut state = State {
        incidents: List::clipped([
            incident(1, "Acid on the face.", true),
            incident(1, "Liquid was spilt.", false),
        ]),
        incidents_so_far: 40,
        grave_so_far: 3,
        ..first_state()
    };
    open(&mut tab, &hub);
    publish(&port, &state, &mut tab, "nothing");
    click(&mut tab, "end");
    click(&mut tab, "end-now");
    wait::until("the order", || port.commands().pop());
    // Once the page shows this state, it has the hub's answer to the order, which is sent first.
    state.controls.message = Text::clipped("Ending.");
    publish(&port, &state, &mut tab, "Ending.");
    drop(port);
    drop(hub);
    tab.until(&reads("link", "The session is over."));
    assert_eq!(text(&mut tab, "said"), "End: done.");
    assert_eq!(
        text(&mut tab, "summary-incidents"),
        "40 incidents, 3 of them grave; 2 of the incidents are listed below."
    );
    no_complaints(&mut tab);
}

#[test]
fn a_page_that_is_open_takes_another_code() {
    let Some((_folder, hub, _student, mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    let page = format!("http://{}/", hub.address());
    tab.go(&format!("{page}#AAAAA-AAAAA"));
    tab.until(&begins("entry-said", "This code is wrong"));
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
    tab.until(&begins("link", "Connected already"));
    assert_eq!(crate::client::enter(hub.address(), &spare).status, 204);
    no_complaints(&mut tab);
}

#[test]
fn a_message_that_was_not_sent_stays_and_an_old_picture_tells_its_age() {
    let Some((_folder, hub, [student], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    let proxy = Proxy::new(hub.address());
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
    tab.until(&begins("link", "No connection"));
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
    no_complaints(&mut tab);
}
