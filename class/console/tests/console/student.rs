//! A stand-in for a student's program: a loop of frames that carries out orders in its state.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use openh264::OpenH264API;
use openh264::encoder::{
    ColorPrimaries, Encoder, EncoderConfig, MatrixCoefficients, TransferCharacteristics, VuiConfig,
};
use openh264::formats::{RgbaSliceU8, YUVBuffer};
use tempfile::TempDir;
use vitriol_console::{
    Choice, Codec, Command, Config, EncodedPicture, Flask, Hub, Incident, Kind, List, Points, Port,
    Range, Said, State, Step, Student, Text,
};
use vitriol_tests::wait::PATIENCE;

/// The colour of its view, sRGB.
pub const COLOUR: [u8; 3] = [200, 60, 40];
/// The colour of the glass from close by.
pub const CLOSE_COLOUR: [u8; 3] = [40, 90, 200];
/// The size of its view.
pub const SIZE: [u16; 2] = [320, 180];

/// A hub that speaks English, and its folder.
pub fn hub() -> (TempDir, Hub) {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub_in("en", folder.path());
    (folder, hub)
}

pub fn hub_in(language: &'static str, folder: &std::path::Path) -> Hub {
    Hub::start(Config {
        listen: ([127, 0, 0, 1], 0).into(),
        always_tls: false,
        folder: folder.to_owned(),
        names: Vec::new(),
        language,
    })
    .unwrap()
}

pub fn card(name: &str) -> Student {
    let choice = |title: &str, kind, counterpart| Choice {
        title: Text::clipped(title),
        kind,
        counterpart,
    };
    Student {
        name: Text::clipped(name),
        version: Text::clipped("0.1.0"),
        choices: List::clipped([
            choice("Acid into water", Kind::Correct, Some(1)),
            choice("Water into acid", Kind::Incorrect, Some(0)),
            choice("The paper's three flasks", Kind::Other, None),
        ]),
        k_v: Some(Range {
            least: 0.0,
            most: 4.0,
        }),
        replays: false,
        close_up: true,
    }
}

/// Its state before any order.
pub fn first_state() -> State {
    let flask = |name: &str, hottest: f64| Flask {
        name: Text::clipped(name),
        volume_m3: Some(1e-4),
        mean_c: Some(hottest - 20.0),
        hottest_c: Some(hottest),
    };
    let said = |t_s, text: &str| Said {
        t_s: Some(t_s),
        text: Text::clipped(text),
    };
    let mut state = State {
        scene: Text::clipped("Acid into water"),
        choice: Some(0),
        step: Some(Step {
            number: 2,
            of: 7,
            title: Text::clipped("Pour the acid into the water, slowly."),
        }),
        points: Some(Points { earned: 12, of: 40 }),
        hints: List::clipped([said(1.5, "Put the goggles on."), said(8.25, "Slower.")]),
        incidents: List::clipped([Incident {
            t_s: Some(12.5),
            // A page that took this text for HTML would run it.
            text: Text::clipped("<img src=x onerror=alert(1)> Acid on the left hand."),
            grave: true,
            attempt: 1,
            scene: Text::clipped("Acid into water"),
        }]),
        attempt: 1,
        incidents_of_attempt: 1,
        incidents_so_far: 1,
        grave_so_far: 1,
        ..State::default()
    };
    state.controls.k_v = Some(0.5);
    state.readings.flasks = List::clipped([flask("beaker", 84.26), flask("cylinder", 25.0)]);
    state.readings.superheat_k = Some(3.2);
    state.readings.void_fraction = Some(0.125);
    state.readings.bench_m3 = Some(2.4e-6);
    state.readings.floor_m3 = Some(0.0);
    state.frames.mean_s = Some(0.0087);
    state.frames.worst_s = Some(0.0131);
    state.frames.period_s = Some(1.0 / 90.0);
    state.frames.missed = 3;
    state
}

/// The effect of a command on the state.
fn obey(state: &mut State, command: &Command) {
    let choices = card("").choices;
    let begin = |state: &mut State, choice: u8| {
        state.choice = Some(choice);
        state.scene = Text::clipped(&choices[usize::from(choice)].title);
        // The lesson is of the first scene.
        state.step = first_state().step.filter(|_| choice == 0);
    };
    let present = state.choice.map(usize::from);
    let other = present.and_then(|at| choices[at].counterpart);
    let controls = &mut state.controls;
    match command {
        Command::Scene { choice } => begin(state, *choice),
        Command::Toggle {} => {
            if let Some(other) = other {
                begin(state, other);
            }
        }
        Command::KV { value } => controls.k_v = Some(*value),
        Command::Reset {} => state.time_s = Some(0.0),
        Command::Pause { on } => controls.paused = *on,
        Command::SlowMotion { rate } => controls.rate = *rate,
        Command::Spare { on } => controls.spared = *on,
        Command::Message { text } => controls.message = text.clone(),
        Command::End {} => controls.ended = true,
    }
}

/// Its coded view, in one colour.
pub struct Camera {
    encoder: Encoder,
    rgba: Vec<u8>,
    taken: u64,
}

impl Camera {
    pub fn new() -> Self {
        let pixels = usize::from(SIZE[0]) * usize::from(SIZE[1]);
        let pixel = [COLOUR[0], COLOUR[1], COLOUR[2], 255];
        // As the film's encoder sets it: without a matrix, browsers guess another one.
        let vui = VuiConfig::bt601()
            .color_primaries(ColorPrimaries::Bt709)
            .transfer_characteristics(TransferCharacteristics::Srgb)
            .matrix_coefficients(MatrixCoefficients::Smpte170M);
        let config = EncoderConfig::new().vui(vui);
        Self {
            encoder: Encoder::with_api_config(OpenH264API::from_source(), config).unwrap(),
            rgba: pixel.repeat(pixels),
            taken: 0,
        }
    }

    pub fn jpeg(&self) -> EncodedPicture {
        EncodedPicture::jpeg(&self.rgba, SIZE, self.taken).unwrap()
    }

    pub fn close_up(&self) -> EncodedPicture {
        let [red, green, blue] = CLOSE_COLOUR;
        let rgba = [red, green, blue, 255].repeat(self.rgba.len() / 4);
        EncodedPicture::close_up(&rgba, SIZE, self.taken).unwrap()
    }

    pub fn card(&self) -> EncodedPicture {
        EncodedPicture::card(&self.rgba, SIZE, self.taken).unwrap()
    }

    pub fn h264(&mut self, is_key: bool) -> EncodedPicture {
        if is_key {
            self.encoder.force_intra_frame();
        }
        let size = (SIZE[0].into(), SIZE[1].into());
        let mut yuv = YUVBuffer::new(size.0, size.1);
        yuv.read_rgba8(RgbaSliceU8::new(&self.rgba, size));
        let stream = self.encoder.encode(&yuv).unwrap();
        self.taken += 1;
        EncodedPicture {
            codec: Codec::H264,
            is_key: matches!(
                stream.frame_type(),
                openh264::encoder::FrameType::IDR | openh264::encoder::FrameType::I
            ),
            size: SIZE,
            time_us: self.taken * 16_667,
            bytes: stream.to_vec(),
        }
    }
}

/// A stand-in for a student's program, on a thread of its own.
pub struct FakeStudent {
    orders: Receiver<Command>,
    over: Arc<AtomicBool>,
    works: Option<JoinHandle<()>>,
    /// Its state; a test may change it.
    pub state: Arc<Mutex<State>>,
}

impl FakeStudent {
    pub fn new(port: Port) -> Self {
        let (sender, orders) = channel();
        let over = Arc::new(AtomicBool::new(false));
        let state = Arc::new(Mutex::new(first_state()));
        let works = {
            let (over, state) = (over.clone(), state.clone());
            std::thread::spawn(move || frames(&port, &sender, &over, &state))
        };
        Self {
            orders,
            over,
            works: Some(works),
            state,
        }
    }

    pub fn in_hub(hub: &Hub, name: &str) -> Self {
        Self::new(hub.student(card(name)).unwrap().unwrap())
    }

    /// The next order that it carried out.
    pub fn ordered(&self) -> Command {
        self.orders.recv_timeout(PATIENCE).expect("an order")
    }

    /// Checks that there is no other order.
    pub fn nothing_else(&self) {
        assert_eq!(self.orders.try_recv().ok(), None);
    }
}

impl Drop for FakeStudent {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        let ended = self.works.take().unwrap().join();
        assert!(
            ended.is_ok() || std::thread::panicking(),
            "the student's loop failed"
        );
    }
}

fn frames(port: &Port, done: &Sender<Command>, over: &AtomicBool, state: &Mutex<State>) {
    let mut camera = Camera::new();
    while !over.load(Ordering::Relaxed) {
        let mut state = state.lock().unwrap();
        for order in port.commands() {
            obey(&mut state, &order.command);
            state.done = order.number;
            // A test that has finished receives no more.
            let _ = done.send(order.command);
        }
        state.frame += 1;
        state.time_s = Some(state.time_s.unwrap_or(0.0) + 0.01);
        port.publish(state.clone());
        drop(state);
        let wanted = port.wanted();
        if wanted.h264 {
            let is_key = port.take_key_request();
            port.picture(Arc::new(camera.h264(is_key)));
        }
        if wanted.jpeg {
            port.picture(Arc::new(camera.jpeg()));
        }
        if wanted.close_up {
            port.picture(Arc::new(camera.close_up()));
        }
        if port.take_card_request() {
            port.picture(Arc::new(camera.card()));
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}
