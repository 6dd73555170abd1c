//! Budgets of memory, and sizes in words.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_files::{MemoryBudget, default_memory, parse_size, size};

#[test]
fn what_exceeds_a_budget_is_refused_by_name() {
    let mut budget = MemoryBudget::new(100);
    budget.take(60, || "a part").unwrap();
    budget.allow(40, || "another").unwrap();
    let over = budget.take(41, || "the last part").unwrap_err();
    assert_eq!((over.needed, over.limit), (101, 100));
    assert!(over.to_string().contains("with the last part it takes"));
    // What was refused was not taken.
    assert_eq!(budget.left(), 40);
    assert!(budget.take(u64::MAX, || "all").is_err());
}

#[test]
fn sizes_are_read_and_written() {
    for (text, bytes) in [
        ("7", 7),
        ("4GiB", 4 << 30),
        ("512M", 512 << 20),
        ("2 GB", 2_000_000_000),
    ] {
        assert_eq!(parse_size(text), Ok(bytes));
    }
    for text in ["", "GiB", "0", "-1", "1.5GiB", "4XiB", "99999999999GiB"] {
        assert!(parse_size(text).is_err(), "{text}");
    }
    for (bytes, text) in [(1, "1 KiB"), (5 << 20, "5.0 MiB"), (64 << 30, "64 GiB")] {
        assert_eq!(size(bytes), text);
    }
    assert!(default_memory() > 0);
}
