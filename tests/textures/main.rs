//! Textures, lookup tables and arrays as ground truths: `lgp import` of files that are made here, and
//! of three that other programs write.

#![cfg(feature = "cli")]

#[path = "../command/mod.rs"]
mod command;

use command::{lgp, succeed, text};
use half::f16;
use lgp::dataset::{Dataset, Split};
use lgp::import::array::{Array, to_exr, to_npy};
use std::collections::BTreeMap;
use std::fs::write;
use std::path::Path;
use tempfile::TempDir;

const SIDE: usize = 64;

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The DFG at the centres of 64 × 64 texels, n_dot_v varying slowest.
fn dfg() -> Dataset {
    let dfg = Dataset::load(&here().join("datasets/dfg.bin")).unwrap();
    assert_eq!(dfg.search.grid, [SIDE, SIDE]);
    dfg
}

/// Its values as a picture has them: n_dot_v along x, roughness along y, scale and bias together.
fn picture() -> Vec<[f32; 2]> {
    let columns = &dfg().search.columns;
    let row = |texel: usize| (texel % SIDE) * SIDE + texel / SIDE;
    (0..SIDE * SIDE).map(|texel| [columns[2][row(texel)], columns[3][row(texel)]]).collect()
}

/// The outputs of all rows by the bits of their inputs; both splits' rows differ.
fn rows(dataset: &Dataset, splits: &[&Split]) -> BTreeMap<Vec<u32>, Vec<f32>> {
    let inputs = dataset.inputs.len();
    let mut rows = BTreeMap::new();
    for split in splits {
        for row in 0..split.rows() {
            let values: Vec<f32> = split.columns.iter().map(|column| column[row]).collect();
            let place = values[..inputs].iter().map(|value| value.to_bits()).collect();
            let before = rows.insert(place, values[inputs..].to_vec());
            assert_eq!(before, None, "a row occurs twice");
        }
    }
    rows
}

/// Imports a file and asserts that it has the DFG's rows, each value within `precision`.
fn assert_dfg(folder: &Path, file: &str, options: &[&str], precision: f32) -> String {
    let said = succeed(folder, &[&["import", file, "-o", "dfg.bin"], options].concat());
    let read = Dataset::load(&folder.join("dfg.bin")).unwrap();
    assert_eq!(read.names(), dfg().names(), "{file}");
    assert_eq!(read.inputs, dfg().inputs, "{file}");
    let found = rows(&read, &[&read.search, &read.validation]);
    let expected = rows(&dfg(), &[&dfg().search]);
    assert_eq!(found.len(), expected.len(), "{file}");
    assert!(read.validation.rows() > 900, "{file}: {} rows", read.validation.rows());
    for ((place, values), (truth_at, truth)) in found.iter().zip(&expected) {
        assert_eq!(place, truth_at, "{file}");
        for (value, truth) in values.iter().zip(truth) {
            assert!((value - truth).abs() <= precision, "{file}: {value} {truth}");
        }
    }
    said
}

const AXES: [&str; 4] = ["--axes", "n_dot_v=0..1,roughness=0..1", "--channels", "scale,bias"];

fn png_of(colour: png::ColorType, depth: png::BitDepth, size: [u32; 2], data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

#[test]
fn the_dfg_comes_back_from_pictures() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let exr = Array {
        size: vec![SIDE, SIDE],
        channels: vec!["R".into(), "G".into()],
        values: picture().into_iter().flatten().collect(),
        ..Array::default()
    };
    write(here.join("lut.exr"), to_exr(&exr).unwrap()).unwrap();
    let said = assert_dfg(here, "lut.exr", &AXES, 0.0);
    for expected in [
        "OpenEXR, 32-bit floats: 64 × 64 texels, 2 channels",
        "n_dot_v along x, from the left: 0 to 1, texel centres",
        "roughness along y, from the top: 0 to 1, texel centres",
        "scale = r, bias = g",
    ] {
        assert!(said.contains(expected), "{said}");
    }

    let levels = |value: f32| (f64::from(value) * 65535.0).round() as u16;
    let colours = picture().into_iter().flat_map(|[scale, bias]| [levels(scale), levels(bias), 0]);
    let data: Vec<u8> = colours.flat_map(u16::to_be_bytes).collect();
    let size = [SIDE as u32; 2];
    let png = png_of(png::ColorType::Rgb, png::BitDepth::Sixteen, size, &data);
    write(here.join("lut.png"), png).unwrap();
    let said = assert_dfg(here, "lut.png", &AXES, 0.501 / 65535.0);
    assert!(said.contains("left out: b") && said.contains("divided by 65535"), "{said}");

    let flipped: Vec<f32> = exr.values.chunks(2 * SIDE).rev().flatten().copied().collect();
    let flipped = to_exr(&Array { values: flipped, ..exr }).unwrap();
    write(here.join("flipped.exr"), flipped).unwrap();
    let said = assert_dfg(here, "flipped.exr", &[&AXES[..], &["--flip-y"]].concat(), 0.0);
    assert!(said.contains("roughness along y, from the bottom"), "{said}");
}

#[test]
fn the_dfg_comes_back_from_arrays() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let texel = |[scale, bias]: [f32; 2]| format!("{{ {scale:?}f, {bias:?}f }}");
    let line = |row: &[[f32; 2]]| {
        format!("    {{ {} }},\n", row.iter().copied().map(texel).collect::<Vec<_>>().join(", "))
    };
    let lines: String = picture().chunks(SIDE).map(line).collect();
    let source =
        format!("#pragma once\n// The DFG.\nstatic const float2 DFG[64][64] = {{\n{lines}}};\n");
    write(here.join("dfg.hlsl"), source).unwrap();
    let said = assert_dfg(here, "dfg.hlsl", &AXES, 0.0);
    assert!(said.contains("`DFG` of a source file"), "{said}");

    let values: Vec<f32> = picture().into_iter().flatten().collect();
    let little: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    write(here.join("dfg.raw"), little).unwrap();
    let raw = [&AXES[..], &["--size", "64x64x2", "--format", "f32"]].concat();
    assert_dfg(here, "dfg.raw", &raw, 0.0);
    let halves: Vec<u8> =
        values.iter().flat_map(|&value| f16::from_f32(value).to_be_bytes()).collect();
    write(here.join("dfg.f16"), halves).unwrap();
    let raw = [&AXES[..], &["--size", "64x64x2", "--format", "f16", "--big-endian"]].concat();
    assert_dfg(here, "dfg.f16", &raw, 2.5e-4);

    // As numpy saves `search.reshape(64, 64, 2)`: the last of the grid's dimensions is x.
    let slowest = Array {
        size: vec![SIDE, SIDE],
        channels: vec!["scale".into(), "bias".into()],
        values: {
            let columns = &dfg().search.columns;
            (0..SIDE * SIDE).flat_map(|row| [columns[2][row], columns[3][row]]).collect()
        },
        ..Array::default()
    };
    write(here.join("dfg.npy"), to_npy(&slowest)).unwrap();
    let axes = ["--axes", "roughness=0..1,n_dot_v=0..1", "--channels", "scale,bias"];
    succeed(here, &[&["import", "dfg.npy", "-o", "npy.bin"][..], &axes].concat());
    let read = Dataset::load(&here.join("npy.bin")).unwrap();
    let mut turned: Vec<(Vec<u32>, Vec<f32>)> =
        rows(&read, &[&read.search, &read.validation]).into_iter().collect();
    turned.iter_mut().for_each(|(place, _)| place.reverse());
    turned.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(turned.into_iter().eq(rows(&dfg(), &[&dfg().search])));
}

#[test]
fn datasets_go_to_arrays_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let data = here().join("datasets/dfg.bin");
    let data = data.to_str().unwrap();
    for (file, more) in [("grid.npy", &["--grid"][..]), ("grid.exr", &[])] {
        succeed(folder.path(), &[&["export", data, "-o", file], more].concat());
        assert_dfg(folder.path(), file, &AXES, 0.0);
    }
    succeed(folder.path(), &["export", data, "-o", "rows.npy", "--split", "search"]);
    let names = ["--columns", "n_dot_v,roughness,scale,bias"];
    let import = ["import", "rows.npy", "-o", "rows.bin", "--inputs", "2"];
    succeed(folder.path(), &[&import[..], &names].concat());
    let read = Dataset::load(&folder.path().join("rows.bin")).unwrap();
    let found = rows(&read, &[&read.search, &read.validation]);
    assert_eq!(found, rows(&dfg(), &[&dfg().search]));
}

#[test]
fn tables_of_other_programs_are_read() {
    let folder = TempDir::new().unwrap();
    let output = folder.path().join("x.bin");
    let output = output.to_str().unwrap();
    let import = |file: &str, options: &[&str]| -> (Dataset, String) {
        let file = here().join("tests/textures").join(file);
        let arguments = ["import", file.to_str().unwrap(), "-o", output];
        let said = succeed(folder.path(), &[&arguments[..], options].concat());
        (Dataset::load(Path::new(output)).unwrap(), said)
    };
    let (curve, said) = import("curve.spi1d", &[]);
    assert_eq!(curve.inputs[0].domain, [0.0, 1.0]);
    assert!(said.contains("x along x: 0 to 1, the first and last texels are the ends"), "{said}");
    let all = rows(&curve, &[&curve.search, &curve.validation]);
    assert_eq!((all.len(), &all[&vec![(7.0f32 / 15.0).to_bits()]]), (16, &vec![0.186989]));

    let (cube, said) = import("tiny.cube", &[]);
    assert!(said.contains("r_out = r, g_out = g, b_out = b"), "{said}");
    let all = rows(&cube, &[&cube.search, &cube.validation]);
    let at = [1.0f32 / 3.0, 1.0, 0.0].map(f32::to_bits).to_vec();
    assert_eq!((all.len(), &all[&at]), (64, &vec![0.372041, 1.0, 0.0]));
    let (named, _) = import("tiny.cube", &["--axes", "x=-1..1,y,z", "--channels", "warm=r"]);
    assert_eq!(named.inputs[0].domain, [-1.0, 1.0]);
    assert_eq!((named.inputs[2].domain, named.outputs.len()), ([0.0, 1.0], 1));

    let (table, _) = import("table.inc", &[&AXES[..], &["--size", "8x8x2"]].concat());
    let all = rows(&table, &[&table.search, &table.validation]);
    let at = [0.1875f32, 0.9375].map(f32::to_bits).to_vec();
    assert_eq!((all.len(), &all[&at]), (64, &vec![0.569783, 0.00625]));
}

#[test]
fn options_say_what_texels_mean() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let bytes: Vec<u8> = (0..=255).collect();
    let png = png_of(png::ColorType::Grayscale, png::BitDepth::Eight, [32, 8], &bytes);
    write(here.join("ramp.png"), png).unwrap();
    let import = |options: &[&str]| {
        let arguments = [&["import", "ramp.png", "-o", "x.bin"][..], options].concat();
        let said = succeed(here, &arguments);
        (Dataset::load(&here.join("x.bin")).unwrap(), said)
    };
    let value = |dataset: &Dataset, at: [f32; 2]| {
        rows(dataset, &[&dataset.search, &dataset.validation])[&at.map(f32::to_bits).to_vec()][0]
    };
    let (plain, said) = import(&[]);
    assert!(said.contains("nothing names the axes"), "{said}");
    assert_eq!(plain.names().inputs, ["u", "v"]);
    assert_eq!(value(&plain, [1.5 / 32.0, 0.5 / 8.0]), 1.0 / 255.0);
    let (corners, _) = import(&["--corners", "--axes", "a=0..31,b=7..0"]);
    assert_eq!(value(&corners, [3.0, 6.0]), 35.0 / 255.0);
    assert_eq!(corners.inputs[1].domain, [0.0, 7.0]);
    let (logarithmic, _) = import(&["--corners", "--axes", "a=1..2147483648:log,b=0..7"]);
    assert_eq!(value(&logarithmic, [8.0, 1.0]), 35.0 / 255.0);
    let (linear, said) = import(&["--srgb", "--channels", "y"]);
    assert!(said.contains("decoded from sRGB"), "{said}");
    // 188 of 255 is the sRGB code of a half.
    assert!((value(&linear, [28.5 / 32.0, 5.5 / 8.0]) - 0.5).abs() < 3e-3);
    let (few, said) = import(&["--every", "4"]);
    assert_eq!(few.search.rows() + few.validation.rows(), 16);
    assert!(said.contains("8 × 2"), "{said}");
    assert_eq!(value(&few, [1.5 / 32.0, 1.5 / 8.0]), 33.0 / 255.0);
    let json = succeed(here, &["import", "ramp.png", "-o", "x.bin", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(json["understood"][0].as_str().unwrap().contains("32 × 8 texels"), "{json}");
}

#[test]
fn rows_and_columns_of_numpy_are_a_table() {
    let folder = TempDir::new().unwrap();
    let columns = Array {
        size: vec![40],
        channels: ["x", "y", "z"].map(str::to_owned).into(),
        values: (0..120).map(|i| (i * i % 97) as f32).collect(),
        ..Array::default()
    };
    write(folder.path().join("rows.npy"), to_npy(&columns)).unwrap();
    let import = ["import", "rows.npy", "-o", "x.bin", "--inputs", "2", "--channels", "x,y,z"];
    succeed(folder.path(), &import);
    let wide = Array {
        size: vec![20],
        channels: (0..6).map(|index| format!("c{index}")).collect(),
        ..columns
    };
    write(folder.path().join("wide.npy"), to_npy(&wide)).unwrap();
    let import = ["import", "wide.npy", "-o", "wide.bin", "--inputs", "c0,c3"];
    let wide = succeed(folder.path(), &import);
    assert!(wide.contains("c0, c3 → c1, c2, c4, c5"), "{wide}");
    let read = Dataset::load(&folder.path().join("x.bin")).unwrap();
    assert_eq!((read.inputs.len(), read.outputs[0].name.as_str()), (2, "z"));
    assert_eq!(read.search.rows() + read.validation.rows(), 40);
}

#[test]
fn what_is_unusable_is_refused_and_nothing_is_written() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let png = |size: [u32; 2], data: &[u8]| {
        png_of(png::ColorType::Grayscale, png::BitDepth::Eight, size, data)
    };
    let whole = png([8, 8], &(0..64).collect::<Vec<u8>>());
    // A header that claims 16384 × 16384, with the checksum that it would have.
    let mut bomb = whole.clone();
    bomb[16..24].copy_from_slice(&[0, 0, 64, 0, 0, 0, 64, 0]);
    let checksum = crc(&bomb[12..29]).to_be_bytes();
    bomb[29..33].copy_from_slice(&checksum);
    let mut values = vec![0.5f32; 16];
    values[6] = f32::NAN;
    let array = |values| Array {
        size: vec![4, 4],
        channels: vec!["value".into()],
        values,
        ..Array::default()
    };
    let holed = array(values);
    let good = array((0..16).map(|i| i as f32).collect());
    let exr = to_exr(&good).unwrap();
    for (file, content) in [
        ("bomb.png", &bomb[..]),
        ("half.png", &whole[..whole.len() / 2]),
        ("text.png", b"hello"),
        ("empty.exr", b""),
        ("half.exr", &exr[..exr.len() - 8]),
        ("holed.npy", &to_npy(&holed)),
        ("holed.exr", &to_exr(&holed).unwrap()),
        ("good.npy", &to_npy(&good)),
        ("good.exr", &exr),
        ("x.jpg", b"\xff\xd8\xff\xe0"),
        ("x.tga", b"\0\0"),
        ("x.raw", &[0; 16]),
        ("main.c", b"int main() { return 0; }"),
        ("table.csv", b"x,y\n1,2\n"),
    ] {
        write(here.join(file), content).unwrap();
    }
    write(here.join("old.bin"), "as it was").unwrap();
    for (file, options, says) in [
        ("bomb.png", &[][..], "16384 × 16384 texels of 1 channel; at most"),
        ("half.png", &[], "truncated"),
        ("text.png", &[], "named as PNG"),
        ("empty.exr", &[], "empty"),
        ("half.exr", &[], "half.exr: "),
        ("holed.npy", &[], "channel `value` of texel (2, 1) is NaN"),
        ("holed.exr", &[], "texel (2, 1)"),
        ("good.npy", &["--axes", "x,y,z"], "--axes names 3 axes"),
        ("good.npy", &["--channels", "a,b"], "no channel `b`"),
        ("good.npy", &["--srgb"], "--srgb says nothing of NPY files"),
        ("good.npy", &["--size", "5x5"], "--size 5 × 5"),
        ("good.npy", &["--axes", "1x=0..1,y=0..1"], "not an identifier"),
        ("good.npy", &["--axes", "y=0..1,y=0..1"], "more than once"),
        ("good.npy", &["--axes", "x=1e7..10000001,y"], "both at 10000000"),
        ("good.npy", &["--every", "9"], "--every 9 leaves"),
        ("good.exr", &["--inputs", "1"], "no table of rows and columns"),
        ("missing.npy", &[], "no such file"),
        ("x.jpg", &[], "not exact"),
        ("x.tga", &[], "PNG"),
        ("x.raw", &[], "--size"),
        ("x.raw", &["--size", "3x3", "--format", "f16"], "16 bytes"),
        ("main.c", &[], "no array of numbers"),
        ("table.csv", &["--axes", "x"], "read as a table"),
    ] {
        let arguments = [&["import", file, "-o", "old.bin"][..], options].concat();
        let output = lgp(here, &arguments);
        let said = text(&output.stderr);
        assert!([Some(2), Some(3)].contains(&output.status.code()), "{file} {options:?}: {said}");
        assert!(said.contains(says), "{file} {options:?}: {said}");
        assert!(said.starts_with("error: ") && !said.contains("panicked"), "{said}");
        assert_eq!(std::fs::read(here.join("old.bin")).unwrap(), b"as it was", "{file}");
    }
}

/// The checksum of PNG's chunks.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
    })
}
