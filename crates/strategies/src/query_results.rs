//! Hardware query results in the bytes of a buffer.

/// Whether each query found a visible sample. `bytes`: a u64 a query.
pub(crate) fn query_results(bytes: &[u8]) -> impl Iterator<Item = bool> + '_ {
    // Boolean by contract, though some drivers count samples.
    let results = bytes.as_chunks::<8>().0.iter();
    results.map(|result| *result != [0; 8])
}
