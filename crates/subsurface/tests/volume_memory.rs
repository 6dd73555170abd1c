//! A volume file larger than the brick budget does not stay in memory beyond the budget. The test runs alone in its
//! process, because it reads the memory that the process holds from the system.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod volume_rule;

use std::path::Path;
use std::sync::Arc;

use antumbra_subsurface::{Axis, BrickCache, VolumeFile, write_volume};
use volume_rule::{Rule, sample_at};

/// Bytes of a mapped file that are resident in this process.
fn mapped(path: &Path) -> usize {
    let maps = std::fs::read_to_string("/proc/self/smaps").unwrap();
    let path = path.to_str().unwrap();
    let ours = maps.lines().skip_while(|line| !line.ends_with(path));
    let line = (ours.skip(1)).find(|line| line.starts_with("Rss:"));
    let kilobytes = line.unwrap().split_whitespace().nth(1).unwrap();
    kilobytes.parse::<usize>().unwrap() << 10
}

#[test]
fn a_file_ten_times_the_budget_stays_within_it() {
    let rule = Rule::new([256, 256, 320], 32);
    let all = rule.layout.total_bytes().unwrap() as usize;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.volume");
    write_volume(&path, "large", &rule, &mut |_, _| {}).unwrap();
    let budget = all / 10;
    let mut bricks = BrickCache::new(Arc::new(VolumeFile::open(&path).unwrap()), budget).unwrap();
    let mut samples = vec![0; 256 * 256];
    for z in 0..320 {
        (bricks.section(Axis::Time, z, [0..256, 0..256], &mut samples)).unwrap();
        let places = (0..256).flat_map(|y| (0..256).map(move |x| [x, y, z]));
        assert!(
            samples.iter().copied().eq(places.map(sample_at)),
            "time {z}"
        );
        assert!(bricks.stats().bytes <= budget);
    }
    assert!(bricks.stats().peak_bytes <= budget);
    // What was read since pages were last returned, and the pages that the system maps around it.
    let held = mapped(&path);
    assert!(held <= 4 << 20, "{held} bytes of the file stayed in memory");
}
