//! A browser's part, by hand: requests over TCP, and a WebSocket.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};

use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::http::HeaderValue;
use tokio_tungstenite::tungstenite::{self, Message, WebSocket};
use vitriol_console::Hub;
use vitriol_tests::wait::PATIENCE;

/// An answer of the hub to a request.
pub struct Answer {
    pub status: u16,
    /// Names in small letters.
    pub fields: Vec<(String, String)>,
    pub body: String,
}

impl Answer {
    pub fn field(&self, name: &str) -> Option<&str> {
        let mut found = self.fields.iter().filter(|(key, _)| key == name);
        found.next().map(|(_, value)| value.as_str())
    }
}

fn connect(to: SocketAddr) -> TcpStream {
    let stream = TcpStream::connect(to).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.set_nodelay(true).unwrap();
    stream
}

/// Sends a request to `to` with these fields; `Host` and `Connection` are the right ones if they are not among them.
pub fn ask(to: SocketAddr, line: &str, fields: &[(&str, &str)], body: &str) -> Answer {
    let mut head = format!("{line} HTTP/1.1\r\n");
    for (name, value) in [("Connection", "close"), ("Host", &to.to_string())] {
        if !fields.iter().any(|(given, _)| *given == name) {
            head += &format!("{name}: {value}\r\n");
        }
    }
    for (name, value) in fields {
        head += &format!("{name}: {value}\r\n");
    }
    if !body.is_empty() {
        head += &format!("Content-Length: {}\r\n", body.len());
    }
    let mut stream = connect(to);
    stream
        .write_all(format!("{head}\r\n{body}").as_bytes())
        .unwrap();
    let mut reader = BufReader::new(stream);
    let mut line = || {
        let mut line = String::new();
        reader.read_line(&mut line).unwrap();
        line.trim_end().to_owned()
    };
    let status = line().split(' ').nth(1).expect("a status").parse().unwrap();
    let mut fields = Vec::new();
    while let Some((name, value)) = line().split_once(": ") {
        fields.push((name.to_lowercase(), value.to_owned()));
    }
    let mut answer = Answer {
        status,
        fields,
        body: String::new(),
    };
    let length = answer
        .field("content-length")
        .map_or(0, |length| length.parse().unwrap());
    let body = &mut answer.body;
    reader.take(length).read_to_string(body).unwrap();
    answer
}

/// Sends a code to the hub, as the page does.
pub fn enter(to: SocketAddr, code: &str) -> Answer {
    let origin = format!("http://{to}");
    ask(to, "POST /enter", &[("Origin", &origin)], code)
}

/// The cookie for a new code.
pub fn cookie(hub: &Hub) -> String {
    let answer = enter(hub.address(), &hub.invite().unwrap().code);
    assert_eq!(answer.status, 204);
    let set = answer.field("set-cookie").unwrap();
    set.split(';').next().unwrap().to_owned()
}

/// A page's socket.
pub struct Client {
    socket: WebSocket<TcpStream>,
    echo: u32,
}

impl Client {
    pub fn new(hub: &Hub, cookie: &str) -> Self {
        Self::try_new(hub.address(), cookie).unwrap()
    }

    pub fn try_new(to: SocketAddr, cookie: &str) -> Result<Self, u16> {
        let mut request = format!("ws://{to}/socket").into_client_request().unwrap();
        let mut set = |name, value: &str| {
            let value = HeaderValue::from_str(value).unwrap();
            request.headers_mut().insert(name, value);
        };
        set("Origin", &format!("http://{to}"));
        set("Cookie", cookie);
        match tungstenite::client(request, connect(to)) {
            Ok((socket, _)) => Ok(Self { socket, echo: 0 }),
            Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(answer))) => {
                Err(answer.status().as_u16())
            }
            Err(other) => panic!("{other}"),
        }
    }

    pub fn say(&mut self, said: &Value) {
        self.send(Message::text(said.to_string())).unwrap();
    }

    pub fn send(&mut self, message: Message) -> tungstenite::Result<()> {
        self.socket.send(message)
    }

    /// The next message; `None` where the hub has closed the socket.
    pub fn next(&mut self) -> Option<Message> {
        self.socket.read().ok()
    }

    /// The next message with this `say`.
    pub fn hear(&mut self, say: &str) -> Value {
        loop {
            let message = self.next().expect("the hub speaks");
            if let Message::Text(text) = message {
                let said: Value = serde_json::from_str(&text).unwrap();
                if said["say"] == say {
                    return said;
                }
            }
        }
    }

    /// The next picture.
    pub fn see(&mut self) -> Vec<u8> {
        loop {
            if let Message::Binary(bytes) = self.next().expect("the hub speaks") {
                return bytes.to_vec();
            }
        }
    }

    /// Opens the first student of the class, with pictures in `codec`; returns the student's number.
    pub fn open(&mut self, codec: &str) -> u64 {
        let class = loop {
            let class = self.hear("class");
            if !class["students"].as_array().unwrap().is_empty() {
                break class;
            }
        };
        let student = class["students"][0]["student"].as_u64().unwrap();
        self.say(&json!({"say": "pictures", "codec": codec}));
        self.say(&json!({"say": "open", "student": student}));
        student
    }

    /// Gives an order; returns the hub's answer to it.
    pub fn order(&mut self, student: u64, command: &Value) -> Value {
        self.echo += 1;
        self.say(
            &json!({"say": "order", "echo": self.echo, "student": student, "command": command}),
        );
        loop {
            let message = self.next().expect("the hub speaks");
            let Message::Text(text) = message else {
                continue;
            };
            let said: Value = serde_json::from_str(&text).unwrap();
            if said["echo"] == self.echo {
                return said;
            }
        }
    }
}
