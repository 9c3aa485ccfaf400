//! `trace.csv`: the progress of a search, as it is written and read.

use crate::fit::Measure;
use crate::search::{Counts, Search};
use serde::Serialize;

/// A line of `trace.csv`.
#[derive(Clone, Debug, PartialEq)]
pub struct TracePoint {
    /// Seconds since the run began.
    pub seconds: f64,
    /// The candidates considered so far, by what became of them.
    pub counts: Counts,
    /// The hypervolume of the archive.
    pub hypervolume: f64,
    /// The least error in the search's measure, on the search split, at each of [`TRACE_COSTS`] or
    /// below.
    pub errors: [f64; TRACE_COSTS.len()],
}

/// The costs whose best error is traced, in cycles.
pub const TRACE_COSTS: [f64; 9] = [5.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 40.0];

impl TracePoint {
    /// Returns the state of a search after some seconds.
    pub fn of(search: &Search, seconds: f64) -> TracePoint {
        TracePoint {
            seconds,
            counts: search.counts(),
            hypervolume: search.hypervolume(),
            errors: TRACE_COSTS.map(|cost| search.best_error(cost)),
        }
    }
}

/// Returns the text of `trace.csv`, its error columns named after the measure.
pub fn trace_csv(points: &[TracePoint], measure: Measure) -> String {
    let costs = TRACE_COSTS.map(|cost| format!("{measure}_{cost}")).join(",");
    let mut text = format!("seconds,considered,fitted,fitted_on_all,hypervolume,{costs}\n");
    for point in points {
        let TracePoint { seconds, counts, hypervolume, errors } = point;
        let errors = errors.map(|error| format!("{error:.6}")).join(",");
        text += &format!(
            "{seconds:.3},{},{},{},{hypervolume:.4},{errors}\n",
            counts.considered, counts.fitted, counts.fitted_on_all
        );
    }
    text
}

/// The columns of a `trace.csv`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Trace {
    /// Seconds since the run began, rising.
    pub seconds: Vec<f64>,
    /// Candidates considered by then.
    pub considered: Vec<f64>,
    /// The hypervolume by then.
    pub hypervolume: Vec<f64>,
    /// The costs, in cycles, rising.
    pub costs: Vec<f64>,
    /// By cost, the least error at each moment at that cost or below; infinite if there is none.
    pub errors: Vec<Vec<f64>>,
}

impl Trace {
    /// Parses the text of a `trace.csv`.
    ///
    /// # Errors
    /// The line, and what is wrong with it.
    pub fn parse(text: &str) -> Result<Trace, (usize, String)> {
        let mut lines = (1..).zip(text.lines());
        let names: Vec<&str> =
            lines.next().map_or(Vec::new(), |(_, line)| line.split(',').collect());
        let place = |name: &str| {
            let found = names.iter().position(|known| *known == name);
            found.ok_or_else(|| (1, format!("there is no column `{name}`")))
        };
        let [seconds, considered, hypervolume] =
            [place("seconds")?, place("considered")?, place("hypervolume")?];
        let by_cost = names.iter().enumerate().filter_map(|(column, name)| {
            // The column's name begins with the measure's.
            let (measure, cost) = name.split_once('_')?;
            measure.parse::<Measure>().ok()?;
            Some((column, cost.parse::<f64>().ok()?))
        });
        let by_cost: Vec<(usize, f64)> = by_cost.collect();
        let mut trace = Trace {
            costs: by_cost.iter().map(|(_, cost)| *cost).collect(),
            errors: vec![Vec::new(); by_cost.len()],
            ..Trace::default()
        };
        for (number, line) in lines {
            let cells: Result<Vec<f64>, _> = line.split(',').map(str::parse::<f64>).collect();
            let cells = cells.map_err(|error| (number, error.to_string()))?;
            if cells.len() != names.len() {
                let (found, expected) = (cells.len(), names.len());
                return Err((number, format!("{found} cells under a header of {expected}")));
            }
            trace.seconds.push(cells[seconds]);
            trace.considered.push(cells[considered]);
            trace.hypervolume.push(cells[hypervolume]);
            for ((column, _), errors) in by_cost.iter().zip(&mut trace.errors) {
                errors.push(cells[*column]);
            }
        }
        Ok(trace)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name() {
        let trace =
            Trace::parse("seconds,considered,hypervolume,max_5,max_10\n1,2,3,inf,.5\n").unwrap();
        assert_eq!((trace.seconds, trace.costs), (vec![1.0], vec![5.0, 10.0]));
        assert_eq!(trace.errors, [[f64::INFINITY], [0.5]]);
    }

    #[test]
    fn what_is_damaged_is_named_with_its_line() {
        let damaged = |text: &str| Trace::parse(text).unwrap_err();
        assert_eq!(damaged("").0, 1);
        assert!(damaged("seconds,considered\n").1.contains("hypervolume"));
        let header = "seconds,considered,hypervolume\n";
        assert_eq!(damaged(&format!("{header}1,2,3\n1,2\n")).0, 3);
        assert_eq!(damaged(&format!("{header}1,x,3\n")).0, 2);
    }
}
