//! The MP4 file of a film (ISO/IEC 14496-12), written while the film is made.
//!
//! Until it is finished it is a fragmented MP4 (8.8): a header, and a fragment for the time from each key frame to the next. So no more
//! than one fragment waits in memory, and a program that is killed leaves a file that plays. At the end an index of all samples is put
//! behind them and one `mdat` is declared around all fragments. Then it is a plain MP4, in which every player seeks. OBS Studio writes
//! its films in the same way and calls this hybrid MP4.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::num::NonZeroU32;

use openh264::nal_units;
use shiguredo_mp4::boxes::{
    AudioSampleEntryFields, Avc1Box, AvccBox, DopsBox, FreeBox, FtypBox, MoovBox, OpusBox,
    SampleEntry, UnknownBox, VisualSampleEntryFields,
};
use shiguredo_mp4::mux::{Fmp4SegmentMuxer, Mp4FileMuxer, MuxError, Sample};
use shiguredo_mp4::{BoxHeader, Decode, Encode, FixedPointNumber, TrackKind, Uint};
use vitriol_sound::{OPUS_DELAY, OPUS_PACKET, RATE};

use crate::film_error::{FilmError, unwritten};
use crate::h264::Coded;
use crate::output::Staged;
use crate::subtitles::{Subtitles, SubtitlesError, track};

/// A film's frame size in pixels, its rate in Hz, and whether it has sound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) size: [u32; 2],
    pub(crate) fps: u32,
    pub(crate) sounds: bool,
}

/// The file of a film that is being made.
#[derive(Debug)]
pub(crate) struct Mp4 {
    // Closed before the next one, which may take the file away.
    file: File,
    staged: Staged,
    size: [u32; 2],
    /// Bytes that have been written.
    end: u64,
    /// Describes each fragment in front of it.
    fragments: Fmp4SegmentMuxer,
    /// Collects what the finished film's index has: some 30 bytes a sample, 10 MB an hour.
    index: Mp4FileMuxer,
    pictures: Track,
    sound: Option<Track>,
}

impl Mp4 {
    /// Begins the file of a film whose first picture, a key frame, is `first`.
    pub(crate) fn begin(staged: Staged, shape: Shape, first: Coded<'_>) -> Result<Self, FilmError> {
        let file = staged.try_clone().map_err(unwritten(&staged.path))?;
        let pictures = Track::of_pictures(shape, first.bytes)?;
        let sound = shape.sounds.then(Track::of_sound);
        let mut fragments = Fmp4SegmentMuxer::new()?;
        // It learns its tracks from samples. These are empty and last no time, so that the header has the sound also where its first
        // packet comes late.
        let none: Vec<Sample> = [Some(&pictures), sound.as_ref()]
            .into_iter()
            .flatten()
            .map(|track| Sample {
                duration: 0,
                ..track.sample(0, true)
            })
            .collect();
        fragments.create_media_segment_metadata(&none)?;
        let index = Mp4FileMuxer::new()?;
        let (head, size) = head(&fragments, &index)?;
        let mut begun = Self {
            file,
            staged,
            size: shape.size,
            end: 0,
            fragments,
            index,
            pictures,
            sound,
        };
        begun.index.advance_position(size)?;
        begun.write(&head)?;
        Ok(begun)
    }

    /// Adds a picture. Before a key frame, what came before it is written.
    pub(crate) fn add_picture(&mut self, coded: Coded<'_>) -> Result<(), FilmError> {
        if coded.is_key {
            self.write_fragment()?;
        }
        let begin = self.pictures.bytes.len();
        for unit in units(coded.bytes) {
            let length = unit.len() as u32;
            self.pictures.bytes.extend(length.to_be_bytes());
            self.pictures.bytes.extend_from_slice(unit);
        }
        self.pictures.end_sample(begin, coded.is_key);
        Ok(())
    }

    /// Adds a packet of Opus; the first belongs to the film's begin, and each follows the one before.
    pub(crate) fn add_packet(&mut self, packet: &[u8]) {
        if let Some(sound) = &mut self.sound {
            let begin = sound.bytes.len();
            sound.bytes.extend_from_slice(packet);
            sound.end_sample(begin, true);
        }
    }

    /// Ends the file with its index, and with a track of subtitles for each of these languages.
    pub(crate) fn finish(mut self, texts: &[Subtitles]) -> Result<Staged, FilmError> {
        self.write_fragment()?;
        // Of pictures: sound ends with them or before.
        let lasts = milliseconds(self.pictures.until, self.pictures.units);
        let mut places = Vec::with_capacity(texts.len());
        if !texts.is_empty() {
            let lasts = u32::try_from(lasts).map_err(|_| SubtitlesError::TooLarge)?;
            for text in texts {
                let samples = track::samples(text, lasts)?;
                self.index.advance_position(samples.len() as u64)?;
                places.push((text, lasts, self.end));
                self.write(&samples)?;
            }
        }

        let finished = self.index.finalize()?;
        let mut moov = finished.moov_box().clone();
        let end = self.end;
        // The muxer's own `moov` would be there.
        let heads: Vec<(u64, Vec<u8>)> = finished
            .offset_and_bytes_pairs()
            .filter(|(at, _)| *at != end)
            .map(|(at, bytes)| (at, bytes.to_vec()))
            .collect();
        // The muxer has the sound first. It counts each track's length in units of that track, where players expect the movie's (8.3.2).
        moov.trak_boxes.reverse();
        moov.mvhd_box.timescale = NonZeroU32::MIN.saturating_add(track::MILLISECONDS - 1);
        moov.mvhd_box.duration = lasts;
        for (track, id) in moov.trak_boxes.iter_mut().zip(1..) {
            let media = &track.mdia_box.mdhd_box;
            track.tkhd_box.duration = milliseconds(media.duration, media.timescale);
            track.tkhd_box.track_id = id;
        }
        let next = moov.trak_boxes.len() as u32 + 1;
        moov.mvhd_box.next_track_id = next + texts.len() as u32;
        for ((text, lasts, place), id) in places.into_iter().zip(next..) {
            let made = track::trak(text, (id, lasts), self.size, place)?;
            let (made, _) = UnknownBox::decode(&made).map_err(MuxError::from)?;
            moov.unknown_boxes.push(made);
        }
        // The index comes first: until the heads before the samples tell of it, the file is a fragmented one.
        let moov = moov.encode_to_vec().map_err(MuxError::from)?;
        self.write(&moov)?;
        for (at, bytes) in heads {
            self.write_at(at, &bytes)?;
        }
        Ok(self.staged)
    }

    /// Writes the samples that wait, as a fragment.
    fn write_fragment(&mut self) -> Result<(), FilmError> {
        let (mut samples, mut bytes) = (Vec::new(), Vec::new());
        for track in [Some(&mut self.pictures), self.sound.as_mut()]
            .into_iter()
            .flatten()
        {
            for mut sample in track.waiting.drain(..) {
                sample.data_offset += bytes.len() as u64;
                samples.push(sample);
            }
            bytes.append(&mut track.bytes);
        }
        if samples.is_empty() {
            return Ok(());
        }
        let head = self.fragments.create_media_segment_metadata(&samples)?;
        self.index.advance_position(head.len() as u64)?;
        self.write(&head)?;
        for mut sample in samples {
            sample.data_offset += self.end;
            self.index.append_sample(&sample)?;
        }
        self.write(&bytes)
    }

    /// Writes behind what has been written.
    fn write(&mut self, bytes: &[u8]) -> Result<(), FilmError> {
        self.write_at(self.end, bytes)?;
        self.end += bytes.len() as u64;
        Ok(())
    }

    fn write_at(&mut self, at: u64, bytes: &[u8]) -> Result<(), FilmError> {
        let there = self.file.seek(SeekFrom::Start(at));
        let written = there.and_then(|_| self.file.write_all(bytes));
        written.map_err(unwritten(&self.staged.path))
    }
}

/// What an unfinished film begins with, and the size of its part that lies behind the finished film's head.
fn head(fragments: &Fmp4SegmentMuxer, index: &Mp4FileMuxer) -> Result<(Vec<u8>, u64), MuxError> {
    let header = fragments.init_segment_bytes()?;
    let (_, size) = FtypBox::decode(&header)?;
    let (kind, rest) = header.split_at(size);
    let (mut moov, _) = MoovBox::decode(rest)?;
    // Without this box a length is not known; with it, it would be 0.
    if let Some(extends) = &mut moov.mvex_box {
        extends.mehd_box = None;
    }
    // Unused until the finished film's head and the header of its `mdat` are put here.
    let room = index.initial_boxes_bytes().len();
    let free = FreeBox {
        payload: vec![0; room.saturating_sub(kind.len() + BoxHeader::MIN_SIZE)],
    };
    let moov = moov.encode_to_vec()?;
    let head = [kind, &free.encode_to_vec()?, &moov].concat();
    Ok((head, moov.len() as u64))
}

/// A track, and its samples that are not in the file yet.
#[derive(Debug)]
struct Track {
    kind: TrackKind,
    entry: SampleEntry,
    /// Units of time in a second.
    units: NonZeroU32,
    /// How long each sample lasts, in these units.
    lasts: u32,
    /// End of the last sample, in these units.
    until: u64,
    bytes: Vec<u8>,
    waiting: Vec<Sample>,
}

impl Track {
    /// Of H.264, as this key frame describes it. Its parameter sets stay in key frames too, which need not be taken apart.
    fn of_pictures(shape: Shape, key: &[u8]) -> Result<Self, FilmError> {
        // Kinds of NAL units (H.264, table 7-1).
        let first = |kind: u8| {
            let mut all = units(key);
            let found = all.find(|unit| unit.first().is_some_and(|head| head & 31 == kind));
            found.map(<[u8]>::to_vec).ok_or(FilmError::Stopped)
        };
        let (sps, pps) = (first(7)?, first(8)?);
        let Some(&[profile, compatibility, level]) = sps.get(1..4) else {
            return Err(FilmError::Stopped);
        };
        // Profiles above Main state that colours are 4:2:0, of 8 bits.
        let high = !matches!(profile, 66 | 77 | 88);
        let [width, height] = shape.size.map(|pixels| pixels as u16);
        let entry = Avc1Box {
            visual: VisualSampleEntryFields {
                data_reference_index: VisualSampleEntryFields::DEFAULT_DATA_REFERENCE_INDEX,
                width,
                height,
                horizresolution: VisualSampleEntryFields::DEFAULT_HORIZRESOLUTION,
                vertresolution: VisualSampleEntryFields::DEFAULT_VERTRESOLUTION,
                frame_count: VisualSampleEntryFields::DEFAULT_FRAME_COUNT,
                compressorname: VisualSampleEntryFields::NULL_COMPRESSORNAME,
                depth: VisualSampleEntryFields::DEFAULT_DEPTH,
            },
            avcc_box: AvccBox {
                avc_profile_indication: profile,
                profile_compatibility: compatibility,
                avc_level_indication: level,
                length_size_minus_one: Uint::new(3),
                sps_list: vec![sps],
                pps_list: vec![pps],
                chroma_format: high.then_some(Uint::new(1)),
                bit_depth_luma_minus8: high.then_some(Uint::new(0)),
                bit_depth_chroma_minus8: high.then_some(Uint::new(0)),
                sps_ext_list: Vec::new(),
            },
            unknown_boxes: Vec::new(),
        };
        // A thousand units a frame: some players take a coarse unit for the precision of times.
        let frame = 1000;
        Ok(Self::new(
            TrackKind::Video,
            SampleEntry::Avc1(entry),
            shape.fps * frame,
            frame,
        ))
    }

    /// Of Opus in stereo.
    fn of_sound() -> Self {
        let entry = OpusBox {
            audio: AudioSampleEntryFields {
                data_reference_index: AudioSampleEntryFields::DEFAULT_DATA_REFERENCE_INDEX,
                channelcount: 2,
                samplesize: AudioSampleEntryFields::DEFAULT_SAMPLESIZE,
                samplerate: FixedPointNumber::new(RATE as u16, 0),
            },
            dops_box: DopsBox {
                output_channel_count: 2,
                pre_skip: OPUS_DELAY,
                input_sample_rate: RATE,
                output_gain: 0,
            },
            unknown_boxes: Vec::new(),
        };
        let packet = OPUS_PACKET as u32;
        Self::new(TrackKind::Audio, SampleEntry::Opus(entry), RATE, packet)
    }

    fn new(kind: TrackKind, entry: SampleEntry, units: u32, lasts: u32) -> Self {
        Self {
            kind,
            entry,
            units: NonZeroU32::new(units).unwrap_or(NonZeroU32::MIN),
            lasts,
            until: 0,
            bytes: Vec::new(),
            waiting: Vec::new(),
        }
    }

    /// The sample that begins at that waiting byte and goes on to the last.
    fn sample(&self, begin: usize, keyframe: bool) -> Sample {
        Sample {
            track_kind: self.kind,
            sample_entry: Some(self.entry.clone()),
            keyframe,
            timescale: self.units,
            duration: self.lasts,
            composition_time_offset: None,
            data_offset: begin as u64,
            data_size: self.bytes.len() - begin,
        }
    }

    fn end_sample(&mut self, begin: usize, keyframe: bool) {
        let sample = self.sample(begin, keyframe);
        self.waiting.push(sample);
        self.until += u64::from(self.lasts);
    }
}

/// A time, ms.
fn milliseconds(time: u64, units: NonZeroU32) -> u64 {
    let units = u64::from(units.get());
    (time * u64::from(track::MILLISECONDS) + units / 2) / units
}

/// The NAL units of a stream that has a start code before each.
fn units(stream: &[u8]) -> impl Iterator<Item = &[u8]> {
    nal_units(stream).map(|unit| {
        // A start code may have four bytes, of which the first is left at the end of the unit before; no unit ends with 0.
        let end = unit.iter().rposition(|byte| *byte != 0);
        unit.get(3..end.map_or(0, |last| last + 1))
            .unwrap_or_default()
    })
}
