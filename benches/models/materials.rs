//! Emitted functions of a page's folder, over the validation rows of the data that they are named after.

use super::Outcome;
use super::shader::Call;
use super::vulkan::Gpu;
use lgp::dataset::Dataset;
use std::path::Path;

pub fn draw(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    let mut files: Vec<_> = std::fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    files.retain(|file| file.extension().is_some_and(|extension| extension == "hlsl"));
    files.sort();
    let datasets = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets");
    println!("RMSE on the validation split, unweighted, as the shader computes it");
    for file in files {
        let name = file.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        let data = Dataset::load(&datasets.join(name).with_extension("bin"))?;
        let function = function(&std::fs::read_to_string(&file)?)?;
        println!("{name}: {:.5}", rmse(gpu, &file, &function, &data)?);
    }
    Ok(())
}

/// The name of the function that a file defines.
fn function(text: &str) -> Outcome<String> {
    let heads = text.lines().filter(|line| line.starts_with("float"));
    let name = heads.filter_map(|line| line.split(['(', ' ']).nth(1)).next();
    Ok(name.ok_or("the file has no function")?.to_owned())
}

fn rmse(gpu: &Gpu, file: &Path, function: &str, data: &Dataset) -> Outcome<f64> {
    let (inputs, outputs) = (data.inputs.len(), data.outputs.len());
    let arguments: Vec<String> = (0..inputs).map(|index| format!("row({index})")).collect();
    let arguments = arguments.join(", ");
    let body = match outputs {
        1 => format!("result(0, {function}({arguments}));"),
        _ => format!(
            "float{outputs} values = {function}({arguments});
    for (uint i = 0; i < {outputs}; ++i) result(i, values[i]);"
        ),
    };
    let columns = &data.validation.columns;
    let count = columns[0].len();
    let rows: Vec<f32> = (0..count)
        .flat_map(|row| columns[..inputs].iter().map(move |column| column[row]))
        .collect();
    let call = Call { file, before: "", body: &body, sizes: [inputs, outputs] };
    let made = call.run(gpu, &rows, &[])?;
    let error = |output: usize| -> f64 {
        let truth = columns[inputs + output].iter();
        let pairs = truth.zip(made.iter().skip(output).step_by(outputs));
        pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>()
    };
    Ok(((0..outputs).map(error).sum::<f64>() / (count * outputs) as f64).sqrt())
}
