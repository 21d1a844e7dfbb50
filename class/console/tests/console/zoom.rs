//! The live view magnified: by wheel, two fingers, buttons and keys.

use serde_json::json;
use vitriol_tests::devtools::Tab;

use crate::look::{at, class_of, click, no_complaints, open, reads, text};

/// Most that two places may differ which are the same, pixels: browsers round the view's edges.
const NEAR: f64 = 1.0;

/// Left, upper edge, width and height of the part with this id, CSS pixels.
fn place(tab: &mut Tab, id: &str) -> [f64; 4] {
    let box_of = format!(
        "(() => {{ const it = {}.getBoundingClientRect(); return [it.left, it.top, it.width, it.height] }})()",
        at(id)
    );
    let found = tab.eval(&box_of);
    [0, 1, 2, 3].map(|side| found[side].as_f64().unwrap())
}

/// How many times the picture is as wide as the view.
fn scale(tab: &mut Tab) -> f64 {
    place(tab, "picture")[2] / place(tab, "screen")[2]
}

/// Whether the picture covers the view.
fn covers(tab: &mut Tab) -> bool {
    let [picture, screen] = ["picture", "screen"].map(|id| place(tab, id));
    (0..2).all(|side| {
        picture[side] <= screen[side] + NEAR
            && picture[side] + picture[side + 2] >= screen[side] + screen[side + 2] - NEAR
    })
}

/// Waits until all parts of the page have come: a scroll bar moves the view.
fn settled(tab: &mut Tab) {
    tab.until(&reads("age", "live"));
    tab.until("document.querySelectorAll('.keys span').length > 0");
}

fn mouse(tab: &mut Tab, kind: &str, [x, y]: [f64; 2], more: serde_json::Value) {
    let mut event = json!({"type": kind, "x": x, "y": y});
    for (key, value) in more.as_object().unwrap() {
        event[key.as_str()] = value.clone();
    }
    tab.call("Input.dispatchMouseEvent", event);
}

#[test]
fn a_wheel_magnifies_where_it_is_turned_and_a_drag_moves() {
    let Some((_folder, hub, _student, mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    open(&mut tab, &hub);
    settled(&mut tab);
    assert!((scale(&mut tab) - 1.0).abs() < 0.01);
    assert_eq!(text(&mut tab, "scale"), "");
    let [left, top, width, height] = place(&mut tab, "screen");
    let over = [left + 0.25 * width, top + 0.75 * height];
    // Which share of the picture is there.
    let shares =
        |picture: [f64; 4]| [0, 1].map(|side| (over[side] - picture[side]) / picture[side + 2]);
    let before = shares(place(&mut tab, "picture"));
    let turn = |by: f64| json!({"deltaX": 0, "deltaY": by});
    mouse(&mut tab, "mouseWheel", over, turn(-200.0));
    tab.until(&format!("{}.textContent.startsWith('× 1.')", at("scale")));
    // 1.002 to the power of 200 is 1.491.
    let scaled = scale(&mut tab);
    assert!((scaled - 1.491).abs() < 0.01, "{scaled}");
    let picture = place(&mut tab, "picture");
    let after = shares(picture);
    let stays = |side: usize| (before[side] - after[side]).abs() * picture[side + 2] <= NEAR;
    assert!((0..2).all(stays), "{before:?} and {after:?}");
    assert!(covers(&mut tab));

    // A drag moves the picture along, and is no click, which would give the view the page's width.
    let to = [over[0] + 20.0, over[1] - 15.0];
    let button = json!({"button": "left", "buttons": 1, "clickCount": 1});
    mouse(&mut tab, "mousePressed", over, button.clone());
    mouse(
        &mut tab,
        "mouseMoved",
        to,
        json!({"button": "left", "buttons": 1}),
    );
    mouse(&mut tab, "mouseReleased", to, button);
    let moved = place(&mut tab, "picture");
    let by = [0, 1].map(|side| moved[side] - picture[side]);
    assert!((by[0] - 20.0).abs() <= NEAR, "{by:?} pixels");
    assert!((by[1] + 15.0).abs() <= NEAR, "{by:?} pixels");
    let pressed = format!("{}.getAttribute('aria-pressed')", at("zoom"));
    assert_eq!(tab.eval(&pressed), "false");

    // Four times at most, and back to the whole.
    for _ in 0..3 {
        mouse(&mut tab, "mouseWheel", to, turn(-600.0));
    }
    tab.until(&format!("{}.disabled", at("closer")));
    assert_eq!(text(&mut tab, "scale"), "× 4.0");
    assert!(covers(&mut tab));
    mouse(&mut tab, "mouseWheel", to, turn(3000.0));
    tab.until(&format!("{}.disabled", at("farther")));
    assert!((scale(&mut tab) - 1.0).abs() < 0.01);
    no_complaints(&mut tab);
}

#[test]
fn buttons_keys_and_two_fingers_magnify() {
    let Some((_folder, hub, _student, mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    open(&mut tab, &hub);
    settled(&mut tab);
    assert_eq!(tab.eval(&format!("{}.disabled", at("farther"))), true);
    for _ in 0..2 {
        click(&mut tab, "closer");
    }
    // 1.25 times 1.25.
    let scaled = scale(&mut tab);
    assert!((scaled - 1.5625).abs() < 0.01, "{scaled}");
    // About the middle: as much is out of view on either side.
    let [screen, picture] = ["screen", "picture"].map(|id| place(&mut tab, id));
    let out = [
        screen[0] - picture[0],
        picture[0] + picture[2] - screen[0] - screen[2],
    ];
    assert!((out[0] - out[1]).abs() <= 2.0 * NEAR, "{out:?}");
    // By keys to the right edge, and no farther.
    let key = "picture.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', cancelable: true }))"
        .replacen("picture", &at("picture"), 1);
    for _ in 0..8 {
        tab.eval(&key);
    }
    let picture = place(&mut tab, "picture");
    let right = [picture, screen].map(|it| it[0] + it[2]);
    assert!((right[0] - right[1]).abs() <= NEAR, "{right:?}");
    for _ in 0..2 {
        click(&mut tab, "farther");
    }
    assert!((scale(&mut tab) - 1.0).abs() < 0.01);

    // Two fingers, 100 pixels from each other and then 200, about the middle.
    let [left, top, width, height] = screen;
    let [x, y] = [left + 0.5 * width, top + 0.5 * height];
    let fingers = |apart: f64| json!([{"x": x - apart / 2.0, "y": y, "id": 1}, {"x": x + apart / 2.0, "y": y, "id": 2}]);
    for (kind, points) in [
        ("touchStart", fingers(100.0)),
        ("touchMove", fingers(200.0)),
        ("touchEnd", json!([])),
    ] {
        let event = json!({"type": kind, "touchPoints": points});
        tab.call("Input.dispatchTouchEvent", event);
    }
    tab.until(&reads("scale", "× 2.0"));
    assert!(covers(&mut tab));
    let pressed = format!("{}.getAttribute('aria-pressed')", at("zoom"));
    assert_eq!(tab.eval(&pressed), "false");
    no_complaints(&mut tab);
}
