//! The film against two programs that are not ours: OpenH264's decoder and a
//! real browser.

use std::fs;
use std::path::Path;

use openh264::decoder::{DecodedYUV, Decoder};
use openh264::formats::YUVSource;
use vitriol_run::{Film, FilmError};

use crate::{mp4, told};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 180;
const FPS: u32 = 30;
const FRAMES: u32 = 60;
const BLOCK: u32 = 40;

/// Flat colours that catch a wrong matrix or range: 4:2:0 cannot blur what is
/// flat over 40 pixels.
const COLOURS: [[u8; 3]; 8] = [
    [255, 0, 0],
    [0, 255, 0],
    [0, 0, 255],
    [255, 255, 255],
    [0, 0, 0],
    [128, 128, 128],
    [200, 120, 40],
    [30, 90, 160],
];

/// The colour of block `column` in frame `frame`: the row of colours moves on
/// by one block every frame, so each frame tells its number modulo eight.
fn colour(column: u32, frame: u32) -> [u8; 3] {
    COLOURS[((column + frame) % 8) as usize]
}

fn pattern(frame: u32) -> Vec<u8> {
    let mut rgba = Vec::with_capacity((WIDTH * HEIGHT * 4) as usize);
    for _ in 0..HEIGHT {
        for x in 0..WIDTH {
            let [r, g, b] = colour(x / BLOCK, frame);
            rgba.extend([r, g, b, 255]);
        }
    }
    rgba
}

/// A film that has so many of these pictures, and is not finished.
fn begun(path: &Path, frames: u32, picture: fn(u32) -> Vec<u8>) -> Film {
    let mut film = Film::create(path, WIDTH, HEIGHT, FPS).unwrap();
    for frame in 0..frames {
        film.push_rgba(&picture(frame)).unwrap();
    }
    film
}

fn make_film(path: &Path) {
    let film = begun(path, FRAMES, pattern);
    assert_eq!(film.finish().unwrap(), path);
}

/// The coded pictures of a finished film, as Annex B.
fn stream(path: &Path) -> Vec<u8> {
    let film = mp4::tracks(&fs::read(path).unwrap());
    mp4::annex_b(film[0].samples.iter().map(|(.., bytes)| &bytes[..]))
}

/// Shows each picture of a stream to `look`, in order.
fn decode(stream: &[u8], mut look: impl FnMut(&DecodedYUV<'_>)) {
    let mut decoder = Decoder::new().unwrap();
    for unit in openh264::nal_units(stream) {
        if let Some(picture) = decoder.decode(unit).unwrap() {
            look(&picture);
        }
    }
    for picture in decoder.flush_remaining().unwrap() {
        look(&picture);
    }
}

/// BT.601, limited range, to RGB (ITU-R BT.601-7, 2.5.1–2.5.3).
fn rgb_of(y: u8, cb: u8, cr: u8) -> [f64; 3] {
    let y = (f64::from(y) - 16.0) / 219.0;
    let cb = (f64::from(cb) - 128.0) / 224.0;
    let cr = (f64::from(cr) - 128.0) / 224.0;
    [
        y + 1.402 * cr,
        y - 0.344_136 * cb - 0.714_136 * cr,
        y + 1.772 * cb,
    ]
    .map(|v| (v * 255.0).clamp(0.0, 255.0))
}

/// How many pictures of the pattern these are, from its first; each is compared.
fn patterns(stream: &[u8]) -> u32 {
    let mut frame = 0;
    decode(stream, |picture| {
        assert_eq!(picture.dimensions(), (WIDTH as usize, HEIGHT as usize));
        let (luma, chroma, _) = picture.strides();
        for column in 0..WIDTH / BLOCK {
            let (x, y) = ((column * BLOCK + BLOCK / 2) as usize, HEIGHT as usize / 2);
            let got = rgb_of(
                picture.y()[y * luma + x],
                picture.u()[y / 2 * chroma + x / 2],
                picture.v()[y / 2 * chroma + x / 2],
            );
            let want = colour(column, frame);
            for channel in 0..3 {
                let off = (got[channel] - f64::from(want[channel])).abs();
                // Two levels of rounding in 8-bit limited range, the rest is
                // quantisation of the coded block.
                assert!(off < 8.0, "frame {frame} column {column}: {got:?} {want:?}");
            }
        }
        frame += 1;
    });
    frame
}

#[test]
fn every_frame_decodes_to_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    make_film(&path);
    assert_eq!(patterns(&stream(&path)), FRAMES);
}

/// Frames of a film of more than two seconds, after which there is a key frame at the latest.
const LONGER: u32 = 70;

/// A player seeks by the index: each picture has its time, and those are named that can be decoded without another (their units
/// are of type 5 of H.264, table 7-1).
#[test]
fn the_index_has_each_pictures_time_and_key() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    begun(&path, LONGER, pattern).finish().unwrap();
    let film = mp4::tracks(&fs::read(&path).unwrap());
    assert_eq!(film.len(), 1);
    let pictures = &film[0];
    assert_eq!(pictures.handler, "vide");
    assert_eq!(pictures.samples.len(), LONGER as usize);
    // To the nearest millisecond.
    assert_eq!(pictures.length, 2333);
    let mut keys = Vec::new();
    for (frame, (from, lasts, bytes)) in (0..).zip(&pictures.samples) {
        assert_eq!(from * FPS, frame * pictures.units);
        assert_eq!(lasts * FPS, pictures.units);
        let stream = mp4::annex_b([&bytes[..]]);
        if openh264::nal_units(&stream).any(|unit| unit[3] & 31 == 5) {
            keys.push(frame + 1);
        }
    }
    assert!(keys.starts_with(&[1]) && keys.len() > 1, "{keys:?}");
    let named = pictures.keys.clone();
    assert_eq!(named.unwrap_or_else(|| (1..=LONGER).collect()), keys);
}

/// Memory does not grow with the film, and a program that is killed leaves what it had: the file has it and can be read at any moment,
/// under a name that says what it is.
#[test]
fn an_unfinished_film_is_in_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    let film = begun(&path, LONGER, pattern);
    // At most four frames wait for the encoder and one is in its hands: that of two seconds is behind it.
    let files: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(files.len(), 1);
    let beside = files[0].as_ref().unwrap();
    let name = beside.file_name().into_string().unwrap();
    assert!(
        name.starts_with("film-unfinished-") && name.ends_with(".mp4"),
        "{name}"
    );
    // The program is killed.
    let bytes = fs::read(beside.path()).unwrap();
    let there = mp4::fragments(&bytes);
    assert!(there.len() >= 60, "{} frames", there.len());
    for (frame, sample) in (0..).zip(&there) {
        assert_eq!((sample.track, sample.from), (1, frame * 1000));
    }
    let stream_there = mp4::annex_b(there.iter().map(|sample| &sample.bytes[..]));
    assert_eq!(patterns(&stream_there) as usize, there.len());
    // It is not.
    film.finish().unwrap();
    assert_eq!(patterns(&stream(&path)), LONGER);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);

    let killed = folder.path().join("killed.mp4");
    fs::write(killed, bytes).unwrap();
    let page = r#"<!doctype html><script>
        const told = (value) => console.log("TOLD " + JSON.stringify(value));
        const film = document.createElement("video");
        film.muted = true;
        film.src = "killed.mp4";
        film.onerror = () => told({ error: film.error.message });
        // It goes on behind its first second.
        film.ontimeupdate = () => {
          if (film.currentTime < 1) return;
          film.ontimeupdate = null;
          told({ width: film.videoWidth, height: film.videoHeight });
        };
        film.play();
        </script>"#;
    if let Some(told) = told(folder.path(), page) {
        assert_eq!(told["width"], WIDTH, "{told}");
        assert_eq!(told["height"], HEIGHT, "{told}");
    }
}

#[test]
fn a_browser_plays_and_seeks_it() {
    let folder = tempfile::tempdir().unwrap();
    make_film(&folder.path().join("film.mp4"));
    let page = r#"<!doctype html><canvas></canvas><script>
        const told = (value) => console.log("TOLD " + JSON.stringify(value));
        const film = document.createElement("video");
        film.muted = true;
        film.src = "film.mp4";
        const canvas = document.querySelector("canvas");
        const seek = (t) => new Promise((done) => {
          film.addEventListener("seeked", done, { once: true });
          film.currentTime = t;
        });
        const colours = COLOURS;
        const want = (frame) => colours[frame % 8];
        const read = (context) => {
          context.drawImage(film, 0, 0);
          const row = [];
          for (let column = 0; column < 8; column++)
            row.push([...context.getImageData(column * 40 + 20, 90, 1, 1).data.slice(0, 3)]);
          return row;
        };
        film.onerror = () => told({ error: film.error.message });
        film.onloadeddata = async () => {
          canvas.width = film.videoWidth;
          canvas.height = film.videoHeight;
          const context = canvas.getContext("2d");
          const rows = [];
          for (const frame of [0, 1, 29, 30, 47, 59]) {
            await seek((frame + 0.5) / 30);
            let row = read(context);
            // What was sought is decoded by now, and a busy browser paints it later.
            for (let tries = 0; tries < 200 && row[0].some((level, n) => Math.abs(level - want(frame)[n]) > 10); tries++) {
              await new Promise((done) => setTimeout(done, 25));
              row = read(context);
            }
            rows.push({ frame, row });
          }
          told({ duration: film.duration, width: film.videoWidth, height: film.videoHeight, rows });
        };
        </script>"#
        .replace("COLOURS", &serde_json::to_string(&COLOURS).unwrap());
    let Some(told) = told(folder.path(), &page) else {
        return;
    };
    assert_eq!(told["width"], WIDTH, "{told}");
    assert_eq!(told["height"], HEIGHT);
    let duration = told["duration"].as_f64().unwrap();
    // The movie header counts milliseconds.
    let expected = f64::from(FRAMES) / f64::from(FPS);
    assert!((duration - expected).abs() < 2e-3, "{duration} s");
    for entry in told["rows"].as_array().unwrap() {
        let frame = entry["frame"].as_u64().unwrap() as u32;
        for column in 0..8u32 {
            let want = colour(column, frame);
            for channel in 0..3 {
                let got = entry["row"][column as usize][channel].as_f64().unwrap();
                let off = (got - f64::from(want[channel])).abs();
                assert!(
                    off < 10.0,
                    "frame {frame} column {column}: {entry} {want:?}"
                );
            }
        }
    }
}

#[test]
fn nothing_half_written_nothing_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");

    let mut film = Film::create(&path, WIDTH, HEIGHT, FPS).unwrap();
    film.push_rgba(&pattern(0)).unwrap();
    assert!(!path.exists(), "not before it is finished");
    drop(film);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);

    let film = Film::create(&path, WIDTH, HEIGHT, FPS).unwrap();
    assert!(matches!(film.finish(), Err(FilmError::Empty)));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);

    let mut film = Film::create(&path, WIDTH, HEIGHT, FPS).unwrap();
    film.push_rgba(&pattern(0)).unwrap();
    fs::write(&path, "mine").unwrap();
    assert!(film.finish().is_err(), "a film that appeared meanwhile");
    assert!(Film::create(&path, WIDTH, HEIGHT, FPS).is_err());
    assert_eq!(fs::read(&path).unwrap(), b"mine");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn impossible_films_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    let refused = |w, h, fps| Film::create(&path, w, h, fps).unwrap_err().to_string();
    assert!(refused(961, 540, 30).contains("961x540"));
    assert!(refused(8192, 4096, 30).contains("8192x4096"));
    assert!(refused(960, 540, 0).contains("0 frames a second"));
    let mut film = Film::create(&path, WIDTH, HEIGHT, FPS).unwrap();
    assert!(matches!(
        film.push_rgba(&[0; 16]),
        Err(FilmError::FrameLength { got: 16, .. })
    ));
}

/// Where the ring's middle is.
fn middle(frame: u32) -> (f64, f64) {
    (40.0 + 2.6 * f64::from(frame), 60.0 + 0.9 * f64::from(frame))
}

/// A wall's grey with a slow gradient and a step of dither, and a dark ring that
/// wanders over it: what a flask's edge is to the film's background.
fn wall_and_ring(frame: u32) -> Vec<u8> {
    let centre = middle(frame);
    let mut noise = u64::from(frame);
    let mut rgba = Vec::with_capacity((WIDTH * HEIGHT * 4) as usize);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            // Knuth's linear congruential generator (MMIX).
            noise = noise
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let wall = 180 + (x / 16) as u8 + (noise >> 63) as u8;
            let r = (f64::from(x) - centre.0).hypot(f64::from(y) - centre.1);
            let grey = if (r - 30.0).abs() < 0.8 {
                wall - 40
            } else {
                wall
            };
            rgba.extend([grey, grey, grey, 255]);
        }
    }
    rgba
}

#[test]
fn what_moves_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    begun(&path, FRAMES, wall_and_ring).finish().unwrap();
    let mut frame = 0;
    decode(&stream(&path), |picture| {
        let centre = middle(frame);
        let stride = picture.strides().0;
        for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
            let r = (f64::from(x) - centre.0).hypot(f64::from(y) - centre.1);
            if (r - 30.0).abs() < 5.0 {
                continue;
            }
            let got = f64::from(picture.y()[y as usize * stride + x as usize]);
            let wall = 16.0 + f64::from(180 + x / 16) * 219.0 / 255.0;
            // Dither and a quantiser of 20 (steps of 6.5); a dot is darker.
            let off = got - wall;
            assert!(off.abs() < 7.0, "frame {frame} ({x}, {y}): {got}, {wall}");
        }
        frame += 1;
    });
    assert_eq!(frame, FRAMES);
}
