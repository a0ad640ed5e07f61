//! tmp
use phase_model::*;
use phase_model::random::{stream, Purpose};
use phase_world::World;
fn r(rng: &mut impl rand::Rng, n: u32) -> usize { (rng.next_u32() % n) as usize }
#[test]
fn stress() {
    let layouts: Vec<Layout> = (0..22).flat_map(|b| [None, Some(Flip::Diagonal), Some(Flip::UpDown)].map(|f| Layout::new(b, f).unwrap())).collect();
    let n: u64 = std::env::var("N").map_or(300, |s| s.parse().unwrap());
    let mut crossings = 0; let mut outs = 0; let mut bad = 0; let mut maxspeed = 0f32; let mut deep = 0f32;
    let mut rebuilt_bad = 0;
    let t = std::time::Instant::now();
    for seed in 0..n {
        let mut rng = stream(seed, Purpose::Scene, 0);
        let layout = layouts[r(&mut rng, layouts.len() as u32)];
        let size = |rng: &mut _| Size::ALL[r(rng, 4)].radius();
        let agents = [0, 1].map(|_| AgentBody { radius: size(&mut rng), max_force: Strength::ALL[r(&mut rng, 4)].max_force() });
        let object_radii = [0, 1].map(|_| size(&mut rng));
        let physique = Physique { walls: layout.walls(), agents, object_radii, object_count: 2 };
        let room = r(&mut rng, 4);
        let state = State::new([0; 4].map(|_| {
            let rr = if r(&mut rng, 2) == 0 { room } else { r(&mut rng, 4) };
            Body::at_rest(arena::START_POINTS[rr][r(&mut rng, 4)], r(&mut rng, 1000) as f32 * 0.0126 - 6.3)
        }));
        let mut world = World::new(&physique, &state);
        let mut prev = world.state();
        let mut check = |prev: &State, s: &State, k: &str| {
            for e in 0..4 {
                let (a, b) = (prev.bodies[e].position, s.bodies[e].position);
                if !s.bodies[e].is_finite() { bad += 1; println!("{seed} {k} nonfinite {e}"); }
                maxspeed = maxspeed.max(s.bodies[e].velocity.length());
                if !arena::contains(b) { outs += 1; println!("{seed} {k} out {e} {b}"); }
                for w in &physique.walls { if w.crosses(Segment { a, b }) { crossings += 1; println!("{seed} {k} cross {e} {a} {b} {w:?} sizes {agents:?} {object_radii:?} v {} grips {:?}", prev.bodies[e].velocity, s.grips); }
                  deep = deep.max(if w.distance(b) < 0.3 { 0.3 - w.distance(b) } else { 0.0 }); }
            }
        };
        let s = world.settle(); check(&prev, &s, "settle"); prev = s;
        let mut acts = [Action::Up; 2];
        for step in 0..40 {
            for a in &mut acts { if r(&mut rng, 4) == 0 { *a = Action::ALL[r(&mut rng, 14)]; } if r(&mut rng, 6) == 0 { *a = Action::Attach } }
            let mut other = World::new(&physique, &prev);
            let t2 = other.step(acts)[4];
            for s in world.step(acts) { check(&prev, &s, &format!("{step} {acts:?}")); prev = s; }
            if t2 != prev && t2.bodies.iter().zip(&prev.bodies).any(|(a,b)| a!=b) { rebuilt_bad += 1; let d = (0..4).map(|e| t2.bodies[e].position.distance(prev.bodies[e].position)).fold(0f32, f32::max); println!("DIFF {d:.6} grips {} contacts {:?}", prev.grips.iter().flatten().count(), prev.contacts); }
        }
    }
    println!("crossings {crossings} outs {outs} bad {bad} maxspeed {maxspeed} deep {deep} rebuilt differs {rebuilt_bad} of {} time {:?}", n*40, t.elapsed());
}
