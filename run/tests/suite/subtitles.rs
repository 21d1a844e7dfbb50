//! A film's subtitles, read by a reader of 3GPP TS 26.245 of its own.

use std::fs;
use std::path::Path;

use vitriol_run::{Cue, Film, FilmError, Subtitles, SubtitlesError};

use crate::mp4::{Track, body, number, tracks};

const FPS: u32 = 10;
/// 4 s.
const FRAMES: u32 = 40;

/// Texts of a track, each from when until when, s.
fn texts(track: &Track) -> Vec<(f64, f64, String)> {
    let seconds = |units: u32| f64::from(units) / f64::from(track.units);
    let each = track.samples.iter().map(|(from, lasts, bytes)| {
        let length = usize::from(u16::from_be_bytes(bytes[..2].try_into().unwrap()));
        let text = std::str::from_utf8(&bytes[2..2 + length]).unwrap();
        (seconds(*from), seconds(from + lasts), text.to_owned())
    });
    each.filter(|(.., text)| !text.is_empty()).collect()
}

/// A film of noise, with sound.
fn film(path: &Path) -> Film {
    let mut film = Film::with_sound(path, [64, 48], FPS).unwrap();
    for frame in 0..FRAMES {
        let level = |at: u32| (at.wrapping_mul(2_654_435_761).wrapping_add(frame) >> 24) as u8;
        let picture: Vec<u8> = (0..64 * 48 * 4).map(level).collect();
        film.push_rgba(&picture).unwrap();
        film.push_sound(&vec![[0.1, -0.1]; 48_000 / FPS as usize])
            .unwrap();
    }
    film
}

fn cue(from_s: f64, until_s: f64, text: &str) -> Cue {
    Cue {
        from_s,
        until_s,
        text: text.into(),
    }
}

const TEXTS: [(&[u8; 3], &str, &str); 4] = [
    (b"eng", "Lift the beaker", "Pour slowly"),
    (b"deu", "Heb das Becherglas", "Gieß langsam – 5 mL/s"),
    (b"spa", "Levanta el vaso", "¿Despacio?\nVierte en el centro"),
    (b"zho", "拿起烧杯", "缓慢倾倒"),
];

fn in_four_languages() -> Vec<Subtitles> {
    let one = |(language, first, second): &(&[u8; 3], &str, &str)| Subtitles {
        language: **language,
        shown: **language == *b"deu",
        cues: vec![
            cue(0.5, 1.25, first),
            cue(1.25, 1.25, "never seen"),
            // Longer than the film.
            cue(2.0, 9.0, second),
        ],
    };
    TEXTS.iter().map(one).collect()
}

#[test]
fn each_language_has_a_track_and_each_text_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    film(&path).finish_with(&in_four_languages()).unwrap();
    let film = tracks(&fs::read(&path).unwrap());

    let added = &film[2..];
    assert_eq!(added.len(), TEXTS.len());
    for (track, (language, first, second)) in added.iter().zip(TEXTS) {
        assert_eq!(track.language.as_bytes(), language);
        assert_eq!(track.handler, "sbtl");
        assert_eq!(track.enabled, language == b"deu");
        let said = [(0.5, 1.25, first.into()), (2.0, 4.0, second.into())];
        assert_eq!(texts(track), said);
        assert_eq!(track.length, 4000);
    }
    let ids: Vec<u32> = film.iter().map(|track| track.id).collect();
    assert_eq!(ids, [1, 2, 3, 4, 5, 6]);
    let next = fs::read(&path).unwrap();
    let header = body(&next, &["moov", "mvhd"]);
    assert_eq!(number(header, header.len() - 4), 7);
}

/// Pictures and sound are the same with subtitles, and no file is left beside the film.
#[test]
fn pictures_and_sound_stay_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let [plain, with] = ["plain.mp4", "with.mp4"].map(|name| folder.path().join(name));
    film(&plain).finish().unwrap();
    film(&with).finish_with(&in_four_languages()).unwrap();
    let [plain, with] = [plain, with].map(|path| tracks(&fs::read(path).unwrap()));
    assert_eq!(plain.len(), 2);
    assert_eq!(plain[0].samples.len(), FRAMES as usize);
    assert!(plain[..] == with[..2]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn what_cannot_be_said_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    let refused = |language: &[u8; 3], cues: Vec<Cue>| {
        let texts = Subtitles {
            language: *language,
            shown: true,
            cues,
        };
        match film(&path).finish_with(&[texts]).unwrap_err() {
            FilmError::Subtitles(error) => error,
            other => panic!("{other}"),
        }
    };
    let order = refused(b"eng", vec![cue(0.0, 2.0, "a"), cue(1.0, 3.0, "b")]);
    assert!(matches!(order, SubtitlesError::Order { before_s: 2.0, .. }));
    let order = refused(b"eng", vec![cue(f64::NAN, 2.0, "a")]);
    assert!(matches!(order, SubtitlesError::Order { .. }));
    let language = refused(b"EN\0", Vec::new());
    assert!(matches!(language, SubtitlesError::Language(_)));
    let long = refused(b"zho", vec![cue(0.0, 1.0, &"烧".repeat(21_846))]);
    assert!(matches!(long, SubtitlesError::TooLong { bytes: 65_538 }));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
