//! A dataset of a table's columns.

use super::notes;
use super::precision::{Kept, keep};
use super::read::{Read, Wanted};
use super::roles::Roles;
use super::{Open, Role, Understood};
use crate::dataset::{Column, Dataset, Origin, Split, domain_of};
use crate::import::{Error, split_rows};
use crate::program::shortest;
use std::ffi::OsStr;

/// Reads the columns that the options ask for.
pub(super) fn dataset(open: &Open) -> Result<(Dataset, Understood), Error> {
    let roles = open.columns().roles(open.options)?;
    let scales = scales(open, &roles)?;
    let scale = |place: usize| scales.iter().find(|(p, _)| *p == place).map(|(_, scale)| *scale);
    let wanted: Vec<Wanted> =
        roles.all().map(|place| Wanted { scale: scale(place), ..open.wanted(place) }).collect();
    let read = open.source().read(&wanted)?;
    let mut understood = open.understood(&read);
    let Read { mut columns, lines, vanished, .. } = read;
    let beside = columns.split_off(roles.inputs.len() + roles.outputs.len());
    let values = keep(&open.source(), &wanted[..columns.len()], columns)?;
    check_not_negative(open, &roles, &wanted[values.len()..], &beside, &lines)?;
    let names = named(&wanted, &values);
    say(open, &roles, &names, &values, &vanished, &mut understood);
    let domains = domains(open, &roles, &wanted, &names, &values, &lines)?;
    let units: Vec<String> = roles.all().map(|place| unit(open, place, scale(place))).collect();
    let whole = whole(&roles, values, beside);
    let (search, validation) = split_rows(&whole, roles.inputs.len());
    let described = (0..names.len()).map(|position| Column {
        name: names[position].clone(),
        unit: units[position].clone(),
        domain: domains[position].unwrap_or_else(|| domain_of(&search, &validation, position)),
    });
    let mut inputs: Vec<Column> = described.collect();
    let outputs = inputs.split_off(roles.inputs.len());
    let lossy = |part: Option<&OsStr>| {
        part.map(|part| part.to_string_lossy().into_owned()).unwrap_or_default()
    };
    let dataset = Dataset {
        name: lossy(open.path.file_stem()),
        origin: Origin::Import {
            file: lossy(open.path.file_name()),
            renamed: understood.renamed(),
        },
        inputs,
        outputs,
        search,
        validation,
        ..Dataset::default()
    };
    dataset.validate_as(open.path)?;
    Ok((dataset, understood))
}

/// The powers of ten that columns are multiplied by, with their places.
fn scales(open: &Open, roles: &Roles) -> Result<Vec<(usize, i32)>, Error> {
    let of = |(name, power): &(String, i32)| {
        let place = open.columns().place(name)?;
        let is_read = roles.all().any(|read| read == place);
        let column = || (open.path.to_path_buf(), open.headings[place].name.clone());
        match is_read {
            true => Ok((place, *power)),
            false => {
                let (path, column) = column();
                Err(Error::ScaleOfNothing { path, column })
            }
        }
    };
    open.options.scales.iter().map(of).collect()
}

/// The names of inputs and outputs; those that are scaled or shifted say it.
fn named(wanted: &[Wanted], kept: &[Kept]) -> Vec<String> {
    let name = |(wanted, kept): (&Wanted, &Kept)| {
        let scaled = match wanted.scale {
            None | Some(0) => wanted.name.clone(),
            Some(power) if power > 0 => format!("{}_times_1e{power}", wanted.name),
            Some(power) => format!("{}_over_1e{}", wanted.name, -i64::from(power)),
        };
        match kept.base {
            0.0 => scaled,
            base if base > 0.0 => format!("{scaled}_minus_{base}"),
            base => format!("{scaled}_plus_{}", -base),
        }
    };
    wanted.iter().zip(kept).map(name).collect()
}

/// The unit that a column is stored in.
fn unit(open: &Open, place: usize, scale: Option<i32>) -> String {
    let unit = &open.headings[place].unit;
    match scale.filter(|power| *power != 0 && !unit.is_empty()) {
        None => unit.clone(),
        Some(power) => format!("1e{} {unit}", -i64::from(power)),
    }
}

fn say(
    open: &Open,
    roles: &Roles,
    names: &[String],
    kept: &[Kept],
    vanished: &[usize],
    understood: &mut Understood,
) {
    let errors = roles.errors.iter().flatten().map(|&place| (place, Role::StandardErrors));
    let known = (roles.inputs.iter().map(|&place| (place, Role::Input)))
        .chain(roles.outputs.iter().map(|&place| (place, Role::Output)))
        .chain(errors)
        .chain(roles.weight.map(|place| (place, Role::Weight)));
    for (place, role) in known {
        open.set_role(understood, place, role);
    }
    let first = open.columns().candidates().next();
    for (position, place) in roles.inputs.iter().chain(&roles.outputs).enumerate() {
        let written = &open.headings[*place].name;
        let is_input = position < roles.inputs.len();
        let is_first = first == Some(*place) && roles.inputs.len() > 1;
        let of_input = || notes::of_input(written, &kept[position].values, is_first);
        understood.notes.extend(kept[position].note.clone());
        understood.notes.extend(notes::of_vanished(written, vanished[position]));
        understood.notes.extend(if is_input { of_input() } else { None });
        if let Some(column) = understood
            .columns
            .iter_mut()
            .find(|column| column.name == *written && !matches!(column.role, Role::LeftOut(_)))
        {
            column.name.clone_from(&names[position]);
        }
    }
}

fn check_not_negative(
    open: &Open,
    roles: &Roles,
    wanted: &[Wanted],
    columns: &[Vec<f32>],
    lines: &[usize],
) -> Result<(), Error> {
    for (wanted, values) in wanted.iter().zip(columns) {
        let negative = values.iter().zip(lines).find(|(value, _)| **value < 0.0);
        let Some((&value, &line)) = negative else { continue };
        let (path, column) = (open.path.to_path_buf(), wanted.name.clone());
        return Err(match Some(wanted.place) == roles.weight {
            true => Error::NegativeWeight { path, line, column, value },
            false => Error::NegativeError { path, line, column, value },
        });
    }
    Ok(())
}

/// The domains that the options give, by column.
fn domains(
    open: &Open,
    roles: &Roles,
    wanted: &[Wanted],
    names: &[String],
    kept: &[Kept],
    lines: &[usize],
) -> Result<Vec<Option<[f64; 2]>>, Error> {
    let mut domains = vec![None; names.len()];
    for (name, asked) in &open.options.domains {
        let place = match names.iter().position(|stored| stored == name) {
            Some(position) => wanted[position].place,
            None => open.columns().place(name)?,
        };
        let column = open.headings[place].name.clone();
        let path = || open.path.to_path_buf();
        let Some(position) = roles.inputs.iter().position(|input| *input == place) else {
            return Err(Error::DomainOfOutput { path: path(), column });
        };
        // A column's own name means its values in the file.
        let is_stored = names[position] == *name;
        let (scale, base) = match is_stored {
            true => (1.0, 0.0),
            false => (10f64.powi(wanted[position].scale.unwrap_or(0)), kept[position].base),
        };
        let [low, high] = asked.map(|end| (end * scale - base) as f32);
        let wide = [low, high].map(f64::from);
        if !(low.is_finite() && high.is_finite()) {
            let [low, high] = wide;
            return Err(Error::UnusableDomain { path: path(), column, low, high });
        }
        let outside = |(value, _): &(&f32, &usize)| !(low..=high).contains(*value);
        if let Some((&value, &line)) = kept[position].values.iter().zip(lines).find(outside) {
            let column = names[position].clone();
            let [low, high] = wide;
            return Err(Error::OutsideDomain { path: path(), line, column, value, low, high });
        }
        // The shortest decimals of the ends, not those of their rounding.
        let exact = |end: f32| shortest(f64::from(end)).parse().unwrap_or(f64::from(end));
        domains[position] = Some([low, high].map(exact));
    }
    Ok(domains)
}

/// All rows of the table.
fn whole(roles: &Roles, values: Vec<Kept>, beside: Vec<Vec<f32>>) -> Split {
    let rows = values.first().map_or(0, |column| column.values.len());
    let mut beside = beside.into_iter();
    let none = roles.errors.iter().all(Option::is_none);
    let errors = |of: &Option<usize>, beside: &mut std::vec::IntoIter<Vec<f32>>| match of {
        Some(_) => beside.next().unwrap_or_default(),
        None => vec![0.0; rows],
    };
    let standard_errors = match none {
        true => Vec::new(),
        false => roles.errors.iter().map(|of| errors(of, &mut beside)).collect(),
    };
    Split {
        columns: values.into_iter().map(|column| column.values).collect(),
        weights: beside.next().unwrap_or_default(),
        standard_errors,
        ..Split::default()
    }
}
