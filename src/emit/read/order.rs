//! Where parameters and results stand, and where the comments say that they do.

use super::ReadBack;

impl ReadBack {
    /// Says how the results stand in another order than the comments say: `-> scale, bias`, or
    /// `let: return.x = …`. None if they do not.
    pub fn misplaced(&self) -> Option<String> {
        let results = || self.names.outputs.iter().zip(&self.places);
        // What leaves by parameters has their names.
        let returned: Vec<&String> = results()
            .filter(|(_, place)| place.starts_with("return"))
            .map(|(name, _)| name)
            .collect();
        let stated: Vec<&String> = self.contract.outputs().iter().collect();
        let same =
            returned.len() == stated.len() && stated.iter().all(|name| returned.contains(name));
        if same && returned != stated {
            let [found, stated] = [returned, stated]
                .map(|names| names.iter().map(|name| name.as_str()).collect::<Vec<_>>().join(", "));
            return Some(format!("it returns {found}, where its comment says {stated}"));
        }
        if let Some([found, stated]) = self.other_order() {
            return Some(format!("its parameters are {found}, where its comment says {stated}"));
        }
        // A column's name has no point.
        let (name, place) = results().find(|(name, place)| name.contains('.') && name != place)?;
        Some(format!("`{name}` of its comment stands where `{place}` is"))
    }

    /// Returns the parameters as they stand and as the comments say, if that is another order: of
    /// the line that says how it is called, or else of the columns.
    fn other_order(&self) -> Option<[String; 2]> {
        let stated = self.contract.parameters();
        let columns = [self.contract.inputs(), self.contract.outputs()].concat();
        let (found, stated) = match stated.is_empty() {
            // Columns in their places are the parameters, or their names.
            true => {
                let found: Vec<&String> = self.parameters.iter().collect();
                let restored = |name: &&String| {
                    let written = self.written.inputs.iter().zip(&self.names.inputs);
                    let of_input = written.into_iter().find(|(written, _)| written == name);
                    of_input.map_or((*name).clone(), |(_, column)| column.clone())
                };
                (found.iter().map(restored).collect::<Vec<_>>(), columns.as_slice())
            }
            false => (self.parameters.clone(), stated),
        };
        let common = |names: &[String], others: &[String]| -> Vec<String> {
            names.iter().filter(|name| others.contains(name)).cloned().collect()
        };
        let [found, stated] = [common(&found, stated), common(stated, &found)];
        (found != stated).then(|| [found, stated].map(|names| names.join(", ")))
    }
}
