//! The three exports of one small plan, compared as text.

use antumbra_graph::{Graph, Plan, PlanFormat};

use crate::declare::{bytes, colour, compile, compute, draw, wait};

/// A graph with a sync point, an edge to the previous frame, a pruned pass and an import.
fn example() -> Plan {
    let mut g = Graph::new("example");
    let screen = g.import_texture("screen", colour());
    let counts = g.buffer("counts", bytes(64));
    let now = compute(&mut g, "count", counts, &[counts.previous()]);
    let decision = g.host::<u32>("decision");
    let _ = wait(&mut g, "decide", &[now], decision);
    let verdict = g.host::<u32>("verdict");
    let mut node = g.host_node("judge \"all\"");
    node.read_back(now).group("cull");
    let verdict = node.write(verdict);
    node.run(|_| Ok(()));
    g.output(verdict);
    draw(&mut g, "shade", screen, &[]);
    compile(g)
}

#[test]
fn dot() {
    let expected = r#"digraph "example" {
  rankdir=LR;
  node [fontname="sans-serif"];
  p0 [shape=box, label="count\ncompute"];
  p1 [shape=box, label="decide\nhost\npruned", color=gray, fontcolor=gray];
  p2 [shape=box, label="judge \"all\"\nhost, cull\nsync point", color=red, peripheries=2];
  p3 [shape=box, label="shade\nraster"];
  r0 [shape=ellipse, label="screen\n64x64 Rgba8Unorm\nimported"];
  r1 [shape=ellipse, label="counts\n64 bytes"];
  r2 [shape=ellipse, label="decision", color=gray, fontcolor=gray];
  r3 [shape=ellipse, label="verdict\noutput"];
  p0 -> r1 [label="storage (write)"];
  r1 -> p0 [label="storage (read)", style=dashed];
  r1 -> p1 [label="read back"];
  p1 -> r2 [label="write"];
  r1 -> p2 [label="read back"];
  p2 -> r3 [label="write"];
  p3 -> r0 [label="colour"];
}
"#;
    assert_eq!(example().export(PlanFormat::Dot), expected);
}

#[test]
fn mermaid() {
    let expected = r#"flowchart LR
  p0["count<br/>compute"]
  p1["decide<br/>host<br/>pruned"]:::pruned
  p2[["judge &quot;all&quot;<br/>host, cull<br/>sync point"]]:::sync
  p3["shade<br/>raster"]
  r0(["screen<br/>64x64 Rgba8Unorm<br/>imported"])
  r1(["counts<br/>64 bytes"])
  r2(["decision"]):::pruned
  r3(["verdict<br/>output"])
  p0 -->|"storage (write)"| r1
  r1 -.->|"storage (read)"| p0
  r1 -->|"read back"| p1
  p1 -->|"write"| r2
  r1 -->|"read back"| p2
  p2 -->|"write"| r3
  p3 -->|"colour"| r0
  classDef sync stroke:#c00,stroke-width:3px
  classDef pruned color:#999,stroke:#999,stroke-dasharray:2
"#;
    assert_eq!(example().export(PlanFormat::Mermaid), expected);
}

#[test]
fn json() {
    let picture: serde_json::Value =
        serde_json::from_str(&example().export(PlanFormat::Json)).unwrap();
    assert_eq!(picture["graph"], "example");
    assert_eq!(picture["sync_points"], 1);
    assert_eq!(
        picture["passes"][2],
        serde_json::json!({
            "name": "judge \"all\"", "kind": "host", "group": "cull", "order": 2,
            "sync_point": true, "pruned": false
        })
    );
    assert_eq!(picture["passes"][1]["pruned"], true);
    assert_eq!(
        picture["resources"][1],
        serde_json::json!({
            "name": "counts", "kind": "buffer", "shape": "64 bytes", "imported": false,
            "output": false, "history": true, "used": true, "objects": [0, 1]
        })
    );
    assert_eq!(
        picture["edges"][1],
        serde_json::json!({
            "pass": 0, "resource": 1, "access": "storage (read)", "writes": false, "history": true
        })
    );
}

#[test]
fn shared_objects_are_noted() {
    let mut g = Graph::new("shared");
    let mut last = g.texture("0", colour());
    last = draw(&mut g, "draw 0", last, &[]);
    for n in 1..3 {
        let next = g.texture(format!("{n}"), colour());
        last = draw(&mut g, &format!("draw {n}"), next, &[last]);
    }
    let screen = g.import_texture("screen", colour());
    draw(&mut g, "present", screen, &[last]);
    let plan = compile(g);
    assert!(plan.export(PlanFormat::Dot).contains("one texture: 0, 2"));
    assert!(
        plan.export(PlanFormat::Mermaid)
            .contains("one texture: 0, 2")
    );
}
