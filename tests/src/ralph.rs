//! A Learning Record Store by other authors: Ralph, of France Université Numérique. `./lab setup` installs it.

use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::program::{Kept, output};
use crate::{installed, wait};

/// User name and password that may write to it, as in a token's file.
pub const CREDENTIALS: &str = "vitriol:sulfuric";

/// The output of `ralph auth` for these, except for the hash: that has bcrypt's least rounds, since it is computed in each test.
const USERS: &str = r#"[{"agent": {"mbox": "mailto:vitriol@example.org"}, "scopes": ["statements/write", "statements/read"],
"hash": "HASH", "username": "vitriol"}]"#;

/// bcrypt of the password.
const HASH: &str = "$2b$04$0clP5spKreqzc13VW5vB9.9X7vvVBgKMJy1.p.2/2KU9841y7Cb3W";

/// The application of `ralph runserver -b fs`, except for two things. That one has a second process, which starts it again whenever its
/// source changes and would outlive a kill. And its storage in files (5.1.0) makes its file anew for each request, so that it refuses all
/// but the first; it can append, and is set to.
const APPLICATION: &str = "
import sys, uvicorn
from ralph.backends.data.base import BaseOperationType
from ralph.backends.data.fs import FSDataBackend
FSDataBackend.default_operation_type = BaseOperationType.APPEND
uvicorn.run('ralph.api:app', host='127.0.0.1', port=int(sys.argv[1]), log_level='warning')
";

/// Path of Ralph's installation.
#[derive(Debug)]
pub struct Ralph {
    root: PathBuf,
}

/// A running server, which is killed when this is dropped.
#[derive(Debug)]
pub struct Server {
    child: Kept,
    /// Its address.
    pub address: String,
}

impl Ralph {
    /// Ralph on this machine; `None` if it is missing, with a message on standard error. With `CI=true` that is a failure instead.
    ///
    /// # Panics
    /// Where there is none and `CI=true`.
    #[must_use]
    pub fn find(test: &str) -> Option<Self> {
        let root = installed::find("ralph-1", "Ralph, a Learning Record Store, is", test)?;
        Some(Self { root })
    }

    /// Standard output of a script, run by Ralph's Python.
    ///
    /// # Panics
    /// Where it fails.
    #[must_use]
    pub fn python(&self, script: &Path, arguments: &[&str]) -> String {
        let mut command = Command::new(self.root.join("bin/python"));
        command.arg(script).args(arguments);
        output(command)
    }

    /// Starts a server that keeps its statements in this folder, and waits until it answers. The port is that of an earlier server, or any
    /// free one.
    ///
    /// It is the application that `ralph runserver -b fs` starts, see `APPLICATION`.
    ///
    /// # Panics
    /// Where it does not start.
    #[must_use]
    pub fn serve(&self, folder: &Path, port: Option<u16>) -> Server {
        let users = folder.join("auth.json");
        std::fs::write(&users, USERS.replace("HASH", HASH)).unwrap();
        let port = port.unwrap_or_else(free_port);
        let child = Command::new(self.root.join("bin/python"))
            .args(["-c", APPLICATION, &port.to_string()])
            .current_dir(folder)
            .env("RALPH_APP_DIR", folder)
            .env("RALPH_AUTH_FILE", &users)
            .env("RALPH_RUNSERVER_BACKEND", "fs")
            .env("RALPH_BACKENDS__LRS__FS__DEFAULT_DIRECTORY_PATH", folder)
            .stdin(Stdio::null())
            .spawn()
            .unwrap();
        let mut server = Server {
            child: Kept(child),
            address: format!("http://127.0.0.1:{port}/xAPI"),
        };
        wait::until("Ralph answers", || {
            let ended = server.child.try_wait().unwrap();
            assert!(ended.is_none(), "Ralph ended: {ended:?}");
            TcpStream::connect(("127.0.0.1", port)).ok()
        });
        server
    }
}

impl Server {
    /// Its port.
    ///
    /// # Panics
    /// Never: it is in the address.
    #[must_use]
    pub fn port(&self) -> u16 {
        let port = self.address.rsplit_once(':').unwrap().1;
        port.trim_end_matches("/xAPI").parse().unwrap()
    }

    /// The file in which it keeps its statements, in its folder.
    #[must_use]
    pub fn file(folder: &Path) -> PathBuf {
        folder.join("fs_lrs.jsonl")
    }
}

/// A port of this machine that nobody listens on. It is outside of those that the system gives to connecting clients (from 32768 on Linux,
/// 49152 elsewhere): while the server is away, a client that tries again and again could otherwise connect to itself there.
///
/// # Panics
/// Where none is free.
#[must_use]
pub fn free_port() -> u16 {
    // Tests that run at the same time begin at different ones.
    let first = 20_000 + (std::process::id() % 12_000) as u16;
    let mut ports = (first..32_000).chain(20_000..first);
    let free = ports.find(|&port| TcpListener::bind(("127.0.0.1", port)).is_ok());
    free.unwrap()
}
