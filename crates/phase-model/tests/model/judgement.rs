//! The output of a model of social perception.

use phase_model::{Relation, RelationProbabilities};

#[test]
fn the_most_likely_relation() {
    let probabilities =
        |friendly, adversarial, neutral| RelationProbabilities { friendly, adversarial, neutral };
    for (of, expected) in [
        (probabilities(0.2, 0.5, 0.3), Relation::Adversarial),
        (probabilities(0.2, 0.2, 0.6), Relation::Neutral),
        (probabilities(0.4, 0.4, 0.2), Relation::Friendly),
        (RelationProbabilities::default(), Relation::Friendly),
    ] {
        assert_eq!(of.most_likely(), expected, "{of:?}");
    }
}
