//! A connection to a PulseAudio server: messages there and back.

use std::ffi::CString;
use std::io::{BufReader, Read};
use std::os::unix::fs::MetadataExt;
use std::os::unix::net::UnixStream;
use std::path::PathBuf;

use pulseaudio::protocol::{
    self, AuthParams, AuthReply, Command, CommandReply, LatencyParams, MAX_VERSION, Prop, Props,
    ProtocolError, SetClientNameReply, SetPlaybackStreamBufferAttrParams,
};

use super::refused;
use crate::output::{OutputError, PATIENCE};

/// Longest message that is read, bytes: a list of a thousand outputs.
const LONGEST: u32 = 1 << 22;

/// A connection.
#[derive(Debug)]
pub(super) struct Link {
    socket: BufReader<UnixStream>,
    version: u16,
    message: Vec<u8>,
}

impl Link {
    /// Numbers of the requests for the latency, for another buffer, and of all others.
    pub(super) const LATENCY: u32 = 2;
    pub(super) const BUFFER: u32 = 3;
    const QUESTION: u32 = 1;

    /// Finds the server and introduces this program.
    pub(super) fn connect() -> Result<Self, OutputError> {
        let path = path().ok_or(OutputError::NoServer)?;
        let socket = UnixStream::connect(path).map_err(|_| OutputError::NoServer)?;
        Self::greet(socket).map_err(|error| refused(&error))
    }

    fn greet(socket: UnixStream) -> Result<Self, ProtocolError> {
        socket.set_read_timeout(Some(PATIENCE))?;
        socket.set_write_timeout(Some(PATIENCE))?;
        let mut link = Self {
            socket: BufReader::new(socket),
            version: MAX_VERSION,
            message: Vec::new(),
        };
        let cookie = pulseaudio::cookie_path_from_env().and_then(|path| std::fs::read(path).ok());
        let reply: AuthReply = link.ask(&Command::Auth(AuthParams {
            version: MAX_VERSION,
            supports_shm: false,
            supports_memfd: false,
            cookie: cookie.unwrap_or_default(),
        }))?;
        link.version = reply.version.min(MAX_VERSION);
        let mut props = Props::new();
        props.set(Prop::ApplicationName, c"Vitriol");
        let process = CString::new(std::process::id().to_string()).unwrap_or_default();
        props.set(Prop::ApplicationProcessId, process);
        let _: SetClientNameReply = link.ask(&Command::SetClientName(props))?;
        Ok(link)
    }

    /// Sends a command, and waits for the reply; other messages meanwhile are skipped.
    pub(super) fn ask<R: CommandReply>(&mut self, command: &Command) -> Result<R, ProtocolError> {
        let version = self.version;
        self.say(Self::QUESTION, command)?;
        loop {
            self.read()?;
            match protocol::read_reply_message(&mut self.message.as_slice(), version) {
                Err(ProtocolError::UnexpectedCommand(_)) => {}
                Ok((_, reply)) => return Ok(reply),
                Err(error) => return Err(error),
            }
        }
    }

    /// From now on reading waits without limit: a suspended output sends no requests.
    pub(super) fn wait_for_ever(&mut self) -> Result<(), ProtocolError> {
        Ok(self.socket().set_read_timeout(None)?)
    }

    /// The next message: its number, the command, and its data. Messages that this program does not support are skipped.
    pub(super) fn next(&mut self) -> Result<(u32, Command, Vec<u8>), ProtocolError> {
        loop {
            self.read()?;
            let mut rest = self.message.as_slice();
            if let Ok((number, command)) = protocol::read_command_message(&mut rest, self.version) {
                return Ok((number, command, rest.to_vec()));
            }
        }
    }

    /// Requests the latency; the reply comes between others.
    pub(super) fn ask_latency(&mut self, of: LatencyParams) -> Result<(), ProtocolError> {
        self.say(Self::LATENCY, &Command::GetPlaybackLatency(of))
    }

    /// Requests another buffer; the reply comes between others.
    pub(super) fn ask_buffer(
        &mut self,
        of: SetPlaybackStreamBufferAttrParams,
    ) -> Result<(), ProtocolError> {
        self.say(Self::BUFFER, &Command::SetPlaybackStreamBufferAttr(of))
    }

    fn say(&mut self, number: u32, command: &Command) -> Result<(), ProtocolError> {
        protocol::write_command_message(self.socket.get_mut(), number, command, self.version)
    }

    /// Writes samples to a stream.
    pub(super) fn give(&mut self, channel: u32, samples: &[u8]) -> Result<(), ProtocolError> {
        protocol::write_memblock(self.socket.get_mut(), channel, samples, 0)
    }

    /// Reads one whole message, so that one that cannot be parsed leaves no rest.
    fn read(&mut self) -> Result<(), ProtocolError> {
        let descriptor = protocol::read_descriptor(&mut self.socket)?;
        if descriptor.length > LONGEST {
            return Err(ProtocolError::Invalid("a message is too long".into()));
        }
        self.message.clear();
        protocol::write_descriptor(&mut self.message, &descriptor)?;
        let mut body = (&mut self.socket).take(u64::from(descriptor.length));
        let read = body.read_to_end(&mut self.message)?;
        if read as u64 == u64::from(descriptor.length) {
            return Ok(());
        }
        Err(ProtocolError::Io(std::io::ErrorKind::UnexpectedEof.into()))
    }

    pub(super) fn socket(&self) -> &UnixStream {
        self.socket.get_ref()
    }

    pub(super) fn version(&self) -> u16 {
        self.version
    }
}

/// The server's socket: PULSE_SERVER's, else the user's. The crate's own search stops at the first that is missing, and does not look into
/// a session's folder.
fn path() -> Option<PathBuf> {
    let variable = |name: &str| std::env::var_os(name).map(PathBuf::from);
    if let Ok(named) = std::env::var("PULSE_SERVER") {
        let path = named.strip_prefix("unix:").unwrap_or(&named);
        return path.starts_with('/').then(|| PathBuf::from(path));
    }
    let folder = variable("PULSE_RUNTIME_PATH");
    let session = variable("XDG_RUNTIME_DIR").or_else(|| {
        let user = std::fs::metadata("/proc/self").ok()?.uid();
        Some(PathBuf::from(format!("/run/user/{user}")))
    });
    let all = folder.into_iter().chain(session.map(|it| it.join("pulse")));
    all.map(|it| it.join("native")).find(|path| path.exists())
}
