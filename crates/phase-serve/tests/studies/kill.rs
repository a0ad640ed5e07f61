//! A server that is killed while raters answer, and how many answers a second it takes.

use crate::support::{answer, ask, begin, bind, try_ask, write_study};
use phase_study::{config::StudyConfig, forms::Forms, question::Given, store::Answers};
use serde_json::Value;
use std::{
    collections::BTreeMap,
    env, fs,
    io::{BufRead as _, BufReader, Write as _},
    net::SocketAddr,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::Mutex,
    time::{Duration, Instant},
};

/// Names the folder of a study for [`as_a_server`].
const FOLDER: &str = "PHASE_STUDY_SERVER";
const RATERS: usize = 50;
const VIDEOS: usize = 20;

/// No test: the server that the tests below start as a process of its own, and kill.
#[test]
fn as_a_server() {
    let Some(folder) = env::var_os(FOLDER).map(PathBuf::from) else { return };
    let server = bind(&folder, &[folder.join("pilot.json")]).expect("a server");
    println!("\nlistening {}", server.address());
    std::io::stdout().flush().expect("told");
    server.run(std::future::pending()).expect("it runs");
}

/// A server in another process.
struct Process {
    child: Child,
    address: SocketAddr,
}

impl Process {
    fn start(folder: &Path) -> Self {
        let program = env::current_exe().expect("this program");
        let mut child = Command::new(program)
            .args(["kill::as_a_server", "--exact", "--nocapture"])
            .env(FOLDER, folder)
            .stdout(Stdio::piped())
            .spawn()
            .expect("started");
        let lines = BufReader::new(child.stdout.take().expect("its output")).lines();
        let address =
            lines.map_while(Result::ok).find_map(|line| line.strip_prefix("listening ")?.parse().ok());
        Self { child, address: address.expect("an address") }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // SIGKILL on Unix: it cannot put anything in order.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The answer of a rater to a trial: different ones, so that one cannot be taken for another.
fn relation(rater: usize, trial: u64) -> &'static str {
    ["friendly", "neutral", "adversarial"][(rater * 7 + trial as usize * 5) % 3]
}

#[test]
fn no_acknowledged_answer_is_lost_when_the_server_is_killed() {
    let folder = tempfile::tempdir().expect("a folder");
    let config = write_study(folder.path(), VIDEOS, RATERS);
    let acknowledged: Vec<Mutex<u64>> = (0..RATERS).map(|_| Mutex::new(0)).collect();
    let mut tokens = Vec::new();
    let mut kills = 0;
    while acknowledged.iter().any(|count| *count.lock().expect("free") < VIDEOS as u64) {
        let mut server = Process::start(folder.path());
        let address = server.address;
        if tokens.is_empty() {
            tokens = (0..RATERS).map(|k| begin(address, &format!("p{k}")).0).collect();
        }
        std::thread::scope(|scope| {
            for (k, token) in tokens.iter().enumerate() {
                let acknowledged = &acknowledged[k];
                scope.spawn(move || {
                    let bearer = format!("Bearer {token}");
                    loop {
                        let trial = *acknowledged.lock().expect("free") + 1;
                        if trial > VIDEOS as u64 {
                            return;
                        }
                        let body = answer(trial, relation(k, trial));
                        let headers = [("authorization", bearer.as_str())];
                        match try_ask(address, "POST", "/study/pilot/api/answer", &headers, Some(&body)) {
                            Some(answered) if answered.status == 200 => {
                                *acknowledged.lock().expect("free") = trial
                            }
                            // All raters come from one address, which may not ask more often.
                            Some(answered) if answered.status == 429 => {
                                std::thread::sleep(Duration::from_millis(50))
                            }
                            Some(answered) => panic!("{answered:?}"),
                            // Killed: whether this answer was stored is open, and it is sent again.
                            None => return,
                        }
                    }
                });
            }
            // At a moment that has nothing to do with what the server is doing, later each time so that an
            // end is reached.
            std::thread::sleep(Duration::from_millis(300 + 271 * kills));
            let all = acknowledged.iter().all(|count| *count.lock().expect("free") == VIDEOS as u64);
            if !all {
                server.child.kill().expect("killed");
                kills += 1;
            }
        });
        drop(server);
        check(&config, &folder.path().join("out/studies/pilot.sqlite"), &acknowledged);
    }
    assert!(kills >= 2, "the server was killed {kills} times while raters answered");
}

/// All that was acknowledged is in the file, and right.
fn check(config: &Path, answers: &Path, acknowledged: &[Mutex<u64>]) {
    let forms = Forms::included().expect("forms");
    let config = StudyConfig::read(&fs::read(config).expect("bytes"), &forms).expect("valid");
    let raters = Answers::read(answers, &config, &forms).expect("answers").raters;
    let by_id: BTreeMap<&str, _> =
        raters.iter().map(|rater| (rater.parameters["PROLIFIC_PID"].as_str(), rater)).collect();
    for (k, count) in acknowledged.iter().enumerate() {
        let rater = by_id[format!("p{k}").as_str()];
        for trial in 1..=*count.lock().expect("free") {
            let given = rater.trials[trial as usize - 1].given.as_ref().expect("an acknowledged answer");
            assert_eq!(given.answer.get("relation"), Some(&Given::Text(relation(k, trial).into())));
        }
    }
}

#[test]
fn it_takes_fifty_answers_a_second() {
    let folder = tempfile::tempdir().expect("a folder");
    write_study(folder.path(), VIDEOS, RATERS);
    let server = Process::start(folder.path());
    let address = server.address;
    let tokens: Vec<String> = (0..RATERS).map(|k| begin(address, &format!("p{k}")).0).collect();
    let times = Mutex::new(Vec::new());
    let begun = Instant::now();
    std::thread::scope(|scope| {
        for (k, token) in tokens.iter().enumerate() {
            let times = &times;
            scope.spawn(move || {
                for trial in 1..=VIDEOS as u64 {
                    // Each rater answers once a second, and they do not all begin at once.
                    let due = Duration::from_millis(20 * k as u64) + Duration::from_secs(trial - 1);
                    std::thread::sleep(due.saturating_sub(begun.elapsed()));
                    let sent = Instant::now();
                    let body = answer(trial, relation(k, trial));
                    let send = || ask(address, "POST", "/study/pilot/api/answer", Some(token), Some(&body));
                    let mut answered = send();
                    // As a page does when all raters' answers have waited for a busy machine.
                    while answered.status == 429 {
                        std::thread::sleep(Duration::from_millis(200));
                        answered = send();
                    }
                    assert_eq!(answered.status, 200);
                    times.lock().expect("free").push(sent.elapsed());
                }
            });
        }
    });
    let total = begun.elapsed();
    let mut times = times.into_inner().expect("free");
    times.sort();
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    println!(
        "{} answers of {RATERS} raters in {total:.1?}; median {:.1?}, 99th percentile {:.1?}, slowest {:.1?}",
        times.len(),
        at(0.5),
        at(0.99),
        at(1.0)
    );
    assert_eq!(times.len(), RATERS * VIDEOS);
    // The last answer is due after 20 s less a moment; a server that cannot keep up would need longer.
    assert!(total < Duration::from_secs(VIDEOS as u64 + 5), "{total:?}");
    let state: Value = ask(address, "GET", "/study/pilot/api/state", Some(&tokens[0]), None).json();
    assert_eq!(state["page"], "done");
}
