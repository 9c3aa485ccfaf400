//! Functions of HLSL files, called once for each row of numbers.

use super::Outcome;
use super::vulkan::Gpu;
use std::path::Path;
use std::process::Command;

const GROUP: usize = 64;

/// A call of a file's functions.
pub struct Call<'a> {
    /// The file that has them.
    pub file: &'a Path,
    /// What the file needs to be defined before it.
    pub before: &'a str,
    /// Statements: the row is `row(0)` to `row(inputs - 1)`, settings of all rows follow as
    /// `setting(0)`, …; results go to `result(0, …)`, ….
    pub body: &'a str,
    /// Numbers of a row, and of its results.
    pub sizes: [usize; 2],
}

impl Call<'_> {
    /// Runs it on all rows, each of `sizes[0]` numbers; returns the results, row after row.
    pub fn run(&self, gpu: &Gpu, rows: &[f32], settings: &[f32]) -> Outcome<Vec<f32>> {
        let [inputs, outputs] = self.sizes;
        let count = rows.len() / inputs;
        let file = self.file.display();
        let source = format!(
            "[[vk::binding(0)]] StructuredBuffer<float> given;
[[vk::binding(1)]] RWStructuredBuffer<float> results;
static uint index;
float row(uint i) {{ return given[index*{inputs} + i]; }}
float setting(uint i) {{ return given[{settings_at} + i]; }}
void result(uint i, float value) {{ results[index*{outputs} + i] = value; }}
{before}
#include \"{file}\"
[numthreads({GROUP}, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {{
    index = id.x;
    if (index >= {count}) return;
{body}
}}
",
            settings_at = rows.len(),
            before = self.before,
            body = self.body,
        );
        let spirv = compile(&source)?;
        let given: Vec<f32> = rows.iter().chain(settings).copied().collect();
        let groups = count.div_ceil(GROUP) as u32;
        Ok(gpu.run(&spirv, &given, count * outputs, groups)?.output)
    }
}

/// HLSL to SPIR-V.
fn compile(source: &str) -> Outcome<Vec<u32>> {
    let folder = tempfile::tempdir()?;
    let [from, to] = ["shader.hlsl", "shader.spv"].map(|name| folder.path().join(name));
    std::fs::write(&from, source)?;
    let ran = Command::new("glslangValidator")
        .args(["-D", "-V", "--target-env", "vulkan1.1", "-S", "comp", "-e", "main", "-I/"])
        .arg(&from)
        .arg("-o")
        .arg(&to)
        .output()
        .map_err(|error| format!("glslangValidator (Debian: glslang-tools): {error}"))?;
    if !ran.status.success() {
        return Err(String::from_utf8_lossy(&ran.stdout).into_owned().into());
    }
    let bytes = std::fs::read(&to)?;
    Ok(bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect())
}
