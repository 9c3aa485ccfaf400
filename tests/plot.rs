//! Plots of fronts: the same bytes for the same front, whatever is in it.

#![cfg(feature = "report")]

use lgp::report::plot::{
    FrontPlot, Line, LinePlot, PlotError, Theme, lines_png, lines_svg, png, svg,
};

type Incumbent = (String, f64, f64);

const FRONT: [(f64, f64); 8] = [
    (0.0, 0.16),
    (2.0, 0.115),
    (6.0, 0.043),
    (10.0, 0.027),
    (15.0, 0.0167),
    (22.0, 0.0121),
    (28.0, 0.008),
    (35.0, 0.0062),
];

fn incumbents() -> Vec<Incumbent> {
    let published = [
        ("lazarov_2013", 13.0, 0.105),
        ("karis_2014", 14.0, 0.092),
        ("pesce_iwanicki_2015", 13.0, 0.09),
        ("ue5_ggx_energy", 49.0, 0.01),
        ("materialx_rational", 49.0, 0.0096),
    ];
    published.map(|(name, cycles, error)| (name.to_owned(), cycles, error)).to_vec()
}

fn plot<'a>(front: &'a [(f64, f64)], incumbents: &'a [Incumbent]) -> FrontPlot<'a> {
    FrontPlot {
        title: "dfg: scale, bias",
        subtitle: "n_dot_v, roughness in [0, 1] · 60 s, 2 threads, seed 1",
        x_label: "GPU cycles (gcn)",
        y_label: "RMSE on the search grid",
        front,
        incumbents,
        theme: Theme::Light,
    }
}

/// Whether each element is closed by its own end, and nothing else needs escaping.
fn is_well_formed(document: &str) -> bool {
    let mut open = Vec::new();
    for piece in document.split('<').skip(1) {
        let Some((tag, text)) = piece.split_once('>') else { return false };
        let entities = ["&lt;", "&gt;", "&amp;", "&quot;", "&apos;"];
        let escaped = |(at, _): (usize, &str)| entities.iter().any(|e| piece[at..].starts_with(e));
        if !piece.match_indices('&').all(escaped) || text.contains(|c| c == '>' || c < '\n') {
            return false;
        }
        match tag.strip_prefix('/') {
            Some(name) if open.pop() != Some(name) => return false,
            Some(_) => {}
            None if tag.ends_with('/') => {}
            None => open.push(tag.split(' ').next().unwrap_or(tag)),
        }
    }
    open.is_empty()
}

/// Draws in both themes and formats.
fn drawn(plot: &FrontPlot) -> String {
    for theme in [Theme::Light, Theme::Dark] {
        let plot = FrontPlot { theme, ..*plot };
        assert!(png(&plot, 400).unwrap().starts_with(b"\x89PNG"));
        assert!(is_well_formed(&svg(&plot).unwrap()));
    }
    svg(plot).unwrap()
}

#[test]
fn the_same_plot_is_the_same_bytes() {
    let incumbents = incumbents();
    let plot = plot(&FRONT, &incumbents);
    assert_eq!(svg(&plot).unwrap(), svg(&plot).unwrap());
    assert_eq!(png(&plot, 800).unwrap(), png(&plot, 800).unwrap());
    let dark = FrontPlot { theme: Theme::Dark, ..plot };
    assert_ne!(svg(&plot).unwrap(), svg(&dark).unwrap());
}

#[test]
fn every_incumbent_is_named() {
    let incumbents = incumbents();
    let document = drawn(&plot(&FRONT, &incumbents));
    for (name, _, _) in &incumbents {
        assert!(document.contains(name.as_str()), "{name}");
    }
    assert!(document.contains("width=\"800\" height=\"480\""));
    assert!(document.contains("published formulas"));
}

#[test]
fn a_front_alone_has_no_key() {
    assert!(!drawn(&plot(&FRONT, &[])).contains("published formulas"));
}

#[test]
fn nothing_is_said_to_be_nothing() {
    assert!(drawn(&plot(&[], &[])).contains("no formulas"));
    assert!(!drawn(&plot(&[], &incumbents())).contains("no formulas"));
}

#[test]
fn extremes_are_drawn() {
    let ends = [0.0, -1.0, 1e-310, 1.0, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for end in ends {
        drawn(&plot(&[(end, 0.1)], &[]));
        drawn(&plot(&[(1.0, end)], &[]));
        drawn(&plot(&[(1.0, 0.1), (3.0, end)], &[("far".into(), end, end)]));
    }
}

#[test]
fn incumbents_that_are_not_finite_are_named_below() {
    let incumbents = [("broken".to_owned(), 4.0, f64::NAN)];
    assert!(drawn(&plot(&FRONT, &incumbents)).contains("not finite: broken"));
}

#[test]
fn names_of_any_length_and_content_are_drawn() {
    let long = "a very long name ".repeat(40);
    let names = ["", "<svg>&\"'\u{0}\u{ffff}\n", "α→β² √x ≤ ½", "漢字", long.as_str()];
    let incumbents: Vec<Incumbent> =
        names.iter().map(|name| ((*name).to_owned(), 20.0, 0.05)).collect();
    let wordy = FrontPlot {
        title: &long,
        subtitle: "",
        x_label: &long,
        y_label: &long,
        ..plot(&FRONT, &incumbents)
    };
    assert!(drawn(&wordy).contains('…'));
}

#[test]
fn widths_out_of_range_are_refused() {
    for width in [0, 319, 4097, u32::MAX] {
        let refused = png(&plot(&FRONT, &[]), width);
        assert!(matches!(refused, Err(PlotError::Width { .. })), "{width}");
    }
}

#[test]
fn lines_are_named_and_extremes_are_drawn() {
    let falling = |scale: f64| (1..30).map(|i| (f64::from(i), scale / f64::from(i))).collect();
    let line = |name: &str, points| Line { name: name.into(), points, bounds: vec![falling(0.7)] };
    let mut lines = vec![line("8 cycles", falling(1.0)), line("16 cycles", falling(0.5))];
    let ends = [0.0, -1.0, 1e-310, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    lines.extend(ends.map(|end| line("far", vec![(end, 0.1), (1.0, end)])));
    let plots = [&lines[..], &[]].map(|lines| LinePlot {
        title: "dfg",
        subtitle: "",
        x_label: "seconds",
        y_label: "RMSE",
        lines,
        theme: Theme::Dark,
    });
    for plot in &plots {
        assert!(is_well_formed(&lines_svg(plot).unwrap()));
        assert!(lines_png(plot, 400).unwrap().starts_with(b"\x89PNG"));
    }
    let document = lines_svg(&plots[0]).unwrap();
    assert!(document.contains("8 cycles") && document.contains("16 cycles"));
}
