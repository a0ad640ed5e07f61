//! exploration
// usage: explore_choice FILE thin intents(0/1) [settings.json]
use phase_simple::*;
use phase_model::*;
use std::sync::{Mutex, atomic::{AtomicUsize, Ordering}};
fn choice(a: Action) -> usize { match a { Action::TurnLeft | Action::TurnRight => 0, o => o.index() - 1 } }
const C: usize = 13;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let recs = phase_event::from_json(&std::fs::read_to_string(&args[1]).unwrap()).unwrap();
    let thin: usize = args[2].parse().unwrap();
    let intents = args[3] == "1";
    let mut minds = InferenceSettings::default().minds;
    if let Some(f) = args.get(4) {
        let mut v = serde_json::to_value(minds).unwrap();
        let o: serde_json::Value = serde_json::from_str(f).unwrap();
        for (k, x) in o.as_object().unwrap() { v[k] = x.clone(); }
        minds = serde_json::from_value(v).unwrap();
    }

    let next = AtomicUsize::new(0);
    // per step record: (kind, role, p, u)
    let out: Mutex<Vec<(usize, Vec<(String, String, f64, f64, usize)>, Option<(f64, bool, bool)>)>> = Mutex::new(vec![]);
    std::thread::scope(|s| for _ in 0..2 { s.spawn(|| loop {
        let k = next.fetch_add(1, Ordering::SeqCst);
        if k >= recs.len() { break; }
        let rec = &recs[k];
        let observed = rec.observed().unwrap();
        let prep = PreparedEvent::new(&observed, minds, 1);
        let alt = prep.motion().alternatives(&observed);
        let like = |r: &[f32; 14]| { let mut m = [f64::INFINITY; C]; for a in Action::ALL { let c = choice(a); m[c] = m[c].min(f64::from(r[a.index()])); }
            let b = m.iter().copied().fold(f64::INFINITY, f64::min); m.map(|x| ((b - x) / 0.03).exp()) };
        let sc = &rec.scene;
        let strengths = AgentId::ALL.map(|a| sc.agents[a].strength);
        let goals = sc.goals();
        let att = AgentId::ALL.map(|a| sc.agents[a].attitude);
        let role = |a: AgentId| -> String { let o = a.other(); match (sc.kind.name(), att[a], att[o]) {
            ("helping", Attitude::Help, _) => "helper", ("helping", ..) => "helpee", ("hindering", Attitude::Hinder, _) => "hinderer", ("hindering", ..) => "victim",
            ("chasing", ..) => if goals[a].sign() == Sign::Positive { "chaser" } else { "fleer" }, ("competing", ..) => "competitor", ("collaborating", ..) => "collaborator", _ => "independent" }.into() };
        let log_of = |hyp: &Hypothesis, agent: AgentId, rec_out: Option<&mut Vec<(String, String, f64, f64, usize)>>| -> f64 {
            let d = prep.simulate_agent_thin(hyp, agent, thin, k % thin).unwrap();
            let mut sum = 0.0; let mut ro = rec_out;
            for (t, dec) in d.iter() {
                let l = like(&alt[*t][agent]);
                let mut p = [0.0; C]; let v: f64 = dec.thought.actions.iter().map(|x| f64::from(x.visits)).sum();
                if v > 0.0 { for x in &dec.thought.actions { p[choice(x.action)] += f64::from(x.visits) / v; } } else { p[choice(dec.action)] = 1.0; }
                let ch: f64 = p.iter().zip(&l).map(|(a, b)| a * b).sum(); let u: f64 = l.iter().sum::<f64>() / C as f64;
                let best = l.iter().enumerate().max_by(|a,b| a.1.total_cmp(b.1)).unwrap().0;
                sum += (0.93 * ch + 0.07 * u).ln();
                if let Some(ro) = ro.as_deref_mut() { { let st = &prep.motion().states[*t]; let touch = st.contacts.touching(Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE)); let hold = st.held_object(agent).is_some(); let sg = dec.thought.subgoal.to_string().replace(|c: char| c.is_ascii_digit(), ""); ro.push((sc.kind.name().to_string(), format!("{}|{}|{}{}|n{}", role(agent), sg, if touch {"touch"} else {""}, if hold {"hold"} else {""}, dec.thought.actions.len()), ch, u, best)); } }
            }
            sum
        };
        let mut steps = vec![];
        let truth = Hypothesis { goals, attitudes: att, strengths };
        for a in AgentId::ALL { log_of(&truth, a, Some(&mut steps)); }
        let post = intents.then(|| {
            let objects = observed.object_sizes().len();
            let w: Vec<Vec<(Intent, f64)>> = AgentId::ALL.iter().map(|&a| Intent::all(a, objects).into_iter().map(|i| {
                let others = if att[a] == Attitude::Neutral && att[a.other()] == Attitude::Neutral { goals[a.other()] } else { goals[a.other()] };
                let h = i.hypothesis(a, others, strengths);
                (i, log_of(&h, a, None) * thin as f64 * 0.3)
            }).collect()).collect();
            let mut hyps: Vec<(Hypothesis, f64)> = vec![];
            for (i, li) in w[0].iter().filter(|x| x.0.attitude == Attitude::Neutral) { for (j, lj) in w[1].iter().filter(|x| x.0.attitude == Attitude::Neutral) {
                let h = i.hypothesis(AgentId::ZERO, j.goal, strengths); hyps.push((h, li + lj + h.log_prior(14))); } }
            for (n, a) in AgentId::ALL.into_iter().enumerate() { for (i, li) in w[n].iter().filter(|x| x.0.attitude != Attitude::Neutral) {
                if let Some((_, lj)) = w[1 - n].iter().find(|x| x.0.attitude == Attitude::Neutral && x.0.goal == i.goal) { let h = i.hypothesis(a, i.goal, strengths); hyps.push((h, li + lj + h.log_prior(14))); } } }
            let mx = hyps.iter().map(|x| x.1).fold(f64::NEG_INFINITY, f64::max);
            let z: f64 = hyps.iter().map(|x| (x.1 - mx).exp()).sum();
            let t = Hypothesis::new(goals, att, strengths);
            let same = |h: &Hypothesis| h.goals == t.goals && h.attitudes == t.attitudes;
            let p: f64 = hyps.iter().filter(|x| same(&x.0)).map(|x| (x.1 - mx).exp() / z).sum();
            let best = hyps.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            if std::env::var("V").is_ok() { eprintln!("{} {} lp {:.2} best {:?} {:?} true {:?} {:?}", rec.id, sc.kind.name(), p.max(1e-9).ln(), best.0.goals, best.0.attitudes, t.goals, t.attitudes); }
            (p.max(1e-6).ln(), best.0.goals == t.goals, best.0.relation() == t.relation())
        });
        out.lock().unwrap().push((k, steps, post));
    }); });
    let mut out = out.into_inner().unwrap(); out.sort_by_key(|x| x.0);
    let all: Vec<_> = out.iter().flat_map(|x| x.1.iter()).collect();
    let report = |name: &str, v: &[&&(String, String, f64, f64, usize)]| {
        let n = v.len() as f64; let ll = |e: f64| v.iter().map(|x| ((1.0 - e) * x.2 + e * x.3).ln()).sum::<f64>() / n;
        let best = (1..60).map(|i| i as f64 * 0.01).map(|e| (ll(e), e)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        println!("{name:14} n {n:5} chance {:.3} ll05 {:.3} llfit {:.3} (lapse {:.2})", v.iter().map(|x| x.2).sum::<f64>() / n, ll(0.05), best.0, best.1);
    };
    report("all", &all.iter().collect::<Vec<_>>());
    for k in ["independent", "helping", "collaborating", "chasing", "competing", "hindering"] { report(k, &all.iter().filter(|x| x.0 == k).collect::<Vec<_>>()); }
    for k in ["hinderer", "victim", "chaser", "fleer", "helper", "helpee"] { report(k, &all.iter().filter(|x| x.1.starts_with(k)).collect::<Vec<_>>()); }
    for (c, name) in ["turn","up","down","left","right","ul","ur","dl","dr","stop","noforce","attach","detach"].iter().enumerate() { let v: Vec<_> = all.iter().filter(|x| x.4 == c).collect(); if !v.is_empty() { report(name, &v); } }
    if std::env::var("S").is_ok() { let mut m: std::collections::BTreeMap<String, Vec<&&(String, String, f64, f64, usize)>> = Default::default();
      for x in &all { m.entry(x.1.clone()).or_default().push(x); }
      let mut v: Vec<_> = m.into_iter().collect(); v.sort_by_key(|x| (x.1.iter().map(|y| (0.9 * y.2 + 0.1 * y.3).ln()).sum::<f64>() * 1000.0) as i64);
      for (n, x) in v.iter().take(45) { println!("loss {:.3}", x.iter().map(|y| (0.9 * y.2 + 0.1 * y.3).ln()).sum::<f64>() / all.len() as f64); let mut c = [0; 13]; for y in x { c[y.4] += 1; } report(&format!("{n} {c:?}"), x); } }
    let posts: Vec<_> = out.iter().filter_map(|x| x.2).collect();
    if !posts.is_empty() { let n = posts.len() as f64; println!("posterior: mean ln {:.3} median {:.3} goals {} relations {} of {}", posts.iter().map(|x| x.0).sum::<f64>() / n, { let mut v: Vec<f64> = posts.iter().map(|x| x.0).collect(); v.sort_by(f64::total_cmp); v[v.len() / 2] }, posts.iter().filter(|x| x.1).count(), posts.iter().filter(|x| x.2).count(), n); }
}
