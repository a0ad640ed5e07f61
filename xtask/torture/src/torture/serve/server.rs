//! The server as a process of its own.

use super::super::permissions;
use std::{
    io::{BufRead as _, BufReader, Read as _},
    net::SocketAddr,
    path::Path,
    process::{Child, Command, Stdio},
};

/// Options of a start of the server.
#[derive(Clone, Copy, Default)]
pub(super) struct Start {
    /// Longest file that it may write (bytes).
    pub(super) largest_file: Option<u64>,
    /// As a user whom permissions bind.
    pub(super) is_plain: bool,
}

/// A server that listens. It is killed when it is dropped.
pub(super) struct Server {
    child: Child,
    pub(super) address: SocketAddr,
    pub(super) admin: String,
}

impl Server {
    /// Starts it in a folder.
    ///
    /// # Errors
    /// Output of its end.
    pub(super) fn start(program: &Path, place: &Path, start: &Start) -> Result<Self, String> {
        let words = ["serve", "--listen", "127.0.0.1:0", "--out", "out", "--rounds", "1"];
        let minds = ["--simulations", "10", "--particles", "4", "--max-steps", "40"];
        let mut command = match start.largest_file {
            None => Command::new(program),
            Some(bytes) => {
                // The signal is ignored, so that writing fails as on a full disk.
                let script = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", bytes.div_ceil(512));
                let mut command = Command::new("sh");
                command.args(["-c", &script, "sh"]).arg(program);
                command
            }
        };
        // Without scenes a server with a study has no game.
        let tasks = ["--study", "torture.json", "--scenes", "scenes.json"];
        command.current_dir(place).args(words).args(minds).args(tasks);
        command.env_remove(phase_files::fault::VARIABLE);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        if start.is_plain {
            permissions::bind(&mut command);
        }
        let mut child = command.spawn().map_err(|error| error.to_string())?;
        let lines = child.stdout.take().map(|output| BufReader::new(output).lines());
        // The address, those of studies, and that of who is in charge, with a token.
        let mut lines = lines.into_iter().flatten().map_while(Result::ok);
        let address = lines
            .next()
            .and_then(|line| line.strip_prefix("http://")?.strip_suffix('/')?.parse::<SocketAddr>().ok());
        let admin = lines.find_map(|line| {
            let (_, token) = line.split_once("/admin/#")?;
            Some(token.split(' ').next()?.to_owned())
        });
        match (address, admin) {
            (Some(address), Some(admin)) => Ok(Self { child, address, admin }),
            (None, Some(_)) => {
                let _ = child.kill();
                let _ = child.wait();
                Err("it does not begin with the address of the game".into())
            }
            (_, None) => Err(told(&mut child)),
        }
    }

    /// Kills it, or says how it has ended already.
    pub(super) fn end_now(&mut self) -> Option<String> {
        if let Ok(Some(_)) = self.child.try_wait() {
            return Some(told(&mut self.child));
        }
        // SIGKILL on Unix: it cannot put anything in order.
        let _ = self.child.kill();
        let _ = self.child.wait();
        None
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Exit status of a process that ended, in words.
fn told(child: &mut Child) -> String {
    let mut text = String::new();
    // What cannot be read has not been said.
    let _ = child.stderr.take().map(|mut errors| errors.read_to_string(&mut text));
    let status = child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
    format!("{status} ({})", text.lines().last().unwrap_or_default())
}
