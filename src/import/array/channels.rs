//! Which of an array's channels are outputs, and their names.

use super::{Array, Fault};
use crate::dataset::identifier_of;
use crate::printable::printable;
use crate::suggest::nearest;
use std::str::FromStr;

/// The name of an output, and the channel that it is: `scale=r`.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelName {
    /// The output's name.
    pub name: String,
    /// The channel's name in the file; `None` for the channel called `name` if each name without one is
    /// a channel's, else for the channel at the same place in the file as the name is among names.
    pub of: Option<String>,
}

/// The names of all outputs: `scale=r,bias=g` or `scale,bias`; empty for all channels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChannelNames(pub Vec<ChannelName>);

impl FromStr for ChannelNames {
    type Err = String;

    fn from_str(text: &str) -> Result<ChannelNames, String> {
        let explained = "write channels as in scale,bias or scale=r,bias=g";
        let channel = |text: &str| {
            let (name, of) = match text.split_once('=') {
                Some((name, of)) => (name.trim(), Some(of.trim())),
                None => (text.trim(), None),
            };
            if name.is_empty() || of == Some("") {
                return Err(format!("a channel has no name; {explained}"));
            }
            Ok(ChannelName { name: name.to_owned(), of: of.map(str::to_owned) })
        };
        text.split(',').map(channel).collect::<Result<_, _>>().map(ChannelNames)
    }
}

/// An output, and which channel it is.
#[derive(Debug, PartialEq)]
pub(super) struct Chosen {
    pub name: String,
    pub channel: usize,
}

/// Chooses an array's channels. Where none are named: all but an alpha that is 1 throughout. An output
/// that would be called as one of the `inputs` is called `r_out`, for example.
///
/// # Errors
/// No channel of a name; more names than channels; a channel twice.
pub(super) fn chosen(
    array: &Array,
    names: &ChannelNames,
    inputs: &[&str],
) -> Result<Vec<Chosen>, Fault> {
    let ChannelNames(names) = names;
    if names.is_empty() {
        return Ok(all(array, inputs));
    }
    let mut bare = names.iter().filter(|name| name.of.is_none());
    let by_name = bare.all(|bare| index_of(array, &bare.name).is_some());
    let mut chosen: Vec<Chosen> = Vec::new();
    for (place, ChannelName { name, of }) in names.iter().enumerate() {
        let channel = match of {
            Some(of) => index_of(array, of).ok_or_else(|| unknown(array, of))?,
            None if by_name => index_of(array, name).ok_or_else(|| unknown(array, name))?,
            None if place < array.channels.len() => place,
            None => return Err(unknown(array, name)),
        };
        if chosen.iter().any(|other| other.channel == channel) {
            let channel = printable(&array.channels[channel]).into_owned();
            let problem = format!("--channels names the channel {channel} twice");
            return Err(Fault::new(problem, "say which is which, as in scale=r,bias=g"));
        }
        chosen.push(Chosen { name: name.clone(), channel });
    }
    Ok(chosen)
}

fn all(array: &Array, inputs: &[&str]) -> Vec<Chosen> {
    let count = array.channels.len();
    let of = |channel: usize| array.values.iter().skip(channel).step_by(count);
    let is_opaque = |channel: usize| {
        count > 1 && array.channels[channel] == "a" && of(channel).all(|&value| value == 1.0)
    };
    let mut chosen: Vec<Chosen> = Vec::new();
    for channel in (0..count).filter(|&channel| !is_opaque(channel)) {
        let mut name = identifier_of(&array.channels[channel]);
        while inputs.contains(&&name[..]) || chosen.iter().any(|other| other.name == name) {
            name += "_out";
        }
        chosen.push(Chosen { name, channel });
    }
    chosen
}

fn index_of(array: &Array, name: &str) -> Option<usize> {
    let exact = array.channels.iter().position(|channel| channel == name);
    exact.or_else(|| array.channels.iter().position(|channel| channel.eq_ignore_ascii_case(name)))
}

fn unknown(array: &Array, name: &str) -> Fault {
    let near = nearest(name, array.channels.iter().map(String::as_str));
    let near = near.map(|near| format!(" (did you mean `{}`?)", printable(near)));
    let problem = format!("it has no channel `{}`{}", printable(name), near.unwrap_or_default());
    let channels: Vec<_> =
        array.channels.iter().take(12).map(|channel| printable(channel)).collect();
    Fault::new(problem, format!("its channels are {}", channels.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(alpha: f32) -> Array {
        Array {
            size: vec![2],
            channels: Array::unnamed_channels(4),
            values: vec![0.1, 0.2, 0.3, 1.0, 0.4, 0.5, 0.6, alpha],
            ..Array::default()
        }
    }

    #[test]
    fn channels_are_chosen_by_place_or_by_name() {
        let of = |text: &str| {
            let chosen = chosen(&picture(1.0), &text.parse().unwrap(), &[]);
            chosen.map(|chosen| {
                chosen.into_iter().map(|one| (one.name, one.channel)).collect::<Vec<_>>()
            })
        };
        let pairs = |pairs: &[(&str, usize)]| -> Vec<(String, usize)> {
            pairs.iter().map(|(name, channel)| ((*name).to_owned(), *channel)).collect()
        };
        assert_eq!(of("scale,bias").unwrap(), pairs(&[("scale", 0), ("bias", 1)]));
        assert_eq!(of("a,b,c").unwrap(), pairs(&[("a", 0), ("b", 1), ("c", 2)]));
        assert_eq!(of("g,r").unwrap(), pairs(&[("g", 1), ("r", 0)]));
        assert_eq!(of("scale=B,bias=g").unwrap(), pairs(&[("scale", 2), ("bias", 1)]));
        for text in ["scale=q", "v,w,x,y,z", "r,scale=r", "r,r", "x=g,y"] {
            assert!(of(text).is_err(), "{text}");
        }
        for text in ["", "a,,b", "a=", "=r"] {
            assert!(text.parse::<ChannelNames>().is_err(), "{text}");
        }
    }

    #[test]
    fn an_opaque_alpha_is_left_out_and_names_of_inputs_are_not_taken() {
        let names = |alpha| -> Vec<String> {
            let chosen = chosen(&picture(alpha), &ChannelNames::default(), &["r", "g"]).unwrap();
            chosen.into_iter().map(|one| one.name).collect()
        };
        assert_eq!(names(1.0), ["r_out", "g_out", "b"]);
        assert_eq!(names(0.5), ["r_out", "g_out", "b", "a"]);
    }
}
