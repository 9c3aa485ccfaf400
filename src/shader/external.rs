//! HLSL and Slang: compiled to SPIR-V by a compiler of the machine, or read as a snippet.

use super::Error;
use super::depth::check_depth;
use super::language::Language;
use super::signature::{CALLER, Signature, caller, signatures, uncalled};
use super::source::Source;
use super::text::Text;
use crate::suggest::did_you_mean;
use naga::ShaderStage;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// A compiler to SPIR-V, and its arguments before the files.
struct Compiler {
    program: &'static str,
    reads_slang: bool,
    arguments: &'static [&'static str],
    /// The argument before the output.
    output: &'static str,
}

/// Of HLSL, in the order of trial. All keep functions apart, without optimisation.
const COMPILERS: [Compiler; 4] = [
    Compiler {
        program: "slangc",
        reads_slang: true,
        arguments: &["-target", "spirv", "-stage", "fragment", "-entry", CALLER, "-O0"],
        output: "-o",
    },
    glslang("glslangValidator", &["-D", "-Od", "-V", "-S", "frag", "-e", CALLER]),
    glslang("glslang", &["-D", "-Od", "-V", "-S", "frag", "-e", CALLER]),
    Compiler {
        program: "dxc",
        reads_slang: false,
        arguments: &["-spirv", "-fcgl", "-T", "ps_6_0", "-E", CALLER],
        output: "-Fo",
    },
];

/// Of GLSL. Functions that nobody calls are kept.
const COMPILERS_OF_GLSL: [Compiler; 2] = [
    glslang("glslangValidator", &["--keep-uncalled", "-Od", "-V", "--amb", "--aml"]),
    glslang("glslang", &["--keep-uncalled", "-Od", "-V", "--amb", "--aml"]),
];

const fn glslang(program: &'static str, arguments: &'static [&'static str]) -> Compiler {
    Compiler { program, reads_slang: false, arguments, output: "-o" }
}

/// The longest time that a compiler may take. By hand.
const PATIENCE: Duration = Duration::from_secs(60);

/// The result of compiling a function.
pub(super) struct Compiled {
    pub source: Source,
    pub name: String,
}

/// What a compiler says of a text that it does not compile.
pub(super) struct Rejected {
    /// The line, counted from 1, if it is known.
    pub line: Option<usize>,
    pub message: String,
}

/// Compiles the function of this name, or the only one that no other calls. None if no compiler is
/// there.
pub(super) fn compiled(
    path: &Path,
    written: &Text,
    language: Language,
    entry: Option<&str>,
) -> Result<Option<Compiled>, Error> {
    let text = &written.text;
    // What compilers take too much memory for, too.
    check_depth(path, written, text)?;
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
        let ran = run(compiler, &[], path, &with_caller).map_err(|e| whole(e.to_string()))?;
        let Some(result) = ran else { continue };
        let own_lines = text.lines().count();
        let code = result.map_err(|Rejected { line, message }| match line {
            Some(line) if line <= own_lines => {
                let source = Source::without_module(path, with_caller.clone());
                Source { written: written.clone(), ..source }.error_in_line(line, message)
            }
            _ => whole(message),
        })?;
        let name = signature.name.clone();
        let source = Source { declared: vec![signature.clone()], ..Source::spir_v(path, code)? };
        return Ok(Some(Compiled { source, name }));
    }
    Ok(None)
}

/// Compiles GLSL that a `#version` begins; none if no compiler is there.
pub(super) fn glsl(
    path: &Path,
    stage: ShaderStage,
    text: &str,
) -> Option<Result<Vec<u8>, Rejected>> {
    let stage = match stage {
        ShaderStage::Vertex => "vert",
        ShaderStage::Compute => "comp",
        _ => "frag",
    };
    let mut ran =
        COMPILERS_OF_GLSL.iter().map(|compiler| run(compiler, &["-S", stage], path, text));
    ran.find_map(|ran| ran.unwrap_or_else(|error| Some(Err(Rejected::of(error.to_string())))))
}

impl Rejected {
    fn of(message: String) -> Rejected {
        Rejected { line: None, message }
    }
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
    options: &[&str],
    path: &Path,
    text: &str,
) -> std::io::Result<Option<Result<Vec<u8>, Rejected>>> {
    let folder = tempfile::tempdir()?;
    let name = path.file_name().map_or_else(|| PathBuf::from("shader.hlsl"), PathBuf::from);
    let (input, output) = (folder.path().join(&name), folder.path().join("lgp.spv"));
    let log = folder.path().join("lgp.log");
    std::fs::write(&input, text)?;
    let mut command = Command::new(compiler.program);
    command.args(compiler.arguments).args(options);
    command.arg(compiler.output).arg(&output).arg(&input);
    let file = std::fs::File::create(&log)?;
    command.stdin(Stdio::null()).stdout(file.try_clone()?).stderr(file);
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    let Some(status) = ended(&mut child)? else {
        let message = format!("{} takes more than a minute for it", compiler.program);
        return Ok(Some(Err(Rejected::of(message))));
    };
    if status.success() && output.exists() {
        return Ok(Some(Ok(std::fs::read(&output)?)));
    }
    let said = String::from_utf8_lossy(&std::fs::read(&log)?).into_owned();
    let said = said.replace(&format!("{}/", folder.path().display()), "");
    Ok(Some(Err(rejected(compiler.program, &name.to_string_lossy(), &said))))
}

/// Waits for a compiler; none if it lost patience, and ended it.
fn ended(child: &mut Child) -> std::io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Reads what a compiler says: the first message if it names a line as glslang does, else those that
/// are of errors.
fn rejected(program: &str, file: &str, said: &str) -> Rejected {
    let first = said.lines().find_map(|line| {
        let (line, message) = line
            .strip_prefix("ERROR: ")?
            .strip_prefix(file)?
            .strip_prefix(':')?
            .split_once(": ")?;
        Some((line.parse().ok()?, message.trim()))
    });
    if let Some((line, message)) = first {
        let message = format!("{program} says: {message}");
        return Rejected { line: Some(line), message };
    }
    let is_error = |line: &&str| line.contains("error") || line.contains("ERROR");
    let mut errors: Vec<&str> = said.lines().filter(is_error).take(5).collect();
    if errors.is_empty() {
        errors = said.lines().take(5).collect();
    }
    Rejected::of(format!("{program} does not compile it:\n  {}", errors.join("\n  ")))
}
