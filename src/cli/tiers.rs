//! The tiers of a run's scene, and the formulas that each can afford.

use super::Failure;
use crate::run::Run;
use crate::scene::Tier;
use crate::search::{Front, FrontMember};
use crate::suggest::did_you_mean;
use crate::wording::{cycles_text, error_text};

fn of(run: &Run) -> &[(String, Tier)] {
    run.scene.as_ref().map_or(&[], |scene| &scene.tiers)
}

fn afforded(tier: Tier, front: &Front) -> Option<&FrontMember> {
    front.within(tier.max_cost, tier.max_error)
}

/// Returns a line for each tier.
pub fn table(run: &Run, front: &Front) -> String {
    let lines = of(run).iter().map(|(name, tier)| match afforded(*tier, front) {
        Some(member) => format!(
            "{name} ({}): {} cycles, error {}: {}\n",
            limits(*tier),
            cycles_text(member.cost),
            error_text(member.error().of(front.measure)),
            member.formula
        ),
        None => format!("{name} ({}): not met\n", limits(*tier)),
    });
    let text: String = lines.collect();
    if text.is_empty() { text } else { format!("\n{text}") }
}

fn limits(tier: Tier) -> String {
    let cost = tier.max_cost.map(|cost| format!("at most {} cycles", cycles_text(cost)));
    let error = tier.max_error.map(|error| format!("error at most {}", error_text(error)));
    cost.into_iter().chain(error).collect::<Vec<_>>().join(", ")
}

/// Fails if a tier is not met.
pub fn check(run: &Run, front: &Front) -> Result<(), Failure> {
    match of(run).iter().find(|(_, tier)| afforded(*tier, front).is_none()) {
        Some((name, tier)) => Err(unmet(name, *tier)),
        None => Ok(()),
    }
}

/// Returns the best formula that a tier can afford.
pub fn pick<'a>(run: &Run, front: &'a Front, name: &str) -> Result<&'a FrontMember, Failure> {
    let tiers = of(run);
    let Some((_, tier)) = tiers.iter().find(|(known, _)| known == name) else {
        let meant = did_you_mean(name, tiers.iter().map(|(known, _)| known.as_str()));
        let known: Vec<&str> = tiers.iter().map(|(known, _)| known.as_str()).collect();
        let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
        let message = format!("--tier {name}: the run's scene has no such tier{meant} ({known})");
        return Err(Failure::usage(message));
    };
    afforded(*tier, front).ok_or_else(|| unmet(name, *tier))
}

fn unmet(name: &str, tier: Tier) -> Failure {
    let limits = limits(tier);
    let message = format!(
        "tier {name}: no formula of the front is within its limits ({limits}); search longer, or allow more"
    );
    Failure::unmet(message)
}
