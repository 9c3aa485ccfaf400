//! Which dimensions of an array are axes, and whether the last are channels.

use super::error::times;
use super::{Fault, MOST_TEXELS, MOST_VALUES};

/// The most channels that a last dimension is taken for without being told. By hand: textures have
/// no more, and axes of tables seldom as few texels.
const MOST_CHANNELS_UNTOLD: usize = 4;

/// Texels along each axis, the first fastest, and channels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub size: Vec<usize>,
    pub channels: usize,
}

impl Shape {
    /// Checks a size before anything of its extent is allocated.
    ///
    /// # Errors
    /// No texels; more than are read.
    pub(super) fn new(size: Vec<usize>, channels: usize) -> Result<Shape, Fault> {
        if size.contains(&0) || channels == 0 {
            return Err(Fault::NoTexels { size });
        }
        let texels = size.iter().try_fold(1usize, |product, &along| product.checked_mul(along));
        let values = texels.and_then(|texels| texels.checked_mul(channels));
        match (texels, values) {
            (Some(..=MOST_TEXELS), Some(..=MOST_VALUES)) => Ok(Shape { size, channels }),
            _ => Err(Fault::TooLarge { size, channels }),
        }
    }

    /// Reads dimensions, the slowest first, as arrays in C and numpy have them. The last one is
    /// that of channels if it is one more than there are `axes`; not told how many there are, if it
    /// is at most four. Dimensions of 1 count for nothing, but that a last one is one channel.
    ///
    /// # Errors
    /// As [`Shape::new`]; dimensions that do not fit the axes.
    pub(super) fn of_dimensions(dimensions: &[usize], axes: Option<usize>) -> Result<Shape, Fault> {
        let mut size: Vec<usize> = dimensions.iter().copied().filter(|&along| along != 1).collect();
        let last_is_small = size.last().is_some_and(|&last| last <= MOST_CHANNELS_UNTOLD);
        let has_channels = match axes {
            Some(axes) if axes > 0 && size.len() == axes => false,
            Some(axes) if axes > 0 && size.len() == axes + 1 => true,
            None => size.len() > 1 && last_is_small && dimensions.last() != Some(&1),
            Some(axes) => {
                let axes = if axes == 1 { "1 axis".into() } else { format!("{axes} axes") };
                let problem =
                    format!("its dimensions are {}, and --axes names {axes}", times(dimensions));
                let advice =
                    "name as many as it has, channels apart, or give its --size, as in 64x64x2";
                return Err(Fault::new(problem, advice));
            }
        };
        let channels = if has_channels { size.pop().unwrap_or(1) } else { 1 };
        size.reverse();
        Shape::new(size, channels)
    }

    /// Reads what `--size` says: texels along x, y, z, then channels.
    ///
    /// # Errors
    /// As [`Shape::of_dimensions`].
    pub(super) fn of_size(size: &[usize], axes: Option<usize>) -> Result<Shape, Fault> {
        let used: Vec<usize> = size.iter().copied().filter(|&along| along != 1).collect();
        let flat = Shape::of_dimensions(size, axes)?;
        let mut texels = used;
        texels.truncate(flat.size.len());
        Shape::new(texels, flat.channels)
    }

    /// Returns the number of values of all texels and channels.
    pub(super) fn values(&self) -> usize {
        self.size.iter().product::<usize>() * self.channels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(size: &[usize], channels: usize) -> Shape {
        Shape { size: size.to_vec(), channels }
    }

    #[test]
    fn the_last_dimension_is_that_of_channels_where_it_can_be() {
        let of = |dimensions: &[usize], axes| Shape::of_dimensions(dimensions, axes).unwrap();
        assert_eq!(of(&[32, 64, 2], None), shape(&[64, 32], 2));
        assert_eq!(of(&[32, 64], None), shape(&[64, 32], 1));
        assert_eq!(of(&[64], None), shape(&[64], 1));
        assert_eq!(of(&[4], None), shape(&[4], 1));
        assert_eq!(of(&[64, 3], None), shape(&[64], 3));
        assert_eq!(of(&[64, 3], Some(2)), shape(&[3, 64], 1));
        assert_eq!(of(&[16, 8, 6], Some(2)), shape(&[8, 16], 6));
        assert_eq!(of(&[1, 32, 64, 1], None), shape(&[64, 32], 1));
        assert_eq!(of(&[4, 3, 1], None), shape(&[3, 4], 1));
        assert!(Shape::of_dimensions(&[16, 8, 6], Some(1)).is_err());
        assert!(Shape::of_dimensions(&[16], Some(0)).is_err());
        assert_eq!(Shape::of_size(&[64, 32, 2], None).unwrap(), shape(&[64, 32], 2));
        assert_eq!(Shape::of_size(&[8, 16, 32], Some(3)).unwrap(), shape(&[8, 16, 32], 1));
    }

    #[test]
    fn sizes_are_bounded_before_anything_is_allocated() {
        let refused = |size: &[usize], channels| Shape::new(size.to_vec(), channels).unwrap_err();
        assert!(Shape::new(vec![4096, 4096], 4).is_ok());
        assert!(matches!(refused(&[16384, 16384], 1), Fault::TooLarge { .. }));
        assert!(matches!(refused(&[4096, 4096], 5), Fault::TooLarge { .. }));
        assert!(matches!(refused(&[usize::MAX, 3], 1), Fault::TooLarge { .. }));
        assert!(matches!(refused(&[64, 0], 1), Fault::NoTexels { .. }));
        assert!(matches!(refused(&[64], 0), Fault::NoTexels { .. }));
    }
}
