//! A table with a mistake in it is refused, or what is kept stands in the text: every line is
//! accounted for, and every number is found in its row, below its column's name.

use lgp::dataset::Dataset;
use lgp::import::table::{Decimal, Options, Role, Separator, Understood, parse};
use std::path::Path;

const MUTATIONS: usize = 1200;

/// Numbers that follow from a seed.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % most.max(1)
    }
}

/// What is typed, lost or garbled.
const PIECES: [&str; 24] = [
    ",", ";", "\t", "|", " ", "\"", "\"\"", "#", "//", "\n", "\r", "\r\n", "-", ".", "e", "0", "7",
    "NaN", "\u{b5}", "1,234", "1.234,5", "x", "\0", "---",
];

fn mutated(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let at = numbers.below(bytes.len());
    let mut lines: Vec<Vec<u8>> =
        bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    let [a, b] = [numbers.below(lines.len()), numbers.below(lines.len())];
    let piece = PIECES[numbers.below(PIECES.len())];
    match numbers.below(8) {
        0 => drop(bytes.drain(at..(at + 1 + numbers.below(3)).min(bytes.len()))),
        1 => drop(bytes.splice(at..at, piece.bytes())),
        2 => bytes[at] ^= 1 << numbers.below(8),
        3 => drop(bytes.splice(at..=at, piece.bytes())),
        4 => bytes.truncate(at),
        of_lines => {
            match of_lines {
                5 => lines.swap(a, b),
                6 => lines.insert(a, lines[b].clone()),
                _ => drop(lines.remove(a)),
            }
            return lines.concat();
        }
    }
    bytes
}

/// The text, where this test can read it: in UTF-8, no quoted cell on several lines.
fn text_of(bytes: &[u8]) -> Option<String> {
    let text = std::str::from_utf8(bytes).ok()?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let text = text.strip_suffix('\u{1a}').unwrap_or(text);
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    text.lines().all(|line| line.matches('"').count() % 2 == 0).then_some(text)
}

fn is_rule(line: &str) -> bool {
    line.contains("---") && line.chars().all(|c| "-=_+|: \t".contains(c))
}

fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    ["#", "//", "%", "!"].iter().any(|mark| line.starts_with(mark)) && !line.starts_with("#N/A")
}

/// The cells of a line, by rules written for this test.
fn cells(line: &str, separator: Separator) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut inside = false;
    let mut left = line.chars().peekable();
    while let Some(c) = left.next() {
        let last = cells.len() - 1;
        let parts = match separator {
            Separator::Character(separator) => c == separator,
            Separator::Blanks => c == ' ' || c == '\t',
        };
        match c {
            '"' if inside && left.next_if_eq(&'"').is_some() => cells[last].push('"'),
            '"' if inside || cells[last].trim().is_empty() => inside = !inside,
            _ if parts && !inside => cells.push(String::new()),
            c => cells[last].push(c),
        }
    }
    let cells = cells.into_iter().map(|cell| cell.trim().to_owned());
    match separator {
        Separator::Blanks => cells.filter(|cell| !cell.is_empty()).collect(),
        Separator::Character(_) => cells.collect(),
    }
}

fn number(cell: &str, decimal: Decimal) -> Option<f64> {
    let (sign, other) = match decimal {
        Decimal::Point => ('.', ','),
        Decimal::Comma => (',', '.'),
    };
    let plain = cell.replace(sign, "@").replace([other, '\u{a0}', '\''], "").replace('@', ".");
    plain.to_lowercase().replace('d', "e").parse().ok().filter(|value: &f64| value.is_finite())
}

/// Checks that the lines of the text are all accounted for.
fn check_lines(text: &str, understood: &Understood) {
    let lines: Vec<&str> = text.lines().collect();
    let named = understood.names_line.filter(|line| !is_comment(lines[line - 1]));
    let counted = understood.rows
        + understood.rows_above
        + understood.rows_below
        + understood.comments
        + understood.empty_rows
        + usize::from(named.is_some())
        + usize::from(understood.units_line.is_some());
    let there = lines.iter().filter(|line| !line.trim().is_empty()).count();
    assert_eq!(counted, there, "{understood:?}\n{text}");
}

/// Checks that the rows are those of the text.
fn check_values(text: &str, data: &Dataset, understood: &Understood) {
    let lines: Vec<&str> = text.lines().collect();
    let names = |line: usize| cells(lines[line - 1].trim_start_matches('#'), understood.separator);
    let header = understood.names_line.map(names);
    let rows = lines[understood.first_line - 1..]
        .iter()
        .filter(|line| !line.trim().is_empty() && !is_comment(line) && !is_rule(line))
        .map(|line| cells(line, understood.separator))
        .filter(|cells| cells.iter().any(|cell| !cell.is_empty()))
        .take(understood.rows);
    let rows: Vec<Vec<String>> = rows.collect();
    let is_full = |place: &usize| {
        rows.iter().any(|cells| cells.get(*place).is_some_and(|cell| !cell.is_empty()))
    };
    let widest = rows.iter().map(Vec::len).max().unwrap_or(0);
    let full: Vec<usize> = (0..widest).filter(is_full).collect();
    let mut places = Vec::new();
    for column in data.inputs.iter().chain(&data.outputs) {
        let known = understood.columns.iter().position(|known| known.name == column.name);
        let known = known.unwrap_or_else(|| panic!("{} is not said\n{text}", column.name));
        let written = &understood.columns[known].written;
        let place = match &header {
            Some(header) if !written.is_empty() && header.len() <= widest => {
                let mut places = (0..header.len()).filter(|&place| header[place] == *written);
                // Of names that occur twice this test cannot tell which is which.
                let (Some(place), None) = (places.next(), places.next()) else { return };
                place
            }
            // Names without a name, or separated by something else than the rows.
            Some(_) => return,
            None => full[known],
        };
        places.push(place);
    }
    let mut there: Vec<Vec<u32>> = rows
        .iter()
        .map(|cells| {
            let value = |place: &usize| {
                let cell = cells.get(*place).map_or("", String::as_str);
                let value = number(cell, understood.decimal);
                let value = value.unwrap_or_else(|| panic!("`{cell}` is no number\n{text}"));
                (value as f32).to_bits()
            };
            places.iter().map(value).collect()
        })
        .collect();
    let splits = match data.search == data.validation {
        true => vec![&data.search],
        false => vec![&data.search, &data.validation],
    };
    let mut kept: Vec<Vec<u32>> = Vec::new();
    for split in splits {
        let row = |row: usize| split.columns.iter().map(|column| column[row].to_bits()).collect();
        kept.extend((0..split.rows()).map(row));
    }
    there.sort();
    kept.sort();
    assert!(there == kept, "{:?}\n{text}", understood.sentences());
}

#[test]
fn no_mistake_gives_a_wrong_column() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/import/tables");
    let mut files: Vec<_> = folder.read_dir().unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    let mut numbers = Numbers(7);
    let (mut read, mut checked) = (0, 0);
    for turn in 0..MUTATIONS {
        let path = &files[turn % files.len()];
        let original = std::fs::read(path).unwrap();
        let mut bytes = mutated(&original, &mut numbers);
        if numbers.below(3) == 0 && !bytes.is_empty() {
            bytes = mutated(&bytes, &mut numbers);
        }
        let Ok((data, understood)) = parse(path, bytes.clone(), &Options::default()) else {
            continue;
        };
        read += 1;
        data.validate().unwrap();
        assert!(understood.columns.iter().any(|column| column.role == Role::Output));
        let Some(text) = text_of(&bytes) else { continue };
        check_lines(&text, &understood);
        let shifted = understood.notes.iter().any(|note| note.contains("is shifted"));
        if !shifted {
            check_values(&text, &data, &understood);
            checked += 1;
        }
    }
    assert!(read > MUTATIONS / 4 && checked > MUTATIONS / 5, "{read} read, {checked} checked");
}
