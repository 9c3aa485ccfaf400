//! Lists the files of `grammar/` and `grammar/gpu/`, which come with the program: to add one is to add a file.

use std::path::Path;
use std::{env, fs};

fn main() {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    let out = env::var("OUT_DIR").expect("cargo sets it");
    // The defaults come first.
    for (list, folder, first) in
        [("grammars", "grammar", "shader"), ("profiles", "grammar/gpu", "gcn")]
    {
        let folder = Path::new(&root).join(folder);
        println!("cargo::rerun-if-changed={}", folder.display());
        let files = fs::read_dir(&folder)
            .expect("the folder is there")
            .map(|file| file.expect("it is read").path());
        let mut files: Vec<_> =
            files.filter(|path| path.extension().is_some_and(|ron| ron == "ron")).collect();
        let name = |path: &Path| path.file_stem().expect("a file").to_string_lossy().into_owned();
        files.sort_by_key(|path| (name(path) != first, name(path)));
        let rows = files.iter().map(|path| format!("({:?}, include_str!({path:?})),", name(path)));
        let text = format!("&[{}]", rows.collect::<Vec<_>>().join("\n"));
        fs::write(Path::new(&out).join(format!("{list}.rs")), text)
            .expect("cargo's folder can be written");
    }
}
