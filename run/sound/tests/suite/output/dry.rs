//! A server that runs dry is asked for a longer buffer.

use std::io::{BufReader, Read};
use std::os::unix::net::{UnixListener, UnixStream};
use std::time::Duration;

use pulseaudio::protocol::{
    self, AuthReply, Command, CreatePlaybackStreamReply, MAX_VERSION, Request, SampleFormat,
    SampleSpec, SetClientNameReply, SetPlaybackStreamBufferAttrReply, Underflow,
    stream::BufferAttr,
};
use vitriol_sound::{Device, Mixer, Output, State};

use crate::output::server::{Server, inside, pause, until};

const RATE: u32 = 48_000;
/// Bytes of a sample of both channels.
const FRAME: u32 = 8;
const CHANNEL: u32 = 5;
const STREAM: u32 = 9;

/// The server's end of a connection, without a clock: the test decides what happens.
struct Peer(BufReader<UnixStream>);

/// A message of a client.
enum Said {
    Command(u32, Box<Command>),
    /// A number of samples.
    Samples(u32),
}

impl Peer {
    /// The next message; `None` when the client has gone.
    fn hear(&mut self) -> Option<Said> {
        let descriptor = protocol::read_descriptor(&mut self.0).ok()?;
        let mut message = Vec::new();
        protocol::write_descriptor(&mut message, &descriptor).unwrap();
        let mut body = (&mut self.0).take(descriptor.length.into());
        body.read_to_end(&mut message).ok()?;
        if descriptor.channel == CHANNEL {
            return Some(Said::Samples(descriptor.length / FRAME));
        }
        let mut message = message.as_slice();
        let (number, command) = protocol::read_command_message(&mut message, MAX_VERSION).unwrap();
        Some(Said::Command(number, Box::new(command)))
    }

    fn say(&mut self, command: &Command) {
        let number = u32::MAX;
        let socket = self.0.get_mut();
        protocol::write_command_message(socket, number, command, MAX_VERSION).unwrap();
    }

    fn reply<R: protocol::CommandReply>(&mut self, number: u32, reply: &R) {
        protocol::write_reply_message(self.0.get_mut(), number, reply, MAX_VERSION).unwrap();
    }

    /// Takes `samples` samples, in requests of 10 ms; agrees to the buffers that the client asks for meanwhile, and returns them.
    fn play(&mut self, samples: u32) -> Vec<BufferAttr> {
        let mut asked = Vec::new();
        let mut given = 0;
        while given < samples {
            let (channel, length) = (CHANNEL, RATE / 100 * FRAME);
            self.say(&Command::Request(Request { channel, length }));
            let mut answered = false;
            while !answered {
                let (number, command) = match self.hear().unwrap() {
                    Said::Samples(count) => {
                        given += count;
                        answered = true;
                        continue;
                    }
                    Said::Command(number, command) => (number, command),
                };
                if let Command::SetPlaybackStreamBufferAttr(of) = *command {
                    assert_eq!(of.index, CHANNEL);
                    asked.push(of.buffer_attr);
                    self.reply(
                        number,
                        &SetPlaybackStreamBufferAttrReply {
                            buffer_attr: of.buffer_attr,
                            configured_sink_latency: 0,
                        },
                    );
                }
            }
        }
        asked
    }

    /// Runs until the stream is there; returns the buffer that the client asked for.
    fn open(&mut self) -> BufferAttr {
        loop {
            let Said::Command(number, command) = self.hear().unwrap() else {
                panic!("samples before a stream");
            };
            match *command {
                Command::Auth(_) => self.reply(
                    number,
                    &AuthReply {
                        version: MAX_VERSION,
                        use_memfd: false,
                        use_shm: false,
                    },
                ),
                Command::SetClientName(_) => {
                    self.reply(number, &SetClientNameReply { client_id: 1 });
                }
                Command::CreatePlaybackStream(of) => {
                    let buffer_attr = of.buffer_attr;
                    self.reply(
                        number,
                        &CreatePlaybackStreamReply {
                            channel: CHANNEL,
                            stream_index: STREAM,
                            requested_bytes: buffer_attr.target_length,
                            buffer_attr,
                            sample_spec: SampleSpec {
                                format: SampleFormat::Float32Le,
                                channels: 2,
                                sample_rate: RATE,
                            },
                            channel_map: of.channel_map,
                            ..CreatePlaybackStreamReply::default()
                        },
                    );
                    return buffer_attr;
                }
                other => panic!("{other:?}"),
            }
        }
    }

    fn runs_dry(&mut self) {
        let (channel, offset) = (CHANNEL, 0);
        self.say(&Command::Underflow(Underflow { channel, offset }));
    }
}

fn ms(of: &BufferAttr) -> u32 {
    of.target_length / FRAME * 1000 / RATE
}

/// The server runs dry eight times: a quarter of a second of samples after a buffer was agreed to, and half a second after that. Then it
/// ends.
fn script(mut peer: Peer) {
    assert_eq!(ms(&peer.open()), 25);
    // A server whose buffer lasts is not asked for another.
    assert_eq!(peer.play(RATE), []);
    let mut asked = Vec::new();
    for _ in 0..4 {
        peer.runs_dry();
        // It runs dry again, while it fills the longer one.
        let first = peer.play(RATE / 4);
        peer.runs_dry();
        assert_eq!(peer.play(RATE / 2), []);
        // The requests are as short as before.
        assert!(
            first
                .iter()
                .all(|of| of.minimum_request_length == RATE / 200 * FRAME)
        );
        asked.push(first.iter().map(ms).collect::<Vec<_>>());
    }
    // No buffer longer than the limit.
    assert_eq!(asked, [vec![50], vec![100], vec![120], vec![]]);
}

#[test]
fn a_server_that_runs_dry_is_asked_to_hold_more() {
    let client = || {
        let output = Output::open(Device::Default, Mixer::new(1)).unwrap();
        until("the script's end", || {
            matches!(output.state(), State::Ended { .. }).then_some(())
        });
        assert_eq!(output.underflows(), 8);
        assert_eq!(output.target(), Some(Duration::from_millis(120)));
    };
    let mut scripted = None;
    inside(client, |folder| {
        let listener = UnixListener::bind(folder.join("socket")).ok()?;
        let play = move || {
            let (client, _) = listener.accept().unwrap();
            script(Peer(BufReader::new(client)));
        };
        scripted = Some(std::thread::spawn(play));
        Some(())
    });
    if let Some(scripted) = scripted {
        scripted.join().unwrap();
    }
}

/// A real server, whose client is stopped for longer than the buffer lasts, until the buffer has reached its limit.
fn starves() {
    let output = Output::open(Device::Default, Mixer::new(1)).unwrap();
    until("the longest buffer", || {
        pause(Duration::from_millis(300));
        (output.target() >= Some(Duration::from_millis(120))).then_some(())
    });
    assert!(output.underflows() >= 3, "{}", output.underflows());
    // Server and device hold it, too: at first there were 30 ms at most.
    let latency = until("a longer latency", || {
        output
            .latency()
            .filter(|it| *it > Duration::from_millis(60))
    });
    eprintln!("{latency:?} after {} underflows", output.underflows());
    assert_eq!(output.state(), State::Playing);
}

#[test]
fn a_real_server_holds_more() {
    inside(starves, Server::start);
}
