//! `antumbra strategies`: every strategy, with its promise and all its settings; and help that names them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra::strategies::registry;
use common::{refuses, succeeds};

#[test]
fn every_strategy_is_listed_with_its_promise_and_all_its_settings() {
    let listed = succeeds(&["strategies"]);
    let words: Vec<&str> = listed.split_whitespace().collect();
    let listed_words = words.join(" ");
    for name in registry().names() {
        let strategy = registry().make(name).unwrap();
        let page = succeeds(&["strategies", name]);
        assert!(listed.contains(page.trim_end()), "{name}: {page}");
        assert!(page.starts_with(name), "{page}");
        let promise = match strategy.conservative() {
            true => "conservative",
            false => "aggressive",
        };
        assert!(page.contains(promise), "{page}");
        assert!(listed_words.contains(strategy.summary()), "{name}");
        // Wrapped anywhere, but in full.
        let page: Vec<&str> = page.split_whitespace().collect();
        let page = page.join(" ");
        for setting in strategy.settings() {
            let [range, value] = [setting.range.to_string(), setting.value.to_string()];
            for part in [setting.key, setting.meaning, &range, &value] {
                assert!(page.contains(part), "{name}: '{part}' is not in: {page}");
            }
        }
    }
    assert!(listed.contains("\nhorizon\n"), "{listed}");
    assert!(listed.lines().all(|line| line.chars().count() <= 110));
}

#[test]
fn columns_are_aligned() {
    let page = succeeds(&["strategies", "three-pass"]);
    let heading = page.lines().find(|line| line.starts_with("  setting"));
    let heading = heading.unwrap();
    let column = heading.find("range").unwrap();
    let table = page.lines().skip_while(|line| *line != heading).skip(1);
    for line in table {
        let before: String = line.chars().take(column).collect();
        assert!(before.ends_with("  "), "{line}");
        assert!(!line.chars().nth(column).unwrap().is_whitespace(), "{line}");
    }
}

#[test]
fn an_unknown_strategy_is_refused_with_the_known_ones() {
    refuses(
        &["strategies", "magic"],
        2,
        &["magic", "three-pass", "horizon"],
    );
}

#[test]
fn options_that_take_strategies_name_them() {
    for command in ["compare", "sweep", "render", "graph"] {
        let help = succeeds(&[command, "--help"]);
        let help: Vec<&str> = help.split_whitespace().collect();
        let help = help.join(" ");
        for words in [
            "none, frustum, ideal",
            "three-pass",
            "horizon",
            "antumbra strategies",
        ] {
            assert!(
                help.contains(words),
                "{command}: '{words}' is not in: {help}"
            );
        }
    }
}
