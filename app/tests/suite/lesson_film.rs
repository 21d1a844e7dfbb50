//! A lesson's film, made by the program.

use std::fs;

use crate::VITRIOL;
use vitriol_lesson::{Language, Lesson};

/// A third of a second in which nobody does anything.
const KEYFRAMES: &str = r#"
name = "still"
scene = "acid-into-water"
duration = 0.3
head = [{ t = 0.0, position = [0.0, 1.2, 0.0] }]
"#;

fn count(bytes: &[u8], part: &[u8]) -> usize {
    bytes.windows(part.len()).filter(|it| *it == part).count()
}

/// The film has a track of text in each of the lesson's languages, of which it shows the one that was asked for; a file that is there
/// stays, and a failure leaves none.
#[test]
fn a_lesson_has_a_film_with_subtitles() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("still.toml"), KEYFRAMES).unwrap();
    let made = VITRIOL.run(here, "track still.toml -o still.mcap");
    assert!(made.status.success());

    let line =
        "lesson dilute --film films/dilute.mp4 --track still.mcap --preset fast --language zh";
    let told = VITRIOL.object(here, line);
    assert_eq!(told["verdict"]["points"], 0, "{told}");
    assert_eq!(told["subtitles"].as_array().unwrap().len(), 4);

    let path = here.join("films/dilute.mp4");
    let film = fs::read(&path).unwrap();
    assert_eq!(count(&film, b"sbtl"), 4);
    let lesson = Lesson::builtin("dilute").unwrap();
    for language in Language::ALL {
        let title = &lesson.texts(language).title;
        assert!(count(&film, title.as_bytes()) > 0, "{language}: {title}");
    }

    VITRIOL.refuses(here, line, &["dilute.mp4", "not overwritten"]);
    assert!(fs::read(&path).unwrap() == film);

    let nowhere = "lesson dilute --film other/none.mp4 --track none";
    VITRIOL.refuses(here, nowhere, &[]);
    // One that is made for another scene is filmed all the same, and is told; no device of that name makes the film here.
    let elsewhere =
        "lesson wrong-order-hot --film other/none.mp4 --track still.mcap --device Voodoo";
    let none = VITRIOL.run(here, elsewhere);
    assert!(!none.status.success());
    let said = String::from_utf8(none.stderr).unwrap();
    assert!(
        said.contains("still.mcap: the track was made in the scene acid-into-water"),
        "{said}"
    );
    // No built-in track is made for its scene.
    let own = VITRIOL.run(here, "lesson wrong-order-hot --toml");
    let own = String::from_utf8(own.stdout).unwrap();
    let elsewhere = own.replace("scene = \"hot-acid\"", "scene = \"hot-acid-85\"");
    fs::write(here.join("own.toml"), elsewhere).unwrap();
    let line = "lesson own.toml --film other/none.mp4";
    VITRIOL.refuses(here, line, &["--track", "hot-acid-85"]);
    assert!(!here.join("other").exists());
}
