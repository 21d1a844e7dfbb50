//! Cards of a class: the lesson's step, the points so far, and a small picture of what each student sees.

use std::time::Duration;

use serde_json::json;
use vitriol_console::{Command, Points, Step, Text};
use vitriol_tests::devtools::Tab;
use vitriol_tests::wait;

use crate::look::{class_of, click, no_complaints, pressed, reads};
use crate::student::{COLOUR, card, first_state};

/// A student's card; students are numbered in the order in which they came.
fn button(student: u32) -> String {
    format!("document.querySelector('[data-student=\"{student}\"]')")
}

/// The lines that a card shows below the name.
fn lines(student: u32) -> String {
    let all = format!("[...{}.querySelectorAll('span')]", button(student));
    format!("{all}.filter((it) => !it.hidden).map((it) => it.textContent)")
}

fn picture(student: u32) -> String {
    format!("{}.querySelector('canvas')", button(student))
}

#[test]
fn a_card_has_step_and_points() {
    let Some((_folder, hub, [ada, bo], mut tab)) = class_of("en", ["Ada", "Bo"]) else {
        return;
    };
    {
        let mut state = bo.state.lock().unwrap();
        (state.step, state.points) = (None, None);
    }
    tab.go(&hub.invite().unwrap().address);
    tab.until(&format!("{}.includes('Points: 12 of 40')", lines(1)));
    let shown = [
        "Acid into water",
        "Step 2 of 7: Pour the acid into the water, slowly.",
        "Points: 12 of 40",
        "hottest 84.3 °C",
        "⚠ 1 incident: <img src=x onerror=alert(1)> Acid on the left hand.",
    ];
    assert_eq!(tab.eval(&lines(1)), json!(shown));
    // Without a lesson, and before anything is judged.
    let plain = json!([shown[0], shown[3], shown[4]]);
    tab.until(&format!(
        "JSON.stringify({}) === JSON.stringify({plain})",
        lines(2)
    ));

    {
        let mut state = ada.state.lock().unwrap();
        state.step = Some(Step {
            number: 8,
            of: 7,
            title: Text::clipped("Diluting"),
        });
        state.points = Some(Points { earned: 38, of: 40 });
    }
    let over = "'Done: Diluting,Points: 38 of 40'";
    tab.until(&format!("{}.join().includes({over})", lines(1)));
    // The student's own page has them too.
    tab.eval(&format!("{}.click()", button(1)));
    tab.until(&reads("points", "Points: 38 of 40"));
    tab.until(&reads("step", "Done: Diluting"));
    no_complaints(&mut tab);
}

/// The colour in the middle of a card's picture is the student's: JPEG keeps it within a few steps of 255.
fn sees(tab: &mut Tab, student: u32) {
    let canvas = picture(student);
    tab.until(&format!("!{canvas}.hidden && {canvas}.dataset.drawn"));
    let size = tab.eval(&format!("[{canvas}.width, {canvas}.height]"));
    // 320 x 180, at half its size.
    assert_eq!(size, json!([160, 90]));
    let middle = format!("[...{canvas}.getContext('2d').getImageData(80, 45, 1, 1).data]");
    let seen = tab.eval(&middle);
    for (at, colour) in COLOUR.iter().enumerate() {
        let seen = seen[at].as_i64().unwrap();
        assert!(
            (i64::from(*colour) - seen).abs() <= 12,
            "{seen} is not {colour}"
        );
    }
}

#[test]
fn a_card_has_a_small_picture_where_there_is_one() {
    let Some((_folder, hub, [ada, _bo], mut tab)) = class_of("en", ["Ada", "Bo"]) else {
        return;
    };
    // A program without a view.
    let blind = hub.student(card("Cy")).unwrap().unwrap();
    blind.publish(first_state());
    tab.go(&hub.invite().unwrap().address);
    for student in [1, 2] {
        sees(&mut tab, student);
    }
    wait::until("it is asked for a picture", || {
        blind.wants_card().then_some(())
    });
    assert_eq!(tab.eval(&format!("{}.hidden", picture(3))), true);
    let drawn = tab.eval(&format!("{}.dataset.drawn", picture(2)));
    tab.until(&format!("{}.dataset.drawn !== {drawn}", picture(2)));
    drop(ada);
    tab.until(&format!("{}.hidden", picture(1)));
    assert_eq!(tab.eval(&format!("{}.hidden", picture(2))), false);
    no_complaints(&mut tab);
}

/// Loads the page anew, and waits until it has the class.
fn reload(tab: &mut Tab) {
    tab.eval("window.isLeft = true");
    tab.call("Page.reload", json!({}));
    tab.until(&format!("!window.isLeft && {} !== null", button(1)));
}

/// Without pictures a class asks for none, a student's own view stays, and the browser keeps the choice where it keeps anything.
#[test]
fn a_class_is_shown_without_pictures_at_will() {
    let Some((_folder, hub, [ada, _bo], mut tab)) = class_of("en", ["Ada", "Bo"]) else {
        return;
    };
    let blind = hub.student(card("Cy")).unwrap().unwrap();
    blind.publish(first_state());
    tab.go(&hub.invite().unwrap().address);
    sees(&mut tab, 1);
    tab.until(&pressed("card-pictures", true));
    click(&mut tab, "card-pictures");
    tab.until(&pressed("card-pictures", false));
    let none = "[...document.querySelectorAll('#students canvas')].every((it) => it.hidden)";
    assert_eq!(tab.eval(none), true);
    // The hub takes a page's messages in their order: what comes after the choice is done after it.
    click(&mut tab, "all-pause");
    assert_eq!(ada.ordered(), Command::Pause { on: true });
    blind.take_card_request();
    // Each card has its turn within 4 s.
    std::thread::sleep(Duration::from_secs(5));
    assert!(!blind.wants_card(), "a picture that nobody shows");
    assert_eq!(tab.eval(none), true);

    // A student's own view has its own switch.
    tab.eval(&format!("{}.click()", button(1)));
    tab.until(&reads("stream", "H.264, 320 × 180"));
    click(&mut tab, "to-class");
    reload(&mut tab);
    tab.until(&pressed("card-pictures", false));
    click(&mut tab, "card-pictures");
    sees(&mut tab, 1);

    // A browser that keeps nothing shows them, and hides them until the page is left.
    let refuse =
        "Object.defineProperty(window, 'localStorage', { get() { throw new Error('refused') } })";
    let refuse = json!({"source": refuse});
    tab.call("Page.addScriptToEvaluateOnNewDocument", refuse);
    reload(&mut tab);
    sees(&mut tab, 1);
    click(&mut tab, "card-pictures");
    tab.until(&pressed("card-pictures", false));
    assert_eq!(tab.eval(none), true);
    no_complaints(&mut tab);
}
