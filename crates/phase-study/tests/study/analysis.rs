//! Analyses of answers that are known.

use crate::support::{complete, document, forms, open};
use phase_study::{
    analysis::{Analysis, document as report},
    forms::Form,
    study::{Study, TrialPage},
};
use serde_json::{Value, json};
use std::path::Path;

/// Four videos, all seen by all raters; the first two from people, with labels.
fn study(folder: &Path, form: Form) -> Study {
    let mut document = document(form, 4, 4, 4);
    let stimuli = document["stimuli"].as_array_mut().expect("a list");
    for (k, stimulus) in stimuli.iter_mut().enumerate() {
        stimulus["source"] = json!(if k < 2 { "human" } else { "phase" });
        stimulus["relation"] = json!(if k < 3 { "friendly" } else { "neutral" });
        stimulus["condition"] = json!(if k % 2 == 0 { "help" } else { "indifferent" });
        stimulus["set"] = json!(format!("pair-{}", k / 2));
        stimulus["goals"] = json!([["touch", "help"], "none"]);
    }
    open(folder, &document)
}

/// Lets raters answer as a function of rater and video (from 0) says.
fn answered(study: &mut Study, raters: usize, answer: impl Fn(usize, usize) -> Value) -> Analysis {
    for rater in 0..raters {
        let files: Vec<String> =
            study.config().stimuli.iter().map(|stimulus| stimulus.video.clone()).collect();
        let names: Vec<(String, usize)> = files.into_iter().enumerate().map(|(k, file)| (file, k)).collect();
        let addresses = addresses(study, &names);
        let given = |page: &TrialPage| {
            let k = addresses.iter().find(|(address, _)| *address == page.video).map(|(_, k)| *k);
            answer(rater, k.expect("a known video"))
        };
        complete(study, &format!("p{rater}"), 0, given).expect("done");
    }
    let raters = study.raters().expect("raters");
    Analysis::of(study.config(), &forms(), &raters)
}

/// The addresses of videos: found through [`Study::video`], for they cannot be told from ids.
fn addresses(study: &Study, files: &[(String, usize)]) -> Vec<(String, usize)> {
    let all = study.addresses();
    let of = |(name, file): (&str, &str)| {
        let k = files.iter().find(|(known, _)| known == file).expect("known").1;
        (format!("videos/{name}.mp4"), k)
    };
    all.map(of).collect()
}

#[test]
fn right_goals_right_relations_and_human_likeness_are_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = study(folder.path(), Form::Goals);
    // Video 0: all right. Video 1: half of the raters call it neutral, which is no majority. Video 2: 3 of 4
    // are wrong. 3: all right.
    let analysis = answered(&mut study, 4, |rater, video| {
        let wrong = (video == 1 && rater < 2) || (video == 2 && rater < 3);
        json!({
            "goal_0": if rater == 0 { "help" } else { "touch" },
            "goal_1": if wrong { "hinder" } else { "none" },
            "relation": if wrong != (video == 3) { "neutral" } else { "friendly" },
            "human_likeness": if video < 2 { "5" } else if rater % 2 == 0 { "2" } else { "3" },
        })
    });
    assert_eq!((analysis.raters.complete, analysis.coverage.judgements), (4, 16));
    assert_eq!((analysis.coverage.least, analysis.coverage.most), (4, 4));
    let of = |question: &str, source: Option<&str>| {
        let found =
            analysis.accuracy.iter().find(|it| it.question == question && it.source.as_deref() == source);
        found.expect("asked").clone()
    };
    let relation = of("relation", None);
    let mean = relation.mean.expect("videos");
    assert!((mean.value - (1.0 + 0.5 + 0.25 + 1.0) / 4.0).abs() < 1e-12);
    assert!(mean.low <= mean.value && mean.value <= mean.high);
    assert_eq!((relation.majority.count, relation.majority.of), (2, 4));
    // Goals: agent 0 is always right, whichever of both names it was called by.
    let goals = of("goals", Some("human"));
    assert!((goals.mean.expect("videos").value - (1.0 + 0.75) / 2.0).abs() < 1e-12);
    assert_eq!((goals.majority.count, goals.majority.of), (3, 4));
    let [human, phase] = &analysis.human_likeness[..] else { panic!("two sources") };
    assert_eq!((human.source.as_str(), human.videos, human.sd), ("human", 2, Some(0.0)));
    assert!((human.mean.expect("videos").value - 5.0).abs() < 1e-12);
    assert!((phase.mean.expect("videos").value - 2.5).abs() < 1e-12);
    let difference = &analysis.human_likeness_differences[0];
    assert!((difference.difference.value - 2.5).abs() < 1e-12);
    assert!(
        (difference.difference.low - 2.5).abs() < 1e-12 && (difference.difference.high - 2.5).abs() < 1e-12
    );
    // Of the three friendly videos 4 + 2 + 1 judgements are right, of the neutral one all.
    let confusion = analysis.confusion.as_ref().expect("labels");
    assert_eq!(confusion.labels, ["friendly", "neutral"]);
    assert_eq!(confusion.answers, ["friendly", "neutral", "adversarial"]);
    assert_eq!(confusion.counts, [[7, 5, 0], [0, 4, 0]]);
    assert_eq!(confusion.judgements, [12, 4]);
    // Both agents of 4 videos and 4 raters: agent 0 is called by both of its right names.
    let goals = analysis.goal_confusion.as_ref().expect("labels");
    assert_eq!(goals.judgements.iter().sum::<usize>(), 32);
    let counted = |label: &str, answer: &str| {
        let row = goals.labels.iter().position(|it| it == label).expect(label);
        goals.counts[row][goals.answers.iter().position(|it| it == answer).expect(answer)]
    };
    assert_eq!(
        [("help or touch", "help"), ("help or touch", "touch"), ("none", "none"), ("none", "hinder")]
            .map(|(label, answer)| counted(label, answer)),
        [4, 12, 11, 5]
    );
    let right = |groups: &[phase_study::analysis::Answers], name: &str| {
        let found = groups.iter().find(|it| it.name == name).expect(name);
        (found.videos, found.judgements, found.relation_right.expect("labels").value)
    };
    assert_eq!(right(&analysis.conditions, "help"), (2, 8, (1.0 + 0.25) / 2.0));
    assert_eq!(right(&analysis.conditions, "indifferent"), (2, 8, (0.5 + 1.0) / 2.0));
    assert_eq!(right(&analysis.sets, "pair-0"), (2, 8, 6.0 / 8.0));
    assert_eq!(right(&analysis.videos, "event-2"), (1, 4, 0.25));
    let video = &analysis.videos[1];
    assert_eq!(
        (video.goals_right.expect("labels").value, video.human_likeness.expect("rated").value),
        (0.75, 5.0)
    );
    assert_eq!(
        video.given,
        [("friendly", 2), ("neutral", 2), ("adversarial", 0)].map(|(it, n)| (it.into(), n))
    );
    let text = report("A study", &analysis).to_markdown();
    assert!(text.contains("| friendly | 7 | 5 | 0 | 12 |"), "{text}");
    assert!(
        text.contains("| event\\-2 | 1 | 4 | 0.250") || text.contains("| event-2 | 1 | 4 | 0.250"),
        "{text}"
    );
    assert!(text.contains("| human − phase | 2.50 [2.50, 2.50] |"), "{text}");
}

#[test]
fn interactions_given_by_anybody_and_by_half_of_the_raters_are_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = study(folder.path(), Form::Interactions);
    // Chasing: half of the raters of videos 0 and 1. Helping: one rater of video 3. Meeting: everybody
    // everywhere.
    let analysis = answered(&mut study, 4, |rater, video| {
        let mut seen = vec!["meeting"];
        if video < 2 && rater < 2 {
            seen.push("chasing");
        }
        if video == 3 && rater == 0 {
            seen.push("helping");
        }
        json!({"interactions": seen})
    });
    let all = &analysis.interactions[0];
    assert_eq!((all.given, all.by_half, all.categories.len()), (3, 2, 23));
    let chasing = all.categories.iter().find(|it| it.choice == "chasing").expect("asked");
    assert_eq!((chasing.given, chasing.by_half.count, chasing.by_half.of), (2, 2, 4));
    assert_eq!(analysis.interactions.len(), 3, "all, and both sources");
    let alpha = |choice: &str| {
        let found = analysis.agreement.iter().find(|it| it.choice.as_deref() == Some(choice));
        found.expect("asked").alpha
    };
    assert_eq!(alpha("meeting"), None, "nobody differs");
    assert!(alpha("chasing").expect("some differ").value < 0.5);
    let document = report("<b>A study</b>", &analysis);
    assert_eq!(
        document.plots().map(|(file, _)| file).collect::<Vec<_>>(),
        ["confusion.svg", "interactions.svg"]
    );
    let confusion = analysis.confusion.as_ref().expect("conditions");
    let chasing = confusion.answers.iter().position(|it| it == "chasing").expect("asked");
    // Two of the eight judgements of each condition.
    assert_eq!(confusion.labels, ["help", "indifferent"]);
    assert_eq!(confusion.counts.iter().map(|row| row[chasing]).collect::<Vec<_>>(), [2, 2]);
    assert!(!document.to_html().contains("<b>"));
}

#[test]
fn an_analysis_without_raters_is_empty() {
    for form in Form::ALL {
        let folder = tempfile::tempdir().expect("a folder");
        let mut study = study(folder.path(), form);
        let analysis = answered(&mut study, 0, |_, _| json!({}));
        assert_eq!((analysis.raters.joined, analysis.coverage.judged, analysis.coverage.least), (0, 0, 0));
        assert!(report("A study", &analysis).to_html().contains("<svg") || form == Form::Relation);
        serde_json::to_string(&analysis).expect("JSON");
    }
}
