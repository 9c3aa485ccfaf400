use lgp::dataset::{Dataset, axis};
use lgp::emit::Language;
use lgp::run::{Budget, Session};
use lgp::search::{Method, Problem};
use lgp::wording::front_table;

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lobe = |[x, roughness]: [f64; 2]| [(-3.0 * x).exp() * (1.0 - 0.5 * roughness)];
    let axes = [axis("x", 0.0..=1.0), axis("roughness", 0.01..=1.0)];
    let data = Dataset::sampled(axes, ["y"], lobe)?;
    let problem = Problem::of(data).gpu("gcn").max_cost(12.0).build()?;
    let budget = Budget { generations: Some(20), ..Budget::default() };
    let mut session = Session::new(problem, Method::default())?.budget(budget);
    let outcome = session.run(|now| eprintln!("{:.1} s", now.point.seconds))?;
    print!("{}", front_table(&outcome.front, &[], &outcome.run.names().outputs));
    let best = outcome.front.within(Some(8.0), None).ok_or("no formula costs 8 cycles or less")?;
    print!("{}", outcome.snippet(best, Language::Wgsl));
    Ok(())
}
