//! What is found can be overruled.

use crate::{names, read_text, refusal, sorted, strings};
use lgp::import::table::{Decimal, InputColumns, Options, Separator};

fn with(change: impl FnOnce(&mut Options)) -> Options {
    let mut options = Options::default();
    change(&mut options);
    options
}

#[test]
fn two_readings_are_told_apart_or_refused() {
    let none = Options::default();
    let columns = |text: &str, options: &Options| {
        let (data, _) = read_text(text, options).unwrap();
        let all = 0..data.inputs.len() + data.outputs.len();
        all.map(|column| data.search.columns[column].clone()).collect::<Vec<_>>()
    };
    assert_eq!(columns("1,5;2,5\n3,5;4,5\n", &none), [[1.5, 3.5], [2.5, 4.5]]);
    assert_eq!(columns("1,5\n3,5\n", &none), [[1.0, 3.0], [5.0, 5.0]]);
    assert_eq!(columns("1,5 2,5\n3,5 4,5\n", &none), [[1.5, 3.5], [2.5, 4.5]]);
    assert_eq!(columns("1, 5\n3, 5\n", &none), [[1.0, 3.0], [5.0, 5.0]]);
    assert_eq!(columns("1\t2,5\n3\t4,5\n", &none), [[1.0, 3.0], [2.5, 4.5]]);
    assert_eq!(columns("a;b\n1;2\n3;4\n", &none), [[1.0, 3.0], [2.0, 4.0]]);
    assert_eq!(columns("a;b\n0,5;1.234,5\n1;2\n", &none), [[0.5, 1.0], [1234.5, 2.0]]);
    for (text, part) in [
        ("a;b\n1,234;5,678\n2,345;6,789\n", "`1,234` may have decimals or grouped digits"),
        ("a;b\n0,5;1.234\n0,75;2.345\n", "`0,75` may have decimals or grouped digits"),
        ("a\tb\n0.5\t1,500\n0.75\t2,500\n", "`2,500` may have decimals or grouped digits"),
        ("x\n0,5\n0,25\n", "may be one number with a decimal comma"),
        ("a;b;c\n1;2 3;4\n5;6 7;8\n", "`6 7` holds several numbers"),
        ("x,y\n5\n1,2\n3,4\n", "line 2: a row of length 1 above a table of 2 columns"),
        ("1,2\na,b,c\n3,4,5\n6,7,8\n", "--skip 1"),
        ("a;b\n0,5;0.25\n0,75;1,5\n1;2\n", "line 2, column `b`: `0.25` is not a number"),
    ] {
        let said = refusal(text, &none);
        assert!(said.contains(part), "{text:?}: {said}");
    }
    let comma = with(|options| options.decimal = Some(Decimal::Comma));
    let point = with(|options| options.decimal = Some(Decimal::Point));
    let text = "a;b\n1,234;5,678\n2,345;6,789\n";
    assert_eq!(columns(text, &comma)[0], [1.234, 2.345]);
    assert_eq!(columns(text, &point)[0], [1234.0, 2345.0]);
    let semicolons = with(|options| options.separator = Some(Separator::Character(';')));
    assert!(refusal("1,5\n3,5\n", &semicolons).contains("at least one"), "one column");
}

#[test]
fn headers_can_be_skipped_named_or_denied() {
    let text = "about it\nred,2\nx,y\n1,2\n3,4\n";
    let skipped = with(|options| options.skip = Some(2));
    let (data, understood) = read_text(text, &skipped).unwrap();
    assert_eq!((names(&data.inputs), understood.rows_above), (vec!["x"], 0));
    let denied = with(|options| options.no_header = true);
    let (data, understood) = read_text("x,y\n1,2\n3,4\n", &denied).unwrap();
    assert_eq!((names(&data.inputs), names(&data.outputs)), (vec!["x0"], vec!["y"]));
    assert_eq!(understood.names_line, None);
    assert!(understood.sentences().join(" ").contains("1 row above the table (line 1)"));
    let named = with(|options| options.columns = Some(strings(&["T (K)", "y"])));
    let (data, _) = read_text("1,2\n3,4\n", &named).unwrap();
    assert_eq!((names(&data.inputs), &*data.inputs[0].unit), (vec!["t"], "K"));
    let (data, _) = read_text("a,b\n1,2\n3,4\n", &named).unwrap();
    assert_eq!(names(&data.inputs), ["t"]);
    let said = refusal("a,b,c\n1,2,3\n", &named);
    assert!(said.contains("gives 2 names, but there are 3 columns (a, b, c)"), "{said}");
    let counted = Options::of_inputs(InputColumns::Count(1));
    let (data, _) = read_text("1,2,3\n4,5,6\n", &counted).unwrap();
    assert_eq!((names(&data.inputs), names(&data.outputs)), (vec!["x0"], vec!["y0", "y1"]));
    // Rows with a mistake are no header.
    let said = refusal("x,y\n1,red\n2,3\n4,5\n", &Options::default());
    assert!(said.contains("line 2, column `y`: `red` is not a number"), "{said}");
}

#[test]
fn columns_get_the_roles_asked_for() {
    let text = "a,b,c,d,b_se\n1,2,3,4,5\n2,3,4,5,6\n";
    let roles = |options: &Options| {
        let (data, _) = read_text(text, options).unwrap();
        let errors = data.search.standard_errors.len();
        let [inputs, outputs] = [&data.inputs, &data.outputs].map(|c| names(c).join(" "));
        (inputs, outputs, data.search.weights.len(), errors)
    };
    let made = |inputs: &str, outputs: &str, weights, errors| {
        (inputs.to_owned(), outputs.to_owned(), weights, errors)
    };
    assert_eq!(roles(&Options::default()), made("a b c b_se", "d", 0, 0));
    let outputs = with(|options| options.outputs = Some(strings(&["b"])));
    assert_eq!(roles(&outputs), made("a c d", "b", 0, 1));
    let both = with(|options| {
        options.inputs = Some(InputColumns::Names(strings(&["d", "a"])));
        options.outputs = Some(strings(&["c"]));
    });
    assert_eq!(roles(&both), made("d a", "c", 0, 0));
    let weighted = with(|options| {
        options.weights = Some("c".into());
        options.drop = strings(&["a", "b_se"]);
    });
    assert_eq!(roles(&weighted), made("b", "d", 2, 0));
    for (options, part) in [
        (with(|o| o.drop = strings(&["e"])), "no column is called `e`"),
        (with(|o| (o.drop, o.outputs) = (strings(&["a"]), Some(strings(&["a"])))), "left out by"),
        (with(|o| o.weights = Some("x".into())), "no column is called `x`"),
        (with(|o| o.scales = vec![("x".into(), 3)]), "no column is called `x`"),
        (with(|o| (o.scales, o.drop) = (vec![("a".into(), 3)], strings(&["a"]))), "is not read"),
        (
            with(|o| {
                o.inputs = Some(InputColumns::Names(strings(&["a"])));
                o.outputs = Some(strings(&["a"]));
            }),
            "as an input and as an output",
        ),
    ] {
        let said = refusal(text, &options);
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn domains_overrule_the_range_of_values_and_hold_all_of_them() {
    let text = "T (K),y\n0.1,1\n0.5,2\n";
    let domain = |name: &str, ends| with(|o| o.domains = vec![(name.to_owned(), ends)]);
    for name in ["t", "T (K)"] {
        let (data, _) = read_text(text, &domain(name, [0.1, 1.0])).unwrap();
        assert_eq!(data.inputs[0].domain, [0.1, 1.0]);
    }
    for (options, part) in [
        (domain("t", [0.2, 1.0]), "line 2, column `t`: 0.1 lies outside the domain [0.2, 1]"),
        (domain("y", [0.0, 3.0]), "column `y` is an output"),
        (domain("u", [0.0, 3.0]), "no column is called `u`"),
        (domain("t", [0.0, 1e300]), "32-bit floats do not hold"),
    ] {
        let said = refusal(text, &options);
        assert!(said.contains(part), "{said}");
    }
    let seconds: String = (0..20).map(|i| format!("{},{i}\n", 1_700_000_000 + i)).collect();
    let shifted = domain("x0", [1.7e9, 1_700_000_100.0]);
    let (data, _) = read_text(&seconds, &shifted).unwrap();
    assert_eq!(names(&data.inputs), ["x0_minus_1700000000"]);
    assert_eq!(data.inputs[0].domain, [0.0, 100.0]);
}

#[test]
fn what_floats_lose_is_said() {
    let ids: String =
        (0..40).map(|i| format!("{},{i}\n", 1 + i * 123_456_789_u64 % 999_999_937)).collect();
    let spread: String =
        (0..40).map(|i| format!("{},{i}\n", (i % 2) * 900_000_000 + 1 + i / 2)).collect();
    assert!(read_text(&ids, &Options::default()).is_ok(), "floats tell them apart");
    let said = refusal(&spread, &Options::default());
    assert!(said.contains("fall together in 32-bit floats"), "{said}");
    let dropped = with(|options| options.drop = strings(&["x0"]));
    assert!(refusal(&spread, &dropped).contains("no input"), "one column is left");
    let tails = "x,y\n0,1\n1,1e-50\n2,1e-60\n3,0\n";
    let (data, understood) = read_text(tails, &Options::default()).unwrap();
    assert_eq!(sorted(&data, 1), [1.0, 0.0, 0.0, 0.0]);
    let said = understood.sentences().join("\n");
    assert!(said.contains("2 values of `y` are below 1e-45, and stored as 0"), "{said}");
}
