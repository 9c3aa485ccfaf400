//! The option `--prune`.

use crate::dataset::{Dataset, Origin};

/// The option to search on fewer rows of large tables.
#[derive(clap::Args)]
pub(super) struct Pruning {
    /// Keep a single row, with the weight of all, where no output varies by more than this share of
    /// its range, as in --prune 0.01; validation keeps all rows
    #[arg(long, value_name = "SHARE", value_parser = share)]
    prune: Option<f64>,
}

impl Pruning {
    /// Prunes the dataset as asked for, and notes that in its origin.
    pub(super) fn applied_to(&self, mut dataset: Dataset) -> Dataset {
        if let Some(share) = self.prune {
            let rows = dataset.search.rows();
            dataset.prune_flat_regions(share, 0);
            let (kept, of) = (dataset.search.rows(), Box::new(dataset.origin));
            dataset.origin = Origin::Pruned { of, share, kept, rows };
        }
        dataset
    }
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.0..1.0).contains(&share) => Ok(share),
        _ => Err("write a share of the outputs' range from 0 to below 1, as in 0.01".into()),
    }
}
