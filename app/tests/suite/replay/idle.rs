//! Idle moments are left out of the films, and the report's page finds its way in what is left.

use std::fs;

use vitriol_run::Cut;
use vitriol_tests::browser;

use super::toy::{Toy, replay_of, report_of};

/// Of eight seconds three are idle, from 1 to 4 s, and the film leaves out two and a half of them: it shows half a second of what comes
/// before. The poster is the moment that has most to see. In a browser, a moment that is shown, one that is left out, one after it, and
/// the plots' line are where the cuts say.
#[test]
fn idle_moments_are_left_out() {
    let folder = tempfile::tempdir().unwrap();
    // Frame n is of step 3 n, of 1/90 s.
    let idle = || Toy {
        idle: 89..359,
        most: 402,
        ..Toy::new(u64::MAX)
    };
    replay_of("two-flasks", folder.path(), &["--seconds", "8"], idle).unwrap();
    let report = report_of(folder.path());
    let film = report.film.unwrap();
    assert_eq!(film.frames, 240 - 75);
    let cut = |film_s, t_s| Cut { film_s, t_s };
    assert_eq!(film.cuts, [cut(0.0, 0.0), cut(1.0, 3.5)]);
    let poster = image::open(folder.path().join(film.poster.unwrap()));
    let pixel = *poster.unwrap().to_rgb8().get_pixel(480, 270);
    // Its red is the step, modulo 256.
    assert_eq!(pixel.0[0], 146);
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("Idle moments are left out: 2.5 of 8.00 s"));

    fs::write(
        folder.path().join("reader.html"),
        r##"<!doctype html><iframe src="report.html" width="1100" height="900"></iframe><script>
        const frame = document.querySelector("iframe");
        frame.onload = async () => {
          const page = frame.contentDocument;
          const film = page.querySelector("video");
          while (film.readyState < 2) await new Promise((done) => setTimeout(done, 20));
          const told = [];
          for (const t of ["0.5", "2.0", "5.0"]) {
            const seeked = new Promise((done) => (film.onseeked = done));
            frame.contentWindow.location.hash = "#t=" + t;
            await seeked;
            await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
            const { left, right, from, to } = page.querySelector(".canvas").dataset;
            const share = (page.querySelector("line.now").getAttribute("x1") - left) / (right - left);
            told.push([film.currentTime, Number(from) + share * (to - from)]);
          }
          console.log("TOLD " + JSON.stringify(told));
        };
        </script>"##,
    )
    .unwrap();
    let Some(visit) = browser::visit(&folder.path().join("reader.html")) else {
        return;
    };
    assert!(visit.console.is_empty(), "{:?}", visit.console);
    let told: Vec<[f64; 2]> = serde_json::from_str(&visit.told).unwrap();
    // Time of the film, and of the run: what is left out is shown by the first moment after it.
    for (found, expected) in told.iter().zip([[0.5, 0.5], [1.0, 3.5], [2.5, 5.0]]) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 2e-3, "{told:?}");
        }
    }
}
