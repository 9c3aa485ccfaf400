//! Tables and pictures of all runs on disk.

use super::Case;
use super::record::{Runs, Spread, TRACED};
use lgp::file::replace_file;
use lgp::fit::Measure;
use lgp::report::plot::{Line, LinePlot, Theme, lines_png, lines_svg};
use lgp::wording::error_text;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

/// Costs that the overview shows.
const SHOWN: [f64; 9] = [3.0, 5.0, 8.0, 10.0, 12.0, 16.0, 20.0, 22.0, 30.0];

/// Medians to be reached: dataset, budget, cost, RMSE.
const GOALS: [(&str, &str, f64, f64); 24] = [
    ("bias", "6s", 5.0, 0.0070),
    ("bias", "6s", 10.0, 0.0036),
    ("bias", "6s", 16.0, 0.0023),
    ("bias", "60s", 5.0, 0.0060),
    ("bias", "60s", 10.0, 0.0030),
    ("bias", "60s", 16.0, 0.0018),
    ("bias", "60s", 22.0, 0.0012),
    ("scale", "6s", 5.0, 0.030),
    ("scale", "6s", 10.0, 0.0190),
    ("scale", "6s", 15.0, 0.0110),
    ("scale", "60s", 5.0, 0.026),
    ("scale", "60s", 10.0, 0.0150),
    ("scale", "60s", 15.0, 0.0085),
    ("scale", "60s", 20.0, 0.0060),
    ("dfg", "60s", 10.0, 0.018),
    ("dfg", "60s", 12.0, 0.0125),
    ("dfg", "60s", 16.0, 0.0100),
    ("dfg", "60s", 20.0, 0.0080),
    ("dfg", "60s", 30.0, 0.0055),
    ("dfg", "600s", 12.0, 0.011),
    ("dfg", "600s", 16.0, 0.0080),
    ("dfg", "600s", 20.0, 0.0060),
    ("dfg", "600s", 30.0, 0.0035),
    ("dfg", "600s", 49.0, 0.001),
];

/// Medians of the maximum error to be reached: dataset, budget, cost, error.
const MAX_GOALS: [(&str, &str, f64, f64); 2] =
    [("bias", "60s", 16.0, 0.012), ("dfg", "60s", 20.0, 0.03)];

const INTRODUCTION: &str = "\
# Search benchmark

Made by `cargo run --release --example search`; [`benches/search`](../../benches/search/main.rs) says what is
measured, `-- --help` how to choose. Errors are RMSE on the search grid, over all outputs: the
median over seeds of the best formula at that cost or below, and behind × the worst seed over the
median. Budgets are seconds on two threads, of wall time or, where `DATA/BUDGET.json` says so, of the CPU
time that a quiet machine spends in such a second (1.8 s: threads wait for each other), so that other
work on the machine changes nothing. `table.csv` has every whole cost,
`published.csv` each published formula, `DATA/BUDGET.json` the fronts and traces, `DATA/BUDGET-max.json` those of
searches for the maximum error.

A published formula is *halved* where the median seed has half its error at its cost or below.
";

pub fn write(out: &Path, cases: &[Case]) -> Result<(), Box<dyn Error>> {
    let mut page = INTRODUCTION.to_owned();
    let mut table = "data,budget,cost,seeds,best,median,worst,worst_over_median\n".to_owned();
    let mut published =
        "data,budget,formula,cost,rmse,max,median_rmse,share,seeds_halving,seeds\n".to_owned();
    for case in cases {
        let all = Runs::of(out, &case.name, Measure::Rmse)?;
        let by_maximum = Runs::of(out, &case.name, Measure::Max)?;
        if all.is_empty() && by_maximum.is_empty() {
            continue;
        }
        write!(page, "\n## {}\n{}.\n", case.name, case.definition)?;
        if let Some(longest) = all.last() {
            plot(out, case, longest)?;
            writeln!(page, "\n![Error against time]({}/time.svg)\n", case.name)?;
            overview(&mut page, &all)?;
        }
        goals(&mut page, &all)?;
        maximum_errors(&mut page, &all)?;
        maximum_errors(&mut page, &by_maximum)?;
        against_published(&mut page, &mut published, case, &all)?;
        for runs in &all {
            rows(&mut table, runs)?;
        }
    }
    for (file, text) in [("README.md", page), ("table.csv", table), ("published.csv", published)] {
        replace_file(&out.join(file), text.as_bytes())?;
    }
    Ok(())
}

/// Every whole cost at which the median is finite and lower than before.
fn rows(table: &mut String, runs: &Runs) -> std::fmt::Result {
    let max_cost = runs.runs.iter().map(|run| run.max_cost).fold(0.0, f64::max);
    for cost in 0..=max_cost as u32 {
        let Spread { best, median, worst } = runs.errors_at(f64::from(cost));
        if median.is_finite() {
            writeln!(
                table,
                "{},{},{cost},{},{best:.4e},{median:.4e},{worst:.4e},{:.3}",
                runs.data,
                runs.budget,
                runs.runs.len(),
                worst / median
            )?;
        }
    }
    Ok(())
}

fn overview(page: &mut String, all: &[Runs]) -> std::fmt::Result {
    let costs: Vec<String> = SHOWN.iter().map(f64::to_string).collect();
    writeln!(page, "| budget | seeds | {} |", costs.join(" | "))?;
    writeln!(page, "|---|---|{}", "---|".repeat(SHOWN.len()))?;
    for runs in all {
        let cell = |&cost: &f64| {
            let Spread { median, worst, .. } = runs.errors_at(cost);
            match median.is_finite() {
                true => format!("{} ×{:.2}", error_text(median), worst / median),
                false => "–".to_owned(),
            }
        };
        let cells: Vec<String> = SHOWN.iter().map(cell).collect();
        writeln!(page, "| {} | {} | {} |", runs.budget, runs.runs.len(), cells.join(" | "))?;
    }
    Ok(())
}

fn goals(page: &mut String, all: &[Runs]) -> std::fmt::Result {
    let mut told = Vec::new();
    for runs in all {
        let of_runs = GOALS.iter().filter(|goal| goal.0 == runs.data && goal.1 == runs.budget);
        for &(_, budget, cost, goal) in of_runs {
            let median = runs.errors_at(cost).median;
            let verdict = if median <= goal { "reached" } else { "missed" };
            told.push(format!("{budget}, {cost} → {goal}: {verdict} ({})", error_text(median)));
        }
    }
    if told.is_empty() { Ok(()) } else { writeln!(page, "\nGoals: {}.", told.join("; ")) }
}

/// Of the fronts that were polished for it.
fn maximum_errors(page: &mut String, all: &[Runs]) -> std::fmt::Result {
    for runs in all {
        let cells: Vec<String> = TRACED
            .iter()
            .filter_map(|&cost| {
                let Spread { median, worst, .. } = runs.max_errors_at(cost)?;
                Some(format!("{cost} → {} ×{:.2}", error_text(median), worst / median))
            })
            .collect();
        if cells.is_empty() {
            continue;
        }
        let how = match runs.measure {
            Measure::Max => "searched for with `--loss max`",
            _ => "of the same runs, polished for it",
        };
        let (budget, seeds) = (&runs.budget, runs.runs.len());
        writeln!(page, "\nMaximum error, {budget}, {seeds} seeds, {how}: {}.", cells.join(", "))?;
        for (_, _, cost, goal) in MAX_GOALS
            .iter()
            .filter(|goal| (goal.0, goal.1) == (runs.data.as_str(), budget.as_str()))
        {
            let median = runs.max_errors_at(*cost).map_or(f64::INFINITY, |spread| spread.median);
            let verdict = if median <= *goal { "reached" } else { "missed" };
            writeln!(page, "Goal: {cost} → {goal}: {verdict} ({}).", error_text(median))?;
        }
    }
    Ok(())
}

fn against_published(
    page: &mut String,
    csv: &mut String,
    case: &Case,
    all: &[Runs],
) -> std::fmt::Result {
    if case.published.is_empty() || all.is_empty() {
        return Ok(());
    }
    let budgets: Vec<&str> = all.iter().map(|runs| runs.budget.as_str()).collect();
    writeln!(page, "\n| published | cost | RMSE | {} |", budgets.join(" | "))?;
    writeln!(page, "|---|---|---|{}", "---|".repeat(all.len()))?;
    for known in &case.published {
        let (cost, error) = (known.member.cost, known.member.search_error());
        let mut cells = Vec::new();
        for runs in all {
            let median = runs.errors_at(cost).median;
            let half = |run: &&super::record::Run| run.error_at(cost) <= error.rmse / 2.0;
            let (halving, seeds) = (runs.runs.iter().filter(half).count(), runs.runs.len());
            let verdict = match median / error.rmse {
                share if share <= 0.5 => "halved",
                share if share <= 1.0 => "dominated",
                _ => "not dominated",
            };
            cells.push(format!("{} {verdict}", error_text(median)));
            writeln!(
                csv,
                "{},{},{},{cost},{:.4e},{:.4e},{median:.4e},{:.4},{halving},{seeds}",
                case.name,
                runs.budget,
                known.name,
                error.rmse,
                error.max,
                median / error.rmse
            )?;
        }
        let cells = cells.join(" | ");
        writeln!(page, "| {} | {cost} | {} | {cells} |", known.name, error_text(error.rmse))?;
    }
    Ok(())
}

/// Error against time, a line for each traced cost, thin ones for the best and the worst seed.
fn plot(out: &Path, case: &Case, runs: &Runs) -> Result<(), Box<dyn Error>> {
    let last = |run: &super::record::Run| run.trace.last().map_or(0.0, |point| point.seconds);
    let end = runs.runs.iter().map(last).fold(f64::INFINITY, f64::min);
    let moments: Vec<f64> =
        (0..).map(|i| 0.1 * 1.15f64.powi(i)).take_while(|&time| time < end).chain([end]).collect();
    let mut lines = Vec::new();
    for (index, cost) in TRACED.iter().enumerate() {
        let at = |run: &super::record::Run, time: f64| {
            let before = run.trace.iter().take_while(|point| point.seconds <= time);
            before.last().and_then(|point| point.errors[index]).unwrap_or(f64::INFINITY)
        };
        let spread =
            |&time: &f64| (time, Spread::of(runs.runs.iter().map(|run| at(run, time)).collect()));
        let spreads: Vec<(f64, Spread)> = moments.iter().map(spread).collect();
        let line =
            |of: fn(&Spread) -> f64| spreads.iter().map(|(time, s)| (*time, of(s))).collect();
        lines.push(Line {
            name: format!("{cost} cycles"),
            points: line(|spread| spread.median),
            bounds: vec![line(|spread| spread.best), line(|spread| spread.worst)],
        });
    }
    let (count, threads) = (runs.runs.len(), runs.runs[0].threads);
    let plot = LinePlot {
        title: &case.name,
        subtitle: &format!("median of {count} seeds, thin: best and worst · {threads} threads"),
        x_label: "seconds",
        y_label: "RMSE on the search grid, at no more than so many cycles",
        lines: &lines,
        theme: Theme::Light,
    };
    let folder = out.join(&case.name);
    replace_file(&folder.join("time.svg"), lines_svg(&plot)?.as_bytes())?;
    Ok(replace_file(&folder.join("time.png"), &lines_png(&plot, 1600)?)?)
}
