//! Replays recorded probes.
use phase_model::*;
use phase_world::World;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct File { probes: Vec<Probe> }
#[derive(Deserialize)]
struct Probe {
    name: String,
    wall_segs: Vec<[[f32; 2]; 2]>,
    sizes: [f32; 4],
    actions: [Vec<Action>; 2],
    initial: [[f32; 6]; 4],
    steps: Vec<[[f32; 6]; 4]>,
    attached_after_step: Vec<[Option<u8>; 2]>,
    max_force: [f32; 2],
}
fn body(r: &[f32; 6]) -> Body {
    Body { position: Vec2::new(r[0], r[1]), velocity: Vec2::new(r[2], r[3]), angle: r[4], angular_velocity: r[5] }
}
fn family(name: &str) -> &str {
    if name == "items_collide" { return name; }
    if name.starts_with("push_off") { return "push_off"; }
    if name.starts_with("item_coast") { return "coast"; }
    if name.starts_with("attach") { return "grab"; }
    if name.starts_with("inner_wall") { return "wall"; }
    if name.starts_with("turn") { return "turn"; }
    name.split('_').next().unwrap()
}
#[test]
fn probes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/reference/probes.json");
    let Ok(text) = std::fs::read_to_string(path) else { println!("skipped"); return };
    let file: File = serde_json::from_str(&text).unwrap();
    let mut errs: BTreeMap<String, Vec<(f32, f32)>> = BTreeMap::new();
    let verbose = std::env::var("VERBOSE").ok();
    for probe in &file.probes {
        let physique = Physique {
            walls: probe.wall_segs.iter().map(|[a, b]| Segment { a: Vec2::from_array(*a), b: Vec2::from_array(*b) }).collect(),
            agents: [0, 1].map(|k| AgentBody { radius: probe.sizes[k], max_force: probe.max_force[k] }),
            object_radii: [probe.sizes[2], probe.sizes[3]],
            object_count: 2,
        };
        let mut world = World::new(&physique, &State::new([0, 1, 2, 3].map(|k| body(&probe.initial[k]))));
        let mut worst = (0.0f32, 0.0f32);
        let mut firsts = vec![];
        for (s, expected) in probe.steps.iter().enumerate() {
            let states = world.step([probe.actions[0][s], probe.actions[1][s]]);
            let state = states[4];
            assert_eq!([0, 1].map(|a| state.held_object(a).map(|o| o as u8)), probe.attached_after_step[s], "{}", probe.name);
            if std::env::var("SUB").is_ok_and(|n| n == probe.name) { for st in &states { for k in 0..4 { let b = st.bodies[k]; print!("{:.5} {:.5} {:.5} {:.5} {:.5} {:.3}| ", b.position.x, b.position.y, b.velocity.x, b.velocity.y, b.angle, b.angular_velocity); } println!(" sub {s}"); } }
            if verbose.as_deref() == Some(probe.name.as_str()) { for k in 0..4 { if state.bodies[k].velocity.length() > 0.0 || (expected[k][2] != 0.0) { let b = state.bodies[k]; println!("{s} {k} got {:.4} {:.4} {:.4} {:.4} {:.4}  want {:?}", b.position.x, b.position.y, b.velocity.x, b.velocity.y, b.angle, expected[k]); } } }
            let mut e = (0.0f32, 0.0f32);
            for k in 0..4 {
                let want = body(&expected[k]);
                e.0 = e.0.max(state.bodies[k].position.distance(want.position));
                e.1 = e.1.max((state.bodies[k].angle - want.angle).abs());
            }
            worst = (worst.0.max(e.0), worst.1.max(e.1));
            firsts.push(e);
            errs.entry(family(&probe.name).to_string()).or_default().push(e);
        }
        if verbose.as_deref().is_some_and(|v| probe.name.contains(v)) {
            println!("{:30} worst {:.4} {:.4}  {}", probe.name, worst.0, worst.1,
              firsts.iter().map(|e| format!("{:.3}/{:.3}", e.0, e.1)).collect::<Vec<_>>().join(" "));
        }
    }
    let q = |v: &Vec<f32>, p: f32| { let mut v = v.clone(); v.sort_by(f32::total_cmp); v[((v.len() - 1) as f32 * p) as usize] };
    let share = |names: &[&str], lim: f32| {
        let all: Vec<_> = names.iter().flat_map(|n| errs[*n].iter()).collect();
        all.iter().filter(|e| e.0 <= lim && e.1 <= lim).count() as f32 / all.len() as f32
    };
    for (name, e) in &errs {
        let p: Vec<f32> = e.iter().map(|e| e.0).collect();
        let a: Vec<f32> = e.iter().map(|e| e.1).collect();
        println!("{name:14} n {:4} pos p50 {:.5} p90 {:.5} max {:.4}  ang p50 {:.5} p90 {:.5} max {:.4} within.01 {:.3} within.1 {:.3}", e.len(), q(&p, 0.5), q(&p, 0.9), q(&p, 1.0), q(&a, 0.5), q(&a, 0.9), q(&a, 1.0), share(&[name], 0.01), share(&[name], 0.1));
    }
    println!("A {:.3} B {:.3}", share(&["free", "coast", "turn", "stop"], 0.01), share(&["wall", "push", "grab", "carry", "collide"], 0.1));
}
