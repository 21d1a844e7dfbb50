//! Linux: PulseAudio's protocol over its socket, which PipeWire supports too. No library is linked or loaded.
//!
//! One thread reads the server's requests and answers with samples; the server's clock drives it.

use std::ffi::CString;
use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::sync::mpsc::Sender;
use std::time::{Duration, SystemTime};

use pulseaudio::protocol::{
    self, ChannelMap, Command, CreatePlaybackStreamReply, LatencyParams, PlaybackLatency,
    PlaybackStreamParams, ProtocolError, Request, SampleFormat, SampleSpec,
    SetPlaybackStreamBufferAttrParams, TagStructReader, stream::BufferAttr,
};

use super::player::Player;
use super::{DeviceName, OutputError, Shared, no_device};
use crate::RATE;

mod length;
mod link;
use length::Length;
use link::Link;

/// Bytes of a sample of both channels, 32-bit floats.
const FRAME: usize = 8;

/// Least number of samples in a server's request: 5 ms.
const LEAST: u32 = RATE / 200;

/// Most bytes that one request is answered with: a second's.
const MOST: usize = RATE as usize * FRAME;

/// Requests between two queries of the latency: about 100 ms.
const BETWEEN: u32 = 20;

/// Ends the thread when it is dropped: the socket is shut down, and reading ends.
#[derive(Debug)]
pub(super) struct Stop(UnixStream);

impl Drop for Stop {
    fn drop(&mut self) {
        // A socket that is closed already has ended the thread.
        let _ = self.0.shutdown(Shutdown::Both);
    }
}

/// Opens a stream, reports that, and plays until the server or the other side ends it.
pub(super) fn play(
    name: Option<&str>,
    mut player: Player,
    shared: &Shared,
    ready: &Sender<Result<Stop, OutputError>>,
) {
    let opened = open(name).and_then(|(link, stream, length)| {
        let stop = link.socket().try_clone();
        let stop = stop.map_err(|error| refused(&ProtocolError::Io(error)))?;
        Ok((link, stream, length, Stop(stop)))
    });
    let (mut link, stream, length) = match opened {
        Ok((link, stream, length, stop)) => match ready.send(Ok(stop)) {
            Ok(()) => (link, stream, length),
            // It took too long. The result that was sent back is dropped, and the socket with it.
            Err(_) => return,
        },
        Err(error) => {
            let _ = ready.send(Err(error));
            return;
        }
    };
    let Err(error) = serve(&mut link, &stream, length, &mut player, shared);
    shared.end(error.to_string());
}

/// Buffer attributes to request of a server.
fn buffer(length: &Length) -> BufferAttr {
    BufferAttr {
        target_length: length.target() * FRAME as u32,
        minimum_request_length: LEAST * FRAME as u32,
        ..BufferAttr::default()
    }
}

fn open(name: Option<&str>) -> Result<(Link, CreatePlaybackStreamReply, Length), OutputError> {
    let mut link = Link::connect()?;
    let sink = match name {
        None => None,
        Some(name) => {
            let all = sinks(&mut link)?;
            let named = all
                .iter()
                .find(|it| it.name == name || it.description == name);
            let named = named.ok_or_else(|| no_device(name, &all))?;
            CString::new(named.name.clone()).ok()
        }
    };
    let mut parameters = PlaybackStreamParams {
        sample_spec: SampleSpec {
            format: SampleFormat::Float32Le,
            channels: 2,
            sample_rate: RATE,
        },
        channel_map: ChannelMap::stereo(),
        sink_name: sink,
        ..Default::default()
    };
    let length = Length::new();
    parameters.buffer_attr = buffer(&length);
    parameters.flags.adjust_latency = true;
    parameters.props.set(protocol::Prop::MediaName, c"Vitriol");
    let asked = link.ask(&Command::CreatePlaybackStream(parameters));
    let stream: CreatePlaybackStreamReply = asked.map_err(|error| refused(&error))?;
    link.wait_for_ever().map_err(|error| refused(&error))?;
    Ok((link, stream, length))
}

/// Answers the server until it or the other side ends.
fn serve(
    link: &mut Link,
    stream: &CreatePlaybackStreamReply,
    mut length: Length,
    player: &mut Player,
    shared: &Shared,
) -> Result<std::convert::Infallible, ProtocolError> {
    let channel = stream.channel;
    let mut samples = Vec::new();
    let mut bytes = Vec::new();
    let mut give = |link: &mut Link, length: &mut Length, asked: usize| {
        samples.resize(asked.min(MOST) / FRAME, [0.0f32; 2]);
        player.fill(&mut samples);
        length.gave(samples.len());
        bytes.clear();
        bytes.extend(samples.iter().flatten().flat_map(|it| it.to_le_bytes()));
        link.give(channel, &bytes)
    };
    shared.set_target(of_samples(length.target().into()));
    give(link, &mut length, stream.requested_bytes as usize)?;
    for requests in (0..BETWEEN).cycle() {
        let asked = loop {
            let (number, command, rest) = link.next()?;
            match command {
                Command::Request(Request { length, .. }) => break length,
                Command::Reply if number == Link::LATENCY => {
                    let mut rest = rest.as_slice();
                    let told = TagStructReader::new(&mut rest, link.version()).read()?;
                    shared.set_latency(latency(&told));
                }
                Command::Underflow(_) => {
                    shared.ran_dry();
                    if length.lengthen() {
                        link.ask_buffer(SetPlaybackStreamBufferAttrParams {
                            index: channel,
                            buffer_attr: buffer(&length),
                            adjust_latency: true,
                            early_requests: false,
                        })?;
                    }
                }
                // A server that refuses is not asked again.
                Command::Reply if number == Link::BUFFER => {
                    length.agreed();
                    shared.set_target(of_samples(length.target().into()));
                }
                Command::PlaybackStreamKilled(_) => {
                    return Err(ProtocolError::Invalid("the server ended the stream".into()));
                }
                _ => {}
            }
        };
        give(link, &mut length, asked as usize)?;
        if requests == 0 {
            let now = SystemTime::now();
            link.ask_latency(LatencyParams { channel, now })?;
        }
    }
    Err(ProtocolError::Invalid("counting ended".into()))
}

/// Duration of the samples that are written and not yet read, and the delay behind them.
fn latency(told: &PlaybackLatency) -> Duration {
    let waiting = (told.write_offset - told.read_offset).max(0) as u64 / FRAME as u64;
    of_samples(waiting) + Duration::from_micros(told.sink_usec)
}

fn of_samples(count: u64) -> Duration {
    Duration::from_micros(count * 1_000_000 / u64::from(RATE))
}

fn refused(error: &ProtocolError) -> OutputError {
    let timed_out = |error: &std::io::Error| {
        use std::io::ErrorKind::{TimedOut, WouldBlock};
        matches!(error.kind(), TimedOut | WouldBlock)
    };
    match error {
        ProtocolError::Io(error) if timed_out(error) => OutputError::TimedOut,
        error => OutputError::Refused {
            cause: error.to_string(),
        },
    }
}

pub(super) fn devices() -> Result<Vec<DeviceName>, OutputError> {
    sinks(&mut Link::connect()?)
}

fn sinks(link: &mut Link) -> Result<Vec<DeviceName>, OutputError> {
    let asked = link.ask::<protocol::SinkInfoList>(&Command::GetSinkInfoList);
    let all = asked.map_err(|error| refused(&error))?;
    let text = |it: &CString| it.to_string_lossy().into_owned();
    let named = |sink: &protocol::SinkInfo| DeviceName {
        name: text(&sink.name),
        description: text(sink.description.as_ref().unwrap_or(&sink.name)),
    };
    Ok(all.iter().map(named).collect())
}
