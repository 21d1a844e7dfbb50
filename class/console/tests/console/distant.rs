//! Students' programs that dial out to a hub, over HTTPS.

use vitriol_console::{Command, Config, Hub, HubAddress, Link, LinkStatus};
use vitriol_tests::devtools::Tab;
use vitriol_tests::wait::until;

use crate::student::{FakeStudent, card};

pub fn hub(folder: &std::path::Path, port: u16) -> Hub {
    let config = Config {
        listen: ([127, 0, 0, 1], port).into(),
        always_tls: true,
        folder: folder.to_owned(),
        names: Vec::new(),
        language: "en",
    };
    // The port of a hub that has just ended may not be free at once.
    until("the hub listens", || Hub::start(config.clone()).ok())
}

fn lost(link: &Link, why: &str) {
    until(why, || match link.status() {
        LinkStatus::Lost(cause) if cause.contains(why) => Some(()),
        _ => None,
    });
}

#[test]
fn another_hub_and_another_key_are_refused() {
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let hubs = folders.each_ref().map(|folder| hub(folder.path(), 0));
    let [one, two] = hubs
        .each_ref()
        .map(|hub| hub.students().unwrap().to_string());
    let parts = |text: &str| -> [String; 3] {
        let (host, rest) = text.split_once('#').unwrap();
        let (fingerprint, key) = rest.split_once('.').unwrap();
        [host, fingerprint, key].map(str::to_owned)
    };
    let ([host, fingerprint, _], [_, other, key]) = (parts(&one), parts(&two));
    let dial = |fingerprint: &str, key: &str| {
        let address: HubAddress = format!("{host}#{fingerprint}.{key}").parse().unwrap();
        Link::start(address, card("Ada")).unwrap()
    };
    // Each reason names who was asked.
    let of = |why: &str| format!("{host}: {why}");
    let other_hub = of("this is not the hub whose fingerprint");
    lost(&dial(&other, &key), &other_hub);
    let other_key = of("the hub refuses this program's key (403)");
    lost(&dial(&fingerprint, &key), &other_key);
    assert_eq!(hubs[0].counts().students, 0);
    let shown = hubs[0].fingerprint().unwrap().to_string();
    assert_eq!(shown.replace(':', "").to_lowercase(), fingerprint);
}

#[test]
fn a_distant_student_is_seen_and_directed_and_found_again() {
    let folder = tempfile::tempdir().unwrap();
    let first = hub(folder.path(), 0);
    let port = first.address().port();
    let link = Link::start(first.students().unwrap().clone(), card("Ada")).unwrap();
    let student = FakeStudent::new(link.port().clone());
    until("it is connected", || {
        (link.status() == LinkStatus::Connected).then_some(())
    });
    until("the hub has it", || {
        (first.counts().students == 1).then_some(())
    });
    // Another hub with the same certificate, after a computer was started anew.
    drop(first);
    lost(&link, "");
    let hub = hub(folder.path(), port);
    until("it is found again", || {
        (hub.counts().students == 1).then_some(())
    });

    let Some(mut tab) = Tab::new() else { return };
    let address = hub.invite().unwrap().address;
    assert!(address.starts_with("https://127.0.0.1:"), "{address}");
    tab.go(&address);
    tab.until("document.getElementById('name').textContent === 'Ada'");
    let protocol = "performance.getEntriesByType('navigation')[0].nextHopProtocol";
    assert_eq!(tab.eval(protocol), "http/1.1");
    assert_eq!(tab.eval("document.cookie"), "", "no script has the cookie");
    tab.until("document.getElementById('stream').textContent === 'H.264, 320 × 180'");
    tab.until("document.getElementById('step').textContent.startsWith('Step 2 of 7')");
    tab.eval("document.getElementById('pause').click()");
    assert_eq!(student.ordered(), Command::Pause { on: true });
    tab.until("document.getElementById('said').textContent === 'Pause: done.'");
    assert_eq!(tab.complaints(), Vec::<String>::new());
    // No page shows the student: no picture is coded.
    tab.go("about:blank");
    until("no picture is wanted", || {
        (!link.port().wanted().h264).then_some(())
    });
    drop(student);
    drop(link);
    until("the hub has it no more", || {
        (hub.counts().students == 0).then_some(())
    });
}
