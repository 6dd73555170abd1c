//! Formats numbers and strings for people: few digits, the same number of them everywhere, and no control characters from file contents.

pub(crate) use antumbra_files::words::{clean, short};

/// Milliseconds with three significant digits or so: `0.042`, `1.25`, `16.7`, `250`.
pub(crate) fn milliseconds(ms: f64) -> String {
    match ms.abs() {
        m if m < 1.0 => format!("{ms:.3}"),
        m if m < 9.995 => format!("{ms:.2}"),
        m if m < 99.95 => format!("{ms:.1}"),
        _ => format!("{ms:.0}"),
    }
}

/// A percentage without its sign, two significant digits below 10: `0`, `0.012`, `1.3`, `25`.
pub(crate) fn percent(percent: f64) -> String {
    match percent.abs() {
        0.0 => "0".to_owned(),
        p if p < 1e-4 => format!("{percent:.0e}"),
        p if p < 0.0995 => {
            // The place of the second significant digit.
            let places = (1.0 - p.log10().floor()) as usize;
            format!("{percent:.places$}")
        }
        p if p < 0.995 => format!("{percent:.2}"),
        p if p < 9.95 => format!("{percent:.1}"),
        _ => format!("{percent:.0}"),
    }
}

/// How many times as fast: `0.85`, `3.4`, `120`.
pub(crate) fn factor(factor: f64) -> String {
    match factor.abs() {
        f if f < 1.995 => format!("{factor:.2}"),
        f if f < 9.95 => format!("{factor:.1}"),
        _ => format!("{factor:.0}"),
    }
}

/// A factor in a column of factors, with one more digit than [`factor`]: `0.85`, `3.42`, `12.3`, `120`.
pub(crate) fn ratio(factor: f64) -> String {
    match factor.abs() {
        f if f < 9.995 => format!("{factor:.2}"),
        f if f < 99.95 => format!("{factor:.1}"),
        _ => format!("{factor:.0}"),
    }
}

/// A mean count: without decimals from 100 on, grouped by threes; below with one decimal, or none if it is whole.
pub(crate) fn count(count: f64) -> String {
    if count.abs() < 99.95 && count.fract().abs() >= 0.05 {
        return format!("{count:.1}");
    }
    let digits = format!("{:.0}", count.abs());
    let mut grouped = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(' ');
        }
        grouped.push(digit);
    }
    if count <= -0.5 {
        format!("-{grouped}")
    } else {
        grouped
    }
}

/// A FLIP difference: `0` for equal images, else with four decimals, or as a power of ten where they would be zeros.
pub(crate) fn flip(flip: f64) -> String {
    match flip.abs() {
        0.0 => "0".to_owned(),
        f if f < 5e-5 => format!("{flip:.0e}"),
        _ => format!("{flip:.4}"),
    }
}

/// A number and its noun, in the plural but for exactly one.
pub(crate) fn plural(n: u64, noun: &str) -> String {
    let number = count(n as f64);
    match (n, noun.strip_suffix('y')) {
        (1, _) => format!("1 {noun}"),
        (_, Some(stem)) => format!("{number} {stem}ies"),
        (_, None) => format!("{number} {noun}s"),
    }
}

/// A length with at most four significant digits: `0.064`, `12.35`, `4e-7`.
pub(crate) fn metres(metres: f64) -> String {
    let rounded = format!("{metres:.3e}");
    match (rounded.parse::<f64>(), metres.abs()) {
        (Ok(rounded), 0.0 | 1e-4..1e9) => rounded.to_string(),
        (Ok(rounded), _) => format!("{rounded:e}"),
        (Err(_), _) => rounded,
    }
}

/// A number without trailing zeros: `0.5`, `2`, `0.001`.
pub(crate) fn trimmed(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}
