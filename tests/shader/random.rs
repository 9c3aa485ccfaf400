//! Random functions, written down as programs and interpreted: the same values.

use crate::{options, read_with};
use lgp::eval::{Arithmetic, Double};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const FUNCTIONS: u64 = 400;
const POINTS: usize = 24;

/// Numbers are those of single precision, powers of two for the most part, so that sums of constants
/// are exact in programs, too.
const ACCURACY: f64 = 1e-5;

#[test]
fn random_functions_are_their_programs() {
    let (mut compared, mut programs) = (0, 0);
    for seed in 0..FUNCTIONS {
        let mut random = Random { rng: ChaCha8Rng::seed_from_u64(seed), variables: 0, depth: 0 };
        let text = random.function();
        let shader = read_with("random.wgsl", &text, &options("f", &[], &[], &[]));
        let shader = shader.unwrap_or_else(|e| panic!("{text}\n{e}"));
        // Literals have suffixes: of abstract ones, some constant expressions are naga's undoing.
        // More paths than are merged, more operations than are written down.
        let Ok(program) = shader.program() else { continue };
        programs += 1;
        for _ in 0..POINTS {
            let point = [0, 1].map(|_| f64::from(random.rng.random_range(-2.0f32..2.0)));
            let (found, expected) =
                (Double.evaluate(&program, &point)[0], shader.at(&point).unwrap()[0]);
            if !expected.is_finite() || expected.abs() > 1e6 {
                continue;
            }
            assert!(
                (found - expected).abs() <= ACCURACY * expected.abs().max(1.0),
                "seed {seed} at {point:?}: {found:e} of the program, {expected:e}\n{text}"
            );
            compared += 1;
        }
    }
    assert!(programs as u64 > FUNCTIONS * 3 / 4, "{programs}");
    assert!(compared > 4000, "{compared}");
}

struct Random {
    rng: ChaCha8Rng,
    variables: usize,
    depth: usize,
}

impl Random {
    fn one_of<'a>(&mut self, choices: &[&'a str]) -> &'a str {
        choices[self.rng.random_range(0..choices.len())]
    }

    fn function(&mut self) -> String {
        let helper = "fn helped(a: f32, p: ptr<function, f32>) -> f32 {
    if (a < *p) { *p = a * 0.5; return *p - a; }
    *p += 0.25;
    return a;
}\n";
        let body = self.block(4);
        let result = self.float(3);
        format!(
            "{helper}fn f(x: f32, y: f32) -> f32 {{\n    var v0 = x;\n    var v1 = y * 0.5;\n    \
             var v2 = vec3(x, y, 0.25);\n{body}    return {result} + v0 + v1 + dot(v2, v2);\n}}\n"
        )
    }

    fn variable(&mut self) -> &'static str {
        self.one_of(&["v0", "v1", "v2.x", "v2.y", "v2[2]"])
    }

    fn block(&mut self, statements: usize) -> String {
        (0..statements).map(|_| self.statement()).collect()
    }

    fn statement(&mut self) -> String {
        if self.depth > 2 {
            return self.assignment();
        }
        self.depth += 1;
        let statement = match self.rng.random_range(0..10) {
            0 | 1 => {
                let (condition, yes) = (self.condition(2), self.block(2));
                format!("if ({condition}) {{\n{yes}}}\n")
            }
            2 => {
                let (condition, yes, no) = (self.condition(2), self.block(1), self.block(2));
                format!("if ({condition}) {{\n{yes}}} else {{\n{no}}}\n")
            }
            3 => self.repeated(),
            4 => {
                let (condition, value) = (self.condition(1), self.float(2));
                format!("if ({condition}) {{ return {value}; }}\n")
            }
            5 => {
                let value = self.float(2);
                let (to, place) = (self.one_of(&["v1", "v2.x"]), self.one_of(&["v0", "v1"]));
                format!("{to} = helped({value}, &{place});\n")
            }
            6 => {
                let (which, a, b) =
                    (self.rng.random_range(0..3), self.assignment(), self.assignment());
                format!("switch {which} {{ case 0: {{ {a} }} case 1, default: {{ {b} }} }}\n")
            }
            _ => self.assignment(),
        };
        self.depth -= 1;
        statement
    }

    fn repeated(&mut self) -> String {
        let i = format!("i{}", self.variables);
        self.variables += 1;
        let count = self.rng.random_range(1..4);
        let mut body = self.block(1);
        match self.rng.random_range(0..4) {
            0 => body += &format!("if ({}) {{ break; }}\n", self.condition(1)),
            1 => body += &format!("if ({}) {{ continue; }}\n", self.condition(1)),
            2 => body += &format!("v0 += f32({i}) * 0.25;\n"),
            _ => {}
        }
        body += &self.assignment();
        format!("for (var {i} = 0; {i} < {count}; {i}++) {{\n{body}}}\n")
    }

    fn assignment(&mut self) -> String {
        let (variable, value) = (self.variable(), self.float(2));
        match self.rng.random_range(0..6) {
            0 => {
                let (a, b) = (self.float(1), self.float(1));
                format!("v2 = vec3({a}, {b}, v2.x).zxy;\n")
            }
            1 => format!("{variable} += {value};\n"),
            _ => format!("{variable} = {value};\n"),
        }
    }

    fn float(&mut self, depth: usize) -> String {
        if depth == 0 || self.rng.random_range(0..5) == 0 {
            return match self.rng.random_range(0..4) {
                0 => self.one_of(&["0.5f", "2.0f", "-0.25f", "0.0f", "1.0f", "1.5f"]).to_owned(),
                1 => self.variable().to_owned(),
                _ => self.one_of(&["x", "y"]).to_owned(),
            };
        }
        let (a, b) = (self.float(depth - 1), self.float(depth - 1));
        match self.rng.random_range(0..12) {
            0 | 1 => format!("({a} + {b})"),
            2 => format!("({a} - {b})"),
            3 | 4 => format!("({a} * {b})"),
            5 => format!("max({a}, {b})"),
            6 => format!("abs({a})"),
            7 => format!("sin({a})"),
            8 => format!("select({a}, {b}, {})", self.condition(depth - 1)),
            9 => format!("clamp({a}, -1.0f, 1.5f)"),
            10 => format!("({a} / (1.0f + {b} * {b}))"),
            _ => format!("smoothstep(-1.0f, 1.0f, {a})"),
        }
    }

    fn condition(&mut self, depth: usize) -> String {
        if depth > 0 && self.rng.random_range(0..3) == 0 {
            let (a, b) = (self.condition(depth - 1), self.condition(depth - 1));
            return match self.rng.random_range(0..4) {
                0 => format!("({a} && {b})"),
                1 => format!("({a} || {b})"),
                2 => format!("!({a})"),
                _ => format!("({a}) != ({b})"),
            };
        }
        let (a, b) = (self.float(1), self.float(1));
        format!("{a} {} {b}", self.one_of(&["<", ">", "<=", ">=", "==", "!="]))
    }
}
