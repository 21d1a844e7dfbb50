//! Windows: WASAPI's shared mode by cpal. The system converts to the device's own rate.

use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};

use cpal::traits::{DeviceTrait, HostTrait, StreamTrait};
use cpal::{BufferSize, ErrorKind, OutputCallbackInfo, StreamConfig};

use super::player::Player;
use super::{DeviceName, OutputError, Shared, no_device};
use crate::RATE;

/// Samples that a buffer should hold: 20 ms. The system may choose otherwise.
const BUFFER: u32 = RATE / 50;

/// Ends the thread when it is dropped.
#[derive(Debug)]
pub(super) struct Stop {
    _open: Sender<()>,
}

/// Opens a stream, reports that, and keeps it until it is lost or the other side ends it.
pub(super) fn play(
    name: Option<&str>,
    player: Player,
    shared: &Arc<Shared>,
    ready: &Sender<Result<Stop, OutputError>>,
) {
    let (open, ended) = channel::<()>();
    let lost = open.clone();
    let stream = match stream(name, player, shared, lost) {
        Ok(stream) => stream,
        Err(error) => {
            let _ = ready.send(Err(error));
            return;
        }
    };
    if ready.send(Ok(Stop { _open: open })).is_ok() {
        // A message means that the device is lost; an error, that the other side has ended.
        let _ = ended.recv();
    }
    drop(stream);
}

fn stream(
    name: Option<&str>,
    mut player: Player,
    shared: &Arc<Shared>,
    lost: Sender<()>,
) -> Result<cpal::Stream, OutputError> {
    let host = cpal::default_host();
    let device = match name {
        None => host.default_output_device(),
        Some(name) => {
            let mut all = host.output_devices().map_err(refused)?;
            all.find(|it| named(it).is_some_and(|it| it.name == name || it.description == name))
        }
    };
    let device = device.ok_or_else(|| {
        let all = devices().unwrap_or_default();
        no_device(name.unwrap_or("default"), &all)
    })?;
    let config = StreamConfig {
        channels: 2,
        sample_rate: RATE,
        buffer_size: BufferSize::Fixed(BUFFER),
    };
    let (told, ends) = (Arc::clone(shared), Arc::clone(shared));
    let mut samples = Vec::new();
    let fill = move |out: &mut [f32], info: &OutputCallbackInfo| {
        samples.resize(out.len() / 2, [0.0f32; 2]);
        player.fill(&mut samples);
        for (to, from) in out.iter_mut().zip(samples.iter().flatten()) {
            *to = *from;
        }
        let times = info.timestamp();
        told.set_latency(times.playback.saturating_duration_since(times.callback));
    };
    let fail = move |error: cpal::Error| {
        use ErrorKind::{DeviceChanged, RealtimeDenied, Xrun};
        if matches!(error.kind(), Xrun) {
            ends.ran_dry();
        }
        if !matches!(error.kind(), DeviceChanged | RealtimeDenied | Xrun) {
            ends.end(error.to_string());
            let _ = lost.send(());
        }
    };
    let stream = device.build_output_stream(config, fill, fail, Some(super::PATIENCE));
    let stream = stream.map_err(refused)?;
    stream.play().map_err(refused)?;
    Ok(stream)
}

fn refused(error: cpal::Error) -> OutputError {
    let cause = error.to_string();
    OutputError::Refused { cause }
}

fn named(device: &cpal::Device) -> Option<DeviceName> {
    let name = device.id().ok()?.to_string();
    let description = device.description().ok()?.name().to_owned();
    Some(DeviceName { name, description })
}

pub(super) fn devices() -> Result<Vec<DeviceName>, OutputError> {
    let all = cpal::default_host().output_devices().map_err(refused)?;
    Ok(all.filter_map(|it| named(&it)).collect())
}
