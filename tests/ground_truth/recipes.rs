//! Recipes as text, and what is said of those that cannot be used.

use lgp::targets::{Error, Recipe, generate};
use std::path::Path;

#[test]
fn recipes_read_back_and_explain_themselves() {
    let recipe = Recipe::parse(
        "// the paper's\n(target: \"dfg\", masking: \"separable\", alpha: \"roughness^4\", points: 32)",
    )
    .unwrap();
    assert_eq!(recipe.get("masking"), Some("separable"));
    assert_eq!(recipe.get("points"), Some("32"));
    assert_eq!(Recipe::parse(&recipe.to_string()).unwrap(), recipe);
    let defaults = Recipe::parse("(target: \"dfg\")").unwrap();
    assert_eq!(defaults, Recipe::new("dfg").unwrap());

    let mut recipe = defaults;
    recipe.set("masking", "separable").unwrap();
    let refusals = [
        (recipe.set("masking", "seperable"), "did you mean `separable`?"),
        (recipe.set("masking", "none"), "write `correlated` or `separable` or `schlick`"),
        (recipe.set("point", "3"), "did you mean `points`?"),
        (recipe.set("points", "1"), "a whole number from 2 to 1024"),
        (recipe.set("points", "many"), "a whole number from 2 to 1024"),
        (recipe.set("sampling", "random"), "write `regular` or `jittered` or `low_discrepancy`"),
        (recipe.set("sampling_seed", "-1"), "a whole number from 0 to 4294967295"),
    ];
    for (refusal, expected) in refusals {
        let error = refusal.unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    assert_eq!(recipe.get("masking"), Some("separable"));
}

#[test]
fn a_recipe_claims_more_of_the_outputs() {
    let text = "(target: \"beckmann_g1\", points: 4, claims: [\"top: g1 <= 1\", \"a: g1 >= 0\"])";
    let recipe = Recipe::parse(text).unwrap();
    assert_eq!(recipe.to_string(), text);
    assert_ne!(recipe, Recipe::parse("(target: \"beckmann_g1\", points: 4)").unwrap());
    let made = generate(&recipe, &|_, _| {}).unwrap();
    assert_eq!(made.claims, ["top: g1 <= 1", "a: g1 >= 0"]);
    assert_eq!(made.origin.source(), text);
    let wrong = Recipe::parse(&text.replace("top: g1", "top: g2")).unwrap();
    let error = generate(&wrong, &|_, _| {}).unwrap_err().to_string();
    assert!(error.contains("column 6") && error.contains("did you mean `g1`?"), "{error}");
}

#[test]
fn unusable_recipes_are_refused() {
    let cases = [
        ("", "line 1"),
        ("(target: \"dfg\",\n masking: )", "line 2"),
        ("12", "not a list of fields"),
        ("(points: 3)", "names no target; begin it with"),
        ("(target: 3)", "names no target"),
        ("(target: \"dgf\")", "did you mean `dfg`?"),
        ("(target: \"dfg\", points: 2.5)", "`2.5` is not a value of parameter `points`"),
        ("(target: \"dfg\", points: [2])", "is not a value of parameter `points`"),
        ("(target: \"dfg\", colour: 1)", "its parameters are masking, alpha, points"),
    ];
    for (text, expected) in cases {
        let error = Recipe::parse(text).unwrap_err().to_string();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    let missing = Recipe::load(Path::new("no_such_recipe.ron")).unwrap_err();
    assert!(matches!(missing, Error::Read { .. }), "{missing}");
}
