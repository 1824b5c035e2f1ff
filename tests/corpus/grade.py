#!/usr/bin/env python3
"""Grades the meshes of the public IGES corpus with grade_mesh, and OpenCASCADE's deviation on the same files.

usage: tests/corpus/grade.py [--corpus DIR] [--program grade_mesh] [--only TEXT] [--prove] [--out FILE.jsonl] [--slow SECONDS]

Each file is meshed at the deflection (mm) and angle (0.5 rad) of OpenCASCADE's reference line (occt_reference.jsonl), whose
"dev" is what sampling found there. Prints the sums that docs/results.md quotes.
"""
import argparse, json, math, os, statistics, subprocess, sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corpus", type=Path, default=Path(os.environ.get("TRIMLOOP_CORPUS", ROOT.parent / "shared" / "corpus")))
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "dev" / "tests" / "grade_mesh")
    parser.add_argument("--only", default="")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "grade.jsonl")
    parser.add_argument("--prove", action="store_true", help="let the mesher prove its bounds")
    parser.add_argument("--slow", type=float, default=120, help="seconds for one file")
    args = parser.parse_args()
    rows, late = [], []
    for line in (args.corpus / "occt_reference.jsonl").read_text().splitlines():
        ref = json.loads(line)
        if not ref["path"].startswith("iges/") or args.only not in ref["path"] or not ref.get("defl"):
            continue
        try:
            done = subprocess.run([args.program, args.corpus / ref["path"], repr(ref["defl"])] + (["28.6478897565", "prove"] if args.prove else []), stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, timeout=args.slow)
            row = json.loads(done.stdout)
        except (subprocess.TimeoutExpired, ValueError) as problem:
            late.append(f"{ref['path']}: {type(problem).__name__}")
            continue
        row.update(path=ref["path"], occt_triangles=ref.get("triangles"), occt_ms=1e3 * (ref.get("t_mesh") or 0),
                   occt_worst=ref["dev"] / ref["defl"] if ref.get("dev") else None)
        rows.append(row)
    args.out.write_text("".join(json.dumps(r) + "\n" for r in rows))
    total = lambda key: sum(r[key] for r in rows)
    with_ratio = [r for r in rows if r["median"] > 0]
    print(f"files {len(rows)}, without a figure {late}")
    for key in ("faces", "failed", "ok_empty", "proven", "not_met", "triangles", "judged", "broken", "over", "faces_over",
                "flipped", "degenerate", "duplicate", "closed_shells", "open_sides"):
        bad = [r["path"] for r in rows if r[key]] if key in ("ok_empty", "broken", "faces_over", "flipped", "degenerate", "duplicate", "open_sides", "not_met") else []
        print(f"{key:>14}: {total(key)}" + (f"   in {len(bad)} files: {[b.split('/')[-1] for b in bad[:8]]}" if bad else ""))
    print(f"worst measured / deflection {max(r['worst'] for r in rows):.4f}, OCCT's {max(r['occt_worst'] or 0 for r in rows):.3f};"
          f" OCCT over its deflection in {sum((r['occt_worst'] or 0) > 1 for r in rows)} files")
    if with_ratio:
        print(f"bound / measured: median of medians {statistics.median(r['median'] for r in with_ratio):.4f}, worst median "
              f"{max(r['median'] for r in with_ratio):.3f}, median of p99 {statistics.median(r['p99'] for r in with_ratio):.3f}")
    # Triangles at equal measured error: their number goes with 1 / error.
    fair = [r for r in rows if r["occt_worst"] and r["worst"] > 0.02 and r["occt_worst"] > 0.02 and r["occt_triangles"] and r["triangles"]]
    if fair:
        geo = lambda xs: math.exp(sum(math.log(x) for x in xs) / len(xs))
        print(f"triangles, ours / OCCT, {len(fair)} files: as asked {geo([r['triangles'] / r['occt_triangles'] for r in fair]):.3f}, at equal "
              f"measured error {geo([r['triangles'] * r['worst'] / (r['occt_triangles'] * r['occt_worst']) for r in fair]):.3f}")
        print(f"mesh time, ours {total('mesh_ms'):.0f} ms, certify {total('certify_ms'):.0f} ms; ours / OCCT's reference, geometric mean "
              f"{geo([max(r['mesh_ms'], 1e-3) / r['occt_ms'] for r in fair if r['occt_ms'] > 1]):.4f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
