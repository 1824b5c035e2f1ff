#!/usr/bin/env python3
"""Reading and meshing the public corpus against OpenCASCADE, alternating in one process, with mesh_peer.

usage: tests/corpus/mesh_speed.py [--corpus DIR] [--program mesh_peer] [--kind iges|step] [--only TEXT] [--out FILE.jsonl] [--slow SECONDS]

Each file at the deflection (mm) and angle (0.5 rad) of its line in occt_reference.jsonl. Processor time. Prints what
docs/results.md quotes. The program is the target mesh_peer (not built by default).
"""
import argparse, json, math, os, subprocess, sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corpus", type=Path, default=Path(os.environ.get("TRIMLOOP_CORPUS", ROOT.parent / "shared" / "corpus")))
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "dev" / "tests" / "oracle" / "mesh_peer")
    parser.add_argument("--kind", default="iges")
    parser.add_argument("--only", default="")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "mesh_speed.jsonl")
    parser.add_argument("--slow", type=float, default=60, help="seconds for one file")
    args = parser.parse_args()
    rows, late = [], []
    for line in (args.corpus / "occt_reference.jsonl").read_text().splitlines():
        ref = json.loads(line)
        if not ref["path"].startswith(args.kind + "/") or args.only not in ref["path"] or not ref.get("defl") or not ref.get("triangles"):
            continue
        try:
            done = subprocess.run([args.program, args.corpus / ref["path"], repr(ref["defl"])], stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, timeout=args.slow)
            row = json.loads(done.stdout.splitlines()[-1])
        except (subprocess.TimeoutExpired, ValueError, IndexError) as problem:
            late.append(f"{ref['path']}: {type(problem).__name__}")
            continue
        row["path"] = ref["path"]
        rows.append(row)
    args.out.write_text("".join(json.dumps(r) + "\n" for r in rows))
    geo = lambda xs: math.exp(sum(math.log(x) for x in xs) / len(xs)) if xs else float("nan")
    met = [r for r in rows if r["faces"] and r["triangles"] and r["not_met"] == 0]
    print(f"files {len(rows)}, deflection met in {len(met)}, without a figure {late}")
    speed = lambda r: r["occt_mesh_s"] / max(r["mesh_s"], 1e-7)
    whole = lambda r: (r["occt_mesh_s"] + r["occt_read_s"]) / max(r["mesh_s"] + r["read_s"], 1e-7)
    print(f"mesh, OCCT / ours: {geo([speed(r) for r in met]):.2f}, of files above 1000 triangles of OCCT's "
          f"{geo([speed(r) for r in met if r['occt_triangles'] > 1000]):.2f}; read and mesh {geo([whole(r) for r in met]):.2f}")
    print(f"sums: mesh {sum(r['mesh_s'] for r in rows):.3f} s against {sum(r['occt_mesh_s'] for r in rows):.3f} s, read "
          f"{sum(r['read_s'] for r in rows):.3f} s against {sum(r['occt_read_s'] for r in rows):.3f} s")
    for r in sorted(met, key=speed)[:8]:
        print(f"  slowest: {speed(r):6.2f}  {1e3 * r['mesh_s']:9.2f} ms {1e3 * r['occt_mesh_s']:9.2f} ms, triangles {r['triangles']} against "
              f"{r['occt_triangles']}  {r['path']}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
