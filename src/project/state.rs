//! What a projection under way has found, in memory and as a file.
//!
//! A line of text says which program wrote the file; then come the key of the projection and the
//! state in postcard's encoding, and a checksum of all before it.

use super::Error;
use super::bench::Point;
use serde::{Deserialize, Serialize};

/// The layout's number, to be raised with every change of what is serialised.
const MAGIC: &str = "LGPPROJECT1";

/// What a projection under way has found so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// The stage that is being worked on.
    pub(super) stage: u32,
    /// By group, what the stages before it have left.
    pub(super) current: Vec<Option<Point>>,
    /// By group, what was there before any pull; empty until then.
    pub(super) alone: Vec<Option<Point>>,
    /// What this stage has found.
    pub(super) fresh: Vec<(u32, Option<Point>)>,
    /// The largest step of the present sweep or comparison, in spreads.
    pub(super) moved: f64,
    /// True if the last sweep or comparison has changed nothing.
    pub(super) is_settled: bool,
}

impl State {
    pub(super) fn new(groups: usize) -> State {
        State {
            stage: 0,
            current: vec![None; groups],
            alone: Vec::new(),
            fresh: Vec::new(),
            moved: 0.0,
            is_settled: false,
        }
    }

    pub(super) fn to_bytes(&self, key: &str) -> Vec<u8> {
        let mut bytes = first_line().into_bytes();
        bytes.extend(postcard::to_allocvec(&(key, self)).expect("plain data"));
        let checksum = blake3::hash(&bytes);
        bytes.extend(checksum.as_bytes());
        bytes
    }

    /// Reads what [`State::to_bytes`] wrote of `groups` groups of `parameters` parameters.
    pub(super) fn from_bytes(
        bytes: &[u8],
        key: &str,
        groups: usize,
        parameters: usize,
    ) -> Result<State, Error> {
        let refused = |problem| Error::State { problem };
        let (content, checksum) =
            bytes.split_last_chunk::<32>().ok_or(refused("no projection's state"))?;
        if !content.starts_with(b"LGPPROJECT") {
            return Err(refused("no projection's state"));
        }
        if blake3::hash(content).as_bytes() != checksum {
            return Err(refused("damaged"));
        }
        let body = content.strip_prefix(first_line().as_bytes()).ok_or(Error::OtherState)?;
        let (own, state): (String, State) =
            postcard::from_bytes(body).map_err(|_| refused("damaged"))?;
        if own != key {
            return Err(Error::OtherState);
        }
        let is_whole = |point: &Point| point.values.len() == parameters;
        let points = state.current.iter().chain(&state.alone).flatten();
        let fresh = state.fresh.iter();
        let is_known = state.current.len() == groups
            && (state.alone.is_empty() || state.alone.len() == groups)
            && points.chain(fresh.clone().filter_map(|(_, point)| point.as_ref())).all(is_whole)
            && fresh.map(|(group, _)| *group as usize).all(|group| group < groups);
        if is_known { Ok(state) } else { Err(refused("not what a projection writes")) }
    }
}

fn first_line() -> String {
    format!("{MAGIC} lgp {}\n", env!("CARGO_PKG_VERSION"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_read_as_it_was_or_refused() {
        let point = Point { values: vec![1.0, 2.0], square: 0.5 };
        let mut state = State::new(3);
        state.current[1] = Some(point.clone());
        state.fresh = vec![(2, None), (0, Some(point))];
        let bytes = state.to_bytes("key");
        assert_eq!(State::from_bytes(&bytes, "key", 3, 2).unwrap(), state);
        let other = |key, groups, parameters| State::from_bytes(&bytes, key, groups, parameters);
        assert!(matches!(other("kez", 3, 2), Err(Error::OtherState)));
        assert!(matches!(other("key", 2, 2), Err(Error::State { .. })));
        assert!(matches!(other("key", 3, 1), Err(Error::State { .. })));
        for place in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[place] ^= 1;
            assert!(State::from_bytes(&damaged, "key", 3, 2).is_err(), "{place}");
            assert!(State::from_bytes(&bytes[..place], "key", 3, 2).is_err(), "{place}");
        }
    }
}
