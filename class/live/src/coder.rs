//! Codes pictures for the console on a thread of its own: a picture takes longer than a frame may.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::time::Duration;

use vitriol_console::{Codec, EncodedPicture, Port};
use vitriol_run::{Blame, Failure, H264};

use vitriol_gpu::Buffer;

/// Longest side of the view, pixels. Our choice: the panel's text is read in it, and a core codes one in a tenth of its time.
pub const VIEW_SIDE: u32 = 720;

/// Pictures a second at most. Our choice: a pour takes half a second.
pub const VIEW_FPS: u32 = 30;

/// Time between two pictures of the glass from close by. Our choice: liquid is seen to rise and boil, and a frame in 14 pays for one where
/// a headset shows 72 a second.
pub const CLOSE_UP_EVERY: Duration = Duration::from_millis(200);

/// From where a picture is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Viewpoint {
    /// The student's eyes.
    Student,
    /// Close to the glass.
    CloseUp,
}

/// How many viewpoints there are.
const VIEWPOINTS: usize = 2;

/// A picture to be coded.
pub enum RawPicture {
    /// 0x00RRGGBB, rows from the top, in memory that the device has written and the host reads, and its width and height.
    Device(Arc<Buffer>, [u32; 2]),
    /// RGBA, rows from the top, and its width and height.
    Rgba(Vec<u8>, [u32; 2]),
}

/// A picture, from where it is seen, and its time since the view began, µs.
type Given = (RawPicture, Viewpoint, u64);

/// Codes pictures for the console on a thread of its own, which ends when this is dropped.
pub struct Coder {
    port: Port,
    /// `None` once it ends.
    pictures: Option<SyncSender<Given>>,
    /// By viewpoint, whether a picture waits.
    waits: Arc<[AtomicBool; VIEWPOINTS]>,
    thread: Option<std::thread::JoinHandle<()>>,
}

/// The pictures that wait to be coded: one of each viewpoint at most, since what is older than that is not live. The student's pictures,
/// 30 a second, so leave a place to those from close by, which are six times rarer, where coding takes longer than a 30th of a second.
struct Queue {
    pictures: Receiver<Given>,
    waits: Arc<[AtomicBool; VIEWPOINTS]>,
}

impl Iterator for Queue {
    type Item = Given;

    /// The next one, which is waited for; `None` once the coder ends.
    fn next(&mut self) -> Option<Given> {
        let given = self.pictures.recv().ok()?;
        self.waits[given.1 as usize].store(false, Ordering::Release);
        Some(given)
    }
}

impl Coder {
    /// A coder for the pages that look at that port's student.
    ///
    /// # Errors
    /// Where no thread can be started.
    pub fn new(port: &Port) -> Result<Self, Failure> {
        let (mut coder, queue) = Self::without_thread(port);
        let own = port.clone();
        let thread = std::thread::Builder::new()
            .name("console-view".to_owned())
            .spawn(move || code_all(&own, queue))
            .other()?;
        coder.thread = Some(thread);
        Ok(coder)
    }

    /// A coder, and the queue that its thread takes pictures from.
    fn without_thread(port: &Port) -> (Self, Queue) {
        let (sender, pictures) = sync_channel(VIEWPOINTS);
        let waits = Arc::<[AtomicBool; VIEWPOINTS]>::default();
        let coder = Self {
            port: port.clone(),
            pictures: Some(sender),
            waits: waits.clone(),
            thread: None,
        };
        (coder, Queue { pictures, waits })
    }

    /// Whether a page shows what is seen from there; of the student's eyes, also whether a picture for a card was asked for.
    pub fn is_wanted(&self, from: Viewpoint) -> bool {
        let wanted = self.port.wanted();
        match from {
            Viewpoint::Student => wanted.h264 || wanted.jpeg || self.port.wants_card(),
            Viewpoint::CloseUp => wanted.close_up,
        }
    }

    /// Hands in the picture of that time (µs) since the view began; while another from there waits, it is left out. Does not wait.
    pub fn give(&self, picture: RawPicture, from: Viewpoint, time_us: u64) {
        let Some(pictures) = &self.pictures else {
            return;
        };
        if !self.waits[from as usize].swap(true, Ordering::AcqRel) {
            // There is room for one of each. It fails only where the thread has ended.
            let _ = pictures.try_send((picture, from, time_us));
        }
    }
}

impl Drop for Coder {
    fn drop(&mut self) {
        self.pictures = None;
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has reported that itself.
            let _ = thread.join();
        }
    }
}

fn code_all(port: &Port, queue: Queue) {
    let mut coding = Coding::default();
    let mut told = false;
    for (picture, from, time_us) in queue {
        let coded = match from {
            Viewpoint::Student => coding.code(port, &picture, time_us),
            Viewpoint::CloseUp => coding.code_close_up(port, &picture, time_us),
        };
        if let Err(failure) = coded
            && !std::mem::replace(&mut told, true)
        {
            tracing::warn!("the console's view stands still: {failure}");
        }
    }
}

#[derive(Default)]
struct Coding {
    rgba: Vec<u8>,
    /// For pictures of that size.
    encoder: Option<([u32; 2], H264)>,
}

impl Coding {
    fn code(&mut self, port: &Port, picture: &RawPicture, time_us: u64) -> Result<(), Failure> {
        let (wanted, card) = (port.wanted(), port.take_card_request());
        if !wanted.h264 && !wanted.jpeg && !card {
            return Ok(());
        }
        let Some(size) = self.unpack(picture)? else {
            return Ok(());
        };
        let sides = sides(size);
        if wanted.h264 {
            let (coded_size, mut encoder) = match self.encoder.take() {
                Some(kept) if kept.0 == size => kept,
                _ => (size, H264::live(size, VIEW_FPS).other()?),
            };
            if port.take_key_request() {
                encoder.begin_anew();
            }
            if let Some(coded) = encoder.encode(&self.rgba).other()? {
                port.picture(Arc::new(EncodedPicture {
                    codec: Codec::H264,
                    is_key: coded.is_key,
                    size: sides,
                    time_us,
                    bytes: coded.bytes.to_vec(),
                }));
            }
            self.encoder = Some((coded_size, encoder));
        }
        if wanted.jpeg {
            let coded = EncodedPicture::jpeg(&self.rgba, sides, time_us).other()?;
            port.picture(Arc::new(coded));
        }
        if card {
            let coded = EncodedPicture::card(&self.rgba, sides, time_us).other()?;
            port.picture(Arc::new(coded));
        }
        Ok(())
    }

    /// Each of these pictures stands alone: there are too few for a stream.
    fn code_close_up(
        &mut self,
        port: &Port,
        picture: &RawPicture,
        time_us: u64,
    ) -> Result<(), Failure> {
        if !port.wanted().close_up {
            return Ok(());
        }
        if let Some(size) = self.unpack(picture)? {
            let coded = EncodedPicture::close_up(&self.rgba, sides(size), time_us).other()?;
            port.picture(Arc::new(coded));
        }
        Ok(())
    }

    /// Its pixels as RGBA, and width and height, which H.264 wants even; `None` of one that is too small for it.
    fn unpack(&mut self, picture: &RawPicture) -> Result<Option<[u32; 2]>, Failure> {
        let extent = match picture {
            RawPicture::Device(_, extent) | RawPicture::Rgba(_, extent) => *extent,
        };
        let size = extent.map(|side| side & !1);
        if size.iter().any(|side| *side < 16) {
            return Ok(None);
        }
        let (wide, [width, height]) = (extent[0] as usize, size.map(|side| side as usize));
        self.rgba.clear();
        match picture {
            RawPicture::Device(pixels, [_, rows]) => {
                let pixels = pixels.read_host::<u32>(wide * *rows as usize).other()?;
                for row in pixels.chunks_exact(wide).take(height) {
                    let bytes = row[..width].iter().flat_map(|pixel| {
                        // 0x00RRGGBB.
                        let [_, r, g, b] = pixel.to_be_bytes();
                        [r, g, b, 255]
                    });
                    self.rgba.extend(bytes);
                }
            }
            RawPicture::Rgba(bytes, _) => {
                for row in bytes.chunks_exact(4 * wide).take(height) {
                    self.rgba.extend(&row[..4 * width]);
                }
            }
        }
        Ok(Some(size))
    }
}

/// Width and height as they are sent.
fn sides(size: [u32; 2]) -> [u16; 2] {
    size.map(|side| u16::try_from(side).unwrap_or(u16::MAX))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::serve::{Console, ada};
    use std::time::Instant;
    use vitriol_console::{Heard, Watcher};

    /// The longest wait. The hub asks every 4 s; a machine that is busy may take longer.
    const PATIENCE: Duration = Duration::from_secs(300);

    /// A page that shows the class gets a small picture for a request, though no page shows the student.
    #[test]
    fn a_card_is_coded_where_it_is_asked_for() {
        let (hub, Console { port, .. }) = ada(true);
        let coder = Coder::new(&port).unwrap();
        assert!(!coder.is_wanted(Viewpoint::Student));
        let mut page = Watcher::enter(&hub, Codec::H264).unwrap();
        page.show_class().unwrap();
        let begun = Instant::now();
        while !port.wants_card() {
            assert!(begun.elapsed() < PATIENCE, "no card is asked for");
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(coder.is_wanted(Viewpoint::Student) && !port.wanted().h264);
        let side = 400;
        let pixels = vec![200; 4 * 400 * 400];
        let picture = RawPicture::Rgba(pixels, [side, side]);
        coder.give(picture, Viewpoint::Student, 0);
        let bytes = loop {
            if let Heard::Picture(bytes) = page.hear().unwrap() {
                break bytes;
            }
        };
        // One colour takes a small part of the 16,000 bytes that a card may have.
        assert!((8..16_008).contains(&bytes), "{bytes} bytes");
    }

    /// A page that shows the glass gets what is seen from there and not the student's view, which nobody shows then.
    #[test]
    fn a_close_up_goes_to_who_asks_for_it() {
        let (hub, Console { port, student, .. }) = ada(true);
        assert!(student.close_up);
        let coder = Coder::new(&port).unwrap();
        assert!(!coder.is_wanted(Viewpoint::CloseUp));
        let mut page = Watcher::enter(&hub, Codec::CloseUp).unwrap();
        let begun = Instant::now();
        while !coder.is_wanted(Viewpoint::CloseUp) {
            assert!(begun.elapsed() < PATIENCE, "no close-up is asked for");
            std::thread::sleep(Duration::from_millis(20));
        }
        assert_eq!([port.wanted().h264, port.wanted().jpeg], [false; 2]);
        let picture = |side: u32| {
            let bytes = 4 * side as usize * side as usize;
            RawPicture::Rgba(vec![200; bytes], [side; 2])
        };
        coder.give(picture(64), Viewpoint::CloseUp, 0);
        let seen = page.see().unwrap();
        // The second camera's mark, and width and height, little-endian.
        assert_eq!(seen[0], 4);
        assert_eq!(seen[4..8], [64, 0, 64, 0]);
    }

    /// While one picture is coded, one from each viewpoint waits, and further ones are left out, whichever come first.
    #[test]
    fn one_picture_of_each_viewpoint_waits() {
        let (_hub, Console { port, .. }) = ada(true);
        let (coder, mut queue) = Coder::without_thread(&port);
        let give = |from, time_us| {
            let picture = RawPicture::Rgba(Vec::new(), [0; 2]);
            coder.give(picture, from, time_us);
        };
        for (from, time_us) in [
            (Viewpoint::Student, 0),
            (Viewpoint::Student, 1),
            (Viewpoint::CloseUp, 2),
            (Viewpoint::CloseUp, 3),
        ] {
            give(from, time_us);
        }
        let seen = |(_, from, time_us): Given| (from, time_us);
        assert_eq!(queue.next().map(seen), Some((Viewpoint::Student, 0)));
        // Its place is free again, and the other one's is not.
        give(Viewpoint::CloseUp, 4);
        give(Viewpoint::Student, 5);
        drop(coder);
        let rest: Vec<_> = queue.map(seen).collect();
        assert_eq!(rest, [(Viewpoint::CloseUp, 2), (Viewpoint::Student, 5)]);
    }

    mod long {
        use super::*;
        use vitriol_console::State;

        /// A page that only reads answers nothing but pings, which come every 10 s; the hub takes 30 s of silence for its end. If only the
        /// first ping came, that would be after 40 s.
        #[test]
        fn a_page_that_only_reads_is_served_on() {
            let (hub, Console { port, .. }) = ada(true);
            let mut page = Watcher::enter(&hub, Codec::Jpeg).unwrap();
            let begun = Instant::now();
            for frame in 0.. {
                port.publish(State {
                    frame,
                    ..State::default()
                });
                page.hear_state().unwrap();
                if begun.elapsed() > Duration::from_secs(45) {
                    break;
                }
                std::thread::sleep(Duration::from_millis(100));
            }
        }
    }
}
