//! microfacet
