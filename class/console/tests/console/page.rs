//! The page in Debian's Chromium, directed as a person would.

use std::path::PathBuf;

use serde_json::json;
use vitriol_console::{Command, Text};
use vitriol_tests::browser::Look;
use vitriol_tests::devtools::Tab;

use crate::look::{at, begins, class_of, click, no_complaints, open, pressed, reads};
use crate::proxy::Proxy;
use crate::student::COLOUR;

/// Writes a picture of the page beside what tests build, for people to look at.
fn photograph(tab: &mut Tab, name: &str) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join(name), tab.picture()).unwrap();
}

#[test]
fn each_control_does_what_it_says() {
    let Some((_folder, hub, [student], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    // One headset is opened by itself, and the code is out of the address.
    open(&mut tab, &hub);
    assert_eq!(tab.eval("location.hash + location.search"), "");
    tab.until(&reads("name", "Ada"));

    for (id, command, shown) in [
        (
            "pause",
            Command::Pause { on: true },
            reads("pause", "Resume"),
        ),
        (
            "pause",
            Command::Pause { on: false },
            reads("pause", "Pause"),
        ),
        ("spare", Command::Spare { on: true }, pressed("spare", true)),
        (
            "spare",
            Command::Spare { on: false },
            pressed("spare", false),
        ),
        (
            "reset",
            Command::Reset {},
            reads("said", "From the start: done."),
        ),
    ] {
        tab.until(&format!("!('waits' in {}.dataset)", at(id)));
        click(&mut tab, id);
        assert_eq!(student.ordered(), command);
        tab.until(&shown);
    }
    let scenes = "document.querySelectorAll('#scenes button')";
    for (choice, mark) in [
        (1, "✗ Water into acid"),
        (2, "The paper's three flasks"),
        (0, "✓ Acid into water"),
    ] {
        assert_eq!(tab.eval(&format!("{scenes}[{choice}].textContent")), mark);
        tab.eval(&format!("{scenes}[{choice}].click()"));
        leave_lesson(&mut tab);
        assert_eq!(student.ordered(), Command::Scene { choice });
        tab.until(&format!(
            "{scenes}[{choice}].getAttribute('aria-pressed') === 'true'"
        ));
    }
    // The other order, and back; the last scene above has one, and the one of index 2 has none.
    let other = at("other-order");
    for choice in [1, 0] {
        tab.until(&format!(
            "!{other}.disabled && !('waits' in {other}.dataset)"
        ));
        click(&mut tab, "other-order");
        leave_lesson(&mut tab);
        assert_eq!(student.ordered(), Command::Toggle {});
        tab.until(&format!(
            "{scenes}[{choice}].getAttribute('aria-pressed') === 'true'"
        ));
    }
    for (choice, disabled) in [(2, true), (0, false)] {
        tab.eval(&format!("{scenes}[{choice}].click()"));
        leave_lesson(&mut tab);
        assert_eq!(student.ordered(), Command::Scene { choice });
        tab.until(&format!("{other}.disabled === {disabled}"));
    }
    tab.eval("{ const speed = document.getElementById('speed'); speed.value = '0.25'; speed.dispatchEvent(new Event('change')) }");
    assert_eq!(student.ordered(), Command::SlowMotion { rate: 0.25 });
    tab.eval("document.getElementById('k-v').focus()");
    tab.type_in("1.75");
    tab.press(&["Enter"]);
    assert_eq!(student.ordered(), Command::KV { value: 1.75 });
    tab.until(&reads("k-v-now", "1.75"));
    tab.eval("document.getElementById('message').focus()");
    let message = "Slowly, <b>please</b>!";
    tab.type_in(message);
    tab.press(&["Enter"]);
    let text = Text::clipped(message);
    assert_eq!(student.ordered(), Command::Message { text });
    tab.until(&reads("shown", message));
    // What the student's program has taken leaves the field, and can be taken away; nothing else can.
    tab.until("document.getElementById('message').value === ''");
    click(&mut tab, "unsay");
    let text = Text::default();
    assert_eq!(student.ordered(), Command::Message { text });
    tab.until("document.getElementById('unsay').disabled");

    // The information beside the controls.
    tab.until(&reads(
        "step",
        "Step 2 of 7: Pour the acid into the water, slowly.",
    ));
    assert_eq!(tab.eval("document.querySelectorAll('#hints li').length"), 2);
    let incident = tab.eval("document.querySelector('#incident-list li').textContent");
    assert_eq!(
        incident,
        "12.5 s ⚠ <img src=x onerror=alert(1)> Acid on the left hand."
    );
    let keys = tab.until(
        "[...document.querySelectorAll('.keys span')].map((key) => key.textContent).join('; ')",
    );
    for reading in [
        "beaker, hottest: 84.3",
        "cylinder, mean: 5.0",
        "hottest: 3.2",
        "liquid: 12.5",
        "bench: 2.4",
        "floor: 0.0",
        "mean: 8.70",
        "longest: 13.10",
    ] {
        assert!(
            keys.as_str().unwrap().contains(reading),
            "{reading} is not in {keys}"
        );
    }
    tab.eval("document.querySelectorAll('details')[0].open = true");
    tab.until("document.querySelector('details table td:nth-child(2)').textContent === '84.3'");

    // The view, by H.264 and by JPEG, and hidden at will.
    for codec in ["H.264", "JPEG"] {
        tab.until(&reads("stream", &format!("{codec}, 320 × 180")));
        tab.until(&reads("age", "live"));
        see(&mut tab);
        if codec == "H.264" {
            photograph(&mut tab, "console.png");
            // A browser without WebCodecs.
            let forget = json!({"source": "delete window.VideoDecoder"});
            tab.call("Page.addScriptToEvaluateOnNewDocument", forget);
            tab.call("Page.reload", json!({}));
            tab.until("!('VideoDecoder' in window)");
        }
    }
    click(&mut tab, "hide");
    tab.until(
        "!document.getElementById('hidden').hidden && document.getElementById('picture').hidden",
    );
    // The student's program gets the information that no page shows its pictures.
    tab.until(&reads("stream", ""));
    click(&mut tab, "hide");
    tab.until(&reads("stream", "JPEG, 320 × 180"));

    click(&mut tab, "end");
    click(&mut tab, "end-not");
    student.nothing_else();
    click(&mut tab, "end");
    click(&mut tab, "end-now");
    assert_eq!(student.ordered(), Command::End {});
    tab.until("document.getElementById('said').textContent === 'The session is over.' && document.getElementById('pause').disabled");
    no_complaints(&mut tab);
}

/// Agrees to the lesson's end, where the page asks.
fn leave_lesson(tab: &mut Tab) {
    tab.eval(&format!(
        "{}.open && {}.click()",
        at("lose"),
        at("lose-now")
    ));
}

/// Checks that the view has the student's colour: H.264 and JPEG keep it within a few steps of 255.
fn see(tab: &mut Tab) {
    let pixel = "(() => { const c = document.getElementById('picture'); \
        return [...c.getContext('2d').getImageData(c.width / 2, c.height / 2, 1, 1).data] })()";
    let begun = std::time::Instant::now();
    loop {
        let seen = tab.eval(pixel);
        let seen: Vec<i64> = seen
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_i64().unwrap())
            .collect();
        let near = COLOUR
            .iter()
            .zip(&seen)
            .all(|(a, b)| (i64::from(*a) - b).abs() <= 12);
        if near && seen[3] == 255 {
            return;
        }
        assert!(
            begun.elapsed() < vitriol_tests::wait::PATIENCE,
            "{seen:?} is not {COLOUR:?}"
        );
    }
}

#[test]
fn codes_keyboard_class_and_a_network_that_is_cut() {
    let Some((_folder, hub, [ada, bo], mut tab)) = class_of("en", ["Ada", "Bo"]) else {
        return;
    };
    bo.state.lock().unwrap().incidents_of_attempt = 0;
    let proxy = Proxy::new(hub.address());
    tab.look([390, 844], Look::Dark);
    let code = hub.invite().unwrap().code;
    let page = format!("http://{}/", proxy.address);
    tab.go(&format!("{page}#AAAAA-AAAAA"));
    tab.until(&begins("entry-said", "This code is wrong"));
    // By keyboard alone: the code's field has the focus.
    tab.type_in(&code.to_lowercase());
    tab.press(&["Enter"]);
    tab.until("!document.getElementById('class').hidden");
    tab.until("document.querySelectorAll('#students button').length === 2");
    let card = tab.eval("document.querySelector('#students button').textContent");
    assert!(card.as_str().unwrap().contains("⚠ 1 incident"), "{card}");
    tab.until("document.querySelectorAll('#students .troubled').length === 1");
    fits(&mut tab);
    photograph(&mut tab, "console-class.png");
    focus(&mut tab, "[data-student='2']");
    tab.press(&["Enter"]);
    tab.until("document.getElementById('name').textContent === 'Bo' && document.getElementById('shown').textContent === 'nothing'");
    focus(&mut tab, "#pause");
    tab.press(&[" "]);
    assert_eq!(bo.ordered(), Command::Pause { on: true });
    tab.until(&reads("pause", "Resume"));
    fits(&mut tab);
    tab.until("document.getElementById('stream').textContent !== ''");
    photograph(&mut tab, "console-phone.png");

    proxy.cut(true);
    tab.until(&begins("link", "No connection"));
    click(&mut tab, "spare");
    tab.until("document.getElementById('said').textContent.includes('not sent')");
    proxy.cut(false);
    tab.until(&reads("link", "Connected"));
    tab.until(&reads("name", "Bo"));
    bo.nothing_else();
    click(&mut tab, "spare");
    assert_eq!(bo.ordered(), Command::Spare { on: true });
    tab.until(&pressed("spare", true));
    let drawn = tab.until("Number(document.getElementById('picture').dataset.drawn)");
    tab.until(&format!(
        "Number(document.getElementById('picture').dataset.drawn) > {drawn}"
    ));

    // Another browser is let in with a code that the page shows.
    click(&mut tab, "invite");
    let other = tab.until("document.getElementById('invitation-code').textContent");
    assert_eq!(
        crate::client::enter(hub.address(), other.as_str().unwrap()).status,
        204
    );
    click(&mut tab, "invitation-close");
    no_complaints(&mut tab);
    // The code that was used does not let anyone in again.
    click(&mut tab, "leave");
    tab.until("!document.getElementById('entry').hidden && document.activeElement.id === 'code'");
    tab.type_in(&code);
    tab.press(&["Enter"]);
    tab.until(&begins("entry-said", "This code is wrong"));
    ada.nothing_else();
}

/// After its opening and an order the page shows no English sentence of its table where it is in another language, and it says the end
/// in that language. Not checked: single words, which the student's program may also say; texts with holes; and what only other events
/// show.
#[test]
fn the_page_speaks_the_language_of_its_hub() {
    let english: serde_json::Value =
        serde_json::from_str(include_str!("../../src/page/texts/en.json")).unwrap();
    let english: Vec<&str> = english
        .as_object()
        .unwrap()
        .values()
        .filter_map(|it| it.as_str())
        .filter(|it| it.contains(' ') && !it.contains('{'))
        .collect();
    for (language, end) in [("de", "Die Sitzung ist beendet."), ("zh", "实验已结束。")] {
        let Some((_folder, hub, [student], mut tab)) = class_of(language, ["Ada"]) else {
            return;
        };
        open(&mut tab, &hub);
        assert_eq!(tab.eval("document.documentElement.lang"), language);
        tab.until("document.querySelectorAll('.keys span').length > 0");
        click(&mut tab, "reset");
        assert_eq!(student.ordered(), Command::Reset {});
        tab.until("!('waits' in document.getElementById('reset').dataset)");
        let all = "[document.title, document.body.textContent, \
                   ...[...document.querySelectorAll('[aria-label]')].map((it) => it.getAttribute('aria-label'))].join('\\n')";
        // The scripts stand in the body too, and have no text of their own but their table.
        let script = "document.querySelector('body > script')?.remove()";
        tab.eval(script);
        let shown = tab.eval(all);
        let shown = shown.as_str().unwrap();
        for text in &english {
            assert!(!shown.contains(text), "{language}: {text}");
        }
        click(&mut tab, "end-now");
        assert_eq!(student.ordered(), Command::End {});
        tab.until(&reads("said", end));
        no_complaints(&mut tab);
    }
}

/// Presses Tab until the control has the focus, and no more often than there are controls.
fn focus(tab: &mut Tab, selector: &str) {
    for _ in 0..40 {
        if tab.eval(&format!(
            "document.activeElement.matches({})",
            json!(selector)
        )) == true
        {
            return;
        }
        tab.press(&["Tab"]);
    }
    panic!("{selector} is not reached by keyboard");
}

/// Checks that nothing is cut off or has to be scrolled to sideways.
fn fits(tab: &mut Tab) {
    let wide = tab.eval(
        "[...document.querySelectorAll('body *')].filter((part) => !part.closest('.table') && \
         part.getBoundingClientRect().right > innerWidth + 1).map((part) => part.outerHTML.slice(0, 80))",
    );
    assert_eq!(wide, json!([]));
}
