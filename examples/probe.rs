use lgp::search::*;
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let seconds: f64 = a[1].parse().unwrap();
    let seed: u64 = a[2].parse().unwrap();
    let outputs: Option<Vec<String>> = a.get(3).map(|s| s.split(',').map(str::to_owned).collect());
    let dataset = lgp::dataset::Dataset::load("datasets/dfg.bin".as_ref()).unwrap();
    let dataset = dataset.select(None, outputs.as_deref()).unwrap();
    let grammar = lgp::grammar::Grammar::find("shader").unwrap();
    let profile = lgp::cost::Profile::find("gcn").unwrap();
    let settings = Settings { seed, ..Settings::default() };
    let problem = Problem::new(&dataset, &grammar, &profile, &settings);
    let mut search = Search::new(settings);
    let start = Instant::now();
    while start.elapsed().as_secs_f64() < seconds {
        search.advance(&problem);
    }
    let front = Front::of(&search, &problem);
    println!("{} generations {:?}", search.generation(), search.counts());
    if a.len() > 4 {
        for m in &front.members {
            println!(
                "{:5.1} {:.5} {:.5} {}",
                m.cost,
                m.search_error().rmse,
                m.validation_error().rmse,
                m.formula
            );
        }
    }
    for cost in [5.0, 10.0, 12.0, 15.0, 16.0, 18.0, 20.0, 22.0, 30.0, 40.0] {
        let best = front
            .members
            .iter()
            .filter(|m| m.cost <= cost)
            .map(|m| m.search_error().rmse)
            .fold(9.0, f64::min);
        print!("{cost}:{best:.5} ");
    }
    println!();
}
