//! The run as a recording that viewers open: the track's own topics, and beside them particles, film and measurements.

use std::collections::BTreeMap;

use vitriol_experiment::output::OutDir;
use vitriol_experiment::particles::Particles;
use vitriol_experiment::track::{STATE_HASH, blame};
use vitriol_experiment::{
    Blame, Experiment, FILM_FPS, FILM_SIZE, Failure, FilmError, H264, Laboratory, Moment, Sample,
    stage,
};
use vitriol_xr::PoseFrame;
use vitriol_xr::track::{Annex, Existing, TrackMetadata, TrackWriter};

use crate::sink::{Frame, Sink};

/// Name of the file.
pub const FILE: &str = "recording.mcap";

/// A recording that is being written.
pub struct Recording {
    writer: TrackWriter,
    encoder: H264,
    /// Film frames so far.
    film: u32,
    /// Time of the last frame, ns.
    last_ns: Option<i64>,
    schema: String,
}

impl Recording {
    /// One of a run of what `metadata` says; samples have that JSON schema.
    ///
    /// # Errors
    /// What the file system says.
    pub fn new(
        metadata: &TrackMetadata,
        schema: String,
        out: &mut OutDir,
    ) -> Result<Self, Failure> {
        let path = out.join(FILE);
        let writer = TrackWriter::create(&path, metadata, Existing::Refuse).map_err(blame)?;
        out.adopt(path);
        Ok(Self {
            writer,
            encoder: H264::new(FILM_SIZE, FILM_FPS).other()?,
            film: 0,
            last_ns: None,
            schema,
        })
    }

    fn write(
        &mut self,
        frame: &PoseFrame,
        laboratory: &Laboratory,
        until_ns: i64,
    ) -> Result<(), Failure> {
        let mut frame = frame.clone();
        // Poses that are held after the track's end have the time of its last frame.
        if let Some(last) = self.last_ns
            && frame.time_ns <= last
        {
            frame.time_ns = until_ns.max(last + 1);
        }
        self.last_ns = Some(frame.time_ns);
        let flasks = stage::flasks(laboratory.world());
        self.writer.write(&frame, &flasks).map_err(blame)
    }

    fn film(&mut self, moment: &Moment<'_>, laboratory: &mut Laboratory) -> Result<(), Failure> {
        let seconds = moment.time.seconds();
        let due = (seconds * f64::from(FILM_FPS) + 1e-6).floor() as u32 + 1;
        if moment.frame.is_none() || due <= self.film {
            return Ok(());
        }
        let picture = laboratory.picture(0)?;
        let coded = self.encoder.encode(picture).other()?;
        let number = self.film;
        let coded = coded.ok_or(FilmError::TooRich { number }).other()?;
        let film = Annex::Film(coded.bytes);
        self.writer
            .add(nanoseconds(seconds), &film)
            .map_err(blame)?;
        // A step that is longer than a frame has one all the same: messages have times of their own.
        self.film = due;
        Ok(())
    }
}

fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

impl Sink for Recording {
    fn step(
        &mut self,
        moment: &Moment<'_>,
        laboratory: &mut Laboratory,
        _out: &mut OutDir,
    ) -> Result<(), Failure> {
        if let Some(frame) = moment.frame {
            self.write(frame, laboratory, nanoseconds(moment.time.seconds()))?;
        }
        self.film(moment, laboratory)
    }

    fn frame(&mut self, frame: &Frame<'_>, _out: &mut OutDir) -> Result<(), Failure> {
        let (fields, rows) = rows(frame.particles());
        let points = Annex::Points {
            fields: &fields,
            rows: &rows,
        };
        let time_ns = nanoseconds(frame.seconds);
        self.writer.add(time_ns, &points).map_err(blame)
    }

    fn sample(&mut self, sample: &Sample, _out: &mut OutDir) -> Result<(), Failure> {
        let json = serde_json::to_string(sample).other()?;
        let measurement = Annex::Measurement {
            json: &json,
            schema: &self.schema,
        };
        let time_ns = nanoseconds(sample.t_s);
        self.writer.add(time_ns, &measurement).map_err(blame)
    }

    fn finish(&mut self, hash: u64, _out: &mut OutDir) -> Result<(), Failure> {
        let said = BTreeMap::from([(STATE_HASH.to_owned(), format!("{hash:016x}"))]);
        self.writer.conclude(&said).map_err(blame)?;
        self.writer.finish().map_err(blame)?;
        Ok(())
    }
}

/// Names of the columns, and the rows.
fn rows(particles: &Particles) -> (Vec<&'static str>, Vec<f32>) {
    let heat = !particles.temperature.is_empty();
    let mut fields = vec!["x", "y", "z", "speed", "flask"];
    if heat {
        fields.extend(["temperature", "acid"]);
    }
    let mut rows = Vec::with_capacity(fields.len() * particles.len());
    for index in 0..particles.len() {
        let place = particles.position[index].as_vec3();
        rows.extend(place.to_array());
        rows.push(particles.velocity[index].length() as f32);
        rows.push(particles.flask[index] as f32);
        if heat {
            rows.extend([particles.temperature[index], particles.acid[index]]);
        }
    }
    (fields, rows)
}
