//! Antumbra.
