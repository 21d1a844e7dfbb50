//! A browser's tab under a test's control: headless Chromium, by its DevTools protocol over a pipe.
//!
//! Messages are JSON, each ended by a zero byte (`--remote-debugging-pipe`); the browser reads them from descriptor 3 and
//! writes them to descriptor 4, which a shell makes of its standard input and output.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::browser::{Look, find_or_say};
use crate::program::Kept;
use crate::wait::PATIENCE;

/// Time between two queries of a page.
const PAUSE: Duration = Duration::from_millis(20);

/// A tab. The browser goes when this is dropped.
pub struct Tab {
    _child: Kept,
    to: ChildStdin,
    from: Receiver<Value>,
    session: String,
    sent: u64,
    complaints: Vec<String>,
    /// What a page told last.
    told: Option<String>,
    // Declared last: the profile may only go after the browser has.
    _profile: tempfile::TempDir,
}

impl Tab {
    /// An empty tab; `None` and panics as for [`visit`](crate::browser::visit).
    ///
    /// # Panics
    /// Where the browser fails.
    #[must_use]
    pub fn new() -> Option<Self> {
        let program = find_or_say()?;
        let profile = tempfile::tempdir().expect("a folder for the browser's profile");
        let mut child = Command::new("sh")
            .args(["-c", r#"exec "$0" "$@" 3<&0 4>&1 </dev/null >/dev/null"#])
            .arg(program)
            .args(["--headless", "--no-sandbox", "--disable-gpu"])
            .args(["--no-first-run", "--disable-extensions", "--mute-audio"])
            .args(["--ignore-certificate-errors", "--remote-debugging-pipe"])
            .arg("--allow-file-access-from-files")
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the browser starts");
        let to = child.stdin.take().expect("the browser's descriptor 3");
        let mut from = BufReader::new(child.stdout.take().expect("the browser's descriptor 4"));
        let (sender, receiver) = channel();
        std::thread::spawn(move || {
            let mut message = Vec::new();
            while from
                .read_until(0, &mut message)
                .is_ok_and(|count| count > 0)
            {
                message.pop();
                let said = serde_json::from_slice(&message).expect("the browser says JSON");
                message.clear();
                if sender.send(said).is_err() {
                    break;
                }
            }
        });
        let mut tab = Self {
            _child: Kept(child),
            to,
            from: receiver,
            session: String::new(),
            sent: 0,
            complaints: Vec::new(),
            told: None,
            _profile: profile,
        };
        tab.attach();
        Some(tab)
    }

    fn attach(&mut self) {
        let begun = Instant::now();
        let target = loop {
            let targets = self.call("Target.getTargets", json!({}));
            let targets = targets["targetInfos"].as_array().expect("targets").iter();
            let mut pages = targets.filter(|target| target["type"] == "page");
            if let Some(page) = pages.next() {
                break page["targetId"].clone();
            }
            assert!(begun.elapsed() < PATIENCE, "the browser has no page");
            std::thread::sleep(PAUSE);
        };
        let how = json!({"targetId": target, "flatten": true});
        let attached = self.call("Target.attachToTarget", how);
        self.session = attached["sessionId"]
            .as_str()
            .expect("a session")
            .to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
    }

    /// Calls a method of the protocol and returns its result.
    ///
    /// # Panics
    /// Where the browser refuses it, ends, or does not answer within [`PATIENCE`].
    pub fn call(&mut self, method: &str, params: Value) -> Value {
        self.sent += 1;
        let mut message = json!({"id": self.sent, "method": method, "params": params});
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.to.write_all(&bytes).expect("the browser listens");
        let deadline = Instant::now() + PATIENCE;
        loop {
            let mut said = self.hear(deadline, method);
            if said["id"] == self.sent {
                assert!(said["error"].is_null(), "{method}: {}", said["error"]);
                return said["result"].take();
            }
            self.note(&said);
        }
    }

    /// The browser's next message, awaited for `what`.
    fn hear(&self, deadline: Instant, what: &str) -> Value {
        let left = deadline.saturating_duration_since(Instant::now());
        match self.from.recv_timeout(left) {
            Ok(said) => said,
            Err(RecvTimeoutError::Timeout) => {
                panic!(
                    "{what} was not answered; the page says {:?}",
                    self.complaints
                )
            }
            Err(RecvTimeoutError::Disconnected) => panic!("the browser ended at {what}"),
        }
    }

    fn note(&mut self, said: &Value) {
        let params = &said["params"];
        let complaint = match said["method"].as_str() {
            Some("Runtime.exceptionThrown") => {
                params["exceptionDetails"]["exception"]["description"].to_string()
            }
            Some("Log.entryAdded") => params["entry"].to_string(),
            Some("Runtime.consoleAPICalled") => {
                let text = params["args"][0]["value"].as_str();
                if let Some(told) = text.and_then(|text| text.strip_prefix("TOLD ")) {
                    self.told = Some(told.to_owned());
                    return;
                }
                params["args"].to_string()
            }
            _ => return,
        };
        self.complaints.push(complaint);
    }

    /// Goes to an address.
    pub fn go(&mut self, address: &str) {
        let gone = self.call("Page.navigate", json!({"url": address}));
        assert!(gone["errorText"].is_null(), "{address}: {gone}");
    }

    /// Goes to a file.
    ///
    /// # Panics
    /// Where it is not there.
    pub fn open(&mut self, page: &Path) {
        let page = page.canonicalize().expect("the page's file");
        self.go(&format!("file://{}", page.display()));
    }

    /// What a page tells by `console.log("TOLD " + JSON.stringify(value))`.
    ///
    /// # Panics
    /// Where it tells nothing within [`PATIENCE`].
    pub fn told(&mut self) -> String {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(told) = self.told.take() {
                return told;
            }
            let said = self.hear(deadline, "a page's word");
            self.note(&said);
        }
    }

    /// The value of an expression, after its promises.
    ///
    /// # Panics
    /// Where it throws.
    pub fn eval(&mut self, expression: &str) -> Value {
        let how = json!({
            "expression": expression, "awaitPromise": true, "returnByValue": true, "userGesture": true,
        });
        let mut given = self.call("Runtime.evaluate", how);
        let thrown = &given["exceptionDetails"];
        assert!(thrown.is_null(), "{expression}: {thrown}");
        given["result"]["value"].take()
    }

    /// Evaluates an expression until its value is true in JavaScript.
    ///
    /// # Panics
    /// Where it does not within [`PATIENCE`].
    pub fn until(&mut self, expression: &str) -> Value {
        let begun = Instant::now();
        loop {
            // A page that is being left has no document for a moment.
            let given = self.eval(&format!("try{{ {expression} }}catch(error){{ null }}"));
            let is_true = !(given.is_null() || given == false || given == 0 || given == "");
            if is_true {
                return given;
            }
            if begun.elapsed() > PATIENCE {
                let shown = self.eval("document.body.innerText");
                panic!(
                    "waited in vain: {expression}; the page says {:?} and shows {shown}",
                    self.complaints
                );
            }
            std::thread::sleep(PAUSE);
        }
    }

    /// Presses and lets go of keys, as a keyboard does: `Tab`, `Enter`, a space.
    pub fn press(&mut self, keys: &[&str]) {
        for key in keys {
            let (code, text) = match *key {
                "Enter" => (13, "\r"),
                "Tab" => (9, ""),
                "Escape" => (27, ""),
                " " => (32, " "),
                other => panic!("{other} is not known here"),
            };
            let down = if text.is_empty() {
                "rawKeyDown"
            } else {
                "keyDown"
            };
            for kind in [down, "keyUp"] {
                let mut event = json!({"type": kind, "key": key, "windowsVirtualKeyCode": code});
                if kind == "keyDown" {
                    event["text"] = json!(text);
                }
                self.call("Input.dispatchKeyEvent", event);
            }
        }
    }

    /// Types text.
    pub fn type_in(&mut self, text: &str) {
        self.call("Input.insertText", json!({"text": text}));
    }

    /// Sets the window's size, CSS pixels, and the colours that its user prefers.
    pub fn look(&mut self, [width, height]: [u32; 2], look: Look) {
        let size = json!({
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600,
        });
        self.call("Emulation.setDeviceMetricsOverride", size);
        let scheme = if look == Look::Dark { "dark" } else { "light" };
        let features = json!([{"name": "prefers-color-scheme", "value": scheme}]);
        self.call("Emulation.setEmulatedMedia", json!({"features": features}));
    }

    /// A PNG of the whole page.
    pub fn picture(&mut self) -> Vec<u8> {
        let how = json!({"format": "png", "captureBeyondViewport": true});
        let taken = self.call("Page.captureScreenshot", how);
        let data = taken["data"].as_str().expect("a picture");
        STANDARD.decode(data).expect("base 64")
    }

    /// Complaints since the last call: uncaught exceptions, actions that a policy forbade, failed loads, messages on the console.
    pub fn complaints(&mut self) -> Vec<String> {
        // Complaints before this answer are recorded.
        self.eval("0");
        std::mem::take(&mut self.complaints)
    }
}
