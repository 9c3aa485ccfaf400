//! A run's folder: `run.ron`, a byte 0, `front.json`. What is read is written and read again, and its
//! formulas evaluate and are written in every language.
#![no_main]

use lgp::emit::{Language, Snippet, emit};
use lgp::fit::Measure;
use lgp::run::Run;
use lgp::search::Front;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|content: &[u8]| {
    let Some(middle) = content.iter().position(|&byte| byte == 0) else { return };
    let text = |bytes| std::str::from_utf8(bytes).ok();
    let (Some(ron), Some(json)) = (text(&content[..middle]), text(&content[middle + 1..])) else {
        return;
    };
    let Ok(run) = Run::from_ron(ron) else { return };
    let again = Run::from_ron(&run.to_ron()).expect("what was written can be read");
    assert_eq!(format!("{again:?}"), format!("{run:?}"));
    let names = run.names();
    let _ = (run.requirements(), run.grammar(), run.profile());
    let path = Path::new("front.json");
    let Ok(front) = Front::parse(path, json, &run, Measure::Rmse) else { return };
    let written = front.to_json(&names);
    let again = Front::parse(path, &written, &run, Measure::Rmse);
    assert_eq!(again.expect("what was written can be read").to_json(&names), written);
    let _ = front.knee();
    let questions = run.questions();
    for member in &front.members {
        assert_eq!(member.program.inputs, questions.domain.len());
        let inputs: Vec<f32> = questions.domain.iter().map(|side| side.low()).collect();
        assert_eq!(member.program.evaluate(&inputs).len(), names.outputs.len());
        let header = [member.formula.clone()];
        let snippet = Snippet::new(&member.program, &names, &run.name).header(&header);
        for &language in Language::ALL {
            emit(language, &snippet);
        }
    }
});
