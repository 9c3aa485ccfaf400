//! Templates: what they mean, what they refuse, and what is found by them.

use lgp::dataset::{Dataset, axis};
use lgp::deadline::Deadline;
use lgp::program::{Names, Program, Template, parse, print};
use lgp::search::{CostOf, Front, Goal, Method, Problem, Requirement, Search};

fn names() -> Names {
    Names::new(["x", "r", "s"], ["y"])
}

fn template(text: &str) -> Template {
    Template::parse(text, &names()).unwrap()
}

/// The formula that a guess makes of a template.
fn filled(text: &str, guess: &str) -> String {
    let template = template(text);
    let child = template.guess(guess).unwrap();
    let formula = Program::verify(template.outer().append(&child)).unwrap();
    print(&formula, &names())
}

fn refused(text: &str) -> String {
    Template::parse(text, &names()).unwrap_err().message
}

#[test]
fn holes_are_filled_in_wherever_they_are_called() {
    for (text, guess, formula) in [
        ("y = f(x)", "f(x) = x + 1", "y = x + 1"),
        ("y = f(x)*f(r)", "f(t) = t + 1", "y = (x + 1)*(r + 1)"),
        ("y = f(x) + f(x)", "f(x) = 2*x", "t0 = 2*x; y = t0 + t0"),
        ("y = $a*x", "$a = 3", "y = 3*x"),
        ("y = $a*x + $a", "$a = 3", "y = 3*x + 3"),
        ("D(t, a) = t/a; y = D(f(r), x)", "f(r) = sqrt(r)", "y = sqrt(r)/x"),
        (
            "y = D(x, r); D(t, a) = (q = t*t; q + a + f(q))",
            "f(q) = 3*q",
            "t0 = x^2; y = t0 + r + 3*t0",
        ),
        ("y = g(f(x)) + f(r)", "f(x) = x + 1; g(x) = x*x", "t0 = x + 1; y = t0^2 + (r + 1)"),
        ("y = g(f(x) + r, s)", "f(x) = x + 1; g(u, s) = u/s", "y = (x + 1 + r)/s"),
        (
            "(u, v) = $M(x, r); y = u/v",
            "$M11 = 2; $M12 = 3; $M21 = 4; $M22 = 5",
            "y = (2*x + 3*r)/(4*x + 5*r)",
        ),
        ("(u, v) = f(x, r); y = u - v", "f(x, r) = (x*r, x + r)", "y = x*r - (x + r)"),
        (
            "R(a, b) = (b, a); (u, v) = R(f($M(x, r))); y = u/v",
            "f(x) = exp2(x); $M21 = 2",
            "y = exp2(2*x + 1*r)/exp2(1*x + 0*r)",
        ),
        ("v = (x, r); (u, w) = max(v, s); y = u*w + $a", "", "y = max(x, s)*max(r, s) + 1"),
    ] {
        assert_eq!(filled(text, guess), formula, "{text}");
    }
}

#[test]
fn what_fills_the_holes_is_written_as_a_guess_reads_it() {
    for (text, guess) in [
        ("y = f(x, r)*g(r)", "f(x, r) = (t0 = r^2; t0*x + t0); g(r) = 1/r; "),
        ("(u, v) = f(x, r); y = u - v", "f(x, r) = (t0 = x*r; f1 = t0 + 1; f2 = t0*f1; (f1, f2))"),
        ("y = f(x)*f(2*r) + $a*x^2", "f(x) = exp2(-0.25*x); $a = 0.1"),
        ("y = f(x)", "f(x) = x"),
    ] {
        let template = template(text);
        let child = template.guess(guess).unwrap();
        let written = template.written(&Program::verify(child.clone()).unwrap());
        let again = template.guess(&written.join("; ")).unwrap();
        let formula =
            |child| print(&Program::verify(template.outer().append(child)).unwrap(), &names());
        assert_eq!(formula(&again), formula(&child), "{written:?}");
        assert_eq!(written.len(), template.holes().len());
    }
}

#[test]
fn holes_over_the_same_arguments_share_a_draft_and_others_do_not_read_theirs() {
    let shared = template("y = f(x, r)*g(r)");
    assert_eq!(shared.outer().shape().inputs, 2);
    let apart = template("y = f(x)*g(r) + f(s)");
    assert_eq!(apart.outer().shape().inputs, 2, "one for f, one for g");
    let nested = template("y = g(f(x), r)");
    assert_eq!(nested.outer().shape().inputs, 3);
    let mut child = shared.guess("f(x, r) = r^2; g(r) = r").unwrap();
    assert_eq!(shared.outer().shape().violation(&child), None);
    child.outputs[1] = lgp::program::Arg::Input(0);
    assert_eq!(shared.outer().shape().violation(&child), Some(1), "g does not read x");
}

#[test]
fn a_hole_has_as_many_values_as_what_an_operation_makes_of_it() {
    let template = template(
        "(u, v) = sqrt(max(f(x, r), 0)); (p, q, t) = saturate($M(x, r)); y = u*v + p + q + t",
    );
    assert_eq!(template.hole("f").unwrap().outputs().len(), 2);
    assert!(template.hole("M32").is_some(), "three rows of two");
    let mut deep = "(u, v) = ".to_owned() + &"sqrt(".repeat(5000) + "f(x)" + &")".repeat(5000);
    deep += "; y = u*v";
    assert!(refused(&deep).contains("nested more than"), "and no stack overflows");
}

#[test]
fn what_is_no_template_is_refused_with_the_reason() {
    for (text, reason) in [
        ("y = f(x) + q", "unknown name `q`"),
        ("y = f(x) + f(x, r)", "`f` is called with 2 arguments here, but with 1 before"),
        ("(u, v) = f(x, r); y = u*v*f(r, x)", "`f` has 1 value here, but 2 before"),
        ("y = f(f(x))", "`f` is called in an argument of itself"),
        ("y = f(g(f(x)))", "`f` is called in an argument of itself"),
        ("D(t) = D(t)*t; y = D(x) + $a", "`D` is defined by itself"),
        ("D(t) = E(t); E(t) = D(t); y = D(x) + $a", "`D` is defined by itself"),
        ("D(t) = t; y = $a*x", "`D` is defined, but never called"),
        ("D(t, t) = t; y = D(x, r)", "two parameters are called `t`"),
        ("D(t) = t; D(u) = u; y = D(x)", "`D` is defined twice"),
        ("sin(t) = t; y = f(x)", "`sin` is an operation"),
        ("y = x", "nothing is to be found"),
        ("t = $a*x; y = f(x)", "nothing reads it"),
        ("t = $a*x; y = f(x) + 0*g(r)", "nothing reads it"),
        ("y = f()", "write `$f` for a constant"),
        ("y = $a(x)", "takes 2 to 9 values"),
        ("y = (x, r)*$a", "output `y` is one value"),
        ("y = f((x, r) + (x, r, s))", "do not go together"),
        ("(u, v) = (x, r, s); y = f(u*v)", "2 names, but the value has 3 components"),
        ("(y, y) = f(x, r)", "`y` is assigned twice"),
        ("(x, y) = f(x, r)", "`x` is an input"),
        ("D(t) = t*; y = D(f(x))", "ends where a value is expected"),
        ("y = add(f(x), 1)", "has no function form"),
        ("u = f(x)", "output `y` is never assigned"),
    ] {
        let message = refused(text);
        assert!(message.contains(reason), "{text}: {message}");
    }
    let deep: String =
        (0..40).map(|i| format!("D{}(t) = D{i}(t + {i}.5) + D{i}(t - {i}.5);", i + 1)).collect();
    let message = refused(&format!("D0(t) = t; {deep} y = f(D40(x))"));
    assert!(message.contains("calls of functions") || message.contains("too many"), "{message}");
}

#[test]
fn guesses_are_of_holes() {
    let template = template("y = f(x)*$a + g(r, s)");
    for (guess, reason) in [
        ("h(x) = x", "no hole `h`"),
        ("f(x, r) = x", "has 2 parameters here"),
        ("f(x) = r", "unknown name `r`"),
        ("f(x) = $a*x", "give it a value"),
        ("$b = 1", "no hole `b`"),
        ("$a = x", "expected a number"),
        ("y = x", "a guess for a template is"),
        ("f(x) = (x, x)", "has 2 values here"),
    ] {
        let message = template.guess(guess).unwrap_err().message;
        assert!(message.contains(reason), "{guess}: {message}");
    }
    assert!(template.guess("$a = -0.5; g(a, b) = a - b").is_ok());
}

#[test]
fn formulas_define_functions_and_vectors_too() {
    let formula = |text| print(&parse(text, &names()).unwrap(), &names());
    assert_eq!(formula("sq(t) = t*t; y = sq(x + r)"), "t0 = x + r; y = t0^2");
    assert_eq!(formula("(a, b) = (x, r)*2; y = a - b"), "y = 2*x - 2*r");
    let error = parse("y = foo(x)", &names()).unwrap_err();
    assert!(error.message.contains("unknown operation `foo`"), "{error}");
}

fn henyey_greenstein() -> Dataset {
    let g = |r: f64| 0.85 * (-2.0 * r).exp2() + 0.1 * (3.0 * r).sin();
    let phase =
        |[c, r]: [f64; 2]| [(1.0 - g(r).powi(2)) / (1.0 + g(r).powi(2) - 2.0 * g(r) * c).powf(1.5)];
    Dataset::sampled([axis("c", -1.0..=0.9), axis("r", 0.0..=1.0)], ["y"], phase).unwrap()
}

const PHASE: &str = "HG(g, c) = (1 - g^2)/pow(1 + g^2 - 2*g*c, 1.5); y = HG(f(r), c)";

fn searched(data: Dataset, goal: Goal, generations: usize) -> Search {
    let problem = Problem::of(data).goal(goal).build().unwrap();
    let method = Method { islands: 4, candidates: 150, ..Method::default() };
    let mut search = Search::new(problem, method).unwrap();
    (0..generations).for_each(|_| search.advance());
    search
}

#[test]
fn a_function_within_a_known_one_is_found() {
    let goal = Goal { template: Some(PHASE.into()), ..Goal::default() };
    let search = searched(henyey_greenstein(), goal, 12);
    let front = Front::of(&search);
    let best = front.members.last().unwrap();
    assert!(best.validation_error().rmse < 2e-3, "{:?}", best.validation_error());
    let template = search.problem().template().unwrap();
    for member in &front.members {
        assert_eq!(member.holes.len(), 1);
        assert!(member.holes[0].starts_with("f(r) = "), "{:?}", member.holes);
        // What is shown of the hole makes the whole that is shown.
        let child = template.guess(&member.holes[0]).unwrap();
        let whole = Program::verify(template.outer().append(&child)).unwrap();
        for point in [[-0.5, 0.1], [0.3, 0.5], [0.85, 0.9]] {
            let (shown, made) = (member.program.evaluate(&point)[0], whole.evaluate(&point)[0]);
            assert!((shown - made).abs() <= 1e-4 * shown.abs(), "{shown} {made}");
        }
    }
}

#[test]
fn the_holes_alone_can_be_costed() {
    let whole = Goal { template: Some(PHASE.into()), ..Goal::default() };
    let holes = Goal { cost_of: CostOf::Holes, max_cost: 8.0, ..whole.clone() };
    let front = Front::of(&searched(henyey_greenstein(), holes, 6));
    assert!(front.members.iter().all(|member| member.cost <= 8.0));
    let profile = lgp::cost::Profile::find("gcn").unwrap();
    assert!(front.members.iter().any(|one| profile.cost(&one.program).cycles > one.cost + 10.0));
    let front = Front::of(&searched(henyey_greenstein(), whole, 2));
    for one in &front.members {
        assert_eq!(one.cost, profile.cost(&one.program).cycles);
    }
}

#[test]
fn a_hole_keeps_its_range() {
    let template = Template::parse(PHASE, &henyey_greenstein().names()).unwrap();
    let names = henyey_greenstein().names();
    let read = |text: &str| Requirement::parse_of(text, &names, template.holes());
    assert_eq!(read("f.range=0..0.5").unwrap().text(&names), "f.range=0..0.5");
    assert!(read("f.rising=r").unwrap_err().contains("only a range"));
    assert!(read("h.range=0..1").unwrap_err().contains("no output `h`"));
    let requirements = vec![read("f.range=0..0.5").unwrap()];
    let goal = Goal { template: Some(PHASE.into()), requirements, ..Goal::default() };
    let search = searched(henyey_greenstein(), goal, 5);
    let front = Front::of(&search);
    assert!(!front.members.is_empty());
    for member in &front.members {
        let child = template.guess(&member.holes[0]).unwrap();
        let values = Program::verify(template.outer().values_of(0, &child)).unwrap();
        for i in 0..=20 {
            let value = values.evaluate(&[0.0, i as f32 / 20.0])[0];
            assert!((0.0..=0.5).contains(&value), "{value}: {:?}", member.holes);
        }
    }
}

#[test]
fn goals_that_contradict_a_template_are_refused() {
    let refused = |goal: Goal| Problem::of(henyey_greenstein()).goal(goal).build().unwrap_err();
    let template = Some(PHASE.to_owned());
    let holes = Goal { cost_of: CostOf::Holes, ..Goal::default() };
    assert!(refused(holes).to_string().contains("needs a `template`"));
    let transforms = vec![Some("rcp".parse().unwrap())];
    let both = Goal { template: template.clone(), transforms, ..Goal::default() };
    assert!(refused(both).to_string().contains("do not go with"));
    let unknown = Goal { template: Some("y = f(q)".into()), ..Goal::default() };
    assert!(refused(unknown).to_string().contains("unknown name `q`"));
    let requirements = vec![Requirement::HoleRange { hole: "g".into(), low: 0.0, high: 1.0 }];
    let none = Goal { template, requirements, ..Goal::default() };
    assert!(refused(none).to_string().contains("no hole"));
}

#[test]
fn constants_alone_can_be_searched() {
    let goal = Goal { template: Some("y = $a*c + $b*r".into()), ..Goal::default() };
    let data = Dataset::sampled([axis("c", 0.0..=1.0), axis("r", 0.0..=1.0)], ["y"], |[c, r]| {
        [0.25 * c - 1.5 * r]
    });
    let front = Front::of(&searched(data.unwrap(), goal, 2));
    let best = front.members.last().unwrap();
    assert_eq!(best.holes, ["$a = 0.25", "$b = -1.5"]);
}

/// The values of a curve within matrices are fitted before its formula is searched for.
#[test]
fn a_curve_between_matrices_is_found_by_its_values() {
    let curve = |v: f64| 0.25 * (1.0 + 15.0 * v).log2();
    let axes = [axis("r", 0.0..=1.0), axis("g", 0.0..=1.0)];
    let data = Dataset::sampled(axes, ["x", "y"], |[r, g]| {
        let [a, b] = [0.7 * r + 0.3 * g, 0.2 * r + 0.8 * g].map(curve);
        [1.2 * a - 0.2 * b, 1.1 * b - 0.1 * a]
    });
    let template = Some("(x, y) = $N(f($M(r, g)))".to_owned());
    let goal = Goal { template, max_cost: 30.0, ..Goal::default() };
    let problem = Problem::of(data.unwrap()).goal(goal).build().unwrap();
    let mut search = Search::new(problem, Method { islands: 1, ..Method::default() }).unwrap();
    search.inject_curves_until(&Deadline::NEVER);
    assert!(search.best_error(30.0) < 1e-4, "{}", search.best_error(30.0));
}
