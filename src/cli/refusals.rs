//! Explains why a search ended without a formula.

use crate::run::Run;

/// Says which refusal took all of a run's candidates; `archived` of them were left at the end.
pub fn of_all(run: &Run, archived: usize) -> String {
    let counts = &run.counts;
    if archived > 0 {
        let required = match run.requirements().as_str() {
            "none" => String::new(),
            required => {
                format!(", or not as required over the whole domain (--require {required})")
            }
        };
        return format!(
            "no formula was found: all {archived} that the search kept are not finite somewhere in the domain or costlier than {} cycles when finished{required}; search longer, or ask for less",
            run.goal.max_cost
        );
    }
    let mut refused = [
        (
            counts.inadmissible,
            "are not built as required (--require, --transform), or nested deeper than the grammar allows",
        ),
        (counts.too_expensive, "cost more than --max-cost"),
        (
            counts.too_long,
            "have more operations than the grammar allows, or constants that are not finite",
        ),
        (counts.not_finite, "are not finite on the samples"),
        (counts.unfulfilled, "have values that are not as required (--require)"),
        (counts.hopeless + counts.no_better, "err more than others"),
    ];
    refused.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    let told = refused.iter().filter(|(count, _)| *count > 0).take(3);
    let told: Vec<String> = told.map(|(count, why)| format!("{count} {why}")).collect();
    match told.is_empty() {
        true => {
            "no formula was found: the search ended before it considered any; give it more time"
                .into()
        }
        false => format!(
            "no formula was found: of {} candidates {}; search longer, or ask for less",
            counts.considered,
            told.join("; ")
        ),
    }
}
