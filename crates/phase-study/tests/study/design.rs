//! Configurations to start from.

use crate::support::forms;
use phase_model::{AgentId, Attitude, Goal, LandmarkId, ObjectId, Sign};
use phase_render::Palette;
use phase_study::{
    config::{CatchTrial, Labels, Stimulus, StudyConfig},
    design::{Design, Experiment, known_goals},
    forms::{Form, GOALS},
};
use std::collections::{BTreeMap, BTreeSet};

fn stimuli(source: &str, count: usize) -> Vec<Stimulus> {
    let of = |k| Stimulus {
        id: format!("{source}-{k}"),
        video: format!("{source}/{k}.mp4"),
        source: source.into(),
        objects: 2,
        set: None,
        condition: Some("helping".into()),
        labels: Labels {
            goals: Some([
                BTreeSet::from(["help".into(), "light blue on green".into()]),
                BTreeSet::from(["none".into()]),
            ]),
            relation: Some("friendly".into()),
            kind: Some("helping".into()),
        },
    };
    (0..count).map(of).collect()
}

fn design(experiment: Experiment, stimuli: Vec<Stimulus>) -> Design {
    Design {
        experiment,
        stimuli,
        catch_trials: Vec::new(),
        name: None,
        videos_per_rater: None,
        one_of_each_set: false,
        seed: 1,
    }
}

fn read(design: &Design) -> StudyConfig {
    StudyConfig::read(design.to_text().as_bytes(), &forms()).expect("what is written can be read")
}

#[test]
fn numbers_of_raters_and_videos_are_those_of_the_published_experiments() {
    let of = |experiment, stimuli| {
        let config = read(&design(experiment, stimuli));
        (config.raters, config.raters_per_video, config.raters_per_video_at_most, config.videos_per_rater)
    };
    // 20 % of 500 videos, 130 people, 10 for a video.
    assert_eq!(of(Experiment::Interactions, stimuli("phase", 100)), (130, 10, 11, 8));
    // 186 people in two groups, 100 videos each.
    let both = [stimuli("human", 100), stimuli("phase", 100)].concat();
    assert_eq!(of(Experiment::HumanLikeness, both), (186, 18, 19, 20));
    // 10 to 19 people for a video, 20 videos each.
    assert_eq!(of(Experiment::Relations, stimuli("phase", 100)), (50, 10, 19, 20));
    for experiment in Experiment::ALL {
        for count in 1..12 {
            let (raters, wanted, most, each) = of(experiment, stimuli("phase", count));
            assert_eq!(each as usize, count, "of few videos a rater sees all");
            assert!(raters as usize * each as usize >= count * wanted as usize && most >= wanted);
        }
    }
}

#[test]
fn what_is_written_is_what_was_designed() {
    let catch = CatchTrial {
        id: "c".into(),
        video: "c.mp4".into(),
        objects: 1,
        expected: BTreeMap::from([("relation".to_owned(), BTreeSet::from(["neutral".to_owned()]))]),
    };
    let stimuli = [stimuli("human", 3), stimuli("phase", 2)].concat();
    let design = design(Experiment::HumanLikeness, stimuli.clone());
    let design = Design { catch_trials: vec![catch.clone()], name: Some("mine".into()), seed: 5, ..design };
    let config = read(&design);
    assert_eq!((config.name.as_str(), config.answer_before_end), ("mine", false));
    assert_eq!((config.stimuli, config.catch_trials, config.seed), (stimuli, vec![catch], 5));
    assert!(config.between_sources && config.form == Form::Goals && config.demographics.is_empty());
}

#[test]
fn of_pairs_a_rater_sees_one_video_each() {
    let mut pairs = stimuli("phase", 12);
    for (k, stimulus) in pairs.iter_mut().enumerate() {
        stimulus.set = Some(format!("pair-{}", k / 2));
        stimulus.condition = Some(if k % 2 == 0 { "help" } else { "hinder" }.into());
    }
    let together = read(&design(Experiment::Relations, pairs.clone()));
    assert_eq!((together.videos_per_rater, together.raters, together.stimuli), (12, 10, pairs.clone()));
    let apart = Design { one_of_each_set: true, ..design(Experiment::Relations, pairs.clone()) };
    let apart = read(&apart);
    assert_eq!((apart.videos_per_rater, apart.raters, apart.one_of_each_set), (6, 20, true));
    // Of a triple each rater sees a third.
    pairs[2].set = Some("pair-0".into());
    let uneven = read(&Design { one_of_each_set: true, ..design(Experiment::Relations, pairs) });
    assert_eq!((uneven.videos_per_rater, uneven.raters), (6, 30));
    let fewer = Design { videos_per_rater: Some(4), ..design(Experiment::Relations, stimuli("phase", 12)) };
    assert_eq!(read(&fewer).raters, 30);
}

#[test]
fn goals_have_the_words_of_form_and_video() {
    let asked = forms().questions(Form::Goals, 2);
    let choices = |k: usize| {
        let question = asked.iter().find(|question| question.name == GOALS[k]).expect("asked");
        question.kind.choices().to_vec()
    };
    let (agents, palette) = ([AgentId::ZERO, AgentId::ONE], Palette::PAPER);
    let mut goals = Vec::new();
    for landmark in LandmarkId::ALL {
        goals.push(Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark, sign: Sign::Positive });
        for object in ObjectId::ALL {
            goals.push(Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive });
        }
    }
    for goal in goals {
        let [first, _] = known_goals(
            [goal, Goal::Touch { agent: agents[1], other: agents[0], sign: Sign::Negative }],
            [Attitude::Neutral; 2],
        )
        .expect("words");
        let word = first.first().expect("a word");
        let choice =
            choices(0).into_iter().find(|choice| choice.value == *word).expect("a choice of the form");
        // The palette tells what videos show: colours must be the same.
        let shown = palette.names.wants(goal, AgentId::ZERO);
        let colours: Vec<&str> =
            palette.names.objects.iter().copied().filter(|name| shown.contains(name)).collect();
        assert!(colours.iter().all(|colour| choice.text.contains(colour)), "{shown}: {}", choice.text);
        let place = shown.rsplit(" on ").next().expect("a place").trim_start_matches("the ");
        assert!(choice.text.ends_with(place), "{shown}: {}", choice.text);
    }
    let touch = Goal::Touch { agent: agents[0], other: agents[1], sign: Sign::Positive };
    let away = Goal::Touch { agent: agents[0], other: agents[1], sign: Sign::Negative };
    let words = known_goals([touch, away], [Attitude::Neutral, Attitude::Hinder]).expect("words");
    assert_eq!(words[0], BTreeSet::from(["touch".to_owned()]));
    assert_eq!(words[1], BTreeSet::from(["get away".to_owned(), "hinder".to_owned()]));
    let other =
        Goal::AgentOnLandmark { agent: agents[0], landmark: LandmarkId::ALL[0], sign: Sign::Positive };
    let words = known_goals([other, other], [Attitude::Neutral, Attitude::Help]).expect("words");
    assert_eq!(words[1], BTreeSet::from(["help".to_owned()]));
    let off = Goal::AgentOnLandmark { agent: agents[0], landmark: LandmarkId::ALL[0], sign: Sign::Negative };
    assert_eq!(known_goals([off, touch], [Attitude::Neutral; 2]), None);
}
