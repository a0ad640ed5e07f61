//! Videos in parts, and what the person in charge downloads.

use crate::support::{Site, answer, ask, begin, bind, step, try_ask, write_study};
use serde_json::json;
use std::{collections::BTreeMap, fs, io::Read as _};

#[test]
fn videos_come_whole_and_in_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = write_study(folder.path(), 1, 1);
    let site = Site::start(folder.path(), &[study]);
    let (_, stage) = begin(site.address, "p1");
    let path = format!("/study/pilot/{}", stage["video"].as_str().expect("an address"));
    let bytes = fs::read(folder.path().join("videos/0.mp4")).expect("a video");
    let get = |method: &str, range: Option<&str>| {
        let headers: Vec<(&str, &str)> = range.iter().map(|range| ("range", *range)).collect();
        try_ask(site.address, method, &path, &headers, None).expect("an answer")
    };
    let whole = get("GET", None);
    assert!(whole.status == 200 && whole.body == bytes);
    assert_eq!(
        (whole.headers["content-type"].as_str(), whole.headers["accept-ranges"].as_str()),
        ("video/mp4", "bytes")
    );
    let part = get("GET", Some("bytes=100-199"));
    assert!(part.status == 206 && part.body == bytes[100..200]);
    assert_eq!(part.headers["content-range"], "bytes 100-199/5000");
    let end = get("GET", Some("bytes=4990-"));
    assert!(end.status == 206 && end.body == bytes[4990..]);
    assert_eq!(get("GET", Some("bytes=5000-")).status, 416);
    let head = get("HEAD", None);
    assert!(head.status == 200 && head.body.is_empty() && head.headers["content-length"] == "5000");
    for other in ["/study/pilot/videos/0.mp4", "/study/pilot/videos/..%2Fpilot.json", "/study/pilot/videos/x"]
    {
        assert_eq!(ask(site.address, "GET", other, None, None).status, 404, "{other}");
    }
}

/// A pipe in place of a study or of a video would keep a request waiting for ever.
#[cfg(unix)]
#[test]
fn pipes_are_no_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = write_study(folder.path(), 1, 1);
    let site = Site::start(folder.path(), &[study]);
    let (_, stage) = begin(site.address, "p1");
    let path = format!("/study/pilot/{}", stage["video"].as_str().expect("an address"));
    let pipe = |path: &std::path::Path| {
        let made = std::process::Command::new("mkfifo").arg(path).status();
        assert!(made.expect("mkfifo").success());
    };
    let video = folder.path().join("videos/0.mp4");
    fs::remove_file(&video).expect("a video");
    pipe(&video);
    assert_eq!(ask(site.address, "GET", &path, None, None).status, 500);
    let other = folder.path().join("other.json");
    pipe(&other);
    let refused = bind(&folder.path().join("another"), &[other]).expect_err("a pipe").to_string();
    assert!(refused.contains("other.json"), "{refused}");
}

#[test]
fn the_person_in_charge_sees_progress_and_downloads() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = write_study(folder.path(), 2, 2);
    let site = Site::start(folder.path(), &[study]);
    let (token, _) = begin(site.address, "p1");
    (1..=2).for_each(|trial| {
        step(site.address, &token, "answer", &answer(trial, "neutral"));
    });
    begin(site.address, "p2");
    let get = |path: &str| ask(site.address, "GET", path, Some(&site.admin), None);
    let study = get("/admin/api/studies").json()["studies"][0].clone();
    assert_eq!(
        (&study["raters"]["complete"], &study["raters"]["unfinished"], &study["wanted"]),
        (&json!(1), &json!(1), &json!(2))
    );
    for path in ["/admin/api/studies", "/admin/api/studies/pilot/psych-ds.tar"] {
        for other in [None, Some(token.as_str())] {
            assert_eq!(ask(site.address, "GET", path, other, None).status, 401);
        }
    }
    let files = |path: &str| {
        let bytes = get(path).body;
        let mut archive = tar::Archive::new(&bytes[..]);
        let read = |entry: Result<tar::Entry<'_, _>, std::io::Error>| {
            let mut entry: tar::Entry<'_, &[u8]> = entry.expect("an entry");
            let name = entry.path().expect("a name").to_string_lossy().into_owned();
            let mut text = String::new();
            entry.read_to_string(&mut text).expect("text");
            (name, text)
        };
        archive.entries().expect("entries").map(read).collect::<BTreeMap<_, _>>()
    };
    let own = files("/admin/api/studies/pilot/psych-ds.tar");
    assert!(own.contains_key("pilot/dataset_description.json"));
    assert!(
        own.values().any(|text| text.contains("'=1+1")) && !own.values().any(|text| text.contains(",=1+1"))
    );
    assert!(!own.values().any(|text| text.contains("PROLIFIC_PID")));
    let with_ids = files("/admin/api/studies/pilot/psych-ds.tar?external_ids");
    assert!(with_ids.values().any(|text| text.contains("external_PROLIFIC_PID")));
    let ratings = get("/admin/api/studies/pilot/ratings.json");
    assert_eq!(ratings.json()["ratings"]["event-0"]["neutral"], 1);
    assert!(ratings.headers["content-disposition"].contains("pilot-ratings.json"));
    let report = String::from_utf8(get("/admin/api/studies/pilot/report.html").body).expect("text");
    assert!(report.contains("&lt;b&gt;A pilot") && !report.contains("<b>A pilot"));
    assert_eq!(get("/admin/api/studies/pilot/analysis.json").json()["format"], "phase-study-report/1");
    assert_eq!(get("/admin/api/studies/pilot/other").status, 404);
    assert_eq!(get("/admin/api/studies/other/ratings.json").status, 404);
}
