//! The live view from close to the glass: on the page, and over a connection to a distant hub.

use vitriol_console::{Codec, Link, Student, Watcher};
use vitriol_tests::devtools::Tab;
use vitriol_tests::wait::until;

use crate::look::{at, class_of, click, no_complaints, open, pressed, reads};
use crate::student::{CLOSE_COLOUR, COLOUR, FakeStudent, card, hub};

/// Waits until the middle of the live view has that colour, which the codecs keep within a few steps of 255.
fn shows(tab: &mut Tab, colour: [u8; 3]) {
    tab.until(&format!(
        "(() => {{ const c = {}, copy = new OffscreenCanvas(1, 1).getContext('2d'); \
         copy.drawImage(c, -c.width / 2, -c.height / 2); \
         const pixel = copy.getImageData(0, 0, 1, 1).data; \
         return pixel[3] === 255 && {colour:?}.every((value, at) => Math.abs(pixel[at] - value) <= 12) }})()",
        at("picture")
    ));
}

#[test]
fn a_button_changes_between_the_students_view_and_the_glass() {
    let Some((_folder, hub, [_ada], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    open(&mut tab, &hub);
    shows(&mut tab, COLOUR);
    tab.until(&reads("stream", "H.264, 320 × 180"));
    // By keyboard, as any button.
    tab.eval(&format!("{}.focus()", at("close-up")));
    tab.press(&["Enter"]);
    tab.until(&pressed("close-up", true));
    shows(&mut tab, CLOSE_COLOUR);
    tab.until(&reads("stream", "JPEG, 320 × 180"));
    let label = format!("{}.getAttribute('aria-label')", at("picture"));
    assert_eq!(tab.eval(&label), "The glass, seen from close by");
    click(&mut tab, "close-up");
    tab.until(&pressed("close-up", false));
    shows(&mut tab, COLOUR);
    assert_eq!(tab.eval(&label), "What the student sees");
    no_complaints(&mut tab);
}

/// A program that has no second camera is not asked for its pictures, and the page shows its student's view.
#[test]
fn a_program_without_the_camera_is_shown_as_before() {
    let Some((_folder, hub, [_ada], mut tab)) = class_of("en", ["Ada"]) else {
        return;
    };
    let plain = Student {
        close_up: false,
        ..card("Bo")
    };
    let port = hub.student(plain).unwrap().unwrap();
    let _bo = FakeStudent::new(port.clone());
    tab.go(&hub.invite().unwrap().address);
    let card = |student: u32| format!("document.querySelector('[data-student=\"{student}\"]')");
    tab.until(&format!("{} !== null", card(2)));
    tab.eval(&format!("{}.click()", card(1)));
    tab.until(&reads("name", "Ada"));
    click(&mut tab, "close-up");
    shows(&mut tab, CLOSE_COLOUR);
    click(&mut tab, "to-class");
    tab.eval(&format!("{}.click()", card(2)));
    tab.until(&reads("name", "Bo"));
    shows(&mut tab, COLOUR);
    assert_eq!(tab.eval(&format!("{}.hidden", at("close-up"))), true);
    let wanted = port.wanted();
    assert!(wanted.h264 && !wanted.close_up, "{wanted:?}");
    no_complaints(&mut tab);
}

/// A page that asks for the glass gets its pictures alone, and the program is asked for them for as long as the page is there.
#[test]
fn a_page_that_asks_gets_the_other_camera() {
    let (_folder, hub) = hub();
    let port = hub.student(card("Ada")).unwrap().unwrap();
    let _ada = FakeStudent::new(port.clone());
    assert!(!port.wanted().close_up);
    let see = |codec| {
        let mut page = Watcher::enter(&hub, codec).unwrap();
        // Before it shows the student it shows the class, with a card's picture.
        let mark = loop {
            match page.see().unwrap()[0] {
                3 => {}
                mark => break mark,
            }
        };
        (mark, port.wanted().close_up, page)
    };
    let (mark, wanted, page) = see(Codec::Jpeg);
    assert_eq!((mark, wanted), (2, false));
    let (mark, wanted, close) = see(Codec::CloseUp);
    assert_eq!((mark, wanted), (4, true));
    drop(close);
    until("no page shows the glass", || {
        (!port.wanted().close_up).then_some(())
    });
    assert!(port.wanted().jpeg);
    drop(page);
}

/// As [`a_page_that_asks_gets_the_other_camera`], of a program that dials in, while another page shows the student's view.
#[test]
fn a_distant_program_is_asked_too() {
    let folder = tempfile::tempdir().unwrap();
    let hub = crate::distant::hub(folder.path(), 0);
    let link = Link::start(hub.students().unwrap().clone(), card("Ada")).unwrap();
    let _ada = FakeStudent::new(link.port().clone());
    until("the hub has it", || {
        (hub.counts().students == 1).then_some(())
    });
    let Some(mut tab) = Tab::new() else { return };
    tab.go(&hub.invite().unwrap().address);
    tab.until(&reads("name", "Ada"));
    shows(&mut tab, COLOUR);
    click(&mut tab, "close-up");
    shows(&mut tab, CLOSE_COLOUR);
    until("the student's view is not coded", || {
        (!link.port().wanted().h264).then_some(())
    });
    no_complaints(&mut tab);
}
