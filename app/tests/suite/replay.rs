//! From a track to film and report, with an experiment whose answers are known:
//! what the loop, the observer and the report make of them.

mod idle;
mod language;
pub(crate) mod toy;

use std::cell::Cell;
use std::fs;
use std::path::Path;

use vitriol::command::replay::run;
use vitriol::report::Report;
use vitriol_run::{Action, Colour, Experiment, Failure, Format, Setup};

use toy::{FLASK, Toy, asked, events, replay, replay_of, report_of};
use vitriol_lesson::{Attempt, Event, Rubric, Texts};
use vitriol_record::store::Store;
use vitriol_sim::scene::PictureRoom;
use vitriol_tests::browser::{self, Look};
use vitriol_xr::track::{Existing, save};

/// What was found is in report, table and page; under a pseudonym it is kept, and what is kept already is not kept twice.
#[test]
fn what_was_found_is_kept_under_a_pseudonym() {
    let folder = tempfile::tempdir().unwrap();
    let class = folder.path().join("class.db");
    let track = folder.path().join("recorded.mcap");
    let built_in = vitriol_run::track::load("two-flasks").unwrap();
    save(&built_in, &track, Existing::Refuse).unwrap();
    let kept = ["--pseudonym", "p07", "--class", class.to_str().unwrap()];
    for (name, more, attempts) in [("a", &[][..], 0), ("b", &kept, 1), ("c", &kept, 1)] {
        let out = folder.path().join(name);
        let options = [&["--no-video"], more].concat();
        let finds = || Toy {
            finds: Box::new(events),
            instructions: vec![(0.5, Action::Message("Slowly <please>".into()))],
            ..Toy::new(u64::MAX)
        };
        replay_of(track.to_str().unwrap(), &out, &options, finds).unwrap();
        let report = report_of(&out);
        assert_eq!(report.attempts.len(), 1);
        assert_eq!(report.attempts[0].incidents.len(), 1);
        assert_eq!(report.score.len(), 1);
        let page = fs::read_to_string(out.join("report.html")).unwrap();
        assert!(page.contains("What happened") && page.contains("the wrong order"));
        assert_eq!(report.instructor[0].t_s, 0.5);
        assert!(page.contains("Your instructor: Slowly &lt;please&gt;"));
        let table = fs::read_to_string(out.join("incidents.csv")).unwrap();
        assert!(
            table.lines().count() == 2 && table.contains("water-into-acid"),
            "{table}"
        );
        assert!(table.starts_with('\u{feff}'), "{table}");
        assert_eq!(class.exists(), attempts > 0);
        let statements = fs::read_to_string(out.join("statements.jsonl"));
        assert_eq!(statements.is_ok(), attempts > 0);
        if attempts > 0 {
            // Named by the pseudonym alone.
            let statements = statements.unwrap();
            assert!(
                statements.lines().all(|line| line.contains("\"p07\"")),
                "{statements}"
            );
            // What is forgotten is counted: of a copy, since the next call is to find what is kept.
            let copy = folder.path().join("copy.db");
            fs::copy(&class, &copy).unwrap();
            let mut store = Store::open_existing(&copy).unwrap();
            let forgotten = store.forget(&"p07".parse().unwrap()).unwrap();
            assert_eq!(forgotten.attempts, attempts);
        }
    }
}

/// What is kept is what was recorded, and not what somebody asks for instead.
#[test]
fn what_is_asked_for_otherwise_is_not_kept() {
    let folder = tempfile::tempdir().unwrap();
    let class = folder.path().join("class.db");
    let options = [
        "--no-video",
        "--seconds",
        "1",
        "--pseudonym",
        "p07",
        "--class",
    ];
    let options = [&options[..], &[class.to_str().unwrap()]].concat();
    let error = replay(&folder.path().join("out"), &options, u64::MAX).unwrap_err();
    assert!(
        matches!(error, Failure::Input(_)) && error.to_string().contains("--seconds"),
        "{error}"
    );
    assert!(!class.exists());
}

/// A report names what makes its run again, for the command line and for `vitriol export`.
#[test]
fn glass_that_was_to_break_is_in_the_report() {
    let folder = tempfile::tempdir().unwrap();
    for (more, breaks) in [(&["--breakable"][..], true), (&[], false)] {
        let out = folder.path().join(format!("{breaks}"));
        let options = [&["--seconds", "0.1", "--no-video"], more].concat();
        replay(&out, &options, u64::MAX).unwrap();
        let report = report_of(&out);
        assert_eq!(report.command.contains(" --breakable"), breaks);
        assert_eq!(report.asked.unwrap().breakable, breaks);
    }
}

#[test]
fn numbers_come_through() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/out");
    // A tenth of a frame over two seconds: one step more.
    replay(&out, &["--seconds", "2.001", "--no-video"], u64::MAX).unwrap();
    let report = report_of(&out);
    assert_eq!(report.frames, 181);
    // 181 steps of 1/90 s, in whole nanoseconds.
    assert_eq!(report.simulated_s, 2.011_111_111);
    assert_eq!(report.state_hash, "00000000feedf00d");
    assert!(report.film.is_none());
    assert_eq!(
        report.command,
        "vitriol replay two-flasks --preset balanced --seed 1 --seconds 2.001 --no-video"
    );
    // 0.0, 0.1, … 2.0 s and the end.
    assert_eq!(report.series.len(), 22);
    assert_eq!(report.series[7].t_s, 0.7);
    let last = report.series.last().unwrap();
    assert_eq!(last.t_s, report.simulated_s);
    assert_eq!(report.mass_kg, last.mass_kg);
    let worst = report.series[1..].iter().map(|s| s.density_error_p99);
    assert_eq!(report.density_error_p99, worst.fold(0.0, f64::max));
    assert!((report.mass_kg.total() - 0.217).abs() < 1e-12);
}

/// A film is drawn in the room that is asked for, and its report's command asks for it again.
#[test]
fn the_room_of_a_film_is_asked_for_again() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("dark");
    let room = Cell::new(None);
    let line = [
        "vitriol",
        "replay",
        "two-flasks",
        "--room",
        "dark",
        "--seconds",
        "0.1",
        "--out",
    ];
    let line = line.into_iter().chain([out.to_str().unwrap()]);
    run(&asked(line), Format::Json, |setup| {
        room.set(setup.room);
        Ok(Box::new(Toy::new(u64::MAX)))
    })
    .unwrap();
    assert_eq!(room.get(), Some(PictureRoom::Dark));
    let command = report_of(&out).command;
    assert!(command.contains(" --room dark"), "{command}");
}

#[test]
fn an_earlier_run_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let more = ["--seconds", "0.1", "--no-video"];
    replay(folder.path(), &more, u64::MAX).unwrap();
    let before = fs::read(folder.path().join("report.json")).unwrap();
    let refused = replay(folder.path(), &more, u64::MAX).unwrap_err();
    assert_eq!(refused.exit_code(), 2);
    let message = refused.to_string();
    assert!(
        message.contains("--out") && message.contains("report.json"),
        "{message}"
    );
    assert_eq!(fs::read(folder.path().join("report.json")).unwrap(), before);
}

#[test]
fn a_run_longer_than_its_track_holds_the_last_pose() {
    let folder = tempfile::tempdir().unwrap();
    // The toy checks the steps; the track is shorter.
    replay(folder.path(), &["--seconds", "60", "--no-video"], u64::MAX).unwrap();
    assert_eq!(report_of(folder.path()).frames, 5400);
}

#[test]
fn a_scene_with_heat_has_two_films_and_its_chemistry() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let hot = |setup: &Setup<'_>| {
        assert_eq!(setup.colours, [Colour::Liquid, Colour::Temperature]);
        let toy = Toy {
            hot: true,
            ..Toy::new(u64::MAX)
        };
        Ok(Box::new(toy) as Box<dyn Experiment>)
    };
    let arguments = "vitriol replay two-flasks --scene water-into-acid --seconds 4 --out";
    let arguments = arguments.split(' ').chain([out.to_str().unwrap()]);
    let args = asked(arguments);
    run(&args, Format::Json, hot).unwrap();
    let report = report_of(&out);
    let films = [report.film.clone(), report.film_temperature.clone()].map(Option::unwrap);
    let coloured = films.each_ref().map(|film| film.colour.as_str());
    assert_eq!(coloured, ["liquid", "temperature"]);
    for film in films {
        assert_eq!(film.frames, 120);
        assert!(fs::metadata(out.join(&film.path)).unwrap().len() > 1000);
    }
    // 2.1, 2.2, … 4.0 s of 90 particles.
    let boiling = &report.boiling_particle_seconds;
    assert!((boiling[FLASK] - 90.0 * 2.0).abs() < 9.01, "{boiling:?}");
    assert_eq!(boiling["erlenmeyer"], 0.0);
    // 10 mg of steam a second, 1.7 m³ a kilogram, through the 50 cm² of the hotter flask.
    let violent = report.boiling;
    assert!((violent.most_steam_m_s.unwrap() - 0.003_399).abs() < 1e-6);
    assert!((violent.most_gas_m3.unwrap() - 8e-6).abs() < 1e-9);
    assert!((violent.highest_drop_m.unwrap() - 0.12).abs() < 1e-6);
    // Nothing was found to be poured.
    assert!(violent.thrown_first_kg.is_none());
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert_eq!(page.matches("<video").count(), 2);
    // Films are heard: each has a track of Opus, and no player is told to be silent.
    assert!(!page.contains("muted"));
    for film in ["film.mp4", "film-temperature.mp4"] {
        let bytes = fs::read(out.join(film)).unwrap();
        assert!(bytes.windows(4).any(|word| word == b"dOps"), "{film}");
    }
    for part in [
        "film-temperature.mp4",
        "Coloured by temperature",
        "120.0 °C",
        "Above the boiling point",
        "foam at the surface",
        "evaporated",
        "Most steam through the surface",
        "0.34\u{a0}cm/s",
        "8.0\u{a0}mL",
        "12\u{a0}cm",
    ] {
        assert!(page.contains(part), "{part} is missing");
    }
    // Refused as a whole, since one of its films is there.
    fs::remove_file(out.join("report.json")).unwrap();
    fs::remove_file(out.join("report.html")).unwrap();
    fs::remove_file(out.join("film.mp4")).unwrap();
    let refused = run(&args, Format::Json, hot).unwrap_err();
    assert!(refused.to_string().contains("film-temperature.mp4"));
    if let Some(keep) = std::env::var_os("VITRIOL_KEEP_PICTURES") {
        fs::write(out.join("report.html"), page).unwrap();
        let picture = Path::new(&keep).join("heat.png");
        browser::photograph(&out.join("report.html"), 1200, Look::Light, &picture).unwrap();
    }
}

#[test]
fn a_failed_run_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for fails_at in [50, 0] {
        let failure = replay(&out, &["--seconds", "1"], fails_at).unwrap_err();
        assert_eq!(failure.to_string(), "the device was lost");
        assert_eq!(failure.exit_code(), 1);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

/// The report of a run in which a student did what the lesson's own tests have: water into acid, then acid into water. The acid's
/// flask has a name that breaks a page which does not escape it.
fn told(mut report: Report) -> (Report, String) {
    let events = include_str!("../../../run/lesson/tests/events.json");
    let events = events.replace("\"target\"", &serde_json::to_string(FLASK).unwrap());
    let events: Vec<Event> = serde_json::from_str(&events).unwrap();
    report.attempts = Attempt::all(events);
    let texts = Texts::english().unwrap();
    report.judge(&Rubric::default(), &texts);
    let page = report.to_html(&texts);
    (report, page)
}

#[test]
fn a_report_of_attempts_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    replay(folder.path(), &["--seconds", "0.1", "--no-video"], u64::MAX).unwrap();
    let plain = report_of(folder.path());
    let json = serde_json::to_value(&plain).unwrap();
    // Where nobody looked, nothing is said, and readers of older reports see what they know.
    assert!(json.get("attempts").is_none() && json.get("score").is_none());
    assert!(json.get("boiling").is_none());
    assert!(!folder.path().join("incidents.csv").exists());
    let page = plain.to_html(&Texts::english().unwrap());
    assert!(page.contains("<details class=\"solver\" open") && !page.contains("What happened"));

    let (report, page) = told(plain);
    let json = serde_json::to_string(&report).unwrap();
    assert_eq!(serde_json::from_str::<Report>(&json).unwrap(), report);
    // Without a film there is nothing to go to.
    assert!(page.contains("What happened") && !page.contains("href=\"#t="));
    assert!(page.contains("<span class=\"moment\">1.9\u{a0}s</span>"));
    assert!(page.contains("id=\"score-1\""));

    // Of what cannot be judged there is no table of points.
    let mut idle = report;
    let texts = Texts::english().unwrap();
    idle.attempts[0].pours.clear();
    idle.attempts[0].incidents.clear();
    idle.judge(&Rubric::default(), &texts);
    let page = idle.to_html(&texts);
    assert!(page.contains("No points") && !page.contains("id=\"score-1\""));
}

#[test]
fn the_report_reads_in_a_browser() {
    let folder = tempfile::tempdir().unwrap();
    replay(folder.path(), &[], u64::MAX).unwrap();
    let report = report_of(folder.path());
    let film = report.film.clone().unwrap();
    assert_eq!(
        film.frames,
        (report.simulated_s * 30.0 - 1e-6).ceil() as u64
    );

    let (report, page) = told(report);
    fs::write(folder.path().join("report.html"), page).unwrap();
    fs::write(
        folder.path().join("reader.html"),
        r##"<!doctype html><iframe src="report.html#t=1.2" width="1100" height="900"></iframe><script>
        const frame = document.querySelector("iframe");
        frame.onload = async () => {
          const page = frame.contentDocument;
          const film = page.querySelector("video");
          while (film.readyState < 2) await new Promise((done) => setTimeout(done, 20));
          const fragment = film.currentTime;
          const after = async (act) => {
            const seeked = new Promise((done) => (film.onseeked = done));
            act();
            await seeked;
            return film.currentTime;
          };
          // What a browser does for a link that has the focus when Enter is pressed, or a finger taps it.
          const link = page.querySelector(".said a.moment");
          link.focus();
          const focused = page.activeElement === link;
          const first = await after(() => link.click());
          await after(() => (film.currentTime = 0.5));
          const again = await after(() => link.click());
          const address = frame.contentWindow.location.hash;
          const other = await after(() => (frame.contentWindow.location.hash = "#t=3.3"));
          const moments = [...page.querySelectorAll("a.moment")].map((it) => [it.textContent, it.hash]);

          const details = page.querySelector("details");
          const folded = !page.body.innerText.includes("Limiter: max neighbours");
          details.querySelector("summary").focus();
          const summary = page.activeElement.tagName;
          details.querySelector("summary").click();
          await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
          const canvas = page.querySelector(".canvas");
          const box = canvas.querySelector("svg").getBoundingClientRect();
          const points = canvas.querySelector("polyline[stroke='#0072B2']").getAttribute("points").trim();
          const ends = points.split(/\s+/).map((pair) => Number(pair.split(",")[0]));
          const middle = (ends[0] + ends.at(-1)) / 2;
          const x = box.left + (middle / canvas.querySelector("svg").viewBox.baseVal.width) * box.width;
          const point = { clientX: x, clientY: box.top + 50, bubbles: true };
          await after(() => canvas.dispatchEvent(new MouseEvent("click", point)));
          const marks = [...page.querySelectorAll("line.now")];
          console.log("TOLD " + JSON.stringify({
            fragment, focused, first, again, address, other, moments, folded, summary,
            open: details.open,
            text: page.body.innerText,
            values: Object.fromEntries([...page.querySelectorAll("[data-key]")].map((e) => [e.dataset.key, e.textContent])),
            plots: page.querySelectorAll(".canvas svg").length,
            duration: film.duration,
            at: film.currentTime,
            marks: marks.map((mark) => Number(mark.getAttribute("x1")) - middle),
            wide: page.documentElement.scrollWidth - page.documentElement.clientWidth,
          }));
        };
        </script>"##,
    )
    .unwrap();
    let Some(visit) = browser::visit(&folder.path().join("reader.html")) else {
        return;
    };
    assert!(visit.console.is_empty(), "{:?}", visit.console);
    let told: serde_json::Value = serde_json::from_str(&visit.told).unwrap();
    let value = |key: &str| told["values"][key].as_str().unwrap();
    assert_eq!(value("lost_particles"), "0");
    let mean = format!("{:.2} %", report.density_error_mean * 100.0);
    assert_eq!(value("density_error_mean"), mean);
    // And what has left the flasks, and what is spilled.
    assert_eq!(told["plots"], 6);
    assert_eq!(told["wide"], 0, "nothing sticks out sideways");
    let duration = told["duration"].as_f64().unwrap();
    assert!((duration - film.frames as f64 / 30.0).abs() < 2e-3);
    // The address's end, a link once and again, and a fragment that is typed: all go to their moment, up to the rounding of a film's
    // clock.
    for (key, moment) in [
        ("fragment", 1.2),
        ("first", 1.9),
        ("again", 1.9),
        ("other", 3.3),
    ] {
        let at = told[key].as_f64().unwrap();
        assert!((at - moment).abs() < 1e-3, "{key}: {at}");
    }
    assert_eq!(told["address"], "#t=1.900");
    // Links and the fold are reached and worked by keyboard, since a browser's own are.
    assert_eq!(
        (&told["focused"], &told["summary"]),
        (&true.into(), &"SUMMARY".into())
    );
    assert_eq!(
        (&told["folded"], &told["open"]),
        (&true.into(), &true.into())
    );
    // Each incident of the words, and each that points are withheld for, says its moment and goes there.
    let incidents = report.attempts.iter().flat_map(|it| &it.incidents);
    for incident in incidents {
        let link = serde_json::json!([
            format!("{:.1}\u{a0}s", incident.t_s),
            format!("#t={:.3}", incident.t_s)
        ]);
        assert!(
            told["moments"].as_array().unwrap().contains(&link),
            "{link}"
        );
    }
    // A click in a plot's middle is the run's middle, up to a pixel.
    let at = told["at"].as_f64().unwrap();
    assert!((at - report.simulated_s / 2.0).abs() < 0.03, "{at}");
    for mark in told["marks"].as_array().unwrap() {
        assert!(mark.as_f64().unwrap().abs() < 3.0, "{told}");
    }
    let text = told["text"].as_str().unwrap();
    for part in [
        FLASK,
        "Toy & Sons",
        "2.50 mm",
        "Limiter: max neighbours",
        "00000000feedf00d",
        &report.command,
        "11 of 100 points",
        "At most 40 of 100 points: water was poured into acid.",
        "99 of 100 points",
        "Water was poured into concentrated acid",
        "The beaker with 98\u{a0}% acid boiled over and threw out: 3.4\u{a0}mL of 71\u{a0}% acid.",
    ] {
        assert!(text.contains(part), "{part} is missing in {text}");
    }

    if let Some(keep) = std::env::var_os("VITRIOL_KEEP_PICTURES") {
        let page = folder.path().join("report.html");
        for (look, name) in [(Look::Light, "light.png"), (Look::Dark, "dark.png")] {
            let picture = Path::new(&keep).join(name);
            browser::photograph(&page, 1280, look, &picture).unwrap();
            let picture = Path::new(&keep).join(format!("phone-{name}"));
            browser::photograph(&page, 390, look, &picture).unwrap();
        }
    }
}
