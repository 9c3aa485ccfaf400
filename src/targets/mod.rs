//! Ground truths to search formulas for.
