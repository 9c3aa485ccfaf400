//! What is in a checkpoint, but for what it begins and ends with: what is read is written and read again,
//! and a search of the usual settings goes on with it.
#![no_main]

use lgp::cost::Profile;
use lgp::dataset::{Column, Dataset, Split};
use lgp::grammar::Grammar;
use lgp::search::{Problem, Search, Settings};
use libfuzzer_sys::fuzz_target;
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;

const FILE: &str = "checkpoint.bin";

struct Bench {
    folder: TempDir,
    dataset: Dataset,
    grammar: Grammar,
    profile: Profile,
    settings: Settings,
    /// What checkpoints of the dataset begin with.
    start: Vec<u8>,
}

static BENCH: LazyLock<Bench> = LazyLock::new(|| {
    let memory = Path::new("/dev/shm");
    let folder = if memory.is_dir() { TempDir::new_in(memory) } else { TempDir::new() };
    let folder = folder.expect("a folder can be made");
    let column = |name: &str| Column { name: name.into(), unit: "1".into(), domain: [0.0, 1.0] };
    let values: Vec<f32> = (0..8).map(|i| i as f32 / 7.0).collect();
    let squares = values.iter().map(|x| x * x).collect();
    let split = Split { columns: vec![values, squares], ..Split::default() };
    let dataset = Dataset {
        name: "square".into(),
        recipe: String::new(),
        inputs: vec![column("x")],
        outputs: vec![column("y")],
        search: split.clone(),
        validation: split,
    };
    let settings = Settings { islands: 1, candidates: 8, max_cost: 4.0, ..Settings::default() };
    let grammar = Grammar::find("polynomial").expect("built in");
    let profile = Profile::find("gcn").expect("built in");
    let mut search = Search::new(settings.clone());
    search.advance(&Problem::new(&dataset, &grammar, &profile, &settings));
    search.save(folder.path(), &dataset).expect("there is room");
    let bytes = std::fs::read(folder.path().join(FILE)).expect("it was just written");
    let hash = dataset.hash();
    let found = bytes.windows(hash.len()).position(|part| part == hash.as_bytes());
    let start = bytes[..found.expect("it says of which data it is") + hash.len()].to_vec();
    if let Some(seed) = std::env::var_os("LGP_FUZZ_SEED") {
        std::fs::write(seed, &bytes[start.len()..bytes.len() - 32]).expect("there is room");
    }
    Bench { folder, dataset, grammar, profile, settings, start }
});

fuzz_target!(|content: &[u8]| {
    let Bench { folder, dataset, grammar, profile, settings, start } = &*BENCH;
    let path = folder.path().join(FILE);
    let mut bytes = [start, content].concat();
    let checksum = blake3::hash(&bytes);
    bytes.extend_from_slice(checksum.as_bytes());
    std::fs::write(&path, &bytes).expect("there is room");
    let Ok(mut search) = Search::load(folder.path(), dataset) else { return };
    search.save(folder.path(), dataset).expect("there is room");
    let again = Search::load(folder.path(), dataset).expect("what was written can be read");
    assert_eq!(again.generation(), search.generation());
    if search.settings() == settings {
        search.advance(&Problem::new(dataset, grammar, profile, settings));
    }
});
