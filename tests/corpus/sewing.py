#!/usr/bin/env python3
"""Sewing against OpenCASCADE's: which files with several faces become closed, at ten times their own resolution.

usage: tests/corpus/sewing.py [--corpus DIR] [--trimloop PROGRAM] [--peer sew_peer] [--out FILE] [--only TEXT]

One line of JSON per file goes to OUT, a summary to standard output. Needs the corpus and the program sew_peer
(target of that name where OpenCASCADE is installed).
"""
import argparse, json, subprocess, sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def json_of(command, limit):
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    for line in done.stdout.decode("utf-8", "replace").splitlines():
        if line.startswith("{"):
            try:
                return json.loads(line)
            except ValueError:
                return None
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--corpus", type=Path, default=ROOT.parent / "shared" / "corpus" / "iges")
    parser.add_argument("--trimloop", type=Path, default=ROOT / "build" / "dev" / "cli" / "trimloop")
    parser.add_argument("--peer", type=Path, default=ROOT / "build" / "dev" / "tests" / "oracle" / "sew_peer")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "corpus" / "sewing.jsonl")
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    if not args.corpus.exists():
        print(f"skipped: no corpus at {args.corpus}")
        return 0
    args.out.parent.mkdir(parents=True, exist_ok=True)
    rows = []
    with open(args.out, "w") as out:
        for path in sorted(p for p in args.corpus.rglob("*") if p.suffix.lower() in (".igs", ".iges") and args.only in str(p)):
            plain = json_of([args.trimloop, "info", "--json", path], 60)
            if not plain or plain["model"]["faces"] < 2:
                continue
            resolution = plain["model"]["resolution"]
            ours = json_of([args.trimloop, "info", "--json", "--timings", "--sew", "auto", path], 60)
            check = json_of([args.trimloop, "check", "--json", path], 60)
            theirs = json_of([args.peer, path, repr(10 * resolution)], 60)
            listed = [f for f in (check or {}).get("findings", []) if f["id"] == "SQ-241"]
            row = {"path": str(path.relative_to(args.corpus)), "faces": plain["model"]["faces"], "tolerance": 10 * resolution,
                   "ours": ours and {k: ours["model"][k] for k in ("solids", "shells", "faces", "edges", "volume")},
                   "sew_ms": ours and ours["milliseconds"].get("sew"), "open_listed": len(listed), "occt": theirs}
            rows.append(row)
            out.write(json.dumps(row) + "\n")
            out.flush()
    whole = lambda r: r["occt"] and r["occt"]["closed"] > 0 and r["occt"]["free_edges"] == 0
    ours_whole = lambda r: r["ours"] and r["ours"]["solids"] > 0 and r["open_listed"] == 0
    some = [r for r in rows if r["occt"] and r["occt"]["closed"] > 0]
    print(f"files with two faces or more: {len(rows)}; OpenCASCADE answers for {sum(bool(r['occt']) for r in rows)}")
    print(f"OpenCASCADE closes all of: {sum(map(whole, rows))}; of these closed here: {sum(bool(whole(r) and ours_whole(r)) for r in rows)}")
    print(f"OpenCASCADE closes a shell in: {len(some)}; as many solids or more here in: {sum(bool(r['ours'] and r['ours']['solids'] >= r['occt']['closed']) for r in some)}")
    print(f"closed here and open there: {sum(bool(r['occt'] and ours_whole(r) and not whole(r)) for r in rows)}")
    for r in rows:
        if r["occt"] and (r["occt"]["closed"] != (r["ours"] or {}).get("solids") or bool(whole(r)) != bool(ours_whole(r))):
            print(f"- {r['path']}: {r['faces']} faces at {r['tolerance']:g} mm; ours {r['ours'] and r['ours']['solids']} solids, "
                  f"{r['open_listed']} open edges; OpenCASCADE {r['occt']['closed']} closed shells, {r['occt']['free_edges']} free, "
                  f"{r['occt']['multiple_edges']} multiple edges")
    return 0


if __name__ == "__main__":
    sys.exit(main())
