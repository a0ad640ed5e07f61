//! Published results.

use phase_report::published;

#[test]
fn published_rows_are_shares_and_in_order() {
    for row in published::GOALS {
        let [one, two, three] = row.goal;
        assert!(0.0 < one && one <= two && two <= three && three <= 1.0, "{row:?}");
    }
    for row in published::TRAJECTORIES {
        let [independent, social, all] = row.ade;
        assert!(independent <= all && all <= social && row.fde[2] >= all, "{row:?}");
    }
}
