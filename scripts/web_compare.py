#!/usr/bin/env python3
"""Compares what a page reports with what the same program reports without a browser.

    scripts/web_compare.py PAGE NATIVE

Both must name the same cases, and every outcome must be the same to the letter, with one exception: wgpu 30 hands no query set to a browser's passes, so that the self-test finds occlusion
queries wrong there. What then counts in another way must still count the same, and what falls back to `frustum` must have no wrong pixel. Nothing may be refused, and every shader that browsers can have must be part of a pipeline.
Exit status: 0 the same; 1 they differ, and each difference is printed.
"""

import json
import re
import sys

NO_QUERIES = "occlusion queries"


def does_without_queries(found, expected):
    """Whether a page's outcome is right, given that it has no occlusion queries."""
    drawn, _, instead = found.partition("; instead: ")
    if f"since the driver gets {NO_QUERIES} wrong" not in instead:
        return False
    if instead.startswith("Counting"):
        return drawn == expected
    return instead.startswith("Frustum") and set(re.findall(r"(\d+) wrong", drawn)) == {"0"}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    page, native = (json.load(open(path)) for path in sys.argv[1:])
    wrong, same, without_queries = [], 0, 0
    print(f"page: {page['adapter'].strip()}; native: {native['adapter']}")
    if [device["device"] for device in page["devices"]] != [device["device"] for device in native["devices"]]:
        sys.exit("the devices differ")
    for on_page, natively in zip(page["devices"], native["devices"]):
        device = on_page["device"]
        for kind in ("shaders", "self_test", "frames"):
            expected = {case["name"]: case["outcome"] for case in natively[kind]}
            found = {case["name"]: case["outcome"] for case in on_page[kind]}
            if not found or found.keys() != expected.keys():
                wrong.append(f"{device}, {kind}: not the same cases: {sorted(found.keys() ^ expected.keys())}")
            for name in found.keys() & expected.keys():
                refused = [words for words in (found[name], expected[name]) if words.startswith("refused")]
                if refused:
                    wrong.append(f"{device}, {name}: {refused[0]}")
                elif found[name] == expected[name]:
                    same += 1
                elif kind == "self_test" and name.startswith(NO_QUERIES):
                    without_queries += 1
                elif does_without_queries(found[name], expected[name]):
                    without_queries += 1
                else:
                    wrong.append(f"{device}, {name}:\n    page:   {found[name]}\n    native: {expected[name]}")
    for report, where in ((page, "page"), (native, "native")):
        # The device with features takes every plan.
        for job in report["devices"][-1]["without_pipeline"]:
            wrong.append(f"{where}: no pipeline was made of the shader {job}")
    print("\n".join(wrong))
    shaders = sum(case["outcome"] == "accepted" for case in page["devices"][-1]["shaders"])
    waits = sum(case["outcome"].startswith("waits") for device in page["devices"] for case in device["frames"])
    print(f"{shaders} shaders taken; {same} cases the same, {waits} of them refused since they wait; {without_queries} without queries; {len(wrong)} wrong")
    sys.exit(bool(wrong))


main()
