//! The text on elapsed and remaining time.

use phase_cli::progress::{line, times};
use std::time::Duration;

#[test]
fn nothing_is_said_of_a_time_that_is_not_known() {
    let seconds = Duration::from_secs;
    assert_eq!(times(Duration::from_millis(999), Some(seconds(30))), "");
    assert_eq!(times(seconds(1), None), " · 1 s elapsed");
    assert_eq!(times(seconds(5), Some(Duration::from_millis(400))), " · 5 s elapsed");
    assert_eq!(times(seconds(59), Some(seconds(60))), " · 59 s elapsed, about 1 min 0 s remaining");
    assert_eq!(times(seconds(3661), Some(seconds(7199))), " · 1 h 1 min elapsed, about 1 h 59 min remaining");
}

#[test]
fn a_line_tells_share_and_times() {
    let text = line("300 disturbances", 75, 300, Duration::from_secs(60));
    assert_eq!(text, "300 disturbances: 25 % · 1 min 0 s elapsed, about 3 min 0 s remaining");
    assert_eq!(line("none", 0, 0, Duration::from_secs(2)), "none: 0 % · 2 s elapsed");
}
