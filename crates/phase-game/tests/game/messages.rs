//! What players may say.

use phase_game::FromPlayer;
use phase_model::Action;

#[test]
fn messages_are_read_strictly() {
    let read = |text: &str| FromPlayer::parse(text).map_err(|error| error.to_string());
    assert_eq!(read(r#"{"type": "hold", "action": "upleft"}"#), Ok(FromPlayer::Hold(Action::UpLeft)));
    assert_eq!(read(r#"{"type": "away", "away": true}"#), Ok(FromPlayer::Away(true)));
    assert_eq!(read(r#"{"type": "grab"}"#), Ok(FromPlayer::Grab));
    for text in [
        "",
        "[]",
        "{}",
        r#"{"type": "win"}"#,
        r#"{"type": "ready", "x": 1}"#,
        r#"{"type": "away", "away": 1}"#,
    ] {
        assert!(read(text).is_err(), "{text}");
    }
    assert!(read(r#"{"type": "hold", "action": "fly"}"#).is_err_and(|error| error.contains("fly")));
}
