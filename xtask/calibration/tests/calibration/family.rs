use phase_calibration::family;

#[test]
fn names_have_families() {
    let cases = [
        ("free_right_size0", "free"),
        ("free_action_turnleft", "free"),
        ("coast_size0", "coast"),
        ("item_coast_size1", "coast"),
        ("turnleft_size0", "turn"),
        ("turnright_then_up", "turn"),
        ("stop_size2", "stop"),
        ("wall_side", "wall"),
        ("inner_wall_end", "wall"),
        ("push_item0", "push"),
        ("push_off_centre_item0", "push_off_centre"),
        ("grab_pull_item0", "grab"),
        ("attach_side", "grab"),
        ("carry_item0", "carry"),
        ("tug_item2", "tug"),
        ("collide_still", "collide"),
        ("items_collide", "items_collide"),
        ("spin_size0", "spin"),
        ("alone", "alone"),
    ];
    for (name, expected) in cases {
        assert_eq!(family(name), expected, "{name}");
    }
}
