//! What runs leave behind: a file for each dataset and budget, to which runs are added.

use lgp::file::replace_file;
use lgp::fit::Measure;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Costs whose error is noted while a search runs.
pub const TRACED: [f64; 7] = [5.0, 8.0, 10.0, 12.0, 16.0, 20.0, 30.0];

/// How long a search goes on: `60s` of wall time, or `200g` generations.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Budget {
    Generations(u64),
    Seconds(u64),
}

impl Budget {
    pub fn is_spent(self, seconds: f64, generations: u64) -> bool {
        match self {
            Budget::Seconds(budget) => seconds >= budget as f64,
            Budget::Generations(budget) => generations >= budget,
        }
    }
}

impl fmt::Display for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Budget::Seconds(budget) => write!(f, "{budget}s"),
            Budget::Generations(budget) => write!(f, "{budget}g"),
        }
    }
}

impl FromStr for Budget {
    type Err = String;

    fn from_str(text: &str) -> Result<Budget, String> {
        let whole = |number: &str| number.parse().ok().filter(|&number: &u64| number > 0);
        let seconds = text.strip_suffix('s').and_then(whole).map(Budget::Seconds);
        let budget = seconds.or(text.strip_suffix('g').and_then(whole).map(Budget::Generations));
        budget.ok_or_else(|| "write a budget as 60s, or 200g for generations".to_owned())
    }
}

/// The runs of one dataset with one budget, by rising seed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Runs {
    pub data: String,
    /// Of the dataset; runs on another are forgotten.
    pub hash: String,
    pub budget: String,
    /// What the searches made small: RMSE, or the maximum error.
    #[serde(default)]
    pub measure: Measure,
    pub runs: Vec<Run>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Run {
    pub seed: u64,
    pub version: String,
    pub grammar: String,
    pub max_cost: f64,
    pub threads: usize,
    /// Whether seconds are of CPU time.
    #[serde(default)]
    pub cpu: bool,
    /// Of the search; polishing the front comes after.
    pub seconds: f64,
    pub generations: u64,
    pub considered: u64,
    /// For RMSE, where that was made small.
    pub front: Vec<Member>,
    /// For the maximum error, where it was made small or asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub minimax: Vec<Member>,
    pub trace: Vec<TracePoint>,
}

/// Errors are over all outputs.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Member {
    pub cost: f64,
    /// On the search grid, as is `max`.
    pub rmse: f64,
    pub max: f64,
    pub validation_rmse: f64,
    pub formula: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TracePoint {
    pub seconds: f64,
    /// The least of what is made small at each of [`TRACED`] or below, not polished yet.
    pub errors: [Option<f64>; TRACED.len()],
}

impl Run {
    /// The least maximum error at no more than a cost, on the front made for it; infinite where there
    /// is none.
    pub fn max_error_at(&self, cost: f64) -> f64 {
        let affordable = self.minimax.iter().filter(|member| member.cost <= cost);
        affordable.map(|member| member.max).fold(f64::INFINITY, f64::min)
    }

    /// The least RMSE at no more than a cost; infinite where there is none.
    pub fn error_at(&self, cost: f64) -> f64 {
        let affordable = self.front.iter().filter(|member| member.cost <= cost);
        affordable.map(|member| member.rmse).fold(f64::INFINITY, f64::min)
    }
}

impl Runs {
    fn path(out: &Path, data: &str, budget: &str, measure: Measure) -> PathBuf {
        let suffix = if measure == Measure::Max { "-max" } else { "" };
        out.join(data).join(format!("{budget}{suffix}.json"))
    }

    /// Adds a run to those on disk, in place of one with its seed.
    pub fn add(
        out: &Path,
        data: &str,
        hash: &str,
        budget: Budget,
        measure: Measure,
        run: Run,
    ) -> Result<(), Box<dyn Error>> {
        let budget = budget.to_string();
        let path = Runs::path(out, data, &budget, measure);
        let known = if path.is_file() { Some(Runs::read(&path)?) } else { None };
        let empty =
            || Runs { data: data.into(), hash: hash.into(), budget, measure, runs: Vec::new() };
        let mut runs = known.filter(|known| known.hash == hash).unwrap_or_else(empty);
        runs.runs.retain(|known| known.seed != run.seed);
        runs.runs.push(run);
        runs.runs.sort_by_key(|run| run.seed);
        std::fs::create_dir_all(out.join(data))?;
        Ok(replace_file(&path, (serde_json::to_string(&runs)? + "\n").as_bytes())?)
    }

    fn read(path: &Path) -> Result<Runs, Box<dyn Error>> {
        let text = std::fs::read_to_string(path)?;
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()).into())
    }

    /// All runs of a dataset that made some error small, budgets rising.
    pub fn of(out: &Path, data: &str, measure: Measure) -> Result<Vec<Runs>, Box<dyn Error>> {
        let entries = std::fs::read_dir(out.join(data)).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        paths.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
        let mut all = paths.iter().map(|path| Runs::read(path)).collect::<Result<Vec<_>, _>>()?;
        all.retain(|runs| runs.measure == measure);
        let order = |runs: &Runs| runs.budget.parse::<Budget>().ok();
        all.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
        Ok(all)
    }

    /// Over all runs, the error at no more than a cost.
    pub fn errors_at(&self, cost: f64) -> Spread {
        Spread::of(self.runs.iter().map(|run| run.error_at(cost)).collect())
    }

    /// The same of the maximum error, over the runs that have a front for it.
    pub fn max_errors_at(&self, cost: f64) -> Option<Spread> {
        let with_one = self.runs.iter().filter(|run| !run.minimax.is_empty());
        let errors: Vec<f64> = with_one.map(|run| run.max_error_at(cost)).collect();
        (!errors.is_empty()).then(|| Spread::of(errors))
    }
}

/// Best, median and worst of some errors.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    pub best: f64,
    pub median: f64,
    pub worst: f64,
}

impl Spread {
    /// # Panics
    /// Of no values.
    pub fn of(mut values: Vec<f64>) -> Spread {
        values.sort_by(f64::total_cmp);
        let last = values.len() - 1;
        let median = 0.5 * (values[last / 2] + values[last.div_ceil(2)]);
        Spread { best: values[0], median, worst: values[last] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_added_and_replaced_by_seed_and_forgotten_with_their_data() {
        let folder = tempfile::tempdir().unwrap();
        let run = |seed, rmse| Run {
            seed,
            version: String::new(),
            grammar: String::new(),
            max_cost: 40.0,
            threads: 2,
            cpu: false,
            seconds: 6.0,
            generations: 1,
            considered: 1,
            front: vec![Member {
                cost: 5.0,
                rmse,
                max: 1.0,
                validation_rmse: 1.0,
                formula: String::new(),
            }],
            minimax: Vec::new(),
            trace: vec![TracePoint { seconds: 1.0, errors: [None; TRACED.len()] }],
        };
        let add = |hash, run| {
            Runs::add(folder.path(), "d", hash, Budget::Seconds(6), Measure::Rmse, run).unwrap()
        };
        let errors = || {
            let all = Runs::of(folder.path(), "d", Measure::Rmse).unwrap();
            all[0].runs.iter().map(|run| (run.seed, run.error_at(5.0))).collect::<Vec<_>>()
        };
        add("a", run(2, 0.2));
        add("a", run(1, 0.1));
        add("a", run(2, 0.3));
        assert_eq!(errors(), [(1, 0.1), (2, 0.3)]);
        add("b", run(4, 0.4));
        assert_eq!(errors(), [(4, 0.4)]);
    }

    #[test]
    fn budgets_are_read_and_ordered() {
        let budget = |text: &str| text.parse::<Budget>();
        assert_eq!(budget("60s"), Ok(Budget::Seconds(60)));
        assert_eq!(budget("20g").unwrap().to_string(), "20g");
        assert!(budget("6s").unwrap() < budget("600s").unwrap());
        assert!(budget("0s").is_err() && budget("6").is_err() && budget("s").is_err());
    }

    #[test]
    fn a_median_lies_between_the_middle_two() {
        let spread = Spread::of(vec![4.0, 1.0, 3.0, 9.0]);
        assert_eq!((spread.best, spread.median, spread.worst), (1.0, 3.5, 9.0));
    }
}
