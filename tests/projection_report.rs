//! The page of a projection: what it says of bounds and inputs, and its pictures, pixel by pixel.

#![cfg(feature = "report")]

use lgp::dataset::{Column, Dataset, Origin, Split};
use lgp::deadline::Deadline;
use lgp::project::{Projection, Settings, Surfaces};
use lgp::report::{ProjectionReport, findings};
use std::path::Path;

/// Points along each of some inputs, the last of which is `x`.
type Axes<'a> = [(&'a str, Vec<f32>)];

fn evenly(count: u32, from: f32, to: f32) -> Vec<f32> {
    (0..count).map(|i| from + (to - from) * i as f32 / (count - 1) as f32).collect()
}

/// The inputs `a` and `b`, and `x`.
fn plane() -> [(&'static str, Vec<f32>); 3] {
    [("a", evenly(9, 0.0, 1.0)), ("b", evenly(7, 0.0, 1.0)), ("x", evenly(17, 0.0, 1.0))]
}

fn rows(axes: &Axes, f: impl Fn(&[f64]) -> f64) -> Dataset {
    let along: Vec<Vec<f32>> = axes.iter().map(|(_, values)| values.clone()).collect();
    of_split(axes, Split::on_grid(&along, |point| [f(point)]))
}

fn of_split(axes: &Axes, split: Split) -> Dataset {
    let columns = axes.iter().map(|(name, _)| Column::new(name, [-9.0, 9.0])).collect();
    let origin = Origin::Formula { text: "rows".into() };
    Dataset::of_splits("rows", origin, columns, [("y", "1")], [split.clone(), split]).unwrap()
}

fn project(
    data: &Dataset,
    text: &str,
    over: &[&str],
    settings: Settings,
) -> (Projection, Surfaces) {
    let over: Vec<String> = over.iter().map(|&name| name.to_owned()).collect();
    let projection = Projection::new(data, text, &over, settings).unwrap();
    let mut state = projection.begin();
    assert!(projection.advance(&mut state, &Deadline::NEVER, &mut |_, _| {}));
    let surfaces = projection.surfaces(&state).unwrap();
    (projection, surfaces)
}

const LOBE: &str = "y = $p*exp2(-$q*x^2)";

fn said(f: impl Fn(&[f64]) -> f64, settings: Settings) -> Vec<String> {
    let (projection, surfaces) = project(&rows(&plane(), f), LOBE, &["a", "b"], settings);
    findings(&projection, &surfaces, &projection.dependences(&surfaces))
}

fn has(said: &[String], words: &str) -> bool {
    said.iter().any(|sentence| sentence.contains(words))
}

#[test]
fn the_page_says_what_a_parameter_hardly_depends_on() {
    let apart = |at: &[f64]| (0.2 + at[0]) * (-(1.0 + 4.0 * at[1]) * at[2].powi(2)).exp2();
    let found = said(apart, Settings::default());
    assert!(has(&found, "p hardly depends on b") && has(&found, "q hardly depends on a"));
    assert_eq!(found.len(), 2, "{found:?}");
    let together =
        |at: &[f64]| (0.2 + at[0] + at[1]) * (-(1.0 + 4.0 * at[0] * at[1]) * at[2].powi(2)).exp2();
    assert_eq!(said(together, Settings::default()), Vec::<String>::new());
    let constant = |at: &[f64]| (0.2 + at[0] + at[1]) * (-3.0 * at[2].powi(2)).exp2();
    let found = said(constant, Settings::default());
    assert!(has(&found, "q may as well be a constant") && found.len() == 1, "{found:?}");
}

#[test]
fn the_page_says_where_a_parameter_lies_on_its_bounds() {
    let lobe = |at: &[f64]| (0.2 + at[0]) * (-(1.0 + 4.0 * at[1]) * at[2].powi(2)).exp2();
    let bounds =
        |low, high| Settings { bounds: vec![("p".to_owned(), [low, high])], ..Settings::default() };
    let found = said(lobe, bounds(0.0, 0.8));
    let upper = "p lies on its upper bound 0.8 in 28 of 63 groups: a 0.625…1, b 0…1";
    assert!(has(&found, upper), "{found:?}");
    assert!(!has(&found, "lower"), "{found:?}");
    let found = said(lobe, bounds(0.3, 9.0));
    assert!(
        has(&found, "p lies on its lower bound 0.3 in 7 of 63 groups: a 0, b 0…1"),
        "{found:?}"
    );
    assert!(!has(&found, "upper"), "{found:?}");
    assert!(!has(&said(lobe, bounds(0.0, 9.0)), "bound"));
}

struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Picture {
    fn read(path: &Path) -> Picture {
        let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        Picture { width: info.width as usize, height: info.height as usize, pixels }
    }

    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * self.width + x);
        [self.pixels[at], self.pixels[at + 1], self.pixels[at + 2]]
    }

    /// The pixel at a place of a panel, from 0 to 1 rightwards and upwards.
    fn of_panel(&self, [column, row]: [usize; 2], [x, y]: [f32; 2]) -> [u8; 3] {
        let left = 24 + column * 226;
        let top = 84 + 44 + row * 328;
        self.at(left + (199.0 * x) as usize, top + (199.0 * (1.0 - y)) as usize)
    }

    /// How many pixels of a panel have a colour.
    fn count(&self, [column, row]: [usize; 2], colour: [u8; 3]) -> usize {
        let (left, top) = (24 + column * 226, 84 + 44 + row * 328);
        let all = (0..200).flat_map(|y| (0..200).map(move |x| (x, y)));
        all.filter(|(x, y)| self.at(left + x, top + y) == colour).count()
    }
}

const DARK: [u8; 3] = [0x44, 0x01, 0x54];
const YELLOW: [u8; 3] = [0xfd, 0xe7, 0x25];
const RED: [u8; 3] = [213, 40, 40];
const GREY: [u8; 3] = [128; 3];

/// The pictures of the parameters and of the errors, and the page.
fn report(data: &Dataset, text: &str, over: &[&str]) -> (Picture, Picture, String) {
    let (projection, surfaces) = project(data, text, over, Settings::default());
    let dependences = projection.dependences(&surfaces);
    let report = ProjectionReport {
        projection: &projection,
        surfaces: &surfaces,
        dependences: &dependences,
        places: vec![surfaces.nearest(&[]).unwrap(), surfaces.worst()],
        commands: vec!["lgp search 'p.bin'".to_owned()],
    };
    let folder = tempfile::TempDir::new().unwrap();
    report.write(folder.path()).unwrap();
    let [parameters, errors] =
        ["parameters.png", "errors.png"].map(|name| Picture::read(&folder.path().join(name)));
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    (parameters, errors, page)
}

#[test]
fn maps_show_parameters_over_two_inputs_and_errors_over_two_parameters() {
    let data = rows(&plane(), |at| (0.2 + at[0]) * (-(1.0 + 4.0 * at[1]) * at[2].powi(2)).exp2());
    let (parameters, errors, page) = report(&data, LOBE, &["a", "b"]);
    assert_eq!((parameters.width, parameters.height), (700, 412));
    // p rises along a, q along b.
    for along in [0.0, 0.5, 1.0] {
        assert_eq!(parameters.of_panel([0, 0], [0.0, along]), DARK);
        assert_eq!(parameters.of_panel([0, 0], [1.0, along]), YELLOW);
        assert_eq!(parameters.of_panel([1, 0], [along, 0.0]), DARK);
        assert_eq!(parameters.of_panel([1, 0], [along, 1.0]), YELLOW);
    }
    assert_eq!((errors.width, errors.height), (700, 412));
    for panel in [[0, 0], [1, 0]] {
        let [cross, dark] = [RED, DARK].map(|colour| errors.count(panel, colour));
        assert!(cross >= 20 && dark < 4000, "{cross} {dark}");
        let white = errors.count(panel, [255; 3]);
        assert_eq!(white, 0, "no part of a map is blank");
    }
    assert!(page.contains("p hardly depends on b") && page.contains("<th>a</th><th>b</th>"));
    assert_eq!(page.matches("data:image/png;base64,").count(), 2);
    assert!(page.contains("lgp search &#x27;p.bin&#x27;") && !page.contains("<script"));
}

#[test]
fn curves_show_parameters_over_one_input() {
    let axes = [("a", evenly(33, 0.0, 1.0)), ("x", evenly(9, 0.0, 1.0))];
    let data = rows(&axes, |at| (0.2 + at[0]) * at[1]);
    let (parameters, errors, page) = report(&data, "y = $p*x", &["a"]);
    assert_eq!((parameters.width, parameters.height), (700, 412));
    // A straight line through the panel, and nothing far from it.
    let ink = |x: f32, y: f32| {
        let [r, g, b] = parameters.of_panel([0, 0], [x, y]);
        b > r && g < 200
    };
    for along in [0.1, 0.5, 0.9] {
        let near = [-0.01, 0.0, 0.01].map(|away| ink(along, along + away));
        assert!(near.contains(&true), "{along}");
        assert!(!ink(along, 1.0 - along) || along == 0.5, "{along}");
    }
    assert!(errors.count([0, 0], RED) > 5);
    // With one input nothing is said of it apart from a constant.
    assert!(!page.contains("<th>a</th>") && page.contains("<th>as a constant</th>"));
}

#[test]
fn slices_show_three_inputs_and_holes_are_grey() {
    let axes = [
        ("a", evenly(5, 0.0, 1.0)),
        ("b", evenly(4, 0.0, 1.0)),
        ("c", evenly(3, 0.0, 1.0)),
        ("x", evenly(5, 0.0, 1.0)),
    ];
    let along: Vec<Vec<f32>> = axes.iter().map(|(_, values)| values.clone()).collect();
    let mut split = Split::on_grid(&along, |at| [(1.0 + at[0] + 4.0 * at[2]) * at[3]]);
    let is_hole = |row: usize| {
        split.columns[0][row] == 1.0 && split.columns[1][row] == 0.0 && split.columns[2][row] == 0.5
    };
    let kept: Vec<usize> = (0..split.rows()).filter(|&row| !is_hole(row)).collect();
    split.columns =
        split.columns.iter().map(|column| kept.iter().map(|&row| column[row]).collect()).collect();
    split.grid.clear();
    let (parameters, _, page) = report(&of_split(&axes, split), "y = $p*x", &["a", "b", "c"]);
    assert_eq!((parameters.width, parameters.height), (700, 84 + 2 * 328));
    // All slices of a parameter have one scale of colours.
    assert_eq!(parameters.of_panel([0, 0], [0.0, 0.5]), DARK);
    assert_eq!(parameters.of_panel([2, 0], [1.0, 0.5]), YELLOW);
    assert!(parameters.count([0, 0], YELLOW) == 0 && parameters.count([2, 0], DARK) == 0);
    assert_eq!(parameters.of_panel([1, 0], [1.0, 0.0]), GREY);
    assert_eq!(parameters.count([0, 0], GREY), 0);
    assert!(page.contains("1 of 60 places of the grid have no group"), "{page}");
}

#[test]
fn places_on_no_grid_are_dots() {
    let mut columns = vec![Vec::new(); 4];
    for group in 0..40u32 {
        let a = (0.618_034 * f64::from(group)).fract() as f32;
        let b = (0.754_878 * f64::from(group)).fract() as f32;
        for x in evenly(5, 0.0, 1.0) {
            let values = [a, b, x, (1.0 + a) * x];
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
    }
    let axes = ["a", "b", "x"].map(|name| (name, Vec::new()));
    let data = of_split(&axes, Split { columns, ..Split::default() });
    let (parameters, _, _) = report(&data, "y = $p*x", &["a", "b"]);
    assert_eq!((parameters.width, parameters.height), (700, 412));
    // The first group is at the origin and has the least value, dots lie on the paper.
    assert_eq!(parameters.of_panel([0, 0], [0.0, 0.0]), DARK);
    let paper = parameters.count([0, 0], [255; 3]);
    assert!((20_000..39_000).contains(&paper), "{paper}");
}
