use phase_pomcp::{GenerativeModel, Pomcp, PomcpSettings};
use rand::{SeedableRng};
use rand_pcg::Pcg64Mcg;
use crate::tiger_problem::*;

#[test]
fn exper() {
    let t = Tiger { accuracy: 0.85, rollout: Rollout::Uniform };
    println!("inf {:?} {:?}", t.exact(500, 0), t.exact(40,0));
    for (h,l) in [(1,0),(2,0),(3,0),(3,2),(4,1)] { 
      for sims in [10_000,100_000] {
      let mut p = Pomcp::new(PomcpSettings{simulations:sims, horizon:h, ..Default::default()}).unwrap();
      let n=10000; let left=(t.probability_left(l)*n as f64).round() as usize;
      let roots: Vec<Side> = (0..n).map(|i| if i<left {Side::Left} else {Side::Right}).collect();
      let mut r = Pcg64Mcg::seed_from_u64(1);
      let d = p.search(&t, &roots, &mut r).unwrap();
      println!("h{h} l{l} {sims} exact {:?}\n   {:?}", t.exact(h,l), d);
    }}
    for rollout in [Rollout::Uniform, Rollout::Listen] { for sims in [1000,4000] { for norm in [true,false] { for rs in [10,0] {
        let t = Tiger{accuracy:0.85, rollout};
        let mut p = Pomcp::new(PomcpSettings{simulations:sims, rollout_steps: rs, normalise_values:norm, c_init: if norm {1.25} else {100.0}, ..Default::default()}).unwrap();
        let mut sum=0.0; let mut sq=0.0; let n=100; let mut dep=0;
        let t0=std::time::Instant::now();
        for e in 0..n {
            let mut r = Pcg64Mcg::seed_from_u64(e);
            let mut s = Side::draw(0.5,&mut r);
            let mut b: Vec<Side> = (0..500).map(|i| if i%2==0 {Side::Left} else {Side::Right}).collect();
            let mut ret=0.0; let mut w=1.0;
            for _ in 0..40 { let d=p.search(&t,&b,&mut r).unwrap(); dep=d.effort.depth.max(dep); let o=t.step(&mut s,d.action,&mut r); ret+=w*o.reward; w*=0.95; t.update(&mut b,o.observation,&mut r);}            
            sum+=ret; sq+=ret*ret;
        }
        let m=sum/n as f64; let se=((sq/n as f64-m*m)/n as f64).sqrt();
        println!("{rollout:?} sims {sims} norm {norm} rs {rs}: {m:.2} ± {se:.2}  depth {dep} {:?}", t0.elapsed());
    }}}}
}
