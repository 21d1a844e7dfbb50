//! The page in Debian's Chromium, directed as a person would.

use std::path::PathBuf;

use serde_json::json;
use vitriol_console::{Command, Text};
use vitriol_tests::browser::Look;
use vitriol_tests::devtools::Tab;

use crate::proxy::Proxy;
use crate::student::{COLOUR, FakeStudent, hub, hub_in};

/// Whether the control with this id has the state of the student's program, `aria-pressed`.
fn pressed(id: &str, on: bool) -> String {
    format!("document.getElementById('{id}').getAttribute('aria-pressed') === '{on}'")
}

/// The browser's complaints, except those about answers that a test provokes.
fn complaints(tab: &mut Tab) -> Vec<String> {
    let mut all = tab.complaints();
    all.retain(|complaint| !complaint.contains("Failed to load resource"));
    all
}

/// Writes a picture of the page beside what tests build, for people to look at.
fn photograph(tab: &mut Tab, name: &str) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join(name), tab.picture()).unwrap();
}

#[test]
fn each_control_does_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let student = FakeStudent::in_hub(&hub, "Ada");
    let Some(mut tab) = Tab::new() else { return };
    tab.look([1280, 900], Look::Light);
    tab.go(&hub.invite().unwrap().address);
    // One headset is opened by itself, and the code is out of the address.
    tab.until("!document.getElementById('student').hidden");
    assert_eq!(tab.eval("location.hash + location.search"), "");
    tab.until("document.getElementById('name').textContent === 'Ada'");

    for (id, command, shown) in [
        ("pause", Command::Pause { on: true }, pressed("pause", true)),
        (
            "pause",
            Command::Pause { on: false },
            pressed("pause", false),
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
            "document.getElementById('said').textContent === 'From the start: done.'".into(),
        ),
    ] {
        tab.until(&format!(
            "!('waits' in document.getElementById('{id}').dataset)"
        ));
        tab.eval(&format!("document.getElementById('{id}').click()"));
        assert_eq!(student.ordered(), command);
        tab.until(&shown);
    }
    let scenes = "document.querySelectorAll('#scenes button')";
    for (choice, mark) in [
        (1, "✗ Incorrect: water into acid"),
        (2, "The paper's three flasks"),
        (0, "✓ Correct: acid into water"),
    ] {
        assert_eq!(tab.eval(&format!("{scenes}[{choice}].textContent")), mark);
        tab.eval(&format!("{scenes}[{choice}].click()"));
        assert_eq!(student.ordered(), Command::Scene { choice });
        tab.until(&format!(
            "{scenes}[{choice}].getAttribute('aria-pressed') === 'true'"
        ));
    }
    // The other order, and back; the last scene above has one, and the one of index 2 has none.
    let other = "document.getElementById('other-order')";
    for choice in [1, 0] {
        tab.until(&format!(
            "!{other}.disabled && !('waits' in {other}.dataset)"
        ));
        tab.eval(&format!("{other}.click()"));
        assert_eq!(student.ordered(), Command::Toggle {});
        tab.until(&format!(
            "{scenes}[{choice}].getAttribute('aria-pressed') === 'true'"
        ));
    }
    for (choice, disabled) in [(2, true), (0, false)] {
        tab.eval(&format!("{scenes}[{choice}].click()"));
        assert_eq!(student.ordered(), Command::Scene { choice });
        tab.until(&format!("{other}.disabled === {disabled}"));
    }
    tab.eval("{ const speed = document.getElementById('speed'); speed.value = '0.25'; speed.dispatchEvent(new Event('change')) }");
    assert_eq!(student.ordered(), Command::SlowMotion { rate: 0.25 });
    tab.eval("document.getElementById('k-v').focus()");
    tab.type_in("1.75");
    tab.press(&["Enter"]);
    assert_eq!(student.ordered(), Command::KV { value: 1.75 });
    tab.until("document.getElementById('k-v-now').textContent === '1.75'");
    tab.eval("document.getElementById('message').focus()");
    let message = "Slowly, <b>please</b>!";
    tab.type_in(message);
    tab.press(&["Enter"]);
    let text = Text::clipped(message);
    assert_eq!(student.ordered(), Command::Message { text });
    tab.until(&format!(
        "document.getElementById('shown').textContent === {}",
        json!(message)
    ));
    // What the student's program has taken leaves the field, and can be taken away; nothing else can.
    tab.until("document.getElementById('message').value === ''");
    tab.eval("document.getElementById('unsay').click()");
    let text = Text::default();
    assert_eq!(student.ordered(), Command::Message { text });
    tab.until("document.getElementById('unsay').disabled");

    // The information beside the controls.
    tab.until("document.getElementById('step').textContent === 'Step 2 of 7: Pour the acid into the water, slowly.'");
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
        tab.until(&format!(
            "document.getElementById('stream').textContent === '{codec}, 320 × 180'"
        ));
        tab.until("document.getElementById('age').textContent === 'live'");
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
    tab.eval("document.getElementById('hide').click()");
    tab.until(
        "!document.getElementById('hidden').hidden && document.getElementById('picture').hidden",
    );
    // The student's program gets the information that no page shows its pictures.
    let port_hears = "document.getElementById('stream').textContent === ''";
    tab.until(port_hears);
    tab.eval("document.getElementById('hide').click()");
    tab.until("document.getElementById('stream').textContent === 'JPEG, 320 × 180'");

    tab.eval("document.getElementById('end').click()");
    tab.eval("document.getElementById('end-not').click()");
    student.nothing_else();
    tab.eval("document.getElementById('end').click()");
    tab.eval("document.getElementById('end-now').click()");
    assert_eq!(student.ordered(), Command::End {});
    tab.until("document.getElementById('said').textContent === 'The session is over.' && document.getElementById('pause').disabled");
    assert_eq!(complaints(&mut tab), Vec::<String>::new());
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
    let folder = tempfile::tempdir().unwrap();
    let hub = hub(folder.path());
    let proxy = Proxy::new(hub.address());
    let ada = FakeStudent::in_hub(&hub, "Ada");
    let bo = FakeStudent::in_hub(&hub, "Bo");
    bo.state.lock().unwrap().incidents_of_attempt = 0;
    let Some(mut tab) = Tab::new() else { return };
    tab.look([390, 844], Look::Dark);
    let code = hub.invite().unwrap().code;
    let page = format!("http://{}/", proxy.address);
    tab.go(&format!("{page}#AAAAA-AAAAA"));
    tab.until("document.getElementById('entry-said').textContent.startsWith('This code is wrong')");
    // By keyboard alone: the code's field has the focus.
    tab.type_in(&code.to_lowercase());
    tab.press(&["Enter"]);
    tab.until("!document.getElementById('class').hidden");
    tab.until("document.querySelectorAll('#students button').length === 2");
    let card = tab.eval("document.querySelector('#students button').textContent");
    assert!(card.as_str().unwrap().contains("⚠ 1 incident"), "{card}");
    assert_eq!(
        tab.eval("document.querySelectorAll('#students .troubled').length"),
        1
    );
    fits(&mut tab);
    photograph(&mut tab, "console-class.png");
    focus(&mut tab, "[data-student='2']");
    tab.press(&["Enter"]);
    tab.until("document.getElementById('name').textContent === 'Bo' && document.getElementById('shown').textContent === 'nothing'");
    focus(&mut tab, "#pause");
    tab.press(&[" "]);
    assert_eq!(bo.ordered(), Command::Pause { on: true });
    tab.until(&pressed("pause", true));
    fits(&mut tab);
    tab.until("document.getElementById('stream').textContent !== ''");
    photograph(&mut tab, "console-phone.png");

    proxy.cut(true);
    tab.until("document.getElementById('link').textContent.startsWith('No connection')");
    tab.eval("document.getElementById('spare').click()");
    tab.until("document.getElementById('said').textContent.includes('not sent')");
    proxy.cut(false);
    tab.until("document.getElementById('link').textContent === 'Connected'");
    tab.until("document.getElementById('name').textContent === 'Bo'");
    bo.nothing_else();
    tab.eval("document.getElementById('spare').click()");
    assert_eq!(bo.ordered(), Command::Spare { on: true });
    tab.until(&pressed("spare", true));
    let drawn = tab.until("Number(document.getElementById('picture').dataset.drawn)");
    tab.until(&format!(
        "Number(document.getElementById('picture').dataset.drawn) > {drawn}"
    ));

    // Another browser is let in with a code that the page shows.
    tab.eval("document.getElementById('invite').click()");
    let other = tab.until("document.getElementById('invitation-code').textContent");
    assert_eq!(
        crate::client::enter(hub.address(), other.as_str().unwrap()).status,
        204
    );
    tab.eval("document.getElementById('invitation-close').click()");
    assert_eq!(complaints(&mut tab), Vec::<String>::new());
    // The code that was used does not let anyone in again.
    tab.eval("document.getElementById('leave').click()");
    tab.until("!document.getElementById('entry').hidden && document.activeElement.id === 'code'");
    tab.type_in(&code);
    tab.press(&["Enter"]);
    tab.until("document.getElementById('entry-said').textContent.startsWith('This code is wrong')");
    ada.nothing_else();
}

/// Nothing that the page itself says is English where it is in another language: what stands in it, and what its scripts write on
/// class, orders, readings and end. What the student's program says is of its own language.
#[test]
fn the_page_speaks_the_language_of_its_hub() {
    let english: serde_json::Value =
        serde_json::from_str(include_str!("../../src/page/texts/en.json")).unwrap();
    let english: Vec<&str> = english
        .as_object()
        .unwrap()
        .values()
        .filter_map(|it| it.as_str())
        // A single word may also be a word of what the student's program says.
        .filter(|it| it.contains(' ') && !it.contains('{'))
        .collect();
    for (language, end) in [("de", "Die Sitzung ist beendet."), ("zh", "实验已结束。")] {
        let folder = tempfile::tempdir().unwrap();
        let hub = hub_in(language, folder.path());
        let student = FakeStudent::in_hub(&hub, "Ada");
        let Some(mut tab) = Tab::new() else { return };
        tab.look([1280, 900], Look::Light);
        tab.go(&hub.invite().unwrap().address);
        tab.until("!document.getElementById('student').hidden");
        assert_eq!(tab.eval("document.documentElement.lang"), language);
        tab.until("document.querySelectorAll('.keys span').length > 0");
        tab.eval("document.getElementById('reset').click()");
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
        tab.eval("document.getElementById('end-now').click()");
        assert_eq!(student.ordered(), Command::End {});
        tab.until(&format!(
            "document.getElementById('said').textContent === '{end}'"
        ));
        assert_eq!(complaints(&mut tab), Vec::<String>::new());
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
