//! Cards of a class: the lesson's step, the points so far, and a small picture of what each student sees.

use serde_json::json;
use vitriol_console::{Points, Step, Text};
use vitriol_tests::devtools::Tab;
use vitriol_tests::wait;

use crate::look::{class_of, no_complaints, reads};
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
