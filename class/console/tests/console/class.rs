//! A class at the page: who needs help, and what is ordered for all.

use serde_json::json;
use vitriol_console::{Command, List, Text};
use vitriol_tests::devtools::Tab;

use crate::instructor::incident;
use crate::look::{at, class_of, click, no_complaints, reads, text};

/// The names on the cards of the class, in their order.
const NAMES: &str =
    "[...document.querySelectorAll('#students strong')].map((it) => it.textContent).join()";

/// Presses the mouse's button, or lets it go, in the middle of Ada's card.
fn mouse(tab: &mut Tab, kind: &str) {
    let middle = "(() => { const it = document.querySelector('#students button').getBoundingClientRect(); \
        return [it.x + it.width / 2, it.y + it.height / 2] })()";
    let middle = tab.eval(middle);
    let event =
        json!({"type": kind, "x": middle[0], "y": middle[1], "button": "left", "clickCount": 1});
    tab.call("Input.dispatchMouseEvent", event);
}

/// A card that is pressed neither moves nor is replaced, whatever is received before it is let go.
#[test]
fn a_click_counts_while_the_class_changes() {
    let Some((_folder, hub, [_ada, bo], mut tab)) = class_of("en", ["Ada", "Bo"]) else {
        return;
    };
    tab.go(&hub.invite().unwrap().address);
    // Both are equally in need, and stand in the order in which they came.
    tab.until("document.querySelectorAll('#students .troubled').length === 2");
    assert_eq!(tab.eval(NAMES), "Ada,Bo");
    mouse(&mut tab, "mousePressed");
    bo.state.lock().unwrap().incidents_of_attempt = 5;
    tab.until("document.querySelector('#students').textContent.includes('5 incidents')");
    assert_eq!(tab.eval(NAMES), "Ada,Bo");
    mouse(&mut tab, "mouseReleased");
    tab.until(&reads("name", "Ada"));
    // Now Bo comes first.
    tab.until(&format!("{NAMES} === 'Bo,Ada'"));
    no_complaints(&mut tab);
}

/// A scene for all ends the lessons of students who are connected and in another scene than it. The others are not counted: the lesson's own
/// scene begins it anew, who is in no lesson loses none, and what is not connected is not told.
#[test]
fn a_scene_for_all_counts_the_lessons_that_it_ends() {
    let Some((_folder, hub, [ada, bo, cy, di], mut tab)) =
        class_of("en", ["Ada", "Bo", "Cy", "Di"])
    else {
        return;
    };
    // All are in a lesson of the first scene, but for Bo, whose lesson is of the second, and Cy, who is in none.
    {
        let mut state = bo.state.lock().unwrap();
        state.scene = Text::clipped("Water into acid");
        state.choice = Some(1);
    }
    cy.state.lock().unwrap().step = None;
    tab.go(&hub.invite().unwrap().address);
    let card =
        |number: u8| format!("document.querySelector('[data-student=\"{number}\"]').textContent");
    tab.until(&format!("{}.includes('Water into acid')", card(2)));
    tab.until(&format!("!{}.includes('Step')", card(3)));
    // Di's program ends within the lesson.
    tab.until(&format!("{}.includes('Step')", card(4)));
    drop(di);
    tab.until(&format!("{}.includes('not connected')", card(4)));
    tab.until(&format!("{}.includes('Step')", card(4)));

    let asked = |tab: &mut Tab, choice: u8| {
        tab.eval(&format!(
            "{{ {0}.value = '{choice}'; {0}.form.requestSubmit(); 1 }}",
            at("all-choice")
        ));
        tab.until(&format!("{}.open", at("lose")));
        let said = text(tab, "lose-lesson");
        click(tab, "lose-not");
        said
    };
    let one = "1 student is in a lesson: it ends, and none of the work in it will be graded.";
    let two = "2 students are in a lesson: it ends for them, and none of their work in it will be graded.";
    for (choice, ends) in [(0, one), (1, one), (2, two)] {
        assert_eq!(asked(&mut tab, choice), ends, "scene {choice}");
    }
    for (student, number) in [(&ada, 1), (&bo, 2)] {
        student.state.lock().unwrap().step = None;
        tab.until(&format!("!{}.includes('Step')", card(number)));
    }
    assert_eq!(asked(&mut tab, 2), "");
    for student in [&ada, &bo, &cy] {
        student.nothing_else();
    }
    no_complaints(&mut tab);
}

#[test]
fn a_class_shows_first_who_needs_help_and_is_directed_as_one() {
    let Some((_folder, hub, students, mut tab)) = class_of("en", ["Ada", "Bo", "Cy"]) else {
        return;
    };
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
    tab.go(&hub.invite().unwrap().address);
    tab.until(&format!("{NAMES} === 'Cy,Bo,Ada'"));
    let card = "document.querySelector('#students button').textContent";
    tab.until(&format!(
        "{card}.includes('⚠ 2 incidents: Acid on the face.')"
    ));

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
    let message = Text::clipped("Goggles on!");
    all(Command::Message { text: message });
    tab.until(&format!("{}.value === ''", at("all-message")));
    // A scene for all asks first, and says how many lessons it ends: Cy's is over already.
    students[2].state.lock().unwrap().step = None;
    tab.until("!document.querySelector('[data-student=\"3\"]').textContent.includes('Step')");
    tab.eval(&format!(
        "{{ {0}.value = '1'; {0}.form.requestSubmit(); 1 }}",
        at("all-choice")
    ));
    tab.until(&format!("{}.open", at("lose")));
    for student in &students {
        student.nothing_else();
    }
    assert_eq!(
        text(&mut tab, "lose-lesson"),
        "2 students are in a lesson: it ends for them, and none of their work in it will be graded."
    );
    assert_eq!(tab.eval("document.activeElement.id"), "lose-not");
    click(&mut tab, "lose-now");
    all(Command::Scene { choice: 1 });
    // So does the end for all.
    click(&mut tab, "all-end");
    assert_eq!(tab.eval("document.activeElement.id"), "end-not");
    let ends = "3 sessions end. Recordings stay on the students' computers.";
    assert_eq!(text(&mut tab, "sure-what"), ends);
    for student in &students {
        student.nothing_else();
    }
    click(&mut tab, "end-now");
    all(Command::End {});
    tab.until(&reads("all-said", "End: sent to 3 students."));
    no_complaints(&mut tab);
}
