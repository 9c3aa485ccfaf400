//! A run's folder: `run.ron`, a byte 0, `front.json`. What is read is written and read again, and its
//! formulas evaluate and are written in every language.
#![no_main]

use lgp::emit::{Language, Snippet, emit};
use lgp::fit::Measure;
use lgp::search::{Front, Run};
use lgp::stability::Questions;
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;
use tempfile::TempDir;

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    let memory = std::path::Path::new("/dev/shm");
    let folder = if memory.is_dir() { TempDir::new_in(memory) } else { TempDir::new() };
    folder.expect("a folder can be made")
});

fuzz_target!(|content: &[u8]| {
    let Some(middle) = content.iter().position(|&byte| byte == 0) else { return };
    let folder = FOLDER.path();
    std::fs::write(folder.join("run.ron"), &content[..middle]).expect("there is room");
    std::fs::write(folder.join("front.json"), &content[middle + 1..]).expect("there is room");
    let Ok(run) = Run::load(folder) else { return };
    run.save(folder).expect("there is room");
    let again = Run::load(folder).expect("what was written can be read");
    assert_eq!(format!("{again:?}"), format!("{run:?}"));
    let names = run.names();
    let _ = run.requirements();
    let Ok(front) = Front::load(&folder.join("front.json"), &names, Measure::Rmse) else { return };
    let json = front.to_json(&names);
    std::fs::write(folder.join("front.json"), &json).expect("there is room");
    let again = Front::load(&folder.join("front.json"), &names, Measure::Rmse);
    assert_eq!(again.expect("what was written can be read").to_json(&names), json);
    let _ = front.knee();
    let questions = Questions::of(&run.inputs, &run.outputs);
    for member in &front.members {
        assert_eq!(member.program.inputs, questions.domain.len());
        let inputs: Vec<f32> = questions.domain.iter().map(|side| side.low()).collect();
        assert_eq!(member.program.evaluate(&inputs).len(), names.outputs.len());
        let header = [member.formula.clone()];
        let snippet = Snippet {
            program: &member.program,
            names: &names,
            function: &run.name,
            header: &header,
        };
        for &language in Language::ALL {
            emit(language, &snippet);
        }
    }
});
