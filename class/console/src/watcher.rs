//! A stand-in for a page, without a browser: it comes in, shows a student, and gives orders. Many of them measure the cost of pages.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::http::HeaderValue;
use tokio_tungstenite::tungstenite::{self, Message, WebSocket};

use crate::command::Command;
use crate::hub::Hub;
use crate::picture::Codec;

/// The longest silence of a hub.
const PATIENCE: Duration = Duration::from_secs(30);

/// The hub did not serve it, for this reason.
#[derive(Debug, thiserror::Error)]
#[error("a page's stand-in is not served: {0}; it is for a hub on loopback, with a student in it")]
pub struct NotServed(String);

fn not_served(cause: impl ToString) -> NotServed {
    NotServed(cause.to_string())
}

/// A message from the hub.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heard {
    /// A state, with the number of the last order that has taken effect in it.
    State(u64),
    /// A picture, with its size in bytes.
    Picture(usize),
    /// The answer to an order, with its number.
    Ordered(u64),
    /// Something else.
    Other,
}

/// A stand-in for a page, connected to a hub. It leaves when it is dropped.
pub struct Watcher {
    socket: WebSocket<TcpStream>,
    student: u64,
    echo: u32,
}

impl Watcher {
    /// Comes in with a new code, and opens the first student, with pictures in `codec`.
    ///
    /// # Errors
    /// [`NotServed`], also for a hub that uses HTTPS.
    pub fn enter(hub: &Hub, codec: Codec) -> Result<Self, NotServed> {
        let (to, code) = (hub.address(), hub.invite().map_err(not_served)?.code);
        let connect = || {
            let stream = TcpStream::connect(to)?;
            stream.set_read_timeout(Some(PATIENCE))?;
            stream.set_nodelay(true)?;
            Ok::<_, std::io::Error>(stream)
        };
        let mut stream = connect().map_err(not_served)?;
        let fields = format!("Host: {to}\r\nOrigin: http://{to}\r\nConnection: close");
        let length = code.len();
        let request =
            format!("POST /enter HTTP/1.1\r\n{fields}\r\nContent-Length: {length}\r\n\r\n{code}");
        stream.write_all(request.as_bytes()).map_err(not_served)?;
        // No answer to this request is longer.
        let lines = BufReader::new(stream.take(64 << 10)).lines();
        let mut lines = lines.map_while(Result::ok);
        let set = lines.find_map(|line| {
            let (name, value) = line.split_once(": ")?;
            let value = value.split(';').next()?.to_owned();
            name.eq_ignore_ascii_case("set-cookie").then_some(value)
        });
        let cookie = set.ok_or_else(|| not_served("it gives no cookie"))?;
        let mut request = format!("ws://{to}/socket")
            .into_client_request()
            .map_err(not_served)?;
        for (name, value) in [("Origin", format!("http://{to}")), ("Cookie", cookie)] {
            let value = HeaderValue::from_str(&value).map_err(not_served)?;
            request.headers_mut().insert(name, value);
        }
        let opened = tungstenite::client(request, connect().map_err(not_served)?);
        let (socket, _) = opened.map_err(not_served)?;
        let mut watcher = Self {
            socket,
            student: 0,
            echo: 0,
        };
        watcher.say(&json!({"say": "pictures", "codec": codec}))?;
        watcher.student = loop {
            let class = watcher.hear_text()?;
            if let Some(student) = class["students"][0]["student"].as_u64() {
                break student;
            }
        };
        let student = watcher.student;
        watcher.say(&json!({"say": "open", "student": student}))?;
        Ok(watcher)
    }

    fn say(&mut self, said: &Value) -> Result<(), NotServed> {
        let message = Message::text(said.to_string());
        self.socket.send(message).map_err(not_served)
    }

    fn hear_text(&mut self) -> Result<Value, NotServed> {
        loop {
            if let Message::Text(text) = self.socket.read().map_err(not_served)? {
                return serde_json::from_str(&text).map_err(not_served);
            }
        }
    }

    /// Waits for its student's next state, as a page gets it.
    ///
    /// # Errors
    /// [`NotServed`], after half a minute of silence too.
    pub fn hear_state(&mut self) -> Result<Value, NotServed> {
        loop {
            let mut said = self.hear_text()?;
            if said["say"] == "state" {
                return Ok(said["state"].take());
            }
        }
    }

    /// Waits for the next picture, as a page gets it: its kind is in the first byte.
    ///
    /// # Errors
    /// [`NotServed`], after half a minute of silence too.
    pub fn see(&mut self) -> Result<Vec<u8>, NotServed> {
        loop {
            if let Message::Binary(bytes) = self.socket.read().map_err(not_served)? {
                return Ok(bytes.to_vec());
            }
        }
    }

    /// Shows the class from now on, in place of its student: pictures are those of the cards.
    ///
    /// # Errors
    /// [`NotServed`].
    pub fn show_class(&mut self) -> Result<(), NotServed> {
        self.say(&json!({"say": "close"}))
    }

    /// Gives an order to its student; [`Heard::Ordered`] has its number.
    ///
    /// # Errors
    /// [`NotServed`].
    pub fn order(&mut self, command: &Command) -> Result<(), NotServed> {
        self.echo += 1;
        let (echo, student) = (self.echo, self.student);
        self.say(&json!({"say": "order", "echo": echo, "student": student, "command": command}))
    }

    /// Waits for the next message.
    ///
    /// # Errors
    /// [`NotServed`], after half a minute of silence too.
    pub fn hear(&mut self) -> Result<Heard, NotServed> {
        let text = match self.socket.read().map_err(not_served)? {
            Message::Binary(bytes) => return Ok(Heard::Picture(bytes.len())),
            Message::Text(text) => text,
            _ => return Ok(Heard::Other),
        };
        let said: Value = serde_json::from_str(&text).map_err(not_served)?;
        let number = |value: &Value| value.as_u64().unwrap_or(0);
        Ok(match said["say"].as_str() {
            Some("state") => Heard::State(number(&said["state"]["done"])),
            Some("ordered") => Heard::Ordered(number(&said["number"])),
            _ => Heard::Other,
        })
    }
}
