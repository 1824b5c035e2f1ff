#!/usr/bin/env python3
"""What the reader makes of every public STEP file: opened or refused by name, faces, area and volume against OpenCASCADE's
(occt_reference.jsonl), files that give their bytes back, meshes against OpenCASCADE's fine mesh. Real files and other
projects' fixtures are counted apart. usage: tests/corpus/measure_step.py [--stages info,bytes,mesh] [--only TEXT]"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
from pathlib import Path

from measure import build_tool

ROOT = Path(__file__).resolve().parents[2]
ANGLE_DEG = 28.6478897565  # occt_peer's 0.5 rad


def run(command, seconds=60):
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, timeout=seconds)
        return done.returncode, done.stdout, done.stderr.decode(errors="replace")
    except subprocess.TimeoutExpired:
        return "timeout", b"", ""


def line_of_json(text):
    for line in text.splitlines():
        if line.startswith(b"{"):
            return json.loads(line)
    return None


def close(a, b, tolerance):
    return a is not None and b is not None and abs(a - b) <= tolerance * max(abs(a), abs(b), 1e-300)


def measure(path, reference, nature, args, mesh_check):
    row = {"path": str(path.relative_to(args.corpus)), "nature": nature}
    row["code"], text, words = run([args.trimloop, "info", "--json", "--timings", path])
    row["refusal"] = words.splitlines()[0][-160:] if words else ""
    info = line_of_json(text)
    if info:
        model = info["model"]
        row.update({k: model[k] for k in ("faces", "faces_failed", "faces_healed", "area", "volume", "solids", "curves", "points")})
        row["ms"] = info["milliseconds"]
    row["occt"] = {k: reference.get(k) for k in ("status", "faces", "area", "area_plain", "volume", "solids", "defl", "diag")}
    if "bytes" in args.stages:
        target = args.out / "same.step"
        code, _, _ = run([args.trimloop, "fix", "--none", "--force", "-q", path, target])
        row["same_bytes"] = code == 0 and target.read_bytes() == path.read_bytes()
    if "mesh" in args.stages and info and info["model"]["faces"] and reference.get("faces") and reference.get("defl"):
        stl, report = args.out / "mesh.stl", args.out / "mesh.json"
        code, _, _ = run([args.trimloop, "convert", "--force", "-q", "--deflection", repr(reference["defl"]), "--angle",
                          repr(ANGLE_DEG), "--report", report, path, stl], args.patience)
        row["mesh_code"] = code
        if code == 0:
            row["open_edges"] = json.loads(report.read_text())["open_edges"]
            _, text, _ = run([mesh_check, path, stl], 3 * args.patience)
            check = line_of_json(text)
            if check and check.get("mesh_to_ref") is not None:
                row["distance"] = max(check["mesh_to_ref"], check["ref_to_mesh"]) * check["diag"] / reference["defl"]
    return row


def share(good, of):
    return f"{len(good)} of {len(of)}" + (f" ({100 * len(good) / len(of):.1f} %)" if of else "")


def summary(rows, stages):
    out = []
    for nature in ("real", "synthetic"):
        mine = [r for r in rows if r["nature"] == nature]
        name = {"real": "real files", "synthetic": "fixtures"}[nature]
        opened = [r for r in mine if r["code"] == 0]
        refused = [r for r in mine if r["code"] == 1 and r["refusal"]]
        out.append(f"| {name}: opened / refused by name / neither | {len(opened)} / {len(refused)} / {len(mine) - len(opened) - len(refused)} |")
        read = [r for r in mine if r["occt"]["status"] == 1 and "faces" in r]
        same = [r for r in read if r["faces"] == r["occt"]["faces"]]
        out.append(f"| {name}: faces equal, of those OCCT reads | {share(same, read)} |")
        judged = [r for r in read if r["occt"]["faces"] and (r["occt"]["area"] or 0) > 0 and
                  close(r["occt"]["area"], r["occt"]["area_plain"], 1e-4)]
        area = [r for r in judged if close(r["area"], r["occt"]["area"], 1e-4)]
        out.append(f"| {name}: area within 1e-4 where OCCT's two integrals agree | {share(area, judged)} |")
        solid = [r for r in judged if r["occt"]["solids"] and r["occt"]["volume"]]
        volume = [r for r in solid if close(r["volume"], r["occt"]["volume"], 1e-6)]
        out.append(f"| {name}: volume within 1e-6, files with solids | {share(volume, solid)} |")
        faces = sum(r.get("faces", 0) for r in mine)
        out.append(f"| {name}: faces all / healed / failed | {faces} / {sum(r.get('faces_healed', 0) for r in mine)} / {sum(r.get('faces_failed', 0) for r in mine)} |")
        if "bytes" in stages:
            out.append(f"| {name}: `fix --none` gives the bytes back | {share([r for r in mine if r.get('same_bytes')], [r for r in mine if r['code'] == 0])} |")
        if "mesh" in stages:
            meshed = [r for r in judged if "mesh_code" in r]
            out.append(f"| {name}: two-sided distance <= 1.2 x deflection | {share([r for r in meshed if r.get('distance', math.inf) <= 1.2], meshed)} |")
            closed = [r for r in meshed if r["occt"]["solids"]]
            out.append(f"| {name}: meshes without open edges, files with solids | {share([r for r in closed if r.get('open_edges') == 0], closed)} |")
    out.append("")
    for r in rows:
        o = r["occt"]
        notes = []
        if r["code"] != 0:
            notes.append(f"exit {r['code']}: {r['refusal']}")
        elif o["status"] == 1:
            if r["faces"] != o["faces"]:
                notes.append(f"faces {r['faces']} / {o['faces']}")
            if o["faces"] and o["area"] and not close(r["area"], o["area"], 1e-4):
                notes.append(f"area {r['area']:.8g} / {o['area']:.8g} (plain {o['area_plain']:.8g})")
            if o["solids"] and o["volume"] and not close(r["volume"], o["volume"], 1e-6):
                notes.append(f"volume {r['volume']} / {o['volume']}")
        if r.get("faces_failed"):
            notes.append(f"{r['faces_failed']} faces failed")
        if "bytes" in stages and r["code"] == 0 and not r.get("same_bytes"):
            notes.append("bytes differ")
        if r.get("distance", 0) > 1.2:
            notes.append(f"distance {r['distance']:.2f} deflections")
        if r.get("open_edges") and o["solids"]:
            notes.append(f"{r['open_edges']} open edges")
        if notes:
            out.append(f"- {r['path']}: {'; '.join(notes)}")
    return "| what (ours / OCCT) | result |\n|---|---|\n" + "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corpus", type=Path, default=Path(os.environ.get("TRIMLOOP_CORPUS", ROOT.parent / "shared" / "corpus")))
    parser.add_argument("--mesh-check", type=Path, default=None, help="the program; built from --tools when not given")
    parser.add_argument("--tools", type=Path, default=None, help="folder of mesh_check.cpp")
    parser.add_argument("--trimloop", type=Path, default=ROOT / "build" / "dev" / "cli" / "trimloop")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "corpus" / "step")
    parser.add_argument("--only", default="", help="only files whose path holds this text")
    parser.add_argument("--stages", default="info,bytes")
    parser.add_argument("--patience", type=float, default=60, help="seconds for one conversion")
    args = parser.parse_args()
    args.stages = args.stages.split(",")
    if not (args.corpus / "occt_reference.jsonl").exists():
        print(f"skipped: no corpus at {args.corpus}")
        return 0
    args.out.mkdir(parents=True, exist_ok=True)
    if "mesh" in args.stages and not args.mesh_check:
        folder = args.tools or args.corpus.parent / "tools"
        if not (folder / "mesh_check.cpp").exists():
            print(f"skipped: no mesh_check.cpp in {folder}")
            return 0
        args.mesh_check = build_tool(folder, "mesh_check", args.out)
    references = {}
    for text in (args.corpus / "occt_reference.jsonl").read_text().splitlines():
        entry = json.loads(text)
        references[entry["path"]] = entry
    rows = []
    with open(args.corpus / "MANIFEST.tsv") as manifest, open(args.out / "results.jsonl", "w") as results:
        for entry in sorted(csv.DictReader(manifest, delimiter="\t"), key=lambda e: e["file"]):
            if entry["file"].startswith("step/") and args.only in entry["file"]:
                rows.append(measure(args.corpus / entry["file"], references[entry["file"]], entry["nature"], args, args.mesh_check))
                results.write(json.dumps(rows[-1]) + "\n")
    text = summary(rows, args.stages)
    (args.out / "summary.md").write_text(text)
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
