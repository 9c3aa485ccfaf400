//! HLSL and Slang: compiled to SPIR-V by a compiler of the machine, or read as a snippet.

use super::Error;
use super::signature::{CALLER, Declared, Signature, caller, signatures, uncalled};
use super::source::{Language, Source};
use crate::suggest::did_you_mean;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A compiler to SPIR-V, and its arguments before the files.
struct Compiler {
    program: &'static str,
    reads_slang: bool,
    arguments: &'static [&'static str],
    /// The argument before the output.
    output: &'static str,
}

/// In the order of trial. All keep functions apart, without optimisation.
const COMPILERS: [Compiler; 4] = [
    Compiler {
        program: "slangc",
        reads_slang: true,
        arguments: &["-target", "spirv", "-stage", "fragment", "-entry", CALLER, "-O0"],
        output: "-o",
    },
    Compiler {
        program: "glslangValidator",
        reads_slang: false,
        arguments: &["-D", "-Od", "-V", "-S", "frag", "-e", CALLER],
        output: "-o",
    },
    Compiler {
        program: "glslang",
        reads_slang: false,
        arguments: &["-D", "-Od", "-V", "-S", "frag", "-e", CALLER],
        output: "-o",
    },
    Compiler {
        program: "dxc",
        reads_slang: false,
        arguments: &["-spirv", "-fcgl", "-T", "ps_6_0", "-E", CALLER],
        output: "-Fo",
    },
];

/// The longest time that a compiler may take. By hand.
const PATIENCE: Duration = Duration::from_secs(60);

/// The result of compiling a function.
pub(super) struct Compiled {
    pub source: Source,
    pub name: String,
    /// By parameter: true if the function may write to it.
    pub is_out: Vec<bool>,
}

/// Compiles the function of this name, or the only one that no other calls. None if no compiler is
/// there.
pub(super) fn compiled(
    path: &Path,
    text: &str,
    language: Language,
    entry: Option<&str>,
) -> Result<Option<Compiled>, Error> {
    let all = signatures(text);
    let signature = chosen(path, text, &all, entry)?;
    let whole = |message: String| Error::Whole { path: path.to_owned(), message };
    let with_caller = format!("{text}{}", caller(signature));
    let is_slang = language == Language::Slang;
    // What Slang shares with HLSL, compilers of HLSL read.
    let mut usable: Vec<&Compiler> =
        COMPILERS.iter().filter(|c| is_slang || !c.reads_slang).collect();
    usable.sort_by_key(|compiler| compiler.reads_slang != is_slang);
    for compiler in usable {
        let Some(result) = run(compiler, path, &with_caller).map_err(|e| whole(e.to_string()))?
        else {
            continue;
        };
        let code = result.map_err(|message| whole(reworded(&message)))?;
        let source = Source::spir_v(path, code)?;
        let is_out = signature.parameters.iter().map(|Declared { is_out, .. }| *is_out).collect();
        return Ok(Some(Compiled { source, name: signature.name.clone(), is_out }));
    }
    Ok(None)
}

fn chosen<'a>(
    path: &Path,
    text: &str,
    all: &'a [Signature],
    entry: Option<&str>,
) -> Result<&'a Signature, Error> {
    let whole = |message: String| Err(Error::Whole { path: path.to_owned(), message });
    let names = || all.iter().map(|signature| signature.name.as_str());
    if let Some(name) = entry {
        if let Some(found) = all.iter().find(|signature| signature.name == name) {
            return Ok(found);
        }
        let hint = did_you_mean(name, names());
        let known = names().collect::<Vec<_>>().join(", ");
        return whole(format!("there is no function `{name}`{hint} (there are: {known})"));
    }
    match uncalled(text, all).as_slice() {
        [only] => Ok(only),
        [] => whole("it has no function".into()),
        several => {
            let names: Vec<&str> = several.iter().map(|one| one.name.as_str()).collect();
            whole(format!(
                "it has several functions: {}; say which, as in --entry {}",
                names.join(", "),
                names[0]
            ))
        }
    }
}

/// Runs a compiler on a text; none if it is not there. The inner error is the compiler's.
fn run(
    compiler: &Compiler,
    path: &Path,
    text: &str,
) -> std::io::Result<Option<Result<Vec<u8>, String>>> {
    let folder = tempfile::tempdir()?;
    let name = path.file_name().map_or_else(|| PathBuf::from("shader.hlsl"), PathBuf::from);
    let (input, output) = (folder.path().join(&name), folder.path().join("lgp.spv"));
    let log = folder.path().join("lgp.log");
    std::fs::write(&input, text)?;
    let around = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let around = around.unwrap_or(Path::new(".")).canonicalize()?;
    let mut command = Command::new(compiler.program);
    command.args(compiler.arguments).arg(format!("-I{}", around.display()));
    command.arg(compiler.output).arg(&output).arg(&input);
    let file = std::fs::File::create(&log)?;
    command.stdin(Stdio::null()).stdout(file.try_clone()?).stderr(file);
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if start.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            let message = format!("{} takes more than a minute for it", compiler.program);
            return Ok(Some(Err(message)));
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    Ok(Some(match status.success() {
        true => Ok(std::fs::read(&output)?),
        false => {
            let said = String::from_utf8_lossy(&std::fs::read(&log)?).into_owned();
            let said = said.replace(&format!("{}/", folder.path().display()), "");
            Err(format!("{} does not compile it:\n{}", compiler.program, said.trim()))
        }
    }))
}

/// Leaves of a compiler's messages those that name a place, if any does.
fn reworded(message: &str) -> String {
    let mut lines = message.lines();
    let first = lines.next().unwrap_or_default();
    let errors: Vec<&str> = lines
        .clone()
        .filter(|line| line.contains("error") || line.contains("ERROR"))
        .filter(|line| {
            !line.contains("compilation terminated") && !line.contains("compilation errors")
        })
        .take(5)
        .collect();
    let shown = if errors.is_empty() { lines.take(5).collect() } else { errors };
    format!("{first}\n  {}", shown.join("\n  "))
}
